"""Roots of functions of arrays: bisection for monotone functions, Newton's method for concave ones."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from roughcontact.validation import Array, Mask

__all__ = ["bisect", "concave_root", "last_below"]

DOUBLINGS = 1000  # the range of a double
HALVINGS = 64  # of a bracket: more than the bits of a double
STEPS = 100
CLOSE = 1e-8  # in scales; Newton's method doubles the digits: after a step of this size only rounding is left


def bisect(beyond: Callable[[Array], Mask], low: Array, high: Array) -> Array:
    """Return the position between `low` and `high` from which on `beyond` is true, to the last digit.

    If a root is far below the width of its bracket, the error is ``2**-64`` of that width.

    Parameters
    ----------
    beyond : callable
        Whether each position of an array lies beyond the root: false up to it, true from there on.
    low, high : float or array
        Ends of the brackets, broadcast against each other.

    Returns
    -------
    float or array
        Roots, in the shape of the brackets.
    """
    low, high = (np.array(end, dtype=np.float64) for end in np.broadcast_arrays(low, high))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if ((middle == low) | (middle == high)).all():
            break
        over = beyond(middle)
        high = np.where(over, middle, high)
        low = np.where(over, low, middle)
    return low[()]


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
    # Halving the upper end before bisection gives roots far below the range the same relative precision.
    for _ in range(DOUBLINGS):
        beyond = (value(low + width / 2) > target) & (width > np.finfo(float).tiny)
        if not beyond.any():
            break
        width[beyond] /= 2
    root = bisect(lambda x: value(x) > target, low + width / 2, low + width)
    # A target met only at `low`: halving underflowed.
    root[width <= np.finfo(float).tiny] = low
    root[at_the_end] = high
    return root


def concave_root(
    function: Callable[[Array], tuple[Array, Array]], value: Array, start: Array, *, scale: float = 1.0
) -> Array:
    """Return the x at which a function takes the `value`.

    Parameters
    ----------
    function : callable
        Function of an array x that returns values and derivatives. It must be monotone and concave, like the logarithm
        of the load on a rough surface over the height of the flat: integrals of log-concave densities are log-concave.
    value, start : array
        Target values, and starting points.
    scale : float
        Change of x over which the slope changes little; 0 if the function is about a power of x.

    Raises
    ------
    RuntimeError
        If a value is not reached in a hundred steps: then the function is not concave and monotone.

    Notes
    -----
    A tangent lies above a concave function, so from the second step on Newton's iterates approach the root from one
    side and cannot pass it: no bracket is needed.
    """
    x = np.array(start, dtype=np.float64)
    for _ in range(STEPS):
        height, slope = function(x)
        step = (value - height) / slope
        x = x + step
        if (np.abs(step) <= CLOSE * (scale + np.abs(x))).all():
            return x
    raise RuntimeError(f"Newton's method found no root in {STEPS} steps: a value or start may be NaN")
