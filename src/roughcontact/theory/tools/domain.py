"""Numbers at the border of a theory: taken as floats, or refused with the reason."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["Array", "count", "finite", "moderate", "number", "pair", "positive", "require", "scalar", "shown"]

Array = npt.NDArray[np.float64]

LONGEST = 60  # text of a value in a message
# Of sizes in between, whatever their unit, products of six are numbers of full precision.
SMALLEST, LARGEST = 1e-50, 1e50


def number(value: npt.ArrayLike, what: str) -> Array:
    """Return `value` as float64, a number as a number and an array as an array.

    Parameters
    ----------
    value : array_like
        What the user gave.
    what : str
        Its name and unit, for the message: ``"force [N]"``.

    Raises
    ------
    ValueError
        If it is no number and no array of numbers: a text, a material, nothing.
    """
    given = np.asarray(value) if value is None or isinstance(value, str | bytes) else value
    try:
        if isinstance(given, np.ndarray) and given.dtype.kind not in "biuf":
            raise TypeError(f"numbers of kind {given.dtype}")
        plain: Array = np.asarray(given, dtype=np.float64)[()]
    except (TypeError, ValueError, OverflowError) as error:
        parts = value if isinstance(value, tuple) else (value,)
        remedy = (
            "; of a material give the reduced modulus as a number: rc.reduced_modulus(...)"
            if "modulus" in what and any(hasattr(part, "young_modulus") for part in parts)
            else ""
        )
        raise ValueError(
            f"{what} must be a number or an array of numbers in SI units, not {shown(value)}{remedy}"
        ) from error
    return plain


def scalar(value: npt.ArrayLike, what: str) -> float:
    """Return one number, or refuse what is none, as `number` does."""
    x = number(value, what)
    require(np.ndim(x) == 0, f"{what} must be one number, not an array of shape {np.shape(x)}")
    return float(x)


def finite(value: npt.ArrayLike, what: str) -> Array:
    """Return `value` as `number` does, if all of it is finite."""
    x = number(value, what)
    require(np.isfinite(x), f"{what} must be finite", x)
    return x


def moderate(value: float, what: str) -> float:
    """Return a positive size, of which products can be taken without overflow and without loss of digits.

    Raises
    ------
    ValueError
        If it is too small or too large for that.
    """
    if not SMALLEST <= value <= LARGEST:
        raise ValueError(
            f"{what} must lie between {SMALLEST:g} and {LARGEST:g}, where products keep their digits, "
            f"not at {value:g}: give it in other units"
        )
    return value


def positive(value: npt.ArrayLike, what: str, *, zero: bool = False) -> Array:
    """Return `value` as `number` does, if it is in range.

    Parameters
    ----------
    value, what
        See `number`.
    zero : bool
        Whether 0 will do.

    Raises
    ------
    ValueError
        If a value is no number, or not positive (or 0) and finite.
    """
    x = number(value, what)
    right = np.isfinite(x) & ((x >= 0) if zero else (x > 0))
    if not right.all():
        wanted = "finite and not negative" if zero else "positive and finite"
        raise ValueError(f"{what} must be {wanted}, not {np.asarray(x)[~right].flat[0]}")
    return x


def count(what: str, value: int) -> int:
    """Return a whole number from 1 up, or refuse it."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 1:
        raise ValueError(f"{what} must be a whole number, at least 1, not {shown(value)}")
    return int(value)


def pair(values: tuple[npt.ArrayLike, npt.ArrayLike], what: str) -> tuple[Array, Array]:
    """Return two positive numbers, or arrays of one shape.

    Raises
    ------
    ValueError
        If there are not two, they are not positive, or their shapes do not fit.
    """
    if not isinstance(values, tuple | list | np.ndarray) or len(values) != 2:
        raise ValueError(f"{what} must be two, such as (1e-3, 2e-3), not {shown(values)}")
    first, second = (positive(value, what) for value in values)
    if np.ndim(first) and np.ndim(second) and np.shape(first) != np.shape(second):
        raise ValueError(
            f"{what} must be two numbers or arrays of one shape, not {first.shape} and {second.shape}"
        )
    return first, second


def require(condition: npt.ArrayLike, message: str, value: npt.ArrayLike | None = None) -> None:
    """Raise a `ValueError` with the `message` unless the `condition` holds everywhere.

    The message ends with the first `value`, an array of the shape of the condition or one number, for which it does
    not hold.
    """
    right = np.asarray(condition)
    if not right.all():
        wrong = "" if value is None else f" (given: {np.broadcast_to(value, right.shape)[~right].flat[0]:g})"
        raise ValueError(message + wrong)


def shown(value: object) -> str:
    """Return a value for a message: as it writes itself if that is short, or else of what kind it is."""
    text = repr(value)
    short = len(text) <= LONGEST and "\n" not in text
    return text if short else f"a {type(value).__name__}"
