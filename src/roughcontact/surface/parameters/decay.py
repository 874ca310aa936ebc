"""How fast the autocorrelation decays in its fastest and its slowest direction."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.ndimage import map_coordinates

from roughcontact.surface.analysis.correlation import autocorrelation
from roughcontact.surface.surface import Surface

__all__ = ["decay_lengths"]

Array = npt.NDArray[np.float64]


def decay_lengths(surface: Surface, level: float) -> tuple[float, float]:
    """Return the shortest and the longest distance over which the autocorrelation falls to `level` of its maximum [m].

    Looked for along rays at every degree, straight between the lags. The longest is infinite if along
    some ray the level is not reached within half the length of the surface.
    """
    lags = autocorrelation(surface)
    middle = [axis.size // 2 for axis in lags.lags]
    share = np.where(lags.pairs > 0, lags.value, 0.0) / lags.value[tuple(middle)]
    steps = surface.grid.spacing
    reach = math.hypot(*(axis[-1] for axis in lags.lags))
    radius = np.arange(0.0, reach + min(steps), min(steps) / 2)
    found = []
    for angle in np.radians(np.arange(0, 180)):  # the other half is the same
        rows = middle[0] + radius * math.sin(angle) / steps[0]
        columns = middle[1] + radius * math.cos(angle) / steps[1]
        inside = (rows <= share.shape[0] - 1) & (columns <= share.shape[1] - 1) & (columns >= 0)
        ray = map_coordinates(share, [rows[inside], columns[inside]], order=1)
        below = np.flatnonzero(ray <= level)
        if not below.size:
            found.append(math.inf)
            continue
        i = int(below[0])
        part = (ray[i - 1] - level) / (ray[i - 1] - ray[i])
        found.append(float(radius[i - 1] + part * (radius[i] - radius[i - 1])))
    return min(found), max(found)
