"""Standard input and output as files: ``-`` holds a surface as .npz, ``x3p:-`` one in the format that is named."""

from __future__ import annotations

import io
import os
import re
import sys
import zipfile
from functools import lru_cache
from typing import IO, Any

from roughcontact.files.file_errors import ContentError

__all__ = ["kind_of", "standard", "standard_input", "write_standard_output"]

_NAME = re.compile(r"(?:(\w+):)?-")
_FORMAT = "npz"  # this format keeps everything


def standard(path: str | os.PathLike[str]) -> str | None:
    """Return the extension of the format if a path stands for standard input or output, otherwise None."""
    match = _NAME.fullmatch(os.fsdecode(path))
    return None if match is None else f".{match[1] or _FORMAT}".casefold()


def kind_of(path: str | os.PathLike[str]) -> str:
    """Return the extension of a file, or of the format of standard input or output, in lower case."""
    return standard(path) or os.path.splitext(os.fsdecode(path))[1].casefold()


def standard_input(path: str | os.PathLike[str]) -> bytes:
    """Return the bytes of standard input, the same at each call; a format that is not named is detected.

    Raises
    ------
    ContentError
        If standard input is empty, or not in the default format and no format is named.
    """
    data = _read(sys.stdin)
    if not data:
        raise ContentError("standard input is empty", "check whether the command before the pipe failed")
    if os.fsdecode(path) == "-" and not _is_npz(data):
        raise ContentError("it is not .npz", "name its format, such as x3p:- or txt:-")
    return data


def write_standard_output(data: bytes) -> None:
    """Write a file to standard output."""
    sys.stdout.flush()
    sys.stdout.buffer.write(data)
    sys.stdout.buffer.flush()


@lru_cache(maxsize=1)  # a file is read more than once: its channels, its heights, its fingerprint
def _read(stream: IO[Any]) -> bytes:
    if stream.isatty():
        raise ContentError("standard input is a terminal", "pipe a surface into the command, or name a file")
    data: bytes = stream.buffer.read()  # type: ignore[attr-defined]
    return data


def _is_npz(data: bytes) -> bool:
    if not zipfile.is_zipfile(io.BytesIO(data)):
        return False
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return any(name.endswith(".npy") for name in archive.namelist())
