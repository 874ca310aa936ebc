"""Limits of outlying heights, for `masked`."""

from __future__ import annotations

import numpy as np

from roughcontact.surface.preparation.regular_subset import regular_subset
from roughcontact.validation import Array

__all__ = ["OUTLYING", "height_limits", "without_far"]

_FAR = 4.0  # interquartile ranges beyond the quartiles: 1e-8 of the values of a normal distribution
_FEW = 0.02  # of the values: a larger share, of pits or peaks, is not an outlier
OUTLYING = 8.0  # rms heights: the highest of 10^14 points of a Gaussian surface is lower


def without_far(values: Array, few: float = _FEW) -> Array:
    """Return finite values without those far from the quartiles; all values if the share of these exceeds `few`."""
    first, third = (float(end) for end in np.quantile(values, (0.25, 0.75)))
    reach = _FAR * (third - first)
    near = values[(values >= first - reach) & (values <= third + reach)]
    return values if near.size < (1 - few) * values.size else near


def height_limits(heights: Array) -> tuple[float, float]:
    """Return the heights 8 rms heights below and above the mean [m], with both from the points that are not outliers.

    They are rounded to three digits for display.
    """
    chosen = regular_subset(heights)
    measured = chosen[~np.isnan(chosen)]
    if measured.size == 0:
        measured = heights[~np.isnan(heights)]
    near = without_far(measured)
    near = near if near.min() < near.max() else measured
    mean, reach = float(near.mean()), OUTLYING * float(near.std())
    return _rounded(mean - reach, reach), _rounded(mean + reach, reach)


def _rounded(height: float, reach: float) -> float:
    """Return a height to a hundredth of the `reach` or finer."""
    if reach == 0:
        return height
    digits = 2 - int(np.floor(np.log10(reach)))
    return round(height, digits)
