"""The numbers of a contact that have errors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt

from roughcontact.contact.solution import Solution
from roughcontact.evaluation.error_budget import ROUNDING
from roughcontact.evaluation.perimeter import corrected_area
from roughcontact.validation import Array

__all__ = ["NUMBERS", "border_floor", "number_table"]

NUMBERS = (
    *("force", "depth", "stiffness", "interfacial_stiffness", "interfacial_stiffness_per_area"),
    *("contact_area", "corrected_contact_area", "contact_fraction", "corrected_contact_fraction"),
    *("mean_gap", "elastic_energy"),
)
# Factors of the correction of an area for its perimeter. They cover nine in ten single spheres
# (docs/concepts/errors.md).
OF_AREA, OF_CORRECTED, OF_STIFFNESS = 1.0, 1 / 2, 1 / 8


def number_table(solutions: Sequence[Solution | None]) -> Array:
    """Return the values of NUMBERS for contacts, shape (numbers, contacts); NaN for None."""
    return np.array([list(_numbers(each)) for each in solutions]).T


def border_floor(values: Array, spots: npt.ArrayLike) -> Array:
    """Return the smallest error of the numbers of a contact, from the cells along its border.

    The borders of different spots lie independently between the cells, so this error decreases as the square root of
    the number of spots.

    Parameters
    ----------
    values : array
        From `number_table`, shape (numbers, contacts).
    spots : array-like, shape (contacts,)
        The number of spots of each contact.

    Returns
    -------
    array
        Smallest errors, of the shape of `values`; 0 for numbers that do not depend on the border.
    """
    found, floor = dict(zip(NUMBERS, values, strict=True)), dict.fromkeys(NUMBERS, np.zeros(values.shape[1]))
    for name in ("contact_area", "contact_fraction"):
        overhang = found[name] - found[f"corrected_{name}"]
        floor |= {name: OF_AREA * overhang, f"corrected_{name}": OF_CORRECTED * overhang}
    with np.errstate(invalid="ignore", divide="ignore"):
        relative = OF_STIFFNESS * (1 - found["corrected_contact_area"] / found["contact_area"])
        stiffness, interfacial = found["stiffness"], found["interfacial_stiffness"]
        floor["stiffness"] = relative * stiffness
        relative *= interfacial / stiffness  # 1/k - 1/K has no error: it is the compliance of the body
        floor["interfacial_stiffness"] = relative * interfacial
        floor["interfacial_stiffness_per_area"] = relative * found["interfacial_stiffness_per_area"]
    # In full contact stiffnesses are infinite, and without contact there is no border.
    known = np.nan_to_num(list(floor.values()), nan=0.0, posinf=0.0, neginf=0.0)
    return known / np.sqrt(np.maximum(spots, 1))


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
