"""Bounds on files that nobody vouches for: the memory they take, what they unpack to, how often they are read."""

from __future__ import annotations

import zipfile
from collections.abc import Callable
from io import BytesIO
from typing import Any

from roughcontact.files.file_errors import ContentError, damage
from roughcontact.memory import require_free

__all__ = ["BYTES_PER_POINT", "BYTES_TO_LOOK", "BoundedStream", "require_memory", "unzip"]

# Reading a map takes up to 92 bytes a point beside the file itself, most of them for the look at spikes and noise.
BYTES_PER_POINT = 100
# What of these 92 is still to come when the heights are there.
BYTES_TO_LOOK = 84
# The other methods unpack without a bound on what one step may give; neither NumPy nor X3P use them.
_BOUNDED = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
# Finding out a format reads the beginning some forty times, so a small file is read over hundreds of times. Beyond
# that, whole files take up to 55 times their size, and a call for every 60 bytes.
_BYTES, _TIMES = 500_000_000, 500
_CALLS, _BYTES_A_CALL = 100_000, 10


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
    # A damaged archive fails in a dozen ways, from struct.error to zlib.error.
    problem, remedy = "its zip archive is damaged or cut short", "copy or export the file again"
    with damage(problem, remedy), zipfile.ZipFile(BytesIO(data)) as archive:
        members = [member for member in archive.infolist() if wanted(member.filename)]
        require_memory(sum(member.file_size for member in members))
        return {member.filename: _content(archive, member) for member in members}


def _content(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> bytes:
    """Return what is in a member: never more than it declares, whatever its compressed bytes unpack to."""
    if member.compress_type not in _BOUNDED:
        raise zipfile.BadZipFile(f"{member.filename} is compressed by method {member.compress_type}")
    with archive.open(member) as stream:
        content = stream.read(member.file_size + 1)
    if len(content) != member.file_size:
        raise zipfile.BadZipFile(f"{member.filename} ends after {len(content)} of {member.file_size} bytes")
    return content


class BoundedStream(BytesIO):
    """The content of a file, to be read only so often: a damaged header can point a reader back to itself for ever.

    Readers of all kinds expect the whole interface of a binary file, which is why this is one. It is nobody else's:
    what was checked and hashed cannot change while it is read.

    Parameters
    ----------
    data : bytes
        The content.
    name : str
        Name to go by, for readers that know a format by its extension; no file of that name is there.

    Raises
    ------
    RuntimeError
        From a read beyond the bounds, and from every one after it.
    """

    def __init__(self, data: bytes, name: str) -> None:
        super().__init__(data)
        self.name = name
        self._size = len(data)
        self._bytes = _BYTES + _TIMES * len(data)
        self._calls = _CALLS + len(data) // _BYTES_A_CALL
        self._furthest = 0

    @property
    def unread(self) -> int:
        """Number of bytes at the end that nothing has been read of since `forget`."""
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
        """Fill `buffer` and return how many bytes that took."""
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
