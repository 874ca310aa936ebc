"""Streaks: runs along one to four scan lines that stand out from the lines on both sides, caused by a slipping tip."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.surface.preparation.regular_subset import regular_subset
from roughcontact.validation import Array, Mask

__all__ = ["LONG", "pieces_along_rows", "stands_out", "streaks_and_pieces", "streaks_in", "tail_of"]

LONG = 16  # cells along the line: runs of neighbours with equal sign on a rough surface are rarely this long
_SHORT = 3  # cells along the line of a piece of a streak
_MANY, _ALONG = (
    32,
    10,
)  # cells of pieces that show streaks by themselves, and ratio to those along the other axis
_WIDE = 4  # lines side by side
_WHOLE = 0.9  # of the measured cells of a line: a longer run is a line that is shifted as a whole
_EXTENT = 0.5  # of the limit: cells that stand out by this much belong to a streak
_HALF, _MOST = 0.5, 0.9  # quantiles between which the tail of sizes is measured
_EXPECTED = 1e-3  # expected number of sizes beyond the limit in a map with an exponential tail
_CHOSEN = 100_000  # steps from which the quantiles are computed
_FEWEST = 100
_SAFE = 0.8  # of the limit from some pairs of lines, because the limit from all pairs may be smaller
_ROUNDING = 16 * float(np.finfo(np.float64).eps)  # of the largest height: differences below it are rounding


def tail_of(values: Array, count: int) -> tuple[float, float]:
    """Return q90 of sizes, and the size that an exponential tail through q50 and q90 exceeds in one map of 1000.

    A map has `count` sizes.
    """
    half, most = (float(np.quantile(values, share)) for share in (_HALF, _MOST))
    rate = (most - half) / math.log((1 - _HALF) / (1 - _MOST))
    return most, half + rate * math.log((1 - _HALF) * count / _EXPECTED)


def streaks_in(heights: Array) -> Mask:
    """Return the cells of streaks along rows and along columns of heights [m], NaN where not measured.

    The steps from a streak to the lines on both sides have one sign and exceed half the limit of `tail_of` along at
    least 16 cells, and the limit somewhere; the limit is computed from all steps between neighbouring lines. A run
    along more than nine tenths of a line is not a streak but a shifted line, see `aligned`. The pieces of streaks along
    the same axis count as well, see `pieces_along_rows`; without a streak, if they have at least 32 cells and the
    pieces along the other axis less than a tenth of that.
    """
    if heights.ndim != 2:
        return np.zeros(heights.shape, dtype=np.bool_)
    return streaks_and_pieces(heights)[0]


def streaks_and_pieces(heights: Array) -> tuple[Mask, Mask, Mask]:
    """Return the cells of streaks of a map, and those of all pieces along rows and along columns."""
    found = np.zeros(heights.shape, dtype=np.bool_)
    long = [_streaks_along_rows(each) for each in (heights, heights.T)]
    pieces = [pieces_along_rows(each) for each in (heights, heights.T)]
    cells = [int(np.count_nonzero(each)) for each in pieces]
    for axis in (0, 1):
        many = cells[axis] >= max(_MANY, _ALONG * cells[1 - axis])
        part = long[axis] | pieces[axis] if many or long[axis].any() else long[axis]
        found |= part.T if axis else part
    return found, pieces[0], pieces[1].T


def stands_out(heights: Array, cells: npt.NDArray[np.intp]) -> Mask:
    """Return which of some cells, by flat indices, may belong to a raised streak or piece.

    They stand out from the lines on both sides of one to four lines. For few cells this takes little time and memory:
    the search of the whole map can be left to maps in which it may find some.
    """
    rows, columns = np.unravel_index(cells, heights.shape)
    found = np.zeros(len(cells), dtype=np.bool_)
    for along, line, across in ((heights, rows, columns), (heights.T, columns, rows)):
        level = _SAFE * _EXTENT * _sampled_limit(along)
        for width in range(1, _WIDE + 1):
            for above in range(width):
                first, last = line - above, line - above + width - 1
                inside = np.flatnonzero((first > 0) & (last < len(along) - 1))
                a, b, at = first[inside], last[inside], across[inside]
                rises, falls = along[a, at] - along[a - 1, at], along[b, at] - along[b + 1, at]
                found[inside] |= np.minimum(rises, falls) > level
    return found


def _sampled_limit(heights: Array) -> float:
    """Return about the limit of the steps between rows [m], from some pairs of rows."""
    every = -(-heights.size // _CHOSEN)
    steps: Array = heights[1::every] - heights[:-1:every]
    sizes = np.abs(steps[~np.isnan(steps)])
    return tail_of(sizes, heights.size)[1] if sizes.size >= _FEWEST else math.inf


def pieces_along_rows(heights: Array) -> Mask:
    """Return runs of at least 3 cells along rows of heights [m] that stand out as streaks do, which are longer.

    Their steps exceed the mean of the median step and the limit. On a map of plateaus, whose median step is 0, there
    are none.
    """
    steps, half, limit = _steps_between_lines(heights)
    if half == 0:
        return np.zeros(heights.shape, dtype=np.bool_)
    level = (half + limit) / 2
    return _runs(heights, steps, level, level, _SHORT)


def _streaks_along_rows(heights: Array) -> Mask:
    steps, _, limit = _steps_between_lines(heights)
    return _runs(heights, steps, _EXTENT * limit, limit, LONG)


def _steps_between_lines(heights: Array) -> tuple[Array, float, float]:
    """Return the steps from each row to the next [m], the median of their sizes, and their limit."""
    steps = np.diff(heights, axis=0)
    sizes = np.abs(steps[~np.isnan(steps)])
    if sizes.size < _FEWEST:
        return steps, math.inf, math.inf
    chosen = regular_subset(sizes)
    _, limit = tail_of(chosen, sizes.size)
    limit = max(limit, _ROUNDING * float(np.nanmax(np.abs(heights))))
    return steps, float(np.median(chosen)), limit


def _runs(heights: Array, steps: Array, soft: float, hard: float, least: int) -> Mask:
    """Return the runs of at least `least` cells along one to four rows that stand out from the rows on both sides.

    The steps on both sides exceed `soft` along the run, and `hard` somewhere.
    """
    raised, lowered = (np.zeros(heights.shape, dtype=np.bool_) for _ in range(2))
    most = _WHOLE * np.count_nonzero(~np.isnan(heights), axis=1)
    for width in range(1, min(_WIDE, len(heights) - 2) + 1):
        for found, other, rise in ((raised, lowered, steps), (lowered, raised, -steps)):
            out = np.minimum(rise[:-width], -rise[width:])  # smaller of the two steps; NaN if either is NaN
            if width > 1:  # the surface between two narrower runs
                out[other[: -width - 1] | other[width + 1 :]] = -math.inf
            if not (out > hard).any():
                continue
            runs = _long_runs(out > soft, out > hard, least, most[1 : 1 + len(out)])
            for line in range(1, 1 + width):
                found[line : line + len(out)] |= runs
    return raised | lowered


def _long_runs(soft: Mask, hard: Mask, least: int, most: Array) -> Mask:
    """Return the runs of `soft` cells along each row of at least `least` and at most `most` cells with a `hard` one."""
    from scipy.ndimage import label

    along: Any = [[0, 0, 0], [1, 1, 1], [0, 0, 0]]
    labels, count = label(soft, along)
    sizes = np.bincount(labels.ravel(), minlength=count + 1)
    sizes[0] = 0
    sizes[np.bincount(labels[hard], minlength=count + 1) == 0] = 0
    length = sizes[labels]
    return np.asarray((length >= least) & (length <= most[:, None]))
