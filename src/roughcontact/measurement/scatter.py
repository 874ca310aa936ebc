"""The scatter of spectra between places: maps that stand out, maps of another surface, and the rest."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.measurement.bins import Binned, averaged
from roughcontact.validation import Array, Mask

__all__ = ["another_surface", "between_places", "outlying"]

_STANDS_OUT = 3.5  # standard deviations from the median of the maps
_IN_A_ROW = 3  # bins
_GAIN = 0.1  # of ln C that instruments always differ by: 5 % of a height
_ANOTHER = math.log(
    10
)  # of ln C in every bin: places of one surface do not differ by three times their heights


def _deviations(found: Binned) -> tuple[Array, Array]:
    """Return the deviations from the median over maps in each bin, and their standard deviations.

    The scatter between maps is 1.4826 median absolute deviations, as for normal numbers, but at least `_GAIN`.
    """
    held = np.isfinite(found.log)
    values = np.where(held.sum(axis=0) >= 3, found.log, math.nan)
    some = np.where(held.any(axis=0), values, 0.0)
    some[:, np.isnan(some).all(axis=0)] = 0.0
    away = found.log - np.nanmedian(some, axis=0)
    away[:, held.sum(axis=0) < 3] = math.nan
    mad = np.nanmedian(np.where(np.isfinite(away).any(axis=0), np.abs(away), 0.0), axis=0)
    return away, np.sqrt(found.variance + np.maximum(1.4826 * mad, _GAIN) ** 2)


def outlying(found: Binned) -> Mask:
    """Return which bins of which maps stand out: by more than 3.5 standard deviations, three or more in a row."""
    away, error = _deviations(found)
    out = np.nan_to_num(np.abs(away) / error) > _STANDS_OUT
    rows = np.zeros(out.shape, bool)
    for k in range(out.shape[1] - _IN_A_ROW + 1):
        whole = out[:, k : k + _IN_A_ROW].all(axis=1)
        rows[whole, k : k + _IN_A_ROW] = True
    return rows


def another_surface(found: Binned) -> tuple[int, float] | None:
    """Return the map that differs from the others by a factor above ten in all of three or more bins, and the factor.

    With two maps, it is the second.
    """
    worst: tuple[int, float] | None = None
    for k in reversed(range(len(found.log))):
        others = np.delete(found.log, k, axis=0)
        shared = np.isfinite(found.log[k]) & np.isfinite(others).any(axis=0)
        if shared.sum() < _IN_A_ROW:
            continue
        away = found.log[k, shared] - np.nanmedian(others[:, shared], axis=0)
        error = np.sqrt(
            found.variance[k, shared] + np.nanmedian(np.delete(found.variance, k, axis=0)[:, shared], axis=0)
        )
        if (np.abs(away) > np.maximum(_ANOTHER, _STANDS_OUT * error)).all() and abs(
            np.sign(away).sum()
        ) == away.size:
            mean = float(away.mean())
            if worst is None or abs(mean) > abs(math.log(worst[1])):
                worst = k, math.exp(mean)
    return worst


def between_places(found: Binned) -> tuple[Array, Array]:
    """Return the standard deviation of ln C between places in each bin, and the number of differences that it rests on.

    DerSimonian and Laird's estimate from three neighbouring bins together; NaN where none of them holds two maps.
    """
    weight = np.where(np.isnan(found.log), 0.0, 1 / np.nan_to_num(found.variance, nan=1.0))
    mean, total = averaged(found.log, weight)
    chi = np.nansum(weight * (found.log - mean) ** 2, axis=0)
    spare = np.maximum(np.isfinite(found.log).sum(axis=0) - 1, 0)
    scale = total - (weight**2).sum(axis=0) / np.maximum(total, 1e-300)
    # In full: with fewer than three bins, the same length would be that of the three.
    excess, scale, spare = (np.convolve(each, np.ones(3))[1:-1] for each in (chi - spare, scale, spare))
    ratio = np.where(spare > 0, excess, math.nan) / np.maximum(scale, 1e-300)
    return np.sqrt(np.maximum(ratio, 0.0)), spare
