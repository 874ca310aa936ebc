"""Numbers that mark points without a height, compared as they were stored or printed."""

from __future__ import annotations

import numpy as np

from roughcontact.validation import Array, Mask

__all__ = ["holds_mark", "without_fills", "without_marks"]

# Larger than any height in any unit; above it only the first digits of a mark are compared: few may be printed.
_BEYOND = 1e30
_DIGITS = 1e-3
# Marks of programs for missing values: the largest single and double, Surfer's 2^127, the default of NetCDF.
_FILLS = (float(np.finfo(np.float32).max), float(np.finfo(np.float64).max), 2.0**127, 9.969209968386869e36)
_NEAR = 1e-2  # relative: a mark that was printed with fewer digits


def holds_mark(values: Array, marks: tuple[float, ...]) -> Mask:
    """Return where `values` hold one of the marks, either of which may be rounded to single precision."""
    found = np.zeros(values.shape, dtype=bool)
    if not marks:
        return found
    with np.errstate(over="ignore", invalid="ignore"):
        single = values.astype(np.float32)
        for mark in marks:
            if abs(mark) > _BEYOND:
                found |= np.abs(values / mark - 1) < _DIGITS
            elif np.isfinite(mark):
                found |= (values == mark) | (single == np.float32(mark))
    return found


def without_marks(values: Array, marks: tuple[float, ...]) -> tuple[Array, tuple[str, ...], tuple[str, ...]]:
    """Return heights without the marks that a file states, a note, and warnings.

    A warning is returned if the mark occurs nowhere, while a repeated extreme height is close to it.
    """
    found = holds_mark(values, marks)
    if found.any():
        stated = ", ".join(f"{mark:g}" for mark in marks)
        return (
            np.where(found, np.nan, values),
            (f"not measured where it is {stated}, as its header states",),
            (),
        )
    warnings = []
    known = values[np.isfinite(values)]
    for mark in marks if known.size else ():
        for extreme in (float(known.min()), float(known.max())):
            count = int(np.count_nonzero(known == extreme))
            if count > 1 and 0 < abs(extreme - mark) <= _NEAR * abs(mark):
                warnings.append(
                    f"it states that {mark:g} marks missing points, and {count} of its heights are {extreme:g}; "
                    f"state {extreme:g} if they are missing"
                )
    return values, (), tuple(warnings)


def without_fills(values: Array) -> tuple[Array, tuple[str, ...]]:
    """Return heights without the numbers that programs store for missing ones, and a warning if there were any."""
    with np.errstate(invalid="ignore"):
        far = np.abs(values) > _BEYOND
    if not far.any():
        return values, ()
    found = far & holds_mark(np.abs(values), _FILLS)
    if not found.any():
        return values, ()
    number = float(values[found][0])
    warning = (
        f"{np.count_nonzero(found)} points hold {number:g}, a mark of missing points, and are read as missing"
    )
    return np.where(found, np.nan, values), (warning,)
