"""The perimeter of a contact on its cells, and the area that is overcounted along it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.arrays import on_host
from roughcontact.errors import InputError
from roughcontact.halfspace.operators.geometry import Geometry

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["OVERHANG", "corrected_area", "edge_count"]

OVERHANG = (math.pi - 1 + math.log(2)) / 24  # of a cell, for each edge of the perimeter


def edge_count(solution: Solution) -> int:
    """Return the number of edges between a cell in contact and a measured one that is not.

    Along a periodic axis neighbours continue across the border of the map. On square cells the perimeter of the contact
    on its grid is this number times the size of a cell. It is longer than the true perimeter: 4/pi times for a disc.
    """
    contact, measured = on_host(solution.contact), on_host(solution.problem.measured)
    count = 0
    for axis, periodic in enumerate(solution.problem.grid.periodic):
        both = np.logical_and(measured, np.roll(measured, 1, axis))
        differ = np.logical_and(both, contact != np.roll(contact, 1, axis))
        if not periodic:  # the first cell follows the last one
            differ[(slice(None),) * axis + (0,)] = False
        count += int(np.count_nonzero(differ))
    return count


def corrected_area(solution: Solution) -> float:
    """Return the real contact area without the area that counting whole cells adds along its perimeter [m^2].

    ``A - (pi - 1 + ln 2)/24 S d`` with the perimeter S on square cells of size d: Yastrebov, Anciaux and Molinari,
    Tribology International 114 (2017) 161, arXiv:1701.02727. For cells that are not square, each edge counts by the
    area of a cell.

    Raises
    ------
    ValueError
        If the contact is not that of a surface.
    """
    problem = solution.problem
    if problem.geometry is not Geometry.SURFACE:
        raise InputError(f"the area of a {problem.geometry.value} has no perimeter", "press a map of heights")
    cell = float(np.ravel(problem.operator.weights)[0])
    return solution.contact_area - OVERHANG * edge_count(solution) * cell
