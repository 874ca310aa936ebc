"""Numbers with units in ordinary notation, converted to SI: "10 N", "110GPa", "1e-6 m"."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from roughcontact.errors import InputError

__all__ = [
    "ANGLE",
    "AREA",
    "COMPLIANCE_AREA",
    "CONDUCTIVITY",
    "DENSITY",
    "ENERGY_PER_AREA",
    "FORCE",
    "FORCE_PER_LENGTH",
    "FREQUENCY",
    "HARDNESS",
    "IMPEDANCE",
    "LENGTH",
    "MODULUS",
    "PRESSURE",
    "RESISTANCE_AREA",
    "RESISTIVITY",
    "STIFFNESS_PER_AREA",
    "TEMPERATURE",
    "TIME",
    "VISCOSITY",
    "Kind",
    "has_unit",
    "parse",
    "parse_number",
    "unit_in",
]

# A number as programs write it; the rest is the unit.
_NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*", re.DOTALL)
# A product or quotient of names with small powers; more general arithmetic could take very long.
_NAME = r"[^\W\d_]+(?:(?:\*\*|\^)?-?\d|[²³])?"
_PRODUCT = rf"{_NAME}(?:\s*[*·]\s*{_NAME})*"
_UNIT = re.compile(rf"{_NAME}(?:\s*[*/·]\s*{_NAME})*|{_PRODUCT}\s*/\s*\(\s*{_PRODUCT}\s*\)")
# SI values far beyond any body, force or pressure; their squares and products stay finite.
_SMALLEST, _LARGEST = 1e-30, 1e30
# For N, m and Pa: pint, which reads all other units, takes longer to load than a small contact takes to solve.
_PREFIXES = {
    **{"p": 1e-12, "n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2},
    **{"k": 1e3, "M": 1e6, "G": 1e9, "T": 1e12},
}


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of quantity: its name, its SI unit, and an example for the messages."""

    name: str
    unit: str
    example: str


FORCE = Kind("a force", "N", "10N")
FORCE_PER_LENGTH = Kind("a force per length", "N/m", "10N/mm")
LENGTH = Kind("a length", "m", "5um")
AREA = Kind("an area", "m^2", "1mm^2")
PRESSURE = Kind("a pressure", "Pa", "1MPa")
MODULUS = Kind("a modulus", "Pa", "110GPa")
HARDNESS = Kind("a hardness", "Pa", "2GPa")
STIFFNESS_PER_AREA = Kind("a stiffness per area", "Pa/m", "N/um/mm^2")
COMPLIANCE_AREA = Kind("a closure over pressure", "m/Pa", "1e-14m/Pa")
IMPEDANCE = Kind("an acoustic impedance", "Pa*s/m", "46MPa*s/m")
RESISTIVITY = Kind("a resistivity", "ohm*m", "17nohm*m")
ENERGY_PER_AREA = Kind("an energy per area", "J/m^2", "50mJ/m^2")
CONDUCTIVITY = Kind("a thermal conductivity", "W/m/K", "400W/m/K")
RESISTANCE_AREA = Kind("a thermal resistance times area", "m^2*K/W", "0.1mm^2*K/W")
VISCOSITY = Kind("a viscosity", "Pa*s", "1mPa*s")
DENSITY = Kind("a density", "kg/m^3", "1000kg/m^3")
SPEED = Kind("a speed", "m/s", "10mm/s")
FREQUENCY = Kind("a frequency", "Hz", "5MHz")
TIME = Kind("a time", "s", "0.1s")
ANGLE = Kind("an angle", "rad", "30deg")
TEMPERATURE = Kind("a temperature", "K", "20degC")


def parse(text: str, kind: Kind) -> float:
    """Return the quantity in `text` in the SI unit of its `kind`; a bare number is SI already.

    Raises
    ------
    ValueError
        If the text is not a finite number with a unit of that kind.
    """
    remedy = f"write {kind.name} such as {kind.example}"
    match = _NUMBER.fullmatch(text)
    if match is None:
        raise InputError(f"{text!r} does not start with a number", remedy)
    if match[2].startswith(","):
        raise InputError(f"{text!r} holds a comma", f"write the decimal point as '.'; {remedy}")
    number, unit = float(match[1]), match[2]
    value = number if unit in ("", kind.unit) else number * _factor(unit, kind, text)
    if not math.isfinite(value):
        raise InputError(f"{text!r} is not a finite number", remedy)
    if value != 0 and not _SMALLEST <= abs(value) <= _LARGEST:
        raise InputError(f"{text!r} is out of range", f"check its exponent and unit; {remedy}")
    return value


def has_unit(text: str) -> bool:
    """Return whether anything follows the number in a text."""
    return unit_in(text) != ""


def unit_in(text: str) -> str:
    """Return the text after the number; the whole text if it does not begin with a number."""
    match = _NUMBER.fullmatch(text)
    return text if match is None else match[2]


def parse_number(text: str, example: str) -> float:
    """Return a number without a unit; the message shows the `example`.

    Raises
    ------
    ValueError
        If the text is not a finite number.
    """
    remedy = f"write a number such as {example}"
    match = _NUMBER.fullmatch(text)
    if match is not None and match[2].startswith(","):
        raise InputError(f"{text!r} holds a comma", f"write the decimal point as '.'; {remedy}")
    if match is None or match[2] or not math.isfinite(float(match[1])):
        raise InputError(f"{text!r} is not a number", remedy)
    return float(match[1])


def _factor(unit: str, kind: Kind, text: str) -> float:
    """Return how many SI units of `kind` one `unit` is."""
    prefix = (
        unit.removesuffix(kind.unit) if kind.unit.isalpha() else unit
    )  # not for m^2: mm^2 is not 1e-3 m^2
    if prefix != unit and prefix in _PREFIXES:
        return _PREFIXES[prefix]
    from roughcontact.units import registry  # late: it brings NumPy, and pint when it is called

    remedy = f"write {kind.name} such as {kind.example}"
    # A correct unit is tried first: an error there means that pint is broken, not that the given unit is wrong.
    units = registry()
    wanted = units.parse_units(kind.unit).dimensionality
    try:
        if _UNIT.fullmatch(unit) is None:
            raise InputError(unit)
        given = units.Quantity(1.0, units.parse_units(unit))
        right = given.check(wanted)
    except Exception as error:  # pint raises many classes for a bad unit, also those of its tokenizer
        raise InputError(f"unknown unit {unit!r} in {text!r}", remedy) from error
    if not right:
        raise InputError(f"{text!r} is not {kind.name}", remedy)
    return float(given.to(kind.unit).magnitude)
