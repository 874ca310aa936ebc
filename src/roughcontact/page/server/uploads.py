"""Files that are dropped on the page: limited in size, under names of ours, gone with their session."""

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
_TOGETHER = (
    4 * LARGEST
)  # bytes of all that a tab has dropped: where temporary files lie in memory, it is limited
_TOO_LARGE = (
    f"The file is larger than {LARGEST // 2**20} MB",
    "crop it in the program that wrote it, or use the command line.",
)
_LONGEST = 120  # bytes of a name
_PATIENCE = 60.0  # seconds in which something of the file must come


class TooLargeError(InputError):
    """A file beyond `LARGEST`, or one too many."""


class TooSlowError(InputError):
    """A file of which nothing comes any more."""


async def store(
    folder: Path, name: str, stated: int | None, parts: AsyncIterator[bytes]
) -> tuple[str, UploadedFile]:
    """Write a file that comes in parts; return what the page calls it, and where it lies.

    Raises
    ------
    TooLargeError
        If it is, or says that it will be, larger than `LARGEST`, or the folder holds too much; nothing is left of it.
    TooSlowError
        If nothing comes for a minute; nothing is left of it.
    OSError
        If the disk does not take it, or the folder is gone; nothing is left of it.
    """
    if stated is not None and stated > LARGEST:
        raise TooLargeError(*_TOO_LARGE)
    if sum(each.stat().st_size for each in folder.glob("*/*")) > _TOGETHER - LARGEST:
        raise TooLargeError(
            "This tab holds many large files already", "load the page again, then drop this file."
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
    """Yield the parts as they come, if they do."""
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
    """Return the last part of a file name, of letters that every disk takes; readers go by its ending."""
    last = re.split(r"[/\\]", name)[-1]
    plain = re.sub(r"[^\w.+ -]", "_", last).strip(". ")
    return plain.encode()[-_LONGEST:].decode(errors="ignore").strip(". ") or "file"


def shown_name(name: str) -> str:
    """Return a file name as one word of a command: no folder, no letter that breaks a line, no dash that begins it."""
    last = "".join(each if each.isprintable() else "_" for each in re.split(r"[/\\]", name)[-1])[-_LONGEST:]
    return f"./{last}" if last.startswith("-") else last or "file"
