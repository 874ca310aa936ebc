"""Files that are dropped on the page: limited in size, stored under safe names, removed with their session."""

from __future__ import annotations

import asyncio
import re
import secrets
import shutil
from collections.abc import AsyncIterator
from pathlib import Path

from roughcontact.errors import InputError
from roughcontact.page.jobs.session_cache import UploadedFile

__all__ = ["LARGEST", "TooLargeError", "TooSlowError", "safe_name", "shown_name", "store"]

LARGEST = 512 * 2**20  # bytes: a map of 8000 x 8000 cells in double precision
_TOGETHER = 4 * LARGEST  # bytes of all files of a tab: on some systems temporary files are in memory
_TOO_LARGE = (
    f"The file is larger than {LARGEST // 2**20} MB",
    "crop it in the program that wrote it, or use the command line.",
)
_LONGEST = 120  # bytes of a name
_PATIENCE = 60.0  # seconds without data after which an upload is ended


class TooLargeError(InputError):
    """A file larger than `LARGEST`, or one file too many."""


class TooSlowError(InputError):
    """A file whose upload has stalled."""


async def store(
    folder: Path, name: str, stated: int | None, parts: AsyncIterator[bytes]
) -> tuple[str, UploadedFile]:
    """Write a file that comes in parts; return its name on the page, and its path.

    Raises
    ------
    TooLargeError
        If its size or its stated size exceeds `LARGEST`, or the folder is full; the file is removed.
    TooSlowError
        If no data arrive for a minute; the file is removed.
    OSError
        If it cannot be stored on the disk, or the folder is missing; the file is removed.
    """
    if stated is not None and stated > LARGEST:
        raise TooLargeError(*_TOO_LARGE)
    if sum(each.stat().st_size for each in folder.glob("*/*")) > _TOGETHER - LARGEST:
        raise TooLargeError(
            "This tab holds many large files already", "reload the page, then drop this file."
        )
    key = secrets.token_hex(8)
    place = folder / key
    place.mkdir()
    file = place / safe_name(name)
    size = 0
    try:
        with file.open("xb") as out:
            async for part in _steady(parts):
                size += len(part)
                if size > LARGEST:
                    raise TooLargeError(*_TOO_LARGE)
                out.write(part)
    except BaseException:
        shutil.rmtree(place, ignore_errors=True)
        raise
    return key, UploadedFile(file, shown_name(name))


async def _steady(parts: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
    """Yield the parts as they come; raise an error if none comes in time."""
    while True:
        try:
            async with asyncio.timeout(_PATIENCE):
                part = await anext(parts)
        except StopAsyncIteration:
            return
        except TimeoutError:
            raise TooSlowError("The upload has stopped", "drop the file again.") from None
        yield part


def safe_name(name: str) -> str:
    """Return the last part of a file name, of letters valid on every disk; readers use its ending."""
    last = re.split(r"[/\\]", name)[-1]
    plain = re.sub(r"[^\w.+ -]", "_", last).strip(". ")
    return plain.encode()[-_LONGEST:].decode(errors="ignore").strip(". ") or "file"


def shown_name(name: str) -> str:
    """Return a file name as one word of a command: without folder, line breaks or a leading dash."""
    last = "".join(each if each.isprintable() else "_" for each in re.split(r"[/\\]", name)[-1])[-_LONGEST:]
    return f"./{last}" if last.startswith("-") else last or "file"
