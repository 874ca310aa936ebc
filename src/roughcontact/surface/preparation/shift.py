"""The shift between two maps of one place, to a fraction of a cell."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.fft
import scipy.ndimage

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.preparation.combine import require_comparable, resampled, same_spacing
from roughcontact.surface.preparation.missing import filled
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, Mask, numeric, require

__all__ = ["MapShift", "shift_between"]

LONGEST = (
    1 / 32
)  # of the shorter side: waves of several times this length and more are removed for the search
OVERLAP = 1 / 4  # of the measured cells of the smaller map, the least on which a correlation counts
APART = 4  # smoothing lengths, beyond which a correlation belongs to another place
CLEAR = 1.5  # correlation over the largest elsewhere: of N independent places of unrelated maps reached with about 1/N
SMOOTH = 1.5  # cells; bias of the cubic interpolation at most 0.003 cells for spectra that fall like q^-2 or faster
OUTLIER = 3.0  # standard deviations
TILE = 8  # cells, longer than the correlation of the errors
SETTLED, MOST = 1e-4, 20  # cells; steps


@dataclass(frozen=True, slots=True)
class MapShift:
    """The shift of a second map relative to a first.

    Attributes
    ----------
    vector : tuple of float
        ``(dy, dx)`` that moves the second map onto the first [m], in the direction of increasing
        indices; with zero their middles coincide. Pass it as ``shift=`` to `combined` or `resampled`.
    error : tuple of float
        Standard error along both axes [m], from the scatter of the remaining differences.
    sign : int
        1 if the heights agree, -1 if peaks of one map lie in valleys of the other, as for the mated faces of a
        fracture.
    correlation : float
        Absolute value of the correlation of the short waves at the nearest shift by whole cells.
    elsewhere : float
        The largest absolute correlation at other places.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> lower = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> found = rc.shift_between(lower, lower * -1)  # as seen by the other body
    >>> found.sign, f"{found.correlation:.2f} here, {found.elsewhere:.2f} elsewhere"
    (-1, '1.00 here, 0.16 elsewhere')
    """

    vector: tuple[float, float]
    error: tuple[float, float]
    sign: int
    correlation: float
    elsewhere: float


@numeric
@analysed_on_host
def shift_between(first: Surface, second: Surface) -> MapShift:
    """Return the shift between two maps of one place: before and after, or the two faces of a fracture.

    Only a shift is searched, no rotation and no scale. Turn the upper of two faces over first, with
    ``upper.flipped("x")``, as `combined` does.

    Parameters
    ----------
    first, second : Surface
        Maps with cells of one size, at least 32 along each axis. Their tilts and some of their heights may differ
        and points may be missing.

    Returns
    -------
    MapShift

    Raises
    ------
    ValueError
        If the cells or periods differ, a map is too small, or no place is found where the maps clearly fit.

    Notes
    -----
    The nearest whole cell is the maximum of the masked, normalised cross-correlation (Padfield, IEEE Trans. Image
    Process. 21, 2706, 2012) over shifts that leave a quarter of the smaller map. Waves much longer than 1/32 of the
    shorter side are removed for it: long waves fit by chance. It must be 1.5 times the largest correlation elsewhere.

    The fraction solves ``<g (first - second(shift))> = 0``, where g is the slope of the smoothed first map. Independent
    noise of both maps does not bias this mean. Differences above three standard deviations (wear, spikes) are left out.
    The standard error is from sums over tiles of 8 x 8 cells; errors that are correlated over longer distances make it
    too small. The cubic interpolation adds at most 0.003 cells for spectra of heights that fall like q^-2 or faster
    down to the cell, and 0.008 cells for white ones.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 96), 1e-6)
    >>> before = rc.self_affine(grid, hurst=0.8, rms=1e-6, short_cutoff=6e-6, rng=np.random.default_rng(1))
    >>> after = rc.resampled(before, grid, shift=(3.0e-6, -2.4e-6))
    >>> found = rc.shift_between(before, after)
    >>> [f"{1e6 * along:.2f} um" for along in found.vector]
    ['-3.00 um', '2.40 um']
    >>> worn = before - rc.resampled(after, grid, shift=found.vector)
    """
    require(
        first.grid.ndim == 2, "the shift is found between maps, not profiles", "give surfaces of two axes"
    )
    require_comparable(second.grid, first.grid)
    if not same_spacing(first.grid, second.grid):
        raise InputError(
            f"both maps need cells of one size, not {first.grid.spacing} and {second.grid.spacing} m",
            "bring one onto cells of the other by rc.resampled",
            "second",
        )
    for name, each in (("first", first), ("second", second)):
        if min(each.shape) < 32:
            raise about(
                name, f"needs at least 32 cells along each axis, not {each.shape}", "use a larger map"
            )
    first, second = first.levelled("auto"), second.levelled("auto")
    start, correlation, elsewhere = _whole_cells(first, second)
    if not abs(correlation) > CLEAR * elsewhere:
        raise InputError(
            f"these are not maps of the same place, or their structure repeats: their correlation is "
            f"{abs(correlation):.2f} at best and {elsewhere:.2f} elsewhere",
            "give maps of one place that are not rotated or scaled",
            "second",
        )
    sign = 1 if correlation > 0 else -1
    vector, error = _refined(first, second * sign, start)
    steps = first.grid.spacing
    return MapShift(
        (vector[0] * steps[0], vector[1] * steps[1]),
        (error[0] * steps[0], error[1] * steps[1]),
        sign,
        abs(correlation),
        elsewhere,
    )


def _whole_cells(first: Surface, second: Surface) -> tuple[Array, float, float]:
    """Return the shift between the middles [cells], the correlation there, and the largest elsewhere."""
    grids = first.grid, second.grid
    length = max(LONGEST * min(min(grid.lengths) for grid in grids), 2 * max(first.grid.spacing))
    axes = list(zip(grids[0].shape, grids[1].shape, first.grid.periodic, strict=True))
    shape = [n if periodic else scipy.fft.next_fast_len(n + m - 1, real=True) for n, m, periodic in axes]
    parts = []
    for each in (first, second):
        known = each.measured.astype(np.float64)
        short = known * (np.where(each.measured, each.heights, 0.0) - _smoothed(each, length))
        parts.append([scipy.fft.rfftn(part, shape) for part in (short, short**2, known)])
    (a, aa, ma), (b, bb, mb) = parts

    def products(one: npt.NDArray[np.complex128], other: npt.NDArray[np.complex128]) -> Array:
        return np.asarray(scipy.fft.irfftn(one * other.conj(), shape))

    size = np.maximum(products(aa, mb), 0) * np.maximum(products(ma, bb), 0)
    enough = products(ma, mb) >= OVERLAP * min(np.count_nonzero(each.measured) for each in (first, second))
    enough &= size > 1e-12 * size.max()
    value = np.where(enough, products(a, b), 0.0) / np.sqrt(np.where(enough, size, 1.0))
    best = np.unravel_index(int(np.argmax(np.abs(value))), value.shape)
    lags, far = [], np.zeros(value.shape)
    for axis, (n, m, _) in enumerate(axes):
        steps = (np.arange(shape[axis]) - best[axis] + shape[axis] // 2) % shape[axis] - shape[axis] // 2
        far += np.expand_dims((steps * first.grid.spacing[axis] / (APART * length)) ** 2, 1 - axis)
        reach = shape[axis] // 2 if axes[axis][2] else n - 1
        whole = int(best[axis]) - shape[axis] * (best[axis] > reach)
        lags.append(whole - (n - m) / 2)
    return np.array(lags), float(value[best]), float(np.abs(value[far > 1]).max(initial=0.0))


def _refined(first: Surface, second: Surface, start: Array) -> tuple[Array, Array]:
    """Return the shift and its standard error, both in cells."""
    grid, steps = first.grid, np.array(first.grid.spacing)
    smooth = scipy.ndimage.gaussian_filter(filled(first).heights, SMOOTH, mode=_modes(grid, "nearest"))
    slopes = np.stack([np.gradient(smooth, axis=axis) for axis in (0, 1)])
    second, known = filled(second), second.with_heights(second.measured.astype(np.float64), "measured")
    vector, step, kept = start, np.ones(2), first.measured
    for _ in range(MOST):
        if np.abs(step).max() < SETTLED:
            break
        moved = resampled(second, grid, shift=vector * steps)
        there = resampled(known, grid, interpolation="linear", shift=vector * steps)
        other = np.stack([np.gradient(moved.heights, axis=axis) for axis in (0, 1)])
        valid = first.measured & (there.heights > 0.5) & np.isfinite(other).all(axis=0)
        left = _without_plane(first.heights - moved.heights, valid & kept)
        left -= np.median(left[valid & kept])  # worn cells lie on one side
        kept = valid & (np.abs(left) <= OUTLIER * 1.4826 * np.median(np.abs(left[valid])))
        left = np.where(kept, _without_plane(left, kept), 0.0)
        along = np.stack([np.where(kept, _without_plane(slope, kept), 0.0) for slope in slopes])
        weight = np.linalg.pinv(np.einsum("iyx,jyx->ij", along, np.where(kept, other, 0.0)))
        step = -weight @ np.einsum("iyx,yx->i", along, left)
        vector = vector + step
    sums = _tiles(along * left)
    covariance = weight @ (sums @ sums.T) @ weight.T
    return vector, np.hypot(np.sqrt(np.diag(covariance)), step)


def _smoothed(surface: Surface, length: float) -> Array:
    """Return Gaussian means of the measured heights around each cell."""
    known = surface.measured.astype(np.float64)
    mean, weight = (
        scipy.ndimage.gaussian_filter(
            part, [length / step for step in surface.grid.spacing], mode=_modes(surface.grid, "constant")
        )
        for part in (np.where(surface.measured, surface.heights, 0.0), known)
    )
    return np.asarray(mean / np.maximum(weight, 1e-9))


def _modes(grid: Grid, free: Literal["nearest", "constant"]) -> list[Literal["wrap", "nearest", "constant"]]:
    return ["wrap" if periodic else free for periodic in grid.periodic]


def _without_plane(values: Array, kept: Mask) -> Array:
    """Return the values less the least-squares plane of the kept cells."""
    y, x = (np.arange(n) - n / 2 for n in values.shape)
    columns = np.stack([np.ones(values.shape), *np.meshgrid(y, x, indexing="ij")], axis=-1)
    return np.asarray(values - columns @ np.linalg.lstsq(columns[kept], values[kept], rcond=None)[0])


def _tiles(values: Array) -> Array:
    """Return the sums over tiles, shape (2, number of tiles)."""
    for axis in (1, 2):
        values = np.add.reduceat(values, np.arange(0, values.shape[axis], TILE), axis=axis)
    return values.reshape(2, -1)
