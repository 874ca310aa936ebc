"""Numbers of each state beside those of a loading curve."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.labels.labelled import Variables, attributes_of
from roughcontact.labels.variables import VARIABLES
from roughcontact.validation import Array

__all__ = ["MeasuredCurve", "StateMeasure", "measured_at", "measured_columns", "measured_variables"]


class StateMeasure(Protocol):
    """A function from a state to numbers by name, such as `roughcontact.Transmissivity`."""

    def __call__(self, solution: Solution, /) -> Mapping[str, float]:
        """Return the numbers of a state by name."""
        ...


class MeasuredCurve(Protocol):
    """A `Curve` or `ViscoelasticCurve`, with the columns of its measures."""

    @property
    def nominal_pressure(self) -> Array:
        """Force over the nominal area [Pa], shape (n,)."""

    @property
    def measured(self) -> Mapping[str, Array]:
        """Columns by name, shape (n,)."""


def measured_at(
    solution: Solution, measures: Sequence[StateMeasure], taken: Sequence[str]
) -> dict[str, float]:
    """Return the numbers of a state by all measures, whose names must differ from those that are `taken`."""
    found: dict[str, float] = {}
    for measure in measures:
        for name, value in measure(solution).items():
            if name in found or name in taken:
                raise InputError(
                    f"two columns of the curve have the name {name!r}", "give another name", "measures"
                )
            found[name] = float(value)
    return found


def measured_columns(points: Sequence[Mapping[str, float]]) -> dict[str, Array]:
    """Return the numbers of all states as columns."""
    names = points[0] if points else {}
    return {name: np.array([point[name] for point in points]) for name in names}


def measured_variables(measured: Mapping[str, Array], along: str = "load") -> Variables:
    """Return the columns as labelled data along a dimension; a name that no table holds has no unit."""
    return {
        name: (
            (along,),
            values,
            attributes_of(VARIABLES[name]) if name in VARIABLES else {"long_name": name},
        )
        for name, values in measured.items()
    }
