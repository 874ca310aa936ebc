"""Options of the command line with units to plain SI numbers: "10 N", "110GPa", "1e-6 m", "1mN:1N:100"."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import numpy.typing as npt

from roughcontact.cli.messages import UsageError
from roughcontact.errors import InputError
from roughcontact.files import quantity
from roughcontact.files.quantity import (
    AREA,
    CONDUCTIVITY,
    ENERGY_PER_AREA,
    FORCE,
    FORCE_PER_LENGTH,
    LENGTH,
    PRESSURE,
    RESISTIVITY,
    STIFFNESS_PER_AREA,
    Kind,
)

__all__ = [
    "AREA",
    "CONDUCTIVITY",
    "ENERGY_PER_AREA",
    "FORCE",
    "FORCE_PER_LENGTH",
    "LENGTH",
    "PRESSURE",
    "RESISTIVITY",
    "STIFFNESS_PER_AREA",
    "Kind",
    "parse",
    "parse_band",
    "parse_load",
    "parse_loads",
    "parse_modulus",
    "parse_number",
    "parse_path",
    "parse_points",
    "parse_positive",
    "parse_seed",
    "parse_size",
    "parse_tolerance",
    "parse_unit",
]

_MOST_LOADS = 100_000
_FOAM = 1e6  # Pa: soft polyurethane foams have 0.1 MPa or less, rubber some MPa


def parse(text: str, kind: Kind, option: str) -> float:
    """Return the quantity in `text` in the SI unit of its `kind`; a bare number is SI already.

    Raises
    ------
    UsageError
        If the text is no finite number with a unit of that kind; the message names the `option`.
    """
    with _named(option):
        return quantity.parse(text, kind)


def parse_positive(text: str, kind: Kind, option: str, what: str) -> float:
    """Return a quantity above 0 in the SI unit of its `kind`; the message says `what` must be positive.

    Raises
    ------
    UsageError
        If it is not.
    """
    value = parse(text, kind, option)
    if not value > 0:
        raise UsageError(f"{what} must be positive, not {text!r}", place=option)
    return value


def parse_modulus(text: str, option: str, what: str) -> float:
    """Return a modulus or a hardness above 0 [Pa]; a bare number that is softer than any foam is asked about.

    Raises
    ------
    UsageError
        If it is none, or is below a megapascal and has no unit.
    """
    value = parse_positive(text, PRESSURE, option, what)
    if value < _FOAM and not quantity.has_unit(text):
        bare = text.strip()
        raise UsageError(
            f"{bare} without a unit is {bare} Pa, softer than foam",
            f"write {bare}GPa if gigapascals are meant, or {bare}Pa if it is so",
            place=option,
        )
    return value


def parse_load(text: str, kind: Kind, option: str) -> float:
    """Return one load in the SI unit of its `kind`: a force or pressure above 0, a depth not below it.

    Raises
    ------
    UsageError
        If it is not.
    """
    if kind is not LENGTH:
        return parse_positive(text, kind, option, f"the {kind.name.removeprefix('a ')}")
    value = parse(text, kind, option)
    if value < 0:
        raise UsageError("the depth counts from first touch", f"give 0 or more, not {text!r}", place=option)
    return value


def parse_unit(text: str, kind: Kind, option: str) -> float:
    """Return how many SI units of its `kind` one unit is, such as 1e6 of "MPa".

    Raises
    ------
    UsageError
        If the text is no unit of that kind.
    """
    unit = kind.example.lstrip("0123456789")
    refusal = UsageError(f"{text!r} is no unit of {kind.name}", f"give one such as {unit}", place=option)
    if not text.strip():
        raise refusal
    try:
        return quantity.parse(f"1 {text}", kind)
    except ValueError as error:
        raise refusal from error


def parse_band(text: str, option: str) -> tuple[float, float]:
    """Return two wavelengths in SI, from "1mm:10um", the longest and the shortest.

    Raises
    ------
    UsageError
        If there are not two, or one is no positive length.
    """
    parts = text.split(":")
    if len(parts) != 2:
        raise UsageError(
            f"{text!r} is no band", "write the longest and the shortest wave, 1mm:10um", place=option
        )
    longest, shortest = (parse_positive(part, LENGTH, option, "a wavelength") for part in parts)
    return longest, shortest


def parse_number(text: str, option: str, example: str) -> float:
    """Return a number without a unit.

    Raises
    ------
    UsageError
        If the text is no finite number.
    """
    with _named(option):
        return quantity.parse_number(text, example)


def parse_tolerance(text: str, option: str) -> float:
    """Return a tolerance that a certificate can meet.

    Raises
    ------
    UsageError
        If it is none, or too small or large to mean anything.
    """
    value = parse_number(text, option, "1e-8")
    if not 1e-14 < value < 1e-2:
        raise UsageError(f"the tolerance must lie between 1e-14 and 1e-2, not {text!r}", place=option)
    return value


def parse_seed(text: str, option: str) -> int:
    """Return the seed of a generator of random numbers.

    Raises
    ------
    UsageError
        If it is no whole number from 0 up.
    """
    if re.fullmatch(r"\s*\d{1,30}\s*", text, re.ASCII) is None:
        raise UsageError(f"{text!r} is no seed", "write a whole number such as 1", place=option)
    return int(text)


def parse_loads(text: str, kind: Kind, option: str) -> npt.NDArray[np.float64]:
    """Return the loads in `text`, ``from:to:count`` (log-spaced) or a comma list, in SI, shape (n,).

    Raises
    ------
    UsageError
        If the text holds no load, or loads that are not positive and increasing.
    """
    if ":" in text:
        loads = _log_spaced(text, kind, option)
    else:
        parts = [part for part in text.split(",") if part.strip()]
        loads = np.array([parse(part, kind, option) for part in parts])
    if loads.size == 0:
        raise UsageError("no load given", f"write {_range_example(kind)} or a comma list", place=option)
    if not (loads > 0).all():
        raise UsageError(f"every load must be positive, not {loads.min():g} {kind.unit}", place=option)
    if not (np.diff(loads) > 0).all():
        raise UsageError(f"the loads must increase from one to the next, not as in {text!r}", place=option)
    return loads


def parse_path(text: str, kind: Kind, option: str) -> npt.NDArray[np.float64]:
    """Return loads of either sign, up and down, in SI, shape (n,).

    The text is a comma list of loads and of ranges ``from:to:count``, evenly spaced.

    Raises
    ------
    UsageError
        If the text holds no load, or a range that is none.
    """
    loads: list[float] = []
    for part in (part for part in text.split(",") if part.strip()):
        ends = part.split(":")
        if len(ends) == 1:
            loads.append(parse(part, kind, option))
            continue
        if len(ends) != 3 or re.fullmatch(r"\s*\d{1,6}\s*", ends[2]) is None:
            raise UsageError(
                f"{part!r} is no range",
                f"write from:to:count, such as -20n{kind.unit}:20n{kind.unit}:41",
                place=option,
            )
        low, high = (parse(end, kind, option) for end in ends[:2])
        if not 2 <= int(ends[2]) <= _MOST_LOADS:
            raise UsageError(f"a range holds from 2 to {_MOST_LOADS} loads, not {int(ends[2])}", place=option)
        loads += np.linspace(low, high, int(ends[2])).tolist()
    if not loads:
        raise UsageError(
            "no load given", f"write 0{kind.unit},20n{kind.unit},-20n{kind.unit} or a range", place=option
        )
    return np.array([load for k, load in enumerate(loads) if k == 0 or load != loads[k - 1]])


def parse_size(text: str, option: str) -> tuple[float, ...]:
    """Return one length or two, "1mm", "1mm x 2mm" or "1 x 2mm" (down the rows, then along them), in [m].

    Raises
    ------
    UsageError
        If a part is no positive length, there are more than two, or the second of two has no unit beside a first that
        has one.
    """
    parts = re.split(r"[x*\u00d7]", text)
    if len(parts) > 2:
        raise UsageError(f"{text!r} holds {len(parts)} lengths", "write '1mm' or '1mm x 2mm'", place=option)
    if len(parts) == 2 and quantity.has_unit(parts[1]) != quantity.has_unit(parts[0]):
        if not quantity.has_unit(parts[1]):
            raise UsageError(
                f"the second length of {text!r} has no unit", "write '1 x 2mm' or '1mm x 2mm'", place=option
            )
        parts[0] += quantity.unit_in(parts[1])  # "1x2mm": of both, as people write it
    return tuple(parse_positive(part, LENGTH, option, "a side length") for part in parts)


def parse_points(text: str, option: str) -> tuple[int, int]:
    """Return the number of points ``(ny, nx)`` of "512" (a square) or "512x256" (rows x columns).

    Raises
    ------
    UsageError
        If the text is not one or two positive whole numbers.
    """
    match = re.fullmatch(r"\s*(\d+)\s*(?:[x*]\s*(\d+)\s*)?", text)
    if match is None or int(match[1]) < 1 or (match[2] and int(match[2]) < 1):
        raise UsageError(
            f"{text!r} is no number of points", "write 512 or 512x256 (rows x columns)", place=option
        )
    return int(match[1]), int(match[2] or match[1])


@contextmanager
def _named(option: str) -> Iterator[None]:
    """Name the option in the message about its text."""
    try:
        yield
    except InputError as error:
        raise UsageError(error.message, error.remedy, option) from error


def _log_spaced(text: str, kind: Kind, option: str) -> npt.NDArray[np.float64]:
    parts = text.split(":")
    example = _range_example(kind)
    if len(parts) != 3 or re.fullmatch(r"\s*\d+\s*", parts[2]) is None:
        raise UsageError(f"{text!r} is no range", f"write from:to:count, such as {example}", place=option)
    low, high = (parse(part, kind, option) for part in parts[:2])
    count = int(parts[2])
    if not 0 < low < high:
        raise UsageError(
            f"a range is log-spaced and must rise from a positive load, unlike {text!r}", place=option
        )
    if not 2 <= count <= _MOST_LOADS:
        raise UsageError(f"a range holds from 2 to {_MOST_LOADS} loads, not {count}", place=option)
    return np.geomspace(low, high, count)


def _range_example(kind: Kind) -> str:
    return (
        f"1m{kind.unit}:1{kind.unit}:100" if kind.unit.startswith("N") else f"1n{kind.unit}:1u{kind.unit}:100"
    )
