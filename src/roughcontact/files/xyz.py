"""Heights as a list of points x, y, z that lie on a regular grid, with or without gaps."""

from __future__ import annotations

import re
from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.numbers import parse_table
from roughcontact.validation import Array

__all__ = ["read_xyz"]

# Coordinates are printed with few digits: a point may lie this far from its place, in steps of the grid.
_SLACK = 0.1
# A scan keeps most of its points; a list that fills less of its grid is scattered.
_LEAST_FILLED = 0.25
_REMEDY = "give points on a regular grid, one a place; interpolate scattered points first"


def read_xyz(data: bytes) -> HeightMap:
    """Return the points on their grid; a place without a point is NaN, the first row has the smallest y.

    A header such as ``# x [um]  y [um]  z [um]`` states the units; without it all three columns are in the
    unit of the heights.
    """
    table = parse_table(data)
    if table.values.shape[1] != 3:
        raise ContentError(f"its rows hold {table.values.shape[1]} numbers", "give three columns x, y, z")
    if not np.isfinite(table.values[:, :2]).all():
        raise ContentError("a coordinate x or y is not finite", "leave out points without a place")
    x, y, z = table.values.T
    columns, dx = _places(x, "x")
    rows, dy = _places(y, "y")
    ny, nx = int(rows.max()) + 1, int(columns.max()) + 1
    if len(z) < _LEAST_FILLED * nx * ny:
        raise ContentError(
            f"its {len(z)} points are scattered: they fill a grid of {ny} x {nx} badly", _REMEDY
        )
    heights: Array = np.full((ny, nx), np.nan)
    heights[rows, columns] = z
    if len(np.unique(rows * nx + columns)) != len(z):
        raise ContentError("two of its points share one place", _REMEDY)
    units = _units(table.comments)
    return HeightMap(
        as_heights(heights),
        "xyz",
        unit=units[2] if units else None,
        spacing=(dy * length_factor(units[1]), dx * length_factor(units[0])) if units else None,
        steps=(dy, dx),
        notes=("the first row has the smallest y",),
        doubts=(*table.doubts, *_cut_short(rows, columns, (ny, nx))),
    )


def _cut_short(
    rows: npt.NDArray[np.intp], columns: npt.NDArray[np.intp], shape: tuple[int, int]
) -> tuple[str, ...]:
    """Return a doubt where points in the order of a scan end within its last line."""
    ny, nx = shape
    for places in (rows * nx + columns, columns * ny + rows):
        if len(places) < ny * nx and np.array_equal(places, np.arange(len(places))):
            return (f"it ends after {len(places)} of {ny * nx} points, within a line: it may be cut short",)
    return ()


def _places(coordinates: Array, axis: str) -> tuple[npt.NDArray[np.intp], float]:
    """Return each point's place 0, 1, 2, ... along an axis, and the step of the grid."""
    levels, inverse = np.unique(coordinates, return_inverse=True)
    if len(levels) < 2:
        raise ContentError(
            f"all its points share one {axis}: it is a profile",
            "give a two-dimensional map, or use read_line on places and heights",
        )
    gaps = np.diff(levels)
    # The smallest gap is off by the printed digits; the median of those like it is not.
    step = float(np.median(gaps[gaps < 1.5 * gaps.min()]))
    counts = np.rint(gaps / step)
    # Places are counted gap by gap, so that rounding does not add up along the axis.
    if counts.sum() > 4 * len(coordinates) or (np.abs(gaps / step - counts) > _SLACK).any():
        raise ContentError(f"its points are scattered: the steps in {axis} are not equal", _REMEDY)
    places = np.concatenate([[0], np.cumsum(counts)]).astype(np.intp)
    return places[inverse.reshape(-1)], float((levels[-1] - levels[0]) / places[-1])


def _units(comments: Iterable[str]) -> tuple[str, ...] | None:
    """Return the units of x, y and z from the first comment that names three lengths in brackets."""
    for comment in comments:
        units = tuple(re.findall(r"[\[(]\s*([^\])]+?)\s*[\])]", comment))
        if len(units) == 3 and all(map(is_length, units)):
            return units
    return None
