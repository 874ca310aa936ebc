"""Points x, y, z put on the regular grid on which they lie, with or without gaps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_bounds import BYTES_PER_POINT, require_memory
from roughcontact.files.file_errors import ContentError
from roughcontact.files.table_axes import counts
from roughcontact.validation import Array

__all__ = ["PointGrid", "grid_of_points"]

# Coordinates are printed with few digits: a point may lie this far from its place, in steps of the grid.
_SLACK = 0.1
# Scattered points that are printed with few digits also lie on a grid, but fill much less of it.
_LEAST_FILLED = 0.02
_REMEDY = "give points on a regular grid, one a place; interpolate scattered points first"


@dataclass(frozen=True, slots=True, eq=False)
class PointGrid:
    """Heights (ny, nx), the row of the smallest y first, the steps (dy, dx) between them, and warnings.

    `numbered` is true if the coordinates only number the points, 0, 1, 2, ... or from 1, along both axes.
    """

    heights: Array
    steps: tuple[float, float]
    numbered: bool
    warnings: tuple[str, ...]


def grid_of_points(points: Array) -> PointGrid:
    """Return points, shape (n, 3), on their grid; a place without a point is NaN.

    Raises
    ------
    ContentError
        If they are scattered, share a place, or lie on a line.
    """
    if not np.isfinite(points[:, :2]).all():
        raise ContentError("a coordinate x or y is not finite", "leave out points without a place")
    x, y, z = points.T
    columns, dx = _places(x, "x")
    rows, dy = _places(y, "y")
    ny, nx = int(rows.max()) + 1, int(columns.max()) + 1
    if len(z) < _LEAST_FILLED * nx * ny:
        raise ContentError(
            f"its {len(z)} points are scattered: they fill a grid of {ny} x {nx} badly", _REMEDY
        )
    require_memory(BYTES_PER_POINT * nx * ny)
    heights: Array = np.full((ny, nx), np.nan)
    heights[rows, columns] = z
    if len(np.unique(rows * nx + columns)) != len(z):
        raise ContentError("two of its points share one place", _REMEDY)
    numbered = all(counts(np.unique(each)) for each in (x, y))
    return PointGrid(heights, (dy, dx), numbered, _cut_short(rows, columns, (ny, nx)))


def _cut_short(
    rows: npt.NDArray[np.intp], columns: npt.NDArray[np.intp], shape: tuple[int, int]
) -> tuple[str, ...]:
    """Return a warning where points in the order of a scan end within its last line."""
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
    # The smallest gap has the rounding error of printed digits; the median of similar gaps has not.
    step = float(np.median(gaps[gaps < 1.5 * gaps.min()]))
    counted = np.rint(gaps / step)
    # Points are counted gap by gap: rounding does not add up along the axis.
    if counted.sum() > 4 * len(coordinates) or (np.abs(gaps / step - counted) > _SLACK).any():
        raise ContentError(f"its points are scattered: the steps in {axis} are not equal", _REMEDY)
    places = np.concatenate([[0], np.cumsum(counted)]).astype(np.intp)
    return places[inverse.reshape(-1)], float((levels[-1] - levels[0]) / places[-1])
