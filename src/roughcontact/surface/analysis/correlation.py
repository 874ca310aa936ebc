"""Heights at two points a lag apart: autocorrelation and structure function."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.surface.surface import Surface

__all__ = ["LagCurve", "LagMap", "autocorrelation", "structure_function", "structure_profile"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class LagCurve:
    """A function of the lag alone.

    Parameters
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

    Parameters
    ----------
    value : array, shape (my, mx) or (m,)
        Mean over all pairs of measured points that far apart [m^2]; NaN where there is none.
    pairs : array, same shape
        Number of such pairs.
    lags : tuple of array
        Lags along each axis [m], increasing.
    """

    value: Array
    pairs: Array
    lags: tuple[Array, ...]

    def radial(self) -> LagCurve:
        """Return the average over all directions, in rings as wide as the larger spacing."""
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


def autocorrelation(surface: Surface) -> LagMap:
    """Return ``<h(x + r) h(x)>`` of the heights above their mean [m^2], the mean square at zero lag.

    Along periodic axes lags go round; along free axes only pairs inside the surface count, and each lag is
    divided by their number, so that no bias comes from the edges. Pairs with a missing point are left out.
    Lags reach to half the length.
    """
    heights, known = _centred(surface)
    shape = _padded(surface)
    wave = scipy.fft.rfftn(heights, shape)
    return _as_map(surface, _correlate(wave, wave, shape), _pairs(known, shape), shape)


def structure_function(surface: Surface) -> LagMap:
    """Return ``<(h(x + r) - h(x))^2>`` [m^2] of the pairs of measured points a lag r apart.

    Lags as in `autocorrelation`. It needs no mean and suffers less from long waves. By transforms, whose rounding
    is 1e-16 of the mean square height: `structure_profile` is exact for the smallest steps of a smooth surface.
    """
    heights, known = _centred(surface)
    shape = _padded(surface)
    wave, squares, mask = (scipy.fft.rfftn(part, shape) for part in (heights, heights**2, known))
    total = _correlate(squares, mask, shape) + _correlate(mask, squares, shape)
    total -= 2 * _correlate(wave, wave, shape)
    return _as_map(surface, np.maximum(total, 0), _pairs(known, shape), shape)


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

    Raises
    ------
    ValueError
        If a lag does not fit the surface, or has no pair of measured points.
    """
    along = surface.grid.ndim - 1 if direction == "x" else 0
    if direction not in ("x", "y") or (direction == "y" and surface.grid.ndim == 1):
        raise ValueError(f"direction must be 'x', or 'y' on a surface, not {direction!r}")
    size, periodic = surface.grid.shape[along], surface.grid.periodic[along]
    steps = default_lags(size) if lags is None else np.asarray(lags)
    if steps.ndim != 1 or steps.dtype.kind not in "iu" or (steps < 1).any() or (steps >= size).any():
        raise ValueError(f"lags must be whole numbers of cells from 1 to {size - 1}, not {steps}")
    heights = np.moveaxis(surface.heights, along, -1)
    values, pairs = np.empty(steps.size), np.empty(steps.size)
    for i, step in enumerate(steps):
        jumps = (
            np.roll(heights, -step, -1) - heights if periodic else heights[..., step:] - heights[..., :-step]
        )
        jumps = jumps[~np.isnan(jumps)]
        if jumps.size == 0:
            raise ValueError(f"no two measured points lie {step} cells apart along {direction}")
        values[i], pairs[i] = np.mean(jumps**2), 2 * jumps.size
    return LagCurve(steps.astype(np.float64) * surface.grid.spacing[along], values, pairs)


def default_lags(size: int) -> npt.NDArray[np.int64]:
    """Return whole lags from 1 to a quarter of `size`, about 20 to a factor of ten."""
    high = max(1, size // 4)
    count = 1 + int(20 * np.log10(high))
    return np.unique(np.geomspace(1, high, count).round().astype(np.int64))


def _centred(surface: Surface) -> tuple[Array, Array]:
    """Return the heights above their mean, zero where missing, and ones where measured."""
    known = surface.measured
    return np.where(known, surface.heights - np.nanmean(surface.heights), 0.0), known.astype(np.float64)


def _padded(surface: Surface) -> tuple[int, ...]:
    """Return lengths of transforms in which lags up to half a free axis do not go round."""
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
