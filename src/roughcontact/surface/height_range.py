"""Checks of heights: real, of the shape of the grid, finite, and in a range in which products keep their digits."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from array_api_compat import is_jax_array

from roughcontact.arrays import is_array, is_numpy, namespace, wants_gradient
from roughcontact.errors import InputError, about
from roughcontact.validation import Array, moderate

__all__ = ["height_range", "is_elsewhere", "own_heights"]


def is_elsewhere(heights: Any) -> bool:
    """Return whether heights are an array of another library than NumPy."""
    return is_array(heights) and not is_numpy(heights)


def own_heights(heights: Any, shape: tuple[int, ...]) -> Array:
    """Return heights as a surface stores them: a read-only copy, or the array of another library.

    Raises
    ------
    ValueError
        If they are not real numbers, do not fit the grid, are infinite or all missing, or have a range that cannot be
        squared without loss.
    """
    if is_elsewhere(heights):
        own = heights
        if not namespace(own).isdtype(own.dtype, "real floating"):
            raise about(
                "heights",
                f"outside NumPy must be real floating numbers [m], not of type {own.dtype}",
                "convert whole numbers to float64",
            )
        if wants_gradient(own):
            raise InputError(
                "heights that require gradients are not recorded by a surface",
                "detach them, heights.detach(), or differentiate a curve: "
                "rc.differentiable_curve(grid, modulus, forces=[...])(heights)",
                "heights",
            )
        if is_jax_array(own):
            raise InputError(
                "heights of JAX cannot be pressed, because its arrays cannot be changed",
                "give np.asarray(heights); for gradients, call rc.differentiable_curve(grid, modulus, "
                "forces=[...])(heights)",
                "heights",
            )
    else:
        given = np.ma.filled(heights, np.nan) if np.ma.isMaskedArray(heights) else np.asarray(heights)
        if given.dtype.kind not in "fiu":
            kind = "text" if given.dtype.kind in "SU" else f"of type {given.dtype.name}"
            raise about("heights", f"must be real numbers [m], not {kind}")
        own = np.array(given, dtype=np.float64)
        own.flags.writeable = False
    if tuple(own.shape) != shape:
        raise about(
            "heights",
            f"of shape {tuple(own.shape)} do not fit the grid of shape {shape}",
            "give Grid(heights.shape, spacing)",
        )
    _check_range(own)
    return own  # type: ignore[no-any-return]


def height_range(heights: Array) -> tuple[float, float]:
    """Return the lowest and the highest measured height; an empty range if all are missing."""
    if is_numpy(heights):  # two passes, without further memory
        return float(np.fmin.reduce(heights, axis=None)), float(np.fmax.reduce(heights, axis=None))
    xp = namespace(heights)
    missing = xp.isnan(heights)
    lowest = float(xp.min(xp.where(missing, math.inf, heights)))
    return lowest, float(xp.max(xp.where(missing, -math.inf, heights)))


def _check_range(heights: Array) -> None:
    """Refuse heights that are infinite or all missing, or whose range is not 0 and cannot be squared without loss.

    Raises
    ------
    ValueError
        The message names the fault and the remedy.
    """
    xp = namespace(heights)
    lowest, highest = height_range(heights)
    if math.isnan(highest) or lowest > highest:
        raise InputError(
            "all heights are NaN: the surface holds no measured point", "give at least one height", "heights"
        )
    if math.isinf(highest) or math.isinf(lowest):
        count = int(xp.count_nonzero(xp.isinf(heights)))
        many = "height is" if count == 1 else "heights are"
        raise InputError(
            f"{count} {many} infinite",
            "mark points without a measurement by NaN",
            "heights",
        )
    if highest > lowest:
        moderate(highest - lowest, "the range of the heights [m]")
