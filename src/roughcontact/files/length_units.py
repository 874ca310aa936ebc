"""Units of length as they stand in files and keywords, turned into metres."""

from __future__ import annotations

import math
import re
import unicodedata

__all__ = ["is_length", "length_factor", "parse_length"]

# Keys in the form NFKC, which makes one sign of the two micro signs and one of the two angstrom signs.
_METRES = {
    "km": 1e3,
    "m": 1.0,
    "cm": 1e-2,
    "mm": 1e-3,
    "μm": 1e-6,
    "um": 1e-6,
    "micron": 1e-6,
    "nm": 1e-9,
    "Å": 1e-10,
    "angstrom": 1e-10,
    "pm": 1e-12,
}
_KNOWN = "km, m, cm, mm, um, nm, angstrom or pm"
_QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\D*?)\s*")


def is_length(unit: str | float | None) -> bool:
    """Whether `unit` is a unit of length: a name in the table, or a positive factor to metres."""
    try:
        return unit is not None and length_factor(unit) > 0
    except ValueError:
        return False


def length_factor(unit: str | float) -> float:
    """Return the metres in one `unit`, a name such as ``"um"`` or itself a number of metres."""
    if isinstance(unit, str):
        factor = _METRES.get(unicodedata.normalize("NFKC", unit).strip())
        if factor is None:
            raise ValueError(
                f"unit {unit!r} is not a unit of length known here; use {_KNOWN}, or a number of metres"
            )
        return factor
    factor = float(unit)
    if not (math.isfinite(factor) and factor > 0):
        raise ValueError(f"unit must be a positive number of metres or one of {_KNOWN}, not {unit}")
    return factor


def parse_length(value: str | float) -> float:
    """Return a positive length [m] from a number of metres or a text such as ``"10 um"``."""
    if isinstance(value, str):
        parts = _QUANTITY.fullmatch(value)
        if parts is None or not parts[2]:
            raise ValueError(f"length {value!r} needs a number and a unit, such as '10 um'")
        length = float(parts[1]) * length_factor(parts[2])
    else:
        length = float(value)
    if not (math.isfinite(length) and length > 0):
        raise ValueError(f"length must be positive and finite, not {value!r}")
    return length
