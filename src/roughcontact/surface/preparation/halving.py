"""The same map on half as many cells along each axis, its outer sides unchanged."""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse

from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.validation import Array

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["halved"]

FEWEST = 4  # cells along an axis that can be halved


def halved(surface: Surface) -> Surface:
    """Return the surface on half as many cells along each axis, over the same sides: the mean height of each new cell.

    Half of an odd number of cells is rounded down, and the new cells are slightly longer than two old ones; an old
    cell in two new cells counts in each by its part. Means keep the long waves and their positions: a wave of length l
    along an axis is multiplied by cos(pi d/l), with the old cell d. A new cell is missing if less than half of it was
    measured. With even numbers of cells this is `Surface.averaged` by 2.

    Raises
    ------
    ValueError
        If an axis has fewer than four cells.
    """
    grid = surface.grid
    if min(grid.shape) < FEWEST:
        raise InputError(
            f"a map of {' x '.join(map(str, grid.shape))} cells has no half: {FEWEST} along each axis are needed"
        )
    shape = tuple(n // 2 for n in grid.shape)
    parts = [_overlaps(n, half) for n, half in zip(grid.shape, shape, strict=True)]

    def gathered(values: Array) -> Array:
        """Return the sum over the old cells in each new one."""
        return reduce(lambda table, axis: _along(table, parts[axis], axis), range(grid.ndim), values)

    level = float(np.nanmean(surface.heights))  # subtracted: heights far from zero keep their digits
    measured = surface.measured
    count = gathered(measured.astype(np.float64))
    total = gathered(np.where(measured, surface.heights - level, 0.0))
    enough = 2 * count >= grid.size / np.prod(shape) * (1 - 1e-12)
    heights = np.divide(total, count, out=np.full(shape, np.nan), where=enough) + level
    coarse = Grid(
        shape, [length / half for length, half in zip(grid.lengths, shape, strict=True)], grid.periodic
    )
    return surface.with_heights(heights, "means over half as many cells along each axis", coarse)


def _overlaps(old: int, new: int) -> scipy.sparse.csr_array:
    """Return the part of each old cell of an axis that lies in each new one, shape (new, old)."""
    ends = np.arange(new + 1) * (old / new)
    last = np.minimum(np.ceil(ends[1:] - 1e-9), old)  # the rounding error of an end is not a part of a cell
    rows = [np.arange(int(low), int(high)) for low, high in zip(ends[:-1], last, strict=True)]
    counts = [len(row) for row in rows]
    columns, which = np.concatenate(rows), np.repeat(np.arange(new), counts)
    part = np.minimum(columns + 1, ends[which + 1]) - np.maximum(columns, ends[which])
    return scipy.sparse.csr_array((part, (which, columns)), shape=(new, old))


def _along(values: Array, weights: scipy.sparse.csr_array, axis: int) -> Array:
    """Return a matrix times the columns of an array along an axis."""
    moved = np.moveaxis(values, axis, 0)
    product = weights @ moved.reshape(moved.shape[0], -1)
    return np.moveaxis(np.asarray(product).reshape(-1, *moved.shape[1:]), 0, axis)
