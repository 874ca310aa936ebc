"""Regions that are masked: a box, an ellipse, heights below or above a limit."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from roughcontact.errors import InputError
from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.preparation.sampling import cell_ranges, range_words
from roughcontact.surface.surface import Surface
from roughcontact.validation import Mask, lengths_method

__all__ = ["masked"]


@on_host_only
@lengths_method
def masked(
    surface: Surface,
    *,
    box: Sequence[slice] | None = None,
    ellipse: Sequence[slice] | None = None,
    below: float | None = None,
    above: float | None = None,
    outside: bool = False,
) -> Surface:
    """Return the surface with the points of a region missing: never in contact, and ignored in every fit and mean.

    Parameters
    ----------
    surface : Surface
    box : sequence of slice, optional
        A rectangle of cells, one slice of step 1 for each axis as in `cropped`: rows, then columns.
    ellipse : sequence of slice, optional
        The ellipse that fits into such a rectangle; a cell belongs to it if its centre does.
    below, above : float, optional
        The points lower than one height or higher than another [m], or both.
    outside : bool
        Mask everything except the region.

    Returns
    -------
    Surface
        On the same grid.

    Raises
    ------
    ValueError
        If not exactly one region is given, it ends beyond the map, it has no cell, or no measured point is left.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> ball.masked(below=-2e-6).missing, ball.masked(ellipse=(slice(0, 64), slice(0, 64)), outside=True).missing
    (2832, 868)
    """
    heights = surface.heights
    given = [box is not None, ellipse is not None, below is not None or above is not None]
    if sum(given) != 1:
        raise InputError("masked() needs exactly one region", "give box, ellipse, or below and above")
    parts = box if box is not None else ellipse
    if parts is not None:
        ranges = cell_ranges(surface.grid, parts, "a mask")
        inside = _ellipse(heights.shape, ranges) if box is None else _box(heights.shape, ranges)
        words = f"{'box' if box is not None else 'ellipse'} of cells {range_words(ranges)}"
    else:
        low = -math.inf if below is None else below
        high = math.inf if above is None else above
        if not low <= high:
            raise InputError(
                f"below {below} m and above {above} m leave nothing: below must be the lower", place="below"
            )
        inside = (heights < low) | (heights > high)
        ends = (("below", below), ("above", above))
        words = "heights " + " and ".join(f"{name} {end:.6g} m" for name, end in ends if end is not None)
    gone = ~inside if outside else inside
    rest = np.where(gone, np.nan, heights)
    if np.isnan(rest).all():
        raise InputError(f"the mask ({words}{', outside' if outside else ''}) leaves no measured point")
    count = surface.grid.size - int(np.count_nonzero(~np.isnan(rest))) - surface.missing
    line = f"masked: {'all but ' if outside else ''}{words}, {count} points set to missing"
    return surface.with_heights(rest, line)


def _box(shape: tuple[int, ...], ranges: list[tuple[int, int]]) -> Mask:
    inside = np.zeros(shape, dtype=np.bool_)
    inside[tuple(slice(*ends) for ends in ranges)] = True
    return inside


def _ellipse(shape: tuple[int, ...], ranges: list[tuple[int, int]]) -> Mask:
    places = np.meshgrid(*(np.arange(n) for n in shape), indexing="ij", sparse=True)
    square = sum(
        ((2 * place - (start + stop - 1)) / (stop - start)) ** 2
        for place, (start, stop) in zip(places, ranges, strict=True)
    )
    return np.asarray(square <= 1)
