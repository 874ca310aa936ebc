"""The range of heights, at the border: finite, and neither so small nor so large that products lose digits."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy, namespace
from roughcontact.validation import moderate

__all__ = ["check_heights"]


def check_heights(heights: npt.NDArray[np.float64]) -> None:
    """Refuse heights that are infinite or all missing, or whose range is not 0 and cannot be squared without loss.

    Raises
    ------
    ValueError
        Naming the fault and the remedy.
    """
    xp = namespace(heights)
    if is_numpy(heights):  # two passes, and no memory
        highest, lowest = (float(bound.reduce(heights, axis=None)) for bound in (np.fmax, np.fmin))
    else:
        missing = xp.isnan(heights)
        highest = float(xp.max(xp.where(missing, -math.inf, heights)))
        lowest = float(xp.min(xp.where(missing, math.inf, heights)))
    if math.isnan(highest) or lowest > highest:
        raise ValueError("all heights are NaN: the surface holds no measured point")
    if math.isinf(highest) or math.isinf(lowest):
        count = int(xp.count_nonzero(xp.isinf(heights)))
        raise ValueError(f"{count} heights are infinite; mark points without a measurement by NaN")
    if highest > lowest:
        moderate(highest - lowest, "the range of the heights [m]")
