"""A hardness that depends on the size of the contact spots: found by solving until spots and hardness agree.

The larger a spot the softer it is, and the softer it is the larger. So from cells that are as hard as single ones the
contact grows from solve to solve, up to the smallest contact that agrees with its own hardness: on a finite grid after
finitely many solves, and whatever the loads before. A law that hardens as spots grow may go to and fro; then the
status says so.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.contact.spots import find_spots
from roughcontact.errors import InputError
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.solver.control import Solver, Start, State, Status
from roughcontact.solver.polonsky_keer import PolonskyKeer
from roughcontact.solver.subdomain import Subdomain, SubdomainSolver, prolong
from roughcontact.validation import Array, Mask, number

if TYPE_CHECKING:
    from roughcontact.contact.problem import ContactProblem
    from roughcontact.contact.size_law import SizeLaw

__all__ = ["settle", "without_spots"]

ROUNDS = 100  # solves: spots that merge one after the other take one each


def settle(
    problem: ContactProblem,
    law: SizeLaw,
    solver: Solver,
    start: tuple[Array, float],
    subdomains: SubdomainSolver,
) -> tuple[ContactProblem, State, Subdomain]:
    """Return the problem under the hardness of its own spots, its last state, and where that lies."""
    contact, steps, last = np.zeros(problem.grid.shape, dtype=bool), 0, 0
    for _ in range(ROUNDS):
        here = replace(problem, hardness=_hardness_of(contact, problem, law))
        # From the pressure before, of which little changes, by projection: others begin with the elastic contact. Where
        # nearly all is plastic the projection may stagnate: it is given no more products than the round before took.
        for method in (PolonskyKeer(max_steps=last), solver) if last else (solver,):
            state, subdomain = subdomains.solve(method, here.separation, here.spec, Start(*start))
            steps += state.steps
            if state.status.converged:
                break
        last = state.steps
        pressure = prolong(state.pressure, subdomain, problem.grid.shape)
        if np.array_equal(pressure > 0, contact) or not state.status.converged:
            return here, replace(state, steps=steps), subdomain
        contact, start = pressure > 0, (pressure, state.depth)
    return here, replace(state, steps=steps, status=Status.UNSETTLED, tangent=None), subdomain


def without_spots(problem: ContactProblem, law: SizeLaw) -> ContactProblem:
    """Return the problem under the hardness of single cells, as it is before the first touch."""
    return replace(problem, hardness=_hardness_of(np.zeros(problem.grid.shape, dtype=bool), problem, law))


def _hardness_of(contact: Mask, problem: ContactProblem, law: SizeLaw) -> Array:
    """Return the hardness of each cell by the spot that it belongs to; outside of contact that of a cell alone [Pa]."""
    if not problem.measure.on_host:
        raise InputError(
            "spots are labelled on the host: a hardness by their size takes heights in NumPy's memory"
        )
    measure, shape = problem.measure, problem.grid.shape
    areas = measure.on(np.arange(problem.grid.size)).reshape(shape)
    spots = find_spots(contact, np.zeros(shape), problem.grid, measure)
    sizes = np.where(contact, np.append(0.0, spots.areas)[spots.labels], areas)
    line = problem.geometry is Geometry.LINE
    hardness = number(law(sizes / 2 if line else np.sqrt(sizes / np.pi)), "the hardness of the spots")
    if hardness.shape != shape or not bool((np.isfinite(hardness) & (hardness > 0)).all()):
        raise InputError(
            "a hardness by the size of spots must be positive and finite [Pa] for each of the radii [m]"
        )
    return hardness
