"""How much memory a file may take, told from its size and what it declares before it is read."""

from __future__ import annotations

import struct
import zipfile
import zlib
from pathlib import Path
from typing import IO

import psutil

from roughcontact.files.file_errors import ReadError
from roughcontact.files.npy import read_npy_header

__all__ = ["BYTES_PER_POINT", "BYTES_TO_LOOK", "needed", "require_memory"]

# Reading a map takes up to 92 bytes a point beside the file itself, most of them for the look at spikes and noise.
BYTES_PER_POINT = 100
# What of these 92 is still to come when the heights are there.
BYTES_TO_LOOK = 84
# Where the number of points cannot be told from outside, the file is taken for numbers of four bytes.
_TIMES_THE_FILE = BYTES_PER_POINT // 4
_DAMAGED = (ValueError, OSError, EOFError, RuntimeError, struct.error, zlib.error, zipfile.BadZipFile)


def require_memory(need: int, file: str) -> None:
    """Refuse a file that takes more memory than is free.

    Parameters
    ----------
    need : int
        Memory that reading it takes from now on [bytes].
    file : str
        Its name.

    Raises
    ------
    ReadError
        If the machine has less free.
    """
    free = psutil.virtual_memory().available
    if need > free:
        raise ReadError(
            file,
            f"reading it needs {need / 1e9:.3g} GB of memory, and {free / 1e9:.3g} GB are free",
            "cut the map or thin it out, or use a machine with more memory",
        )


def needed(stream: IO[bytes], size: int, file: str) -> int:
    """Return an upper estimate of the memory that reading a file of `size` bytes takes [bytes].

    Points are counted from the headers of ``.npy`` and ``.npz``. Any other file is taken to need 25 times its size,
    archives unpacked. What a damaged header declares beyond the end of the file does not count.
    """
    try:
        stream.seek(0)
        if Path(file).suffix.casefold() == ".npy":
            return size + BYTES_PER_POINT * _points(stream, size)
        if zipfile.is_zipfile(stream):
            return _needed_unpacked(stream, size, file)
    except _DAMAGED:
        pass
    return _TIMES_THE_FILE * size


def _needed_unpacked(stream: IO[bytes], size: int, file: str) -> int:
    with zipfile.ZipFile(stream) as archive:
        unpacked = sum(member.file_size for member in archive.infolist())
        if Path(file).suffix.casefold() != ".npz":
            return _TIMES_THE_FILE * max(size, unpacked)
        points = 0
        for member in archive.infolist():
            if member.filename.endswith(".npy"):
                with archive.open(member) as content:
                    points = max(points, _points(content, member.file_size))
        return size + 2 * unpacked + BYTES_PER_POINT * points


def _points(stream: IO[bytes], size: int) -> int:
    """Return the number of points that the header of a NumPy array declares, as far as `size` bytes hold them."""
    header = read_npy_header(stream)
    return min(header.points, size // max(header.dtype.itemsize, 1))
