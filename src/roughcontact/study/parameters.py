"""Types of the parameters of cases: numbers in SI, or text with a unit.

A model that has a field ``size: Length`` takes ``1e-3`` as well as ``"1 mm"``, and holds 0.001 in both cases.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, TypeVar

from pydantic import BeforeValidator, Field

from roughcontact.files.quantity import FORCE, LENGTH, PRESSURE, Kind, parse

__all__ = ["Area", "Energy", "Force", "Length", "Positive", "Pressure", "Stiffness", "quantity"]

_T = TypeVar("_T")
Positive = Annotated[_T, Field(gt=0)]
"""``Positive[Length]``: a length above zero."""


def quantity(kind: Kind) -> BeforeValidator:
    """Return what turns text with a unit of that kind into its number, and leaves numbers as they are."""
    return BeforeValidator(_reader(kind))


def _reader(kind: Kind) -> Callable[[Any], Any]:
    def read(value: Any) -> Any:
        if isinstance(value, bool):
            raise ValueError(f"{value} is not {kind.name}; expected {kind.name} such as {kind.example!r}")
        return parse(value, kind) if isinstance(value, str) else value

    return read


Length = Annotated[float, quantity(LENGTH)]
Pressure = Annotated[float, quantity(PRESSURE)]
Force = Annotated[float, quantity(FORCE)]
Area = Annotated[float, quantity(Kind("an area", "m**2", "1mm**2"))]
Stiffness = Annotated[float, quantity(Kind("a stiffness", "N/m", "1MN/m"))]
Energy = Annotated[float, quantity(Kind("an energy", "J", "1mJ"))]
