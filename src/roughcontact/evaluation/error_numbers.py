"""The numbers of a contact that have errors."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import on_host
from roughcontact.contact.solution import Solution
from roughcontact.evaluation.error_budget import ROUNDING
from roughcontact.evaluation.perimeter import corrected_area
from roughcontact.validation import Array

__all__ = ["NUMBERS", "border_floor", "number_table", "symmetries"]

NUMBERS = (
    *("force", "depth", "stiffness", "interfacial_stiffness", "interfacial_stiffness_per_area"),
    *("contact_area", "corrected_contact_area", "contact_fraction", "corrected_contact_fraction"),
    *("mean_gap", "elastic_energy"),
)
# Factors of the correction of an area for its perimeter. They cover 85 to 100 % of single spheres
# (docs/concepts/errors.md).
OF_AREA, OF_CORRECTED, OF_STIFFNESS = 1.0, 1 / 2, 1 / 8


def number_table(solutions: Sequence[Solution | None]) -> Array:
    """Return the values of NUMBERS for contacts, shape (numbers, contacts); NaN for None."""
    return np.array([list(_numbers(each)) for each in solutions]).T


def border_floor(values: Array, spots: npt.ArrayLike, symmetric: npt.ArrayLike = 1) -> Array:
    """Return the smallest error of the numbers of a contact, from the cells along its border.

    The borders of different spots lie independently between the cells, so this error decreases as the square root of
    the number of spots. On a symmetric contact, cells come into contact in groups, so the error of stiffnesses grows as
    the square root of their number; that of areas, of which a half is a bias, as its fourth root.

    Parameters
    ----------
    values : array
        From `number_table`, shape (numbers, contacts).
    spots : array-like, shape (contacts,)
        The number of spots of each contact.
    symmetric : array-like, shape (contacts,)
        From `symmetries`.

    Returns
    -------
    array
        Smallest errors, of the shape of `values`; 0 for numbers that do not depend on the border.
    """
    found, floor = dict(zip(NUMBERS, values, strict=True)), dict.fromkeys(NUMBERS, np.zeros(values.shape[1]))
    for name in ("contact_area", "contact_fraction"):
        overhang = found[name] - found[f"corrected_{name}"]
        overhang *= np.power(symmetric, 1 / 4)
        floor |= {name: OF_AREA * overhang, f"corrected_{name}": OF_CORRECTED * overhang}
    with np.errstate(invalid="ignore", divide="ignore"):
        relative = OF_STIFFNESS * (1 - found["corrected_contact_area"] / found["contact_area"])
        relative *= np.sqrt(symmetric)
        stiffness, interfacial = found["stiffness"], found["interfacial_stiffness"]
        floor["stiffness"] = relative * stiffness
        relative *= interfacial / stiffness  # 1/k - 1/K has no error: it is the compliance of the body
        floor["interfacial_stiffness"] = relative * interfacial
        floor["interfacial_stiffness_per_area"] = relative * found["interfacial_stiffness_per_area"]
    # In full contact stiffnesses are infinite, and without contact there is no border.
    known = np.nan_to_num(list(floor.values()), nan=0.0, posinf=0.0, neginf=0.0)
    return known / np.sqrt(np.maximum(spots, 1))


def symmetries(solution: Solution) -> int:
    """Return the number of reflections and rotations under which the cells in contact remain the same, at most 8.

    It is 8 for a sphere whose axis goes through the centre or the corner of a cell.
    """
    contact = on_host(solution.contact)
    part = contact[np.ix_(contact.any(axis=1), contact.any(axis=0))]  # without empty rows and columns
    images = [image[::y, ::x] for image in (part, part.T) for y in (1, -1) for x in (1, -1)]
    return sum(np.array_equal(part, image) for image in images)


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
