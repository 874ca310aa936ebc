"""What the header of a ``.npy`` file says, checked before anything is allocated."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import IO, Any

import numpy as np
import numpy.typing as npt

__all__ = ["NpyHeader", "read_npy_header"]

_MAGIC = b"\x93NUMPY"
_LONGEST = 10_000  # bytes of a header, as in NumPy
# NumPy evaluates the header as Python; numbers need no more than these, and nothing that can warn. Python 2 wrote 3L.
_DESCR = re.compile(r"""['"]descr['"]\s*:\s*['"]([<>|=]?[biufcSUVmM?]\d*(?:\[\w+\])?)['"]""")
_ORDER = re.compile(r"""['"]fortran_order['"]\s*:\s*(True|False)""")
_SHAPE = re.compile(r"""['"]shape['"]\s*:\s*\(((?:\d{1,18}L?\s*,\s*)*(?:\d{1,18}L?\s*)?)\)""")


@dataclass(frozen=True, slots=True)
class NpyHeader:
    """Type and shape of an array, and where in the file its values begin."""

    dtype: np.dtype[Any]
    shape: tuple[int, ...]
    fortran: bool
    offset: int

    @property
    def points(self) -> int:
        """Number of values."""
        return math.prod(self.shape)

    @property
    def size(self) -> int:
        """Size of header and values [bytes]."""
        return self.offset + self.points * self.dtype.itemsize

    def array(self, data: bytes) -> npt.NDArray[Any]:
        """Return the values in `data`, the whole file, as they lie there."""
        values: npt.NDArray[Any] = np.ndarray(
            self.shape, self.dtype, data, self.offset, order="F" if self.fortran else "C"
        )
        return values


def read_npy_header(stream: IO[bytes]) -> NpyHeader:
    """Return the header at the beginning of `stream`.

    Raises
    ------
    ValueError
        If it is damaged, or of an array of objects or named fields.
    """
    start = stream.read(12)
    version = start[6:8]
    if not start.startswith(_MAGIC) or version not in (b"\1\0", b"\2\0", b"\3\0"):
        raise ValueError("it does not begin as one")
    wide = version != b"\1\0"
    length = int.from_bytes(start[8:12] if wide else start[8:10], "little")
    offset = length + (12 if wide else 10)
    if length > _LONGEST:
        raise ValueError(f"a header of {length} bytes")
    text = (start + stream.read(offset - len(start)))[:offset].decode("latin-1")
    found = [pattern.search(text) for pattern in (_DESCR, _ORDER, _SHAPE)]
    if len(text) < offset or None in found:
        raise ValueError("its header is damaged, or of values of no plain type")
    descr, order, shape = (match[1] for match in found if match is not None)
    counts = tuple(int(n.strip().rstrip("L")) for n in shape.split(",") if n.strip())
    try:
        dtype = np.dtype(descr)
    except TypeError as error:
        raise ValueError(f"values of type {descr}") from error
    return NpyHeader(dtype, counts, order == "True", offset)
