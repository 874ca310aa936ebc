"""Numbers at the border of a theory: taken as floats, or refused with the reason."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["Array", "positive", "require"]

Array = npt.NDArray[np.float64]


def positive(value: npt.ArrayLike, what: str, *, zero: bool = False) -> Array:
    """Return `value` as float64, a number as a number and an array as an array.

    Parameters
    ----------
    value : array_like
        What the user gave.
    what : str
        Its name and unit, for the message: ``"force [N]"``.
    zero : bool
        Whether 0 will do.

    Raises
    ------
    ValueError
        If a value is not positive (or 0) and finite.
    """
    x = np.asarray(value, dtype=np.float64)
    right = np.isfinite(x) & ((x >= 0) if zero else (x > 0))
    if not right.all():
        wanted = "finite and not negative" if zero else "positive and finite"
        raise ValueError(f"{what} must be {wanted}, not {x[~right].flat[0]}")
    plain: Array = x[()]
    return plain


def require(condition: npt.ArrayLike, message: str) -> None:
    """Raise a `ValueError` with the `message` unless the `condition` holds everywhere."""
    if not np.all(condition):
        raise ValueError(message)
