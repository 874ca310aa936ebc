"""Texts of users into values in SI: quantities, numbers, choices, regions, lists of loads."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from roughcontact.errors import InputError
from roughcontact.files import quantity
from roughcontact.files.quantity import FORCE, FORCE_PER_LENGTH, LENGTH, MODULUS, PRESSURE, TEMPERATURE, Kind
from roughcontact.recipe.job_calls import Call

if TYPE_CHECKING:
    from roughcontact.materials import Material

__all__ = [
    "METALS",
    "RIGID",
    "Amount",
    "Choice",
    "Likely",
    "Names",
    "PureNumber",
    "Share",
    "band",
    "choose",
    "known_material",
    "linear_loads",
    "modulus",
    "points",
    "ranges",
    "rising_loads",
    "sha256",
    "size",
    "temperature",
    "whole",
    "word",
]

METALS = (
    *("steel", "stainless-steel", "aluminium", "titanium", "copper", "silver", "gold", "nickel"),
    "tungsten",
)  # those of `materials`, which imports NumPy: help and completion must be fast
RIGID = "rigid"
MOST_LOADS = 100_000
ZERO_CELSIUS = 273.15  # K
_FOAM = 1e6  # Pa: soft polyurethane foams have 0.1 MPa or less, rubber some MPa


@dataclass(frozen=True, slots=True)
class Amount:
    """Reads a quantity of a kind; it must be positive, or not negative, if so declared."""

    kind: Kind
    what: str = ""
    positive: bool = True
    zero: bool = False

    def __call__(self, text: str) -> float:
        """Return the value that a text states."""
        value = _parsed(text, self.kind)
        what = self.what or f"the {self.kind.name.split(' ', 1)[1]}"
        if self.positive and not value > 0:
            raise InputError(
                f"{what} must be positive, not {text!r}", f"give a value such as {self.kind.example}"
            )
        if self.zero and value < 0:
            raise InputError(
                f"{what} must not be negative, not {text!r}", f"give 0 or more, such as {self.kind.example}"
            )
        return value


@dataclass(frozen=True, slots=True)
class PureNumber:
    """Reads a number without a unit between two ends, which are allowed if `ends`."""

    low: float
    high: float
    what: str
    example: str
    ends: bool = True

    def __call__(self, text: str) -> float:
        """Return the value that a text states."""
        value = quantity.parse_number(text, self.example)
        if not (self.low <= value <= self.high if self.ends else self.low < value < self.high):
            excluded = "" if self.ends else " (both excluded)"
            raise InputError(
                f"{self.what} must lie between {self.low:g} and {self.high:g}{excluded}, not {text!r}",
                f"give a number such as {self.example}",
            )
        return value


@dataclass(frozen=True, slots=True)
class Share:
    """Reads a fraction above 0 and below 1: "5%" or "0.05"."""

    what: str

    def __call__(self, text: str) -> float:
        """Return the value that a text states."""
        number = quantity.parse_number(text.removesuffix("%"), "5%")
        value = number / 100 if text.endswith("%") else number
        if not 0 < value < 1:
            raise InputError(f"{self.what} must lie between 0 and 100 %, not {text!r}", "give one such as 5%")
        return value


@dataclass(frozen=True, slots=True)
class Choice:
    """Reads one word of a list."""

    choices: tuple[str, ...]

    def __call__(self, text: str) -> str:
        """Return the value that a text states."""
        if text not in self.choices:
            raise InputError(f"{text!r} is not one of the choices", choose(text, self.choices))
        return text


@dataclass(frozen=True, slots=True)
class Names:
    """Reads a comma list of words of a given list, each at most once."""

    what: str
    names: tuple[str, ...]

    def __call__(self, text: str) -> tuple[str, ...]:
        """Return the value that a text states."""
        names = tuple(part.strip() for part in text.split(",") if part.strip())
        for name in names:
            if name not in self.names:
                raise InputError(f"there is no {self.what} {name!r}", choose(name, self.names))
        if not names or len(set(names)) < len(names):
            raise InputError(
                f"{text!r} is not a valid list",
                f"name each {self.what} once, such as {','.join(self.names[:2])}",
            )
        return names


def choose(text: str, known: Sequence[str]) -> str:
    """Return the remedy for an unknown word: the nearest known one, and the list."""
    near = difflib.get_close_matches(text, known, 1)
    return (
        f"did you mean {near[0]!r}? choose from {', '.join(known)}"
        if near
        else f"choose from {', '.join(known)}"
    )


def whole(low: int, what: str, high: int = 10**30) -> Callable[[str], int]:
    """Return a reader of whole numbers of at least `low`."""

    def read(text: str) -> int:
        if re.fullmatch(r"\s*\d{1,30}\s*", text, re.ASCII) is None or not low <= int(text) <= high:
            end = "up" if high == 10**30 else f"to {high}"
            raise InputError(
                f"{what} must be a whole number from {low} {end}, not {text!r}",
                f"give one such as {max(low, 2)}",
            )
        return int(text)

    return read


def word(text: str) -> str:
    """Return a name, which is not empty."""
    if not text:
        raise InputError("the name is empty", "write it, or leave the field out")
    return text


def sha256(text: str) -> str:
    """Return a SHA-256 as files of checksums write it."""
    if re.fullmatch("[0-9a-f]{64}", text) is None:
        raise InputError(
            f"{text!r} is not a SHA-256",
            "write its 64 digits from 0 to f, as sha256sum prints them, or leave it out",
        )
    return text


@dataclass(frozen=True, slots=True)
class Likely:
    """Reads a quantity; an unusual number without a unit raises an error.

    Parameters
    ----------
    amount : Amount
    low, high : float
        The range of usual values, in SI.
    odd : str
        Description of a value outside this range.
    meant : str
        The unit that is probably intended.
    named : str
        The remedy for a name in place of the number.
    """

    amount: Amount
    low: float
    high: float
    odd: str
    meant: str
    named: str = ""

    @property
    def kind(self) -> Kind:
        """The kind of the quantity."""
        return self.amount.kind

    def __call__(self, text: str) -> float:
        """Return the value that a text states."""
        if self.named and text[:1].isalpha():
            raise InputError(f"{text!r} is a name, but {self.amount.what} is a number", self.named)
        value = self.amount(text)
        if not self.low <= value <= self.high and not quantity.has_unit(text):
            bare, unit = text.strip(), self.kind.unit
            raise InputError(
                f"{bare} without a unit is {bare} {unit}, {self.odd}",
                f"write {bare}{self.meant} or, for a value in {unit}, {bare}{unit}",
            )
        return value


def modulus(what: str, kind: Kind = MODULUS) -> Likely:
    """Return a reader of moduli and hardnesses [Pa]."""
    named = (
        "name both bodies by `materials`, such as steel,aluminium or steel,rigid" if kind is MODULUS else ""
    )
    return Likely(Amount(kind, what), _FOAM, math.inf, "softer than foam", "GPa", named)


def known_material(text: str) -> Material | None:
    """Return the material that a text names; None if the text is a number."""
    from roughcontact.materials import handbook

    word = text.strip()
    return handbook(word.lower()) if word[:1].isalpha() else None


def rising_loads(text: str, kind: Kind, what: str = "load") -> Call | list[float]:
    """Return loads or other quantities in SI, each above zero and above the one before.

    The text is ``from:to:count`` (equal ratios) or a comma list.

    A range is returned as the call of NumPy that makes it.
    """
    low_prefix, high_prefix = ("k", "M") if kind is PRESSURE else ("m", "")
    example = f"1{low_prefix}{kind.unit}:1{high_prefix}{kind.unit}:100"
    if ":" in text:
        low, high, count = _range(text, kind, example, what)
        if not 0 < low < high:
            raise InputError(
                f"a range of {what}s must increase from a positive {what}, unlike {text!r}",
                f"write one such as {example}",
            )
        return Call("np.geomspace", (low, high, count))
    loads = [_parsed(part, kind) for part in text.split(",") if part.strip()]
    if not loads:
        raise InputError(f"{text!r} holds no {what}", f"write {example} or a comma list")
    if min(loads) <= 0:
        raise InputError(
            f"every {what} must be positive, not {min(loads):g} {kind.unit}", f"give positive {what}s only"
        )
    if any(after <= before for before, after in pairwise(loads)):
        raise InputError(f"the {what}s must increase from one to the next, unlike {text!r}", "sort them")
    return loads


def linear_loads(text: str, kind: Kind) -> list[float]:
    """Return loads in SI of either sign, up and down: a comma list of values and of even ranges from:to:count."""
    loads: list[float] = []
    for part in (part for part in text.split(",") if part.strip()):
        if ":" not in part:
            loads.append(_parsed(part, kind))
            continue
        import numpy as np

        low, high, count = _range(part, kind, f"-20n{kind.unit}:20n{kind.unit}:41")
        loads += np.linspace(low, high, count).tolist()
    if not loads:
        raise InputError(
            f"{text!r} holds no load", f"write 0{kind.unit},20n{kind.unit},-20n{kind.unit} or a range"
        )
    return [load for k, load in enumerate(loads) if k == 0 or load != loads[k - 1]]


def temperature(text: str) -> float:
    """Return a temperature [K] of "293K" or "20degC"."""
    unit = quantity.unit_in(text)
    if unit in ("degC", "°C"):
        kelvin = quantity.parse_number(text.strip().removesuffix(unit), TEMPERATURE.example) + ZERO_CELSIUS
        if not 0 < kelvin < math.inf:
            raise InputError(f"{text!r} is not a temperature above absolute zero", "give one such as 20degC")
        return kelvin
    return Amount(TEMPERATURE)(text)


def band(text: str) -> tuple[float, float]:
    """Return two wavelengths [m] of "1mm:10um", the longest and the shortest."""
    parts = text.split(":")
    if len(parts) != 2:
        raise InputError(
            f"{text!r} is not a band", "write the longest and the shortest wave, such as 1mm:10um"
        )
    longest, shortest = (Amount(LENGTH, "a wavelength")(part) for part in parts)
    if shortest > longest:
        raise InputError(f"{text!r} begins with the shortest wave", f"exchange them: {parts[1]}:{parts[0]}")
    return longest, shortest


def size(text: str) -> tuple[float, ...]:
    """Return the lengths [m] in "1mm", "1mm x 2mm" or "1 x 2mm": height, then width."""
    parts = re.split(r"[x*\u00d7]", text)
    if len(parts) > 2:
        raise InputError(f"{text!r} holds {len(parts)} lengths", "write '1mm' or '1mm x 2mm'")
    if len(parts) == 2 and quantity.has_unit(parts[1]) != quantity.has_unit(parts[0]):
        if not quantity.has_unit(parts[1]):
            raise InputError(f"the second length of {text!r} has no unit", "write '1 x 2mm' or '1mm x 2mm'")
        parts[0] += quantity.unit_in(parts[1])  # "1x2mm": the unit of both
    return tuple(Amount(LENGTH, "a side length")(part) for part in parts)


def points(text: str) -> tuple[int, int]:
    """Return the number of points ``(ny, nx)`` of "512" (a square) or "512x256" (rows x columns)."""
    match = re.fullmatch(r"\s*(\d+)\s*(?:[x*]\s*(\d+)\s*)?", text)
    if match is None or int(match[1]) < 1 or (match[2] and int(match[2]) < 1):
        raise InputError(f"{text!r} is not a number of points", "write 512 or 512x256 (rows x columns)")
    return int(match[1]), int(match[2] or match[1])


def ranges(text: str) -> tuple[slice, ...]:
    """Return the cells of ``0:40,5:45`` (rows, columns), of a line ``0:40``; an end may be left open."""
    matches = [re.fullmatch(r"\s*(\d*)\s*:\s*(\d*)\s*", part, re.ASCII) for part in text.split(",")]
    if len(matches) > 2 or not all(matches):
        raise InputError(
            f"{text!r} is not a part of a map", "write rows,columns such as 0:40,5:45, or 0:40 for a profile"
        )
    found = [[int(end) if end else None for end in match.groups()] for match in matches if match]
    for first, last in found:
        if last is not None and last <= (first or 0):
            raise InputError(
                f"{first or 0}:{last} holds no cell",
                f"end above {first or 0}, such as at {(first or 0) + 100}",
            )
    return tuple(slice(*ends) for ends in found)


def _range(text: str, kind: Kind, example: str, what: str = "load") -> tuple[float, float, int]:
    ends = text.split(":")
    if len(ends) != 3 or re.fullmatch(r"\s*\d{1,30}\s*", ends[2]) is None:
        raise InputError(f"{text!r} is not a range", f"write from:to:count, such as {example}")
    low, high, count = _parsed(ends[0], kind), _parsed(ends[1], kind), int(ends[2])
    if not 2 <= count <= MOST_LOADS:
        raise InputError(f"a range holds from 2 to {MOST_LOADS} {what}s, not {count}", "give another count")
    return low, high, count


def _parsed(text: str, kind: Kind) -> float:
    """Return a quantity in SI; a number without a unit is in SI already.

    A quantity with a unit is rounded to 15 digits: 200um is exactly 0.0002 m, without the rounding error of a product.
    """
    try:
        value = quantity.parse(text, kind)
        return float(f"{value:.15g}") if quantity.has_unit(text) else value
    except InputError as error:
        if kind is FORCE and _is_per_length(text):
            remedy = "give `profile` for a profile, or write a force such as 10N"
            raise InputError(error.message, remedy) from error
        raise


def _is_per_length(text: str) -> bool:
    try:
        quantity.parse(text, FORCE_PER_LENGTH)
    except InputError:
        return False
    return True
