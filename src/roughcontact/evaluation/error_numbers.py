"""The numbers of a contact that have errors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from roughcontact.contact.solution import Solution
from roughcontact.evaluation.error_budget import ROUNDING
from roughcontact.evaluation.perimeter import corrected_area
from roughcontact.validation import Array

__all__ = ["NUMBERS", "number_table"]

NUMBERS = (
    *("force", "depth", "stiffness", "interfacial_stiffness", "interfacial_stiffness_per_area"),
    *("contact_area", "corrected_contact_area", "contact_fraction", "corrected_contact_fraction"),
    *("mean_gap", "elastic_energy"),
)


def number_table(solutions: Sequence[Solution | None]) -> Array:
    """Return NUMBERS of contacts, shape (numbers, contacts); NaN for None."""
    return np.array([list(_numbers(each)) for each in solutions]).T


def _numbers(solution: Solution | None) -> Iterator[float]:
    """Yield the values of NUMBERS."""
    if solution is None:
        yield from (math.nan for _ in NUMBERS)
        return
    nominal, corrected = solution.problem.grid.area, corrected_area(solution)
    yield from (solution.force, solution.depth, solution.stiffness, solution.interfacial_stiffness)
    yield solution.interfacial_stiffness / nominal
    yield from (solution.contact_area, corrected)
    yield from (solution.contact_fraction, corrected / nominal)
    gap = solution.mean_gap  # a difference of lengths of the depth's size
    yield 0.0 if abs(gap) <= ROUNDING * solution.depth else gap
    yield solution.elastic_energy
