"""Spikes and streaks: clusters of cells that stand out from their surroundings, like faulty measurements."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.preparation.regular_subset import regular_subset
from roughcontact.surface.preparation.streaks import LONG, streaks_in, tail_of
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, Mask, numeric

__all__ = ["Spikes", "described", "find_spikes", "spikes_in"]

_REACH = {1: 4, 2: 2}  # cells from the middle of a window to its edge, by the number of axes: 9 and 25 cells
_GROUP = 3  # one in this number of cells of a window may stand out: 2 of 9 and 8 of 25
_EXTENT = 0.5  # of the limit: neighbours that stand out by this much belong to a spike ...
_LARGEST = 2  # ... which has at most half the cells of a window
_AROUND = {1: 30, 2: 7}  # cells from a spike within which the steps measure the roughness of its surroundings
_FEWEST = 100
_PASSES = 4  # over the flanks of spikes that were found
_SLAB = 2**14  # windows sorted at once
_ROUNDING = 16 * float(np.finfo(np.float64).eps)  # of the largest height: differences below it are rounding


@dataclass(frozen=True, slots=True, eq=False)
class Spikes:
    """The spikes of a surface, including streaks along its scan lines.

    Attributes
    ----------
    mask : array of bool, shape of the surface
        Their cells.
    places : array of int, shape (count, axes)
        The cell of each spike that stands out most: its row and column, or its position on a line.
    height : array, shape (count,)
        Height of that cell above the median of the cells around the spike [m], negative below it; the largest come
        first.
    cells : array of int, shape (count,)
        Number of cells of each spike.
    streak : array of bool, shape (count,)
        Whether the spike is a streak: it extends over 16 cells or more.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> heights = rough.heights.copy()
    >>> heights[20, 30:32] += 1e-5
    >>> spikes = rc.find_spikes(rc.Surface(heights, rough.grid))
    >>> spikes.places.tolist(), f"{spikes.height[0] * 1e6:.0f} um high"
    ([[20, 30]], '10 um high')
    """

    mask: Mask
    places: npt.NDArray[np.int64]
    height: Array
    cells: npt.NDArray[np.int64]
    streak: Mask

    @property
    def count(self) -> int:
        """Number of spikes and streaks."""
        return self.height.size

    def __str__(self) -> str:
        words = [
            f"{_counted(int(chosen.sum()), name)} of {_counted(int(self.cells[chosen].sum()), 'cell')}"
            for name, chosen in (("spike", ~self.streak), ("streak", self.streak))
            if chosen.any() or (name == "spike" and not self.count)
        ]
        return " and ".join(words)


@numeric
@analysed_on_host
def find_spikes(surface: Surface) -> Spikes:
    """Return the clusters of a few cells, and the streaks along scan lines, that stand out from their surroundings.

    Parameters
    ----------
    surface : Surface
        Tilt does not matter. A map with fewer than 100 measured cells is too small for statistics: no spikes are
        found.

    Returns
    -------
    Spikes

    Notes
    -----
    The heights in a window of 5 x 5 cells (9 on a line) are sorted. The widest step to the next height is determined
    in the lowest and in the highest third, 8 cells: a spike in the middle causes a wide step with the spike beyond it,
    but an edge or a right corner of a plateau does not. A cell is marked where that step exceeds

        q50 + (q90 - q50) / ln 5 * ln(500 N),

    where q50 and q90 are the quantiles of the widest steps of all N windows, whatever is in their middle. An
    exponential tail through both exceeds this limit in one window of a thousand maps. Steps on Gaussian surfaces,
    including self-affine ones, have a lighter tail, and spikes that touch less than a tenth of the windows barely
    change the quantiles. If the median of the steps in the 15 x 15 cells around (61 on a line) exceeds q90, the limit
    is raised by their ratio. Neighbours beyond half the limit belong to a spike, which has at most 12 cells (4 on a
    line); cells beside it that stand out once it is removed, its flank, are also marked. In windows cut by edges or
    missing points a third is fewer cells.

    A streak is a run of at least 16 cells along one to four rows or columns. Its steps to the lines on both sides have
    one sign and exceed half the limit everywhere and the limit somewhere, with the quantiles of all N steps between
    neighbouring lines. A run along more than nine tenths of a line is a line that is shifted as a whole, see
    `aligned`. Runs of at least 3 cells are pieces of streaks if their steps exceed the mean of the median step and the
    limit, on a map with a streak along the same axis, or with at least 32 cells of pieces along it and less than a
    tenth of that along the other. Pieces shorter than 16 cells count as spikes.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> heights = rough.heights.copy()
    >>> heights[20, 30:32] += 1e-5
    >>> spikes = rc.find_spikes(rc.Surface(heights, rough.grid))
    >>> print(spikes)
    1 spike of 2 cells
    >>> rc.find_spikes(rough).count
    0
    """
    return spikes_in(surface.heights, surface.grid.periodic)


def spikes_in(heights: Array, periodic: tuple[bool, ...]) -> Spikes:
    """Return the spikes of heights [m], NaN where not measured, on axes of which some may be `periodic`."""
    mask = streaks_in(heights)
    measured = np.flatnonzero(~np.isnan(heights))
    if measured.size >= _FEWEST:
        usual, limit = _limits(heights, periodic, measured)
        cells = _screened(np.where(mask, np.nan, heights), periodic, _EXTENT * limit)
        for _ in range(_PASSES):
            found = _marked(np.where(mask, np.nan, heights), periodic, cells, usual, limit)
            if not found.any():
                break
            mask |= found
            cells = _dilated(mask, _REACH[mask.ndim]) & ~mask & ~np.isnan(heights)
    return described(heights, mask)


def _limits(
    heights: Array, periodic: tuple[bool, ...], measured: npt.NDArray[np.int64]
) -> tuple[float, float]:
    """Return the quantile q90 of the widest steps, and the limit beyond which a step makes a spike [m]."""
    chosen = regular_subset(measured)
    steps = _steps(_padded(heights, periodic), np.stack(np.unravel_index(chosen, heights.shape), axis=1))
    most, limit = tail_of(steps, measured.size)
    return most, max(limit, _ROUNDING * float(np.nanmax(np.abs(heights))))


def _padded(heights: Array, periodic: tuple[bool, ...]) -> Array:
    """Return the heights padded by the reach of a window beyond each edge: missing, or wrapped around if periodic."""
    reach = _REACH[heights.ndim]
    for axis, repeats in enumerate(periodic):
        width = [(reach, reach) if k == axis else (0, 0) for k in range(heights.ndim)]
        wide = np.pad(heights, width, mode="wrap")
        if not repeats:
            ends = np.moveaxis(wide, axis, 0)
            ends[:reach] = ends[-reach:] = np.nan
        heights = wide
    return heights


def _windows(padded: Array, cells: npt.NDArray[np.int64]) -> Iterator[tuple[slice, Array]]:
    """Yield the heights around a slice of the `cells`, shape (n, axes), one window a row."""
    side = 2 * _REACH[padded.ndim] + 1
    views = np.lib.stride_tricks.sliding_window_view(padded, (side,) * padded.ndim)
    for start in range(0, len(cells), _SLAB):
        part = slice(start, start + _SLAB)
        yield part, views[tuple(cells[part].T)].reshape(-1, side**padded.ndim)


def _steps(padded: Array, cells: npt.NDArray[np.int64]) -> Array:
    """Return the widest step in the window about each of the `cells`, at either end [m]."""
    found = np.zeros(len(cells))
    for part, window in _windows(padded, cells):
        none = np.full(len(window), -np.inf)
        found[part] = np.maximum(_widest(window, none), _widest(-window, none))
    return found


def _gaps(padded: Array, cells: npt.NDArray[np.int64]) -> Array:
    """Return the widest step with the cell beyond it: positive below the cell, negative above [m]."""
    found = np.zeros(len(cells))
    for part, window in _windows(padded, cells):
        middle = window[:, window.shape[1] // 2]
        below, above = _widest(window, middle), _widest(-window, -middle)
        found[part] = np.where(above >= below, above, -below)
    return found


def _widest(window: Array, middle: Array) -> Array:
    """Return the widest step among the lowest third of the heights, those with `middle` before them."""
    ordered = np.sort(window, axis=1)  # missing heights go last
    group = (np.count_nonzero(~np.isnan(ordered), axis=1) - 1) // _GROUP
    widest = np.zeros(len(ordered))
    for k in range(1, (ordered.shape[1] - 1) // _GROUP + 1):
        step = ordered[:, k] - ordered[:, k - 1]
        np.maximum(widest, step, out=widest, where=(k <= group) & (middle <= ordered[:, k - 1]))
    return widest


def _screened(heights: Array, periodic: tuple[bool, ...], gap: float) -> Mask:
    """Return the cells whose gap may exceed `gap`: enough of their window is at least that far below or above."""
    padded, reach = _padded(heights, periodic), _REACH[heights.ndim]
    keep = np.zeros(heights.shape, dtype=np.bool_)
    rows = max(1, _SLAB * len(heights) // heights.size)
    shifts = list(np.ndindex(*(2 * reach + 1,) * heights.ndim))
    for start in range(0, len(heights), rows):
        slab = padded[start : start + rows + 2 * reach]
        shape = (len(slab) - 2 * reach, *heights.shape[1:])
        parts = [tuple(slice(k, k + n) for k, n in zip(shift, shape, strict=True)) for shift in shifts]
        middle = slab[parts[len(parts) // 2]]
        low, high, here = middle - gap, middle + gap, ~np.isnan(slab)
        below, above, count = (np.zeros(shape, dtype=np.int8) for _ in range(3))
        for part in parts:
            below += slab[part] <= low
            above += slab[part] >= high
            count += here[part]
        beyond = count - (count - 1) // _GROUP
        enough = (below >= beyond) | (above >= beyond)
        keep[start : start + rows] = enough & (count > _GROUP) & ~np.isnan(middle)
    return keep


def _marked(heights: Array, periodic: tuple[bool, ...], cells: Mask, usual: float, limit: float) -> Mask:
    """Return those of the `cells` that belong to a spike."""
    from scipy.ndimage import find_objects, label

    padded = _padded(heights, periodic)
    gaps = np.zeros(heights.shape)
    gaps[cells] = _gaps(padded, np.argwhere(cells))
    most = (2 * _REACH[heights.ndim] + 1) ** heights.ndim // _LARGEST
    around = _AROUND[heights.ndim]
    found = np.zeros(heights.shape, dtype=np.bool_)
    for side in (gaps, -gaps):
        clusters, _ = label(side > _EXTENT * limit, np.ones((3,) * heights.ndim))
        for index, box in enumerate(find_objects(clusters), start=1):
            inside = clusters[box] == index
            largest = float(side[box][inside].max())
            if largest <= limit or np.count_nonzero(inside) > most:
                continue
            wide = tuple(slice(max(0, part.start - around), part.stop + around) for part in box)
            rest = np.argwhere(~np.isnan(heights[wide])) + [part.start for part in wide]
            if usual > 0 and largest * usual <= limit * float(np.median(_steps(padded, rest))):
                continue
            found[box] |= inside
    return found


def _dilated(mask: Mask, reach: int) -> Mask:
    from scipy.ndimage import binary_dilation

    return np.asarray(
        binary_dilation(mask, np.ones((2 * reach + 1,) * mask.ndim, dtype=np.bool_)), dtype=np.bool_
    )


def described(heights: Array, mask: Mask) -> Spikes:
    """Return the spikes whose cells are marked, the largest first."""
    from scipy.ndimage import find_objects, label

    places, height, cells, streak = [], [], [], []
    clusters, _ = label(mask, np.ones((3,) * heights.ndim))
    for index, box in enumerate(find_objects(clusters), start=1):
        wide = tuple(slice(max(0, part.start - 1), part.stop + 1) for part in box)
        inside = clusters[wide] == index
        around = heights[wide][~mask[wide] & ~np.isnan(heights[wide])]
        level = float(np.median(around)) if around.size else 0.0
        above = np.where(inside, heights[wide] - level, 0.0)
        top = np.unravel_index(int(np.argmax(np.abs(above))), above.shape)
        places.append([part.start + int(k) for part, k in zip(wide, top, strict=True)])
        height.append(float(above[top]))
        cells.append(int(np.count_nonzero(inside)))
        streak.append(heights.ndim == 2 and max(part.stop - part.start for part in box) >= LONG)
    order = np.argsort(-np.abs(height), kind="stable")
    return Spikes(
        mask,
        np.array(places, dtype=np.int64).reshape(-1, heights.ndim)[order],
        np.array(height, dtype=np.float64)[order],
        np.array(cells, dtype=np.int64)[order],
        np.array(streak, dtype=np.bool_)[order],
    )


def _counted(number: int, thing: str) -> str:
    return f"{number} {thing}{'' if number == 1 else 's'}"
