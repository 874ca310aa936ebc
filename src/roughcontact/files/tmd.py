"""TrueMap's format, also that of GelSight: ``.tmd``, all lengths in millimetres."""

from __future__ import annotations

import math
import struct

import numpy as np

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights, line_if_one_row

__all__ = ["read_tmd"]

_MARK = b"Binary TrueMap Data File v2.0"
_COMMENT = 32  # where the comment begins
_LONGEST = 256  # bytes of zeros behind it
_HEADER = struct.Struct("<2I4f")  # points, sides and offsets, each x before y
_AGAIN = "copy the file again, or export it as X3P"


def read_tmd(data: bytes) -> HeightMap:
    """Return the one map of the file; after a comment of any length, the header must fit the length exactly."""
    if not data.startswith(_MARK):
        raise ContentError("it does not begin as a TrueMap file of version 2.0", "check its extension")
    end = data.find(b"\0", _COMMENT)
    # A zero ends the comment; some writers add further zeros.
    for start in range(
        end + 1 + _HEADER.size, min(end + _LONGEST + _HEADER.size, len(data)) if end >= 0 else 0
    ):
        nx, ny, lx, ly, *_ = _HEADER.unpack_from(data, start - _HEADER.size)
        if data[end : start - _HEADER.size].strip(b"\0"):
            break
        if nx > 0 and ny > 0 and len(data) - start == 4 * nx * ny:
            return _map(data, start, (ny, nx), (ly, lx))
    raise ContentError("its numbers of points and its length contradict each other: it is damaged", _AGAIN)


def _map(data: bytes, start: int, shape: tuple[int, int], sides: tuple[float, float]) -> HeightMap:
    if not all(math.isfinite(side) and side > 0 for side in sides):
        raise ContentError(f"its header states sides of {sides[1]:g} x {sides[0]:g} mm", _AGAIN)
    heights = as_heights(np.frombuffer(data, "<f4", offset=start).reshape(shape))
    spacing = (sides[0] * 1e-3 / shape[0], sides[1] * 1e-3 / shape[1])
    return line_if_one_row(HeightMap(heights, "TrueMap", unit="mm", spacing=spacing))
