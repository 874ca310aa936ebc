"""ImageData of VTK, for ParaView: an XML header and the numbers appended as they are."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np
import numpy.typing as npt

from roughcontact.grid import AnyGrid, RadialGrid

__all__ = ["vti_bytes"]


def vti_bytes(fields: Mapping[str, npt.NDArray[Any]], grid: AnyGrid) -> bytes:
    """Return a ``.vti`` file of cell fields, each of the shape of the grid; NaN stays NaN, truth values are 0 and 1.

    The first row is the top of the picture: rows are turned round, so that y counts upwards from the lower left
    corner of the map.

    Raises
    ------
    ValueError
        If the grid is one of rings, which image data cannot hold.
    """
    if isinstance(grid, RadialGrid):
        raise ValueError("ParaView's image data hold cells in rows, not rings; write another format")
    ny, nx = (1, *grid.shape)[-2:]
    dy, dx = (grid.spacing[-1], *grid.spacing)[-2:]
    extent = f"0 {nx} 0 {ny if grid.ndim == 2 else 0} 0 0"
    arrays, blocks, offset = [], [], 0
    for name, values in fields.items():
        kind, dtype = ("UInt8", "u1") if values.dtype.kind == "b" else ("Float64", "<f8")
        numbers = np.ascontiguousarray(values[::-1] if grid.ndim == 2 else values, dtype=dtype).tobytes()
        arrays.append(
            f'<DataArray type="{kind}" Name={quoteattr(name)} format="appended" offset="{offset}"/>'
        )
        blocks += [struct.pack("<Q", len(numbers)), numbers]
        offset += 8 + len(numbers)
    head = (
        '<?xml version="1.0"?>\n'
        '<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n'
        f'<ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="{dx!r} {dy!r} {min(dx, dy)!r}">\n'
        f'<Piece Extent="{extent}">\n<CellData>\n'
        + "\n".join(arrays)
        + "\n</CellData>\n</Piece>\n</ImageData>\n"
        '<AppendedData encoding="raw">\n_'
    )
    return b"".join([head.encode(), *blocks, b"\n</AppendedData>\n</VTKFile>\n"])
