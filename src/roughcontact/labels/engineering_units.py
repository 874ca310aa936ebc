"""Engineering units: prefixes with which numbers are easy to read."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

__all__ = ["Scale", "pretty", "scale", "written"]

_PREFIXES = {-18: "a", -15: "f", -12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


@dataclass(frozen=True, slots=True)
class Scale:
    """A unit for a picture: multiply a value in SI by `factor` and write `unit` beside it.

    Parameters
    ----------
    factor : float
        Numbers in `unit` over those in SI.
    unit : str
        The unit as it is printed.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.plot.Scale(1e-6, "MPa")  # a pressure in Pa times 1e-6 is in MPa
    Scale(factor=1e-06, unit='MPa')
    """

    factor: float
    unit: str


def scale(largest: float, unit: str) -> Scale:
    """Return the scale in which `largest`, in the SI unit `unit`, lies between 1 and 1000.

    The prefix goes to the first unit of a product (``"N m-1"`` becomes kN/m) and is raised to the power of that unit
    (``"m2"`` becomes µm², a factor of 1e12, ``"m-2"`` 1/µm²). Neighbouring prefixes of areas differ by a factor of a
    million: areas lie between 0.01 and 10 000, and higher powers likewise. Kilometres are the largest length, seconds
    the largest time; only energies go below pico. A stiffness per area is in N/µm/mm² (MPa/µm).
    """
    if unit == "Pa m-1":  # always the unit of machine design
        return Scale(1e-12, "N/µm/mm²")
    first = unit.split()[0] if unit else ""
    found = re.search(r"-?\d+$", first)
    power = int(found.group()) if found else 1
    exponent = 0
    if math.isfinite(largest) and largest > 0 and first not in ("", "1", "%"):
        lowest = -2 * (abs(power) - 1)  # decade in which the numbers begin
        # The small factor keeps 1e-6 m, which rounding may put just below, at 1 µm.
        decades = math.log10(largest * (1 + 1e-9)) - lowest
        exponent = 3 * math.floor(decades / (3 * abs(power))) * (1 if power > 0 else -1)
    highest = 0 if unit == "s" else 3 if first.startswith("m") else 12
    smallest = -18 if first == "J" else -12
    exponent = min(max(exponent, smallest), highest)
    # A division by an exact power of ten rounds only once.
    shift = -exponent * power
    factor = 10.0**shift if shift >= 0 else 1 / 10.0**-shift
    return Scale(factor, pretty(f"{_PREFIXES[exponent]}{unit}"))


def pretty(unit: str) -> str:
    """Return a unit as it is written in print: ``"N m-1"`` as N/m, ``"m-2"`` as 1/m², ``"N/um/mm^2"`` as N/µm/mm²."""
    unit = re.sub(r"\bu(?=[A-Za-z])", "µ", unit.replace("**", "").replace("^", ""))
    if unit in ("", "1"):
        return ""
    over = [part.replace("-1", "").replace("-", "") for part in unit.split() if "-" in part]
    under = [part for part in unit.split() if "-" not in part]
    units = ["·".join(under), *over]
    raised = "/".join(units).translate(_SUPERSCRIPTS)
    return raised if under else f"1{raised}"


def written(value: float, unit: str, digits: int = 3) -> str:
    """Return a value with its unit in words: ``written(1.2345e-5, "m")`` is "12.3 µm"."""
    if not math.isfinite(value):
        return "infinite" if value > 0 else "unknown"
    # Rounded first, so that 999.99 nm are 1 µm and not 1000 nm.
    rounded = float(f"{value:.{digits}g}")
    chosen = scale(abs(rounded), unit)
    number = float(f"{rounded * chosen.factor:.{digits}g}")
    # Beyond all prefixes, powers of ten are shorter than zeros.
    text = f"{number:.0f}" if 10**digits <= abs(number) < 1e6 else f"{number:g}"
    return f"{text} {chosen.unit}".rstrip()
