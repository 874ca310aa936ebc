"""The bytes of an ordinary file, checked against its stated size and the free memory."""

from __future__ import annotations

import io
import os
import stat
import struct
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, BinaryIO

from roughcontact.files.file_bounds import BYTES_PER_POINT, require_memory
from roughcontact.files.file_errors import ContentError, ReadError
from roughcontact.files.numpy_files import read_npy_header
from roughcontact.files.standard_streams import standard, standard_input

__all__ = ["content", "named", "needed", "ordinary_file"]

_COPY = "copy or export the file again"
# If the number of points is not known from outside, numbers of four bytes are assumed.
_TIMES_THE_FILE = BYTES_PER_POINT // 4
_DAMAGED = (ValueError, OSError, EOFError, RuntimeError, struct.error, zlib.error, zipfile.BadZipFile)


@contextmanager
def content(path: str | os.PathLike[str]) -> Iterator[tuple[str, bytes]]:
    """Yield the name of a file, or of standard input, and its bytes; errors of reading name the file.

    Raises
    ------
    ReadError
        If it is missing, empty, not an ordinary file (a folder, a device, a pipe, a file that the system generates
        while it is read), if reading it takes more memory than is free, or if the block raises `ContentError`.
    """
    with named(path) as name:
        if (kind := standard(path)) is not None:
            data = standard_input(path)
            require_memory(needed(io.BytesIO(data), len(data), kind))
            yield f"standard input{kind}", data
            return
        with ordinary_file(path) as stream:
            data = _read(stream, Path(name).suffix.casefold())
        yield name, data


@contextmanager
def named(path: str | os.PathLike[str]) -> Iterator[str]:
    """Yield the name of a file; a `ContentError` of the block becomes a `ReadError` that names the file."""
    # A name may hold bytes that are not letters; in messages and provenance they become question marks.
    name = (Path(path).name or str(path)).encode("utf-8", "replace").decode("utf-8")
    try:
        yield name
    except ContentError as error:
        raise ReadError(name, error.message, error.remedy, error.place) from error.__cause__


@contextmanager
def ordinary_file(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """Yield a file opened for reading; refuse any but an ordinary file, and report errors of reading."""
    try:
        # Opening a device may start it.
        _require_ordinary(os.stat(path))
        with open(path, "rb", opener=_without_waiting) as stream:
            _require_ordinary(
                os.fstat(stream.fileno())
            )  # another file may have replaced the one that was checked
            yield stream
    except ContentError:
        raise
    except (OSError, ValueError, MemoryError) as error:  # ValueError: a zero byte in the name
        reason = getattr(error, "strerror", None) or str(error) or type(error).__name__
        raise ContentError(f"it cannot be opened ({reason})", "check the path and the permissions") from error


def _read(stream: BinaryIO, kind: str) -> bytes:
    status = os.fstat(stream.fileno())
    if status.st_size == 0:
        # Files that the system generates also state size 0, and some of them have no end.
        raise ContentError("it is empty, or not an ordinary file", _COPY)
    require_memory(needed(stream, status.st_size, kind))
    stream.seek(0)
    data = stream.read(status.st_size + 1)
    if len(data) != status.st_size:
        raise ContentError(
            f"it does not hold the {status.st_size} bytes that it should, or is being written", _COPY
        )
    return data


def _require_ordinary(status: os.stat_result) -> None:
    if stat.S_ISDIR(status.st_mode):
        raise ContentError("it is a folder", "name a file in it")
    if not stat.S_ISREG(status.st_mode):
        raise ContentError("it is a device, a pipe or a socket", "save it as an ordinary file first")


def _without_waiting(path: str, flags: int) -> int:
    """Open a file; if a pipe has replaced it meanwhile, do not wait for its other end."""
    return os.open(path, flags | getattr(os, "O_NONBLOCK", 0))


def needed(stream: IO[bytes], size: int, kind: str) -> int:
    """Return an upper estimate of the memory that reading a file of `size` bytes takes [bytes].

    Points are counted from the headers of ``.npy`` and ``.npz``. Any other file is assumed to need 25 times its size,
    that of its unpacked contents for an archive. Points that a damaged header declares beyond the end of the file do
    not count.
    """
    try:
        stream.seek(0)
        if kind == ".npy":
            return size + BYTES_PER_POINT * _points(stream, size)
        if zipfile.is_zipfile(stream):
            return _needed_unpacked(stream, size, kind)
    except _DAMAGED:
        pass
    return _TIMES_THE_FILE * size


def _needed_unpacked(stream: IO[bytes], size: int, kind: str) -> int:
    with zipfile.ZipFile(stream) as archive:
        unpacked = sum(member.file_size for member in archive.infolist())
        if kind != ".npz":
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
