"""Units of length as they stand in files and keywords, turned into metres."""

from __future__ import annotations

import math
import re
import unicodedata

from roughcontact.errors import InputError, about

__all__ = ["is_length", "length_factor", "parse_length", "stated_length"]

# Keys in the form NFKC, which unifies the two micro signs and the two angstrom signs.
_METRES = {
    "km": 1e3,
    "m": 1.0,
    "dm": 1e-1,
    "cm": 1e-2,
    "mm": 1e-3,
    "μm": 1e-6,
    "um": 1e-6,
    "nm": 1e-9,
    "Å": 1e-10,
    "pm": 1e-12,
    "in": 2.54e-2,
}
_PREFIXES = {
    "": 1.0,
    "kilo": 1e3,
    "centi": 1e-2,
    "milli": 1e-3,
    "micro": 1e-6,
    "mikro": 1e-6,
    "nano": 1e-9,
    "pico": 1e-12,
}
# In lower case, each with and without an s at its end.
_WORDS = {
    **{prefix + word: factor for prefix, factor in _PREFIXES.items() for word in ("meter", "metre")},
    "micron": 1e-6,
    **dict.fromkeys(("angstrom", "angstroem", "ångstrom", "ångström"), 1e-10),
    **dict.fromkeys(("inch", "inche"), 2.54e-2),
    **dict.fromkeys(("mil", "thou"), 2.54e-5),
    **dict.fromkeys(("microin", "microinch", "microinche"), 2.54e-8),
}
_KNOWN = "km, m, cm, mm, um, nm, angstrom or pm"
_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\D*?)\s*")


def is_length(unit: str | float | None) -> bool:
    """Whether a file states a unit of length: a name in the table here, or a positive factor to metres.

    Other words are left to the user: for a library of units, ``au`` and ``points`` are lengths.
    """
    if isinstance(unit, str):
        return _named(unit) is not None
    return unit is not None and math.isfinite(unit) and unit > 0


def length_factor(unit: str | float) -> float:
    """Return the metres in one `unit`: a name such as ``"um"``, any length of pint, or a number of metres."""
    if isinstance(unit, str):
        factor = _named(unit)
        return _by_pint(unit) if factor is None else factor
    factor = float(unit)
    if not (math.isfinite(factor) and factor > 0):
        raise about("unit", f"must be a length above 0, not {unit}", f"use {_KNOWN}, or a number of metres")
    return factor


def parse_length(value: str | float) -> float:
    """Return a positive length [m] from a number of metres or a text such as ``"10 um"``."""
    if isinstance(value, str):
        parts = _QUANTITY.fullmatch(value)
        if parts is None or not parts[2]:
            raise InputError(f"length {value!r} needs a number and a unit, such as '10 um'")
        length = float(parts[1]) * length_factor(parts[2])
    else:
        length = float(value)
    if not (math.isfinite(length) and length > 0):
        raise InputError(f"length must be positive and finite, not {value!r}")
    return length


def stated_length(text: str) -> float | None:
    """Return the positive length [m] that a file states, such as ``"10 microns"``; None if its words are unknown."""
    parts = _QUANTITY.fullmatch(text)
    return parse_length(text) if parts is not None and is_length(parts[2]) and float(parts[1]) > 0 else None


def _named(unit: str) -> float | None:
    """Return the metres in a unit that stands in the tables; None for any other."""
    name = unicodedata.normalize("NFKC", unit).strip()
    word = name.casefold()
    return _METRES.get(name) or _WORDS.get(word) or _WORDS.get(word.removesuffix("s"))


def _by_pint(unit: str) -> float:
    from roughcontact.files.quantity import LENGTH, parse  # late: it brings pint

    try:
        if not unit.strip():
            raise InputError(unit)
        return parse(f"1 {unit}", LENGTH)
    except ValueError as error:
        raise InputError(
            f"unit {unit!r} is not a known unit of length",
            f"use {_KNOWN}, or a number of metres",
            place="unit",
        ) from error
