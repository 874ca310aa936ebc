"""Heights at two points a lag apart: autocorrelation and structure function."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.errors import InputError, about
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric

__all__ = [
    "LagCurve",
    "LagMap",
    "autocorrelation",
    "structure_function",
    "structure_profile",
    "tapered_structure",
]

Steps = npt.NDArray[np.int64]
# The weight of the pairs in `tapered_structure` rises from zero to one over this share of the length, at both ends.
RAMP = 1 / 16


@dataclass(frozen=True, slots=True, eq=False)
class LagCurve:
    """A function of only the length of the lag.

    Attributes
    ----------
    lag : array, shape (n,)
        Mean length of the lags in each bin [m].
    value : array, shape (n,)
        Mean over the pairs of points [m^2].
    pairs : array, shape (n,)
        Number of pairs of measured points, both directions of a lag.
    """

    lag: Array
    value: Array
    pairs: Array


@dataclass(frozen=True, slots=True, eq=False)
class LagMap:
    """A function of the lag vector, zero lag in the middle.

    Attributes
    ----------
    value : array, shape (my, mx) or (m,)
        Mean over all pairs of measured points at this lag [m^2]; NaN if there is none.
    pairs : array, same shape
        Number of such pairs.
    lags : tuple of array
        Lags along each axis [m], increasing.
    """

    value: Array
    pairs: Array
    lags: tuple[Array, ...]

    def radial(self) -> LagCurve:
        """Return the average over all directions.

        Returns
        -------
        LagCurve
            Averages over rings as wide as the larger spacing, up to half the shorter side.
        """
        step = max(float(np.diff(axis).max(initial=0.0)) for axis in self.lags)
        length = np.sqrt(sum(axis**2 for axis in np.meshgrid(*self.lags, indexing="ij", sparse=True)))
        reach = min(float(axis[-1]) for axis in self.lags if axis.size > 1)
        keep = (length <= reach * (1 + 1e-9)) & (self.pairs > 0)
        index = (length[keep] / step + 0.5).astype(np.int64)
        pairs = np.asarray(np.bincount(index, self.pairs[keep]), dtype=np.float64)
        total = np.bincount(index, self.pairs[keep] * self.value[keep])
        lag = np.bincount(index, self.pairs[keep] * length[keep])
        full = pairs > 0
        return LagCurve(lag[full] / pairs[full], total[full] / pairs[full], pairs[full])


@numeric
@analysed_on_host
def autocorrelation(surface: Surface) -> LagMap:
    """Return the autocorrelation ``<h(x + r) h(x)>`` of the heights above their mean.

    Along periodic axes lags wrap around. Along free axes only pairs inside the surface count, and each lag is divided
    by their number, which avoids a bias from the edges. Pairs with a missing point are left out.

    Parameters
    ----------
    surface : Surface

    Returns
    -------
    LagMap
        The mean square [m^2] at zero lag; lags reach to half the length.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> lags = rc.autocorrelation(surface)
    >>> lags.value.shape, f"rms {lags.value[32, 32] ** 0.5:.3g} m"
    ((65, 65), 'rms 1e-06 m')
    """
    heights, known = _centred(surface)
    shape = _padded(surface)
    wave = scipy.fft.rfftn(heights, shape)
    return _as_map(surface, _correlate(wave, wave, shape), _pairs(known, shape), shape)


@numeric
@analysed_on_host
def structure_function(surface: Surface) -> LagMap:
    """Return the structure function ``<(h(x + r) - h(x))^2>`` of the heights.

    It needs no mean and is less affected by long waves than the autocorrelation. It is computed by transforms, whose
    rounding error is 1e-16 of the mean square height. For the smallest lags of a smooth surface use
    `structure_profile`, which is exact.

    Parameters
    ----------
    surface : Surface

    Returns
    -------
    LagMap
        Mean over the pairs of measured points [m^2], at the lags of `autocorrelation`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> wave = rc.shapes.wave(rc.Grid((64, 64), 1e-6, periodic=True), amplitude=1e-6, wavelength=32e-6)
    >>> lags = rc.structure_function(wave)
    >>> f"{lags.value[32, 48]:.3g} m^2"  # half a wave away from zero lag: (2 amplitudes)^2 / 2
    '2e-12 m^2'
    """
    heights, known = _centred(surface)
    shape = _padded(surface)
    wave, squares, mask = (scipy.fft.rfftn(part, shape) for part in (heights, heights**2, known))
    total = _correlate(squares, mask, shape) + _correlate(mask, squares, shape)
    total -= 2 * _correlate(wave, wave, shape)
    return _as_map(surface, np.maximum(total, 0), _pairs(known, shape), shape)


@numeric
@analysed_on_host
def structure_profile(
    surface: Surface, direction: Literal["x", "y"] = "x", *, lags: npt.ArrayLike | None = None
) -> LagCurve:
    """Return the structure function along x or y, from differences of heights.

    Parameters
    ----------
    surface : Surface
        May have missing points: pairs with one are left out.
    direction : {"x", "y"}
    lags : array of int, optional
        Lags in whole cells; by default all from 1 to a quarter of the length, about 20 to a factor of ten.

    Returns
    -------
    LagCurve
        One value [m^2] for each lag.

    Raises
    ------
    ValueError
        If a lag does not fit the surface, or has no pair of measured points.

    Examples
    --------
    >>> import roughcontact as rc
    >>> wave = rc.shapes.wave(rc.Grid(64, 1e-6, periodic=True), amplitude=1e-6, wavelength=32e-6)
    >>> f"{rc.structure_profile(wave, lags=[16]).value[0]:.3g} m^2"  # half a wave: (2 amplitudes)^2 / 2
    '2e-12 m^2'
    """
    along = surface.grid.ndim - 1 if direction == "x" else 0
    if direction not in ("x", "y") or (direction == "y" and surface.grid.ndim == 1):
        raise about("direction", f"must be 'x', or 'y' on a surface, not {direction!r}")
    size = surface.grid.shape[along]
    steps = default_lags(size) if lags is None else np.asarray(lags)
    if steps.ndim != 1 or steps.dtype.kind not in "iu" or (steps < 1).any() or (steps >= size).any():
        raise about("lags", f"must be whole numbers of cells from 1 to {size - 1}, not {steps}")
    values, pairs = np.empty(steps.size), np.empty(steps.size)
    for i, (jumps, known) in enumerate(_jumps(surface, along, steps)):
        values[i], pairs[i] = np.mean(jumps[known] ** 2), 2 * np.count_nonzero(known)
    return LagCurve(steps.astype(np.float64) * surface.grid.spacing[along], values, pairs)


def tapered_structure(surface: Surface, axis: Literal["x", "y"], steps: Steps) -> tuple[Array, float]:
    """Return ``<(h(x + r) - h(x))^2>`` at lags along one axis, weighted by the place of the pairs.

    On a free axis the weight depends only on the middle of a pair and falls smoothly to zero where the pairs of the
    longest lag end. With equal weights each lag would cover another part of the surface, and the differences between
    lags, which determine the exponent, would contain the noise of its ends. At H = 0.95 on 128 points that would
    increase the error of H by a fifth, and above the value from the covariance of a large surface.

    Parameters
    ----------
    surface : Surface
        On a grid of two axes; may have missing points: pairs with one are left out.
    axis : {"x", "y"}
    steps : array of int, shape (k,)
        Lags in whole cells.

    Returns
    -------
    values : array, shape (k,)
        [m^2]
    share : float
        Effective part of the axis, ``<w>^2/<w^2>``: 1 along a periodic axis.

    Raises
    ------
    ValueError
        If a lag does not fit the surface, or has no pair of measured points.
    """
    along = 1 if axis == "x" else 0
    size, periodic = surface.grid.shape[along], surface.grid.periodic[along]
    most = size - 1 if periodic else size // 2
    if steps.ndim != 1 or steps.dtype.kind not in "iu" or (steps < 1).any() or (steps > most).any():
        raise InputError(
            f"lags along {axis} must be whole numbers of cells from 1 to {most}, not {steps}", place="steps"
        )
    values = np.empty(steps.size)
    for i, (jumps, known) in enumerate(_jumps(surface, along, steps)):
        weight = np.ones(size) if periodic else _weight(size, int(steps[i]), int(steps.max()))
        columns = known.reshape(-1, weight.size)
        squares = np.sum(jumps.reshape(columns.shape) ** 2, axis=0, where=columns)
        values[i] = float(weight @ squares) / float(weight @ columns.sum(axis=0))
    weight = np.ones(size) if periodic else _weight(size, 0, int(steps.max()))
    return values, float(weight.mean() ** 2 / np.mean(weight**2))


def _jumps(surface: Surface, axis: int, steps: Steps) -> Iterator[tuple[Array, npt.NDArray[np.bool_]]]:
    """Yield for each lag the differences of heights along the `axis`, now the last, and the mask of known ones."""
    heights = np.moveaxis(surface.heights, axis, -1)
    for step in steps.tolist():
        periodic = surface.grid.periodic[axis]
        jumps = (
            np.roll(heights, -step, -1) - heights if periodic else heights[..., step:] - heights[..., :-step]
        )
        known = ~np.isnan(jumps)
        if not known.any():
            along = "x" if axis == surface.grid.ndim - 1 else "y"
            raise InputError(f"no two measured points lie {step} cells apart along {along}")
        yield jumps, known


def _weight(size: int, step: int, longest: int) -> Array:
    """Return the weight of every pair `step` apart: a function of only its middle."""
    middle = np.arange(size - step) + (step + 1) / 2
    inside = np.minimum(middle, size - middle) - longest / 2
    return np.asarray(np.sin(np.pi / 2 * np.clip(inside / (RAMP * size), 0, 1)) ** 2)


def default_lags(size: int) -> Steps:
    """Return whole lags from 1 to a quarter of `size`, about 20 to a factor of ten."""
    high = max(1, size // 4)
    count = 1 + int(20 * np.log10(high))
    return np.unique(np.geomspace(1, high, count).round().astype(np.int64))


def _centred(surface: Surface) -> tuple[Array, Array]:
    """Return the heights above their mean, zero where missing, and the mask of measured points as numbers."""
    known = surface.measured
    return np.where(known, surface.heights - np.nanmean(surface.heights), 0.0), known.astype(np.float64)


def _padded(surface: Surface) -> tuple[int, ...]:
    """Return lengths of transforms in which lags up to half a free axis do not wrap around."""
    axes = zip(surface.grid.shape, surface.grid.periodic, strict=True)
    return tuple(n if p else int(scipy.fft.next_fast_len(n + n // 2, real=True)) for n, p in axes)


def _correlate(
    one: npt.NDArray[np.complex128], other: npt.NDArray[np.complex128], shape: tuple[int, ...]
) -> Array:
    return np.asarray(scipy.fft.irfftn(one * other.conj(), s=shape, overwrite_x=True))


def _pairs(known: Array, shape: tuple[int, ...]) -> Array:
    mask = scipy.fft.rfftn(known, shape)
    return np.rint(_correlate(mask, mask, shape))


def _as_map(surface: Surface, total: Array, pairs: Array, shape: tuple[int, ...]) -> LagMap:
    """Return the means at lags up to half the length, zero lag in the middle."""
    steps = [np.arange(-(n // 2), n // 2 + 1) for n in surface.grid.shape]
    chosen = np.ix_(*(step % m for step, m in zip(steps, shape, strict=True)))
    total, pairs = total[chosen], pairs[chosen]
    value = np.divide(total, pairs, out=np.full(total.shape, np.nan), where=pairs > 0)
    lags = tuple(step.astype(np.float64) * d for step, d in zip(steps, surface.grid.spacing, strict=True))
    return LagMap(value, pairs, lags)
