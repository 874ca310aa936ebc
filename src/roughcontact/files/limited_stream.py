"""Bytes in memory as a stream that ends the work of a reader which goes round in circles."""

from __future__ import annotations

from io import BytesIO
from typing import Any

__all__ = ["BoundedStream"]

# Finding out a format reads the beginning some forty times, so a small file is read over hundreds of times. Beyond
# that, whole files take up to 55 times their size, and a call for every 60 bytes.
_BYTES, _TIMES = 500_000_000, 500
_CALLS, _BYTES_A_CALL = 100_000, 10


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
