"""Which cells of a grid are meant."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_array, namespace

__all__ = ["checked_region"]

Mask = npt.NDArray[np.bool_]


def checked_region(region: Any, shape: tuple[int, ...]) -> Mask:
    """Return which cells of a grid are meant, as truth values.

    Raises
    ------
    ValueError
        If the shape is another, or if there are numbers other than one and zero: heights or gaps, say, or NaN.
    """
    given = region if is_array(region) else np.asarray(region)
    xp = namespace(given)
    if tuple(given.shape) != shape:
        raise ValueError(f"a region of shape {tuple(given.shape)} does not fit the grid of shape {shape}")
    if xp.isdtype(given.dtype, "bool"):
        return given
    if xp.isdtype(given.dtype, "numeric"):
        inside: Mask = given == 1
        if bool(xp.all(inside | (given == 0))):
            return inside
    raise ValueError("a region is told by truth values, such as pressure > 0, or by ones and zeros alone")
