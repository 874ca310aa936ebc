"""Files that are dropped on the page: limited in size, under names of ours, gone with their session."""

from __future__ import annotations

import re
import secrets
from collections.abc import AsyncIterator
from pathlib import Path

from roughcontact.page.workbench import UploadedFile

__all__ = ["LARGEST", "TooLargeError", "safe_name", "store"]

LARGEST = 512 * 2**20  # bytes: a map of 8000 x 8000 cells in double precision
_LONGEST = 120  # letters of a name


class TooLargeError(ValueError):
    """A file beyond `LARGEST`."""


async def store(
    folder: Path, name: str, stated: int | None, parts: AsyncIterator[bytes]
) -> tuple[str, UploadedFile]:
    """Write a file that comes in parts; return what the page calls it, and where it lies.

    Raises
    ------
    TooLargeError
        If it is, or says that it will be, larger than `LARGEST`; nothing is left of it.
    """
    if stated is not None and stated > LARGEST:
        raise TooLargeError(_words())
    key = secrets.token_hex(8)
    place = folder / key
    place.mkdir(parents=True)
    file = place / safe_name(name)
    size = 0
    try:
        with file.open("xb") as out:
            async for part in parts:
                size += len(part)
                if size > LARGEST:
                    raise TooLargeError(_words())
                out.write(part)
    except BaseException:
        file.unlink(missing_ok=True)
        place.rmdir()
        raise
    return key, UploadedFile(file, name)


def safe_name(name: str) -> str:
    """Return the last part of a file name, of letters that every disk takes; readers go by its ending."""
    last = re.split(r"[/\\]", name)[-1]
    plain = re.sub(r"[^\w.+ -]", "_", last).strip(". ")
    return plain[-_LONGEST:] or "file"


def _words() -> str:
    return f"The file is larger than {LARGEST // 2**20} MB: crop it where it was measured, or use the command line."
