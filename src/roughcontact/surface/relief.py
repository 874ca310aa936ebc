"""The range of heights, at the border: too small or too large a number loses its digits in products."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.theory.tools.domain import moderate

__all__ = ["check_relief"]


def check_relief(heights: npt.NDArray[np.float64]) -> None:
    """Refuse heights whose range is neither zero nor a number that can be squared without loss.

    Raises
    ------
    ValueError
        Naming the range; the remedy is another unit.
    """
    xp = namespace(heights)
    missing = xp.isnan(heights)
    highest = float(xp.max(xp.where(missing, -math.inf, heights)))
    lowest = float(xp.min(xp.where(missing, math.inf, heights)))
    if highest > lowest:
        moderate(highest - lowest, "the range of the heights [m]")
