"""Bounds for files that cannot be trusted: memory, size after unpacking, number of reads."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from io import BytesIO
from typing import Any

from roughcontact.files.file_errors import ContentError, damage
from roughcontact.memory import require_free

__all__ = ["BYTES_PER_POINT", "BYTES_TO_LOOK", "BoundedStream", "require_memory", "unzip"]

# Reading a map takes up to 92 bytes a point beside the file, most of them in the search for spikes and noise.
BYTES_PER_POINT = 100
# The part of these 92 that is allocated after the heights.
BYTES_TO_LOOK = 84
# The other methods have no bound on the output of one step of unpacking; neither NumPy nor X3P uses them.
_BOUNDED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
# To detect a format, the beginning is read about forty times: hundreds of times the size of a small file. Beyond
# that, reading a whole file takes up to 55 times its size, and a call for every 60 bytes.
_BYTES, _TIMES, _BYTES_A_CALL = 500_000_000, 500, 10


def require_memory(need: int) -> None:
    """Refuse a file that takes more memory than is free.

    Parameters
    ----------
    need : int
        Memory that reading it takes from now on [bytes].
    file : str
        Its name.

    Raises
    ------
    ContentError
        If the machine has less free.
    """
    require_free(need, "reading it", "cut the map or subsample it", ContentError)


def unzip(data: bytes, wanted: Callable[[str], bool]) -> dict[str, bytes]:
    """Return the members whose name is `wanted`, by name, each checked against its size and checksum."""
    # A damaged archive raises a dozen kinds of errors, from struct.error to zlib.error.
    problem, remedy = "its zip archive is damaged or cut short", "copy or export the file again"
    with damage(problem, remedy), zipfile.ZipFile(BytesIO(data)) as archive:
        members = [member for member in archive.infolist() if wanted(member.filename)]
        require_memory(sum(member.file_size for member in members))
        return {member.filename: _content(archive, member) for member in members}


def _content(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes:
    """Return the content of a member, at most the declared size, whatever its compressed bytes unpack to."""
    if member.compress_type not in _BOUNDED:
        raise zipfile.BadZipFile(f"{member.filename} is compressed by method {member.compress_type}")
    with archive.open(member) as stream:
        content = stream.read(member.file_size + 1)
    if len(content) != member.file_size:
        raise zipfile.BadZipFile(f"{member.filename} ends after {len(content)} of {member.file_size} bytes")
    return content


class BoundedStream(BytesIO):
    """The content of a file with a limited number of reads: a damaged header can send a reader into an endless loop.

    It is a complete binary file, because the readers expect that interface. It is a private copy: the checked and
    hashed bytes cannot change while they are read.

    Parameters
    ----------
    data : bytes
        The content.
    name : str
        Name for readers that detect a format by its extension; no file of that name exists.

    Raises
    ------
    RuntimeError
        At a read beyond the bounds, and at every later read.
    """

    calls = 100_000  # besides one for every ten bytes: many readers read a text line by line

    def __init__(self, data: bytes, name: str) -> None:
        super().__init__(data)
        self.name, self._size = name, len(data)
        self._bytes = _BYTES + _TIMES * len(data)
        self._calls = self.calls + len(data) // _BYTES_A_CALL
        self._furthest = 0

    @property
    def unread(self) -> int:
        """Number of bytes at the end that have not been read since the last call of `forget`."""
        return self._size - self._furthest

    def forget(self) -> None:
        """Count every byte as unread again."""
        self._furthest = 0

    def read(self, size: int | None = -1, /) -> bytes:
        """Return the next `size` bytes."""
        return self._counted(super().read(size))

    def read1(self, size: int | None = -1, /) -> bytes:
        """Return the next `size` bytes."""
        return self._counted(super().read1(size))

    def readline(self, size: int | None = -1, /) -> bytes:
        """Return the next line."""
        return self._counted(super().readline(size))

    def readinto(self, buffer: Any, /) -> int:
        """Fill `buffer` and return the number of bytes read."""
        count = super().readinto(buffer)
        self._count(count)
        return count

    def _counted(self, content: bytes) -> bytes:
        self._count(len(content))
        return content

    def _count(self, size: int) -> None:
        self._bytes -= size
        self._calls -= 1
        self._furthest = max(self._furthest, self.tell())
        if self._bytes < 0 or self._calls < 0:
            raise RuntimeError("its header leads round in circles")
