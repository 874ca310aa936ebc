"""A table of numbers without further information: heights, heights with coordinates, or a list of points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap
from roughcontact.files.point_grid import grid_of_points
from roughcontact.files.table_axes import axes_of, counts
from roughcontact.validation import Array

__all__ = ["heights_alone", "points_in", "require_no_list"]

_LISTED = 8  # rows from which on two or three columns count as coordinates and heights
_NARROW = "such a narrow map as .npz under the key 'heights'"


def heights_alone(found: HeightMap) -> HeightMap:
    """Return bare numbers, keeping only the heights.

    Points, shape (n, 3) or (3, n), are put on their grid; coordinates in the first row and column are left out. If the
    file states the size of a cell, or holds a profile, all numbers are heights.

    Raises
    ------
    ContentError
        If they are a list of coordinates and heights, or of scattered points.
    """
    values = found.heights
    if values.ndim != 2 or found.spacing is not None:
        return found
    require_no_list(values.shape)
    if (points := points_in(values)) is not None:
        return _on_grid(found, points)
    axes = axes_of(values)
    if axes is None:
        return found
    return replace(found, heights=axes.heights, warnings=(*found.warnings, axes.warning))


def points_in(values: Array) -> Array | None:
    """Return a list of points x, y, z, shape (n, 3), without a column that numbers them; None for a map."""
    for rows in (values, values.T):
        if len(rows) >= _LISTED:
            if rows.shape[1] == 3:
                return rows
            if rows.shape[1] == 4 and counts(rows[:, 0]):
                return rows[:, 1:]
    return None


def require_no_list(shape: Sequence[int]) -> None:
    """Refuse a list of coordinates and heights: two columns or rows of many numbers.

    Raises
    ------
    ContentError
        If it is such a list.
    """
    if len(shape) == 2 and min(shape) == 2 and max(shape) >= _LISTED:
        which = "column, array[:, 1]" if shape[1] == 2 else "row, array[1]"
        raise ContentError(
            f"its {' x '.join(map(str, shape))} numbers look like places and heights, not a map",
            f"save only the {which}, for read_line, or {_NARROW}",
        )


def _on_grid(found: HeightMap, points: Array) -> HeightMap:
    try:
        grid = grid_of_points(points)
    except ContentError as error:
        raise ContentError(
            f"its {len(points)} rows of 3 look like points x, y, z, not a map ({error.message})",
            f"save the heights as a matrix, rows by columns, or {_NARROW}",
        ) from None
    ny, nx = grid.heights.shape
    warning = f"its {len(points)} rows of 3 are points x, y, z, and are put on their grid of {ny} x {nx}"
    return replace(
        found,
        heights=grid.heights,
        format=f"{found.format} of points",
        unclear=f"steps of {grid.steps[1]:g} along x and {grid.steps[0]:g} along y, without a unit",
        warnings=(*found.warnings, warning, *grid.warnings),
    )
