"""Where a monotone, concave function takes a value, by Newton's method for whole arrays."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

__all__ = ["concave_root"]

Array = npt.NDArray[np.float64]

STEPS = 100
CLOSE = 1e-8  # in scales; Newton doubles the digits: after a step of this size nothing but rounding is left


def concave_root(
    function: Callable[[Array], tuple[Array, Array]], value: Array, start: Array, *, scale: float = 1.0
) -> Array:
    """Return the x at which a function takes the `value`.

    Parameters
    ----------
    function : callable
        Of an array x; it returns the function's values and derivatives. Monotone and concave, as is the logarithm
        of the load on a rough surface over the height of the flat: integrals of log-concave densities are
        log-concave.
    value, start : array
        What is to be met, and where to start.
    scale : float
        How far x may go without much of a change of the slope; 0 if the function is a power of x, or near one.

    Raises
    ------
    RuntimeError
        If a hundred steps do not meet a value: the function is not what it should be.

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
    raise RuntimeError(f"Newton's method met no root in {STEPS} steps: a value or start may not be a number")
