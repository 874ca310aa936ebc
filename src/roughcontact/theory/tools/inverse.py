"""The inverse of an increasing function, for whole arrays at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from roughcontact.validation import Array

__all__ = ["bisect"]

# Halvings after which a bracket of a few times its lower end is as narrow as rounding.
HALVINGS = 56


def bisect(function: Callable[[Array], Array], value: Array, low: Array, high: Array) -> Array:
    """Return where an increasing `function` takes a `value`, by bisection between `low` and `high`.

    The error is ``2**-56`` of the bracket; for a small relative one, its ends must be of the size of the root.
    """
    low, high = (np.array(end, dtype=np.float64) for end in np.broadcast_arrays(low, high))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        below = function(middle) < value
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    root: Array = ((low + high) / 2)[()]
    return root
