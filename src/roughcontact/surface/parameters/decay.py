"""How fast the autocorrelation decays in its fastest and its slowest direction."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.ndimage import map_coordinates, spline_filter

from roughcontact.surface.analysis.correlation import autocorrelation
from roughcontact.surface.surface import Surface

__all__ = ["decay_lengths"]

Array = npt.NDArray[np.float64]
_HALVINGS = 30  # of half a cell: to a billionth of it


def decay_lengths(surface: Surface, level: float) -> tuple[float, float]:
    """Return the shortest and the longest distance over which the autocorrelation falls to `level` of its maximum [m].

    Sal and the length that Str compares it with (ISO 25178-2:2021, 4.3.2 and 4.3.3).
    Looked for along rays at every degree, where the autocorrelation first falls to the level; a cubic spline goes
    through the lags. The longest is infinite if along some ray the level is not reached within half the length of the
    surface.
    """
    lags = autocorrelation(surface)
    middle = [axis.size // 2 for axis in lags.lags]
    share = np.where(lags.pairs > 0, lags.value, 0.0) / lags.value[tuple(middle)]
    smooth = spline_filter(share, order=3, mode="mirror")
    steps = surface.grid.spacing

    def values(radius: Array, angle: Array | float) -> Array:
        rows = middle[0] + radius * np.sin(angle) / steps[0]
        columns = middle[1] + radius * np.cos(angle) / steps[1]
        # Beyond the largest lags nothing is known.
        known = (rows <= share.shape[0] - 1) & (columns <= share.shape[1] - 1) & (columns >= 0)
        found = map_coordinates(smooth, [rows, columns], order=3, prefilter=False, mode="mirror")
        return np.where(known, found, np.nan)

    reach = math.hypot(*(axis[-1] for axis in lags.lags))
    radius = np.arange(0.0, reach + min(steps), min(steps) / 2)
    angles = np.radians(np.arange(0, 180))  # the other half is the same
    first = [int(np.argmax(values(radius, angle) <= level)) for angle in angles]
    if not any(first):
        return math.inf, math.inf
    # Zero lag is above the level: a first place of 0 says that there is none.
    falls = np.array([place > 0 for place in first])
    outer = radius[np.array(first)[falls]]
    inner = outer - min(steps) / 2
    for _ in range(_HALVINGS):
        half = (inner + outer) / 2
        below = values(half, angles[falls]) <= level
        inner, outer = np.where(below, inner, half), np.where(below, half, outer)
    return float(outer.min()), float(outer.max()) if falls.all() else math.inf
