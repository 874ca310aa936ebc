"""Values that carry a unit (pint, astropy, xarray and others), converted to SI numbers on entry."""

from __future__ import annotations

import re
from functools import cache
from types import NoneType
from typing import Any

import numpy as np

from roughcontact.errors import about

__all__ = ["PLAIN", "as_text", "in_si", "registry", "word_of"]

# The types of almost all arguments, which carry no unit: they cost one look-up in this set.
PLAIN = frozenset({float, int, bool, str, bytes, NoneType, np.ndarray, np.float64, np.int64, slice})
# CF and UDUNITS write exponents behind the names: "N m-1", "m2".
_EXPONENT = re.compile(r"(?<![\d.][eE])(?<=[^\W\d])(?=-?\d)")

def in_si(value: Any, unit: str | None, what: str) -> Any:
    """Return a value that carries a unit as plain numbers in an SI `unit`, and any other value as it is.

    A unit is carried in ``.units`` (pint, netCDF4), in ``.unit`` (astropy) or in ``.attrs["units"]`` (xarray, pandas,
    h5py). Lists and tuples are searched.

    Parameters
    ----------
    value : object
        Value of the user.
    unit : str, optional
        SI unit of the parameter, such as ``"N/m"``. Without it the parameter is a pure number.
    what : str
        Name of the parameter, for the message.

    Raises
    ------
    ValueError
        If the unit is not known or has another dimension, or if a list also holds numbers without a unit.
    """
    if type(value) in PLAIN:
        return value
    if isinstance(value, list | tuple):
        return value if PLAIN.issuperset(map(type, value)) else _parts_in_si(value, unit, what)
    carried = _unit_of(value)
    if carried is not None:
        return _converted(value, carried, unit, what)
    if isinstance(value, np.ndarray):
        return _unmasked(value)
    if hasattr(value, "attrs") and type(getattr(value, "data", None)) not in PLAIN:
        return in_si(value.data, unit, what)  # an array of xarray around one of pint
    return value


def as_text(value: Any) -> Any:
    """Return a value that carries a unit as text, ``"1 mm"``, an array as a list of texts, other values as they are."""
    carried = None if type(value) in PLAIN else _unit_of(value)
    if carried is None:
        return value
    unit = word_of(carried)
    numbers = np.asarray(_numbers_of(value), dtype=np.float64)
    texts = [f"{number!r} {unit}" for number in numbers.reshape(-1).tolist()]
    return texts if numbers.ndim else texts[0]


def word_of(value: Any) -> str:
    """Return a word, which some files hold as bytes."""
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


@cache
def registry() -> Any:
    """Return the units of pint, with which text is read: ``"kN"``, ``"N m-1"``, ``"µm"``."""
    import pint  # late: it takes longer to import than the rest of the command line

    return pint.UnitRegistry(preprocessors=[lambda text: _EXPONENT.sub("**", text)])


def _parts_in_si(values: Any, unit: str | None, what: str) -> Any:
    parts = [in_si(value, unit, what) for value in values]
    changed = [part is not value for part, value in zip(parts, values, strict=True)]
    if not any(changed):
        return values
    bare = [value for value, other in zip(values, changed, strict=True) if not other and value != 0]
    if bare:
        raise about(what, f"holds numbers with a unit and {bare[0]!r} without", "give each a unit")
    return tuple(parts) if isinstance(values, tuple) else parts


def _unit_of(value: Any) -> Any:
    """Return the unit that a value carries, an object or a text, or None."""
    for name in ("units", "unit"):
        carried = getattr(value, name, None)
        if carried is not None and not callable(carried):
            return carried
    attributes: Any = getattr(value, "attrs", None)
    if not hasattr(attributes, "items"):
        return None
    return next(
        (text for name, text in attributes.items() if str(name).casefold() in ("units", "unit")), None
    )


def _numbers_of(value: Any) -> Any:
    """Return a value without its unit; NaN where a mask covers it."""
    numbers = next((getattr(value, name) for name in ("magnitude", "value") if hasattr(value, name)), value)
    return _unmasked(numbers) if isinstance(numbers, np.ndarray) else numbers


def _unmasked(values: Any) -> Any:
    """Return real numbers with NaN where NumPy's or astropy's mask covers them, other values as they are."""
    mask = getattr(values, "mask", None)
    if mask is None or values.dtype.kind not in "fiu":
        return values
    return np.where(mask, np.nan, np.asarray(values, dtype=np.float64))


def _converted(value: Any, carried: Any, unit: str | None, what: str) -> Any:
    """Return plain numbers in `unit`; a value of pint or astropy goes to the base units of its own library first."""
    stated = words = word_of(carried)
    if hasattr(value, "to_base_units"):
        value = value.to_base_units()
        words = str(value.units)
    elif hasattr(value, "si"):
        value = value.si
        words = str(value.unit)
    numbers = _numbers_of(value)
    try:
        given = registry().Quantity(
            float(numbers) if np.ndim(numbers) == 0 else np.asarray(numbers), "" if words == "1" else words
        )
    except Exception as error:  # pint raises many classes for a bad unit, also those of its tokenizer
        wanted = f"plain numbers in {unit}" if unit else "plain numbers"
        raise about(what, f"carries the unit {stated!r}, which is not known", f"give {wanted}") from error
    if (unit == "Hz" and "radian" in str(given.to_root_units().units)) or (
        unit == "rad/s" and re.search("hz|hertz", stated, re.IGNORECASE)
    ):  # pint converts one to the other without the factor 2 pi
        raise about(
            what, f"must be in {unit}, not in {stated}", "divide or multiply by 2 pi: 1 Hz is 2 pi rad/s"
        )
    if given.is_compatible_with(unit or ""):
        return given.m_as(unit or "")
    if unit is not None:
        raise about(what, f"must be in {unit}, or in a unit of the same dimension, not in {stated}")
    plain = given.to_base_units().magnitude
    number = f"{plain:.12g}" if np.ndim(plain) == 0 else "their numbers in SI units"
    raise about(what, f"is read as plain numbers, not in {stated}", f"give {number}")
