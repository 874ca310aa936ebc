"""The inverse of a rising function, for many values at once."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

__all__ = ["bisect", "last_below"]

Array = npt.NDArray[np.float64]

DOUBLINGS = 1000  # as many as a double's range has


def last_below(value: Callable[[Array], Array], target: Array, low: float, high: float) -> Array:
    """Return for every target the largest x in [low, high] with ``value(x) <= target``.

    Parameters
    ----------
    value : callable
        Non-decreasing function of an array, with ``value(low) <= target``.
    target : array, shape (n,)
    low, high : float
        `high` may be infinite; then the range is doubled until the function exceeds the targets.

    Returns
    -------
    array, shape (n,)
        To the last digit; infinite where the function never exceeds the target.
    """
    width = np.full(target.shape, high - low if math.isfinite(high) else max(low, 1.0))
    if not math.isfinite(high):
        for _ in range(DOUBLINGS):
            inside = value(low + width) <= target
            if not inside.any():
                break
            width[inside] *= 2
    at_the_end = value(low + width) <= target
    # Halving first and bisecting then gives roots far below the range the same relative precision.
    for _ in range(DOUBLINGS):
        beyond = (value(low + width / 2) > target) & (width > np.finfo(float).tiny)
        if not beyond.any():
            break
        width[beyond] /= 2
    root = bisect(lambda x: value(x) > target, low + width / 2, low + width)
    # A target met at `low` alone: halving went to nothing.
    root[width <= np.finfo(float).tiny] = low
    root[at_the_end] = high
    return root


def bisect(beyond: Callable[[Array], npt.NDArray[np.bool_]], low: Array, high: Array) -> Array:
    """Return the place between `low` and `high` from which on `beyond` is true, to the last digit."""
    low, high = low.copy(), high.copy()
    for _ in range(64):
        middle = (low + high) / 2
        if ((middle == low) | (middle == high)).all():
            break
        over = beyond(middle)
        high = np.where(over, middle, high)
        low = np.where(over, low, middle)
    return np.asarray(low)
