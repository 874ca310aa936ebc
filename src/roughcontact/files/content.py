"""The bytes of an ordinary file, as many as it says and the memory holds."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import BinaryIO

from roughcontact.files.file_errors import ReadError
from roughcontact.files.file_memory import needed, require_memory

__all__ = ["content"]

_COPY = "copy or export the file again"


def content(path: str | os.PathLike[str]) -> tuple[str, bytes]:
    """Return the name of a file and its bytes.

    Raises
    ------
    ReadError
        If it is missing, empty, no ordinary file (a folder, a device, a pipe, what the system makes up while it is
        read), or if reading it takes more memory than is free.
    """
    # A name may hold bytes that are no letters; in messages and provenance they become question marks.
    name = (Path(path).name or str(path)).encode("utf-8", "replace").decode("utf-8")
    try:
        # To open a device may set it going.
        _require_ordinary(os.stat(path), name)
        with open(path, "rb", opener=_without_waiting) as stream:
            return name, _read(stream, name)
    except ReadError:
        raise
    except (OSError, ValueError, MemoryError) as error:  # ValueError: a zero byte in the name
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        raise ReadError(
            name, f"it cannot be opened ({reason})", "check the path and the permissions"
        ) from error


def _read(stream: BinaryIO, name: str) -> bytes:
    status = os.fstat(stream.fileno())  # another file may have taken the place of the one that was looked at
    _require_ordinary(status, name)
    if status.st_size == 0:
        # Files that the system makes up say so too, and some of them have no end.
        raise ReadError(name, "it is empty, or no ordinary file", _COPY)
    require_memory(needed(stream, status.st_size, name), name)
    stream.seek(0)
    data = stream.read(status.st_size + 1)
    if len(data) != status.st_size:
        raise ReadError(
            name, f"it does not hold the {status.st_size} bytes that it should, or is being written", _COPY
        )
    return data


def _require_ordinary(status: os.stat_result, name: str) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise ReadError(name, "it is a folder", "name a file in it")
    if not stat.S_ISREG(status.st_mode):
        raise ReadError(name, "it is a device, a pipe or a socket", "save it as an ordinary file first")


def _without_waiting(path: str, flags: int) -> int:
    """Open a file; a pipe that takes its place meanwhile does not wait for its other end."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))
