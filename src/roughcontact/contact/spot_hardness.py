"""A hardness that depends on the size of the contact spots: found by solving until spots and hardness agree.

A larger spot is softer, and a softer spot grows. The first solve takes the hardness of single cells. From there the
contact grows from solve to solve, up to the smallest contact that agrees with the hardness of its spots. On a finite
grid this takes finitely many solves, and the result does not depend on earlier loads. A law that hardens as spots grow
may oscillate; the status is then ``UNSETTLED``.
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

ROUNDS = 100  # solves: each merger of spots may take one


def settle(
    problem: ContactProblem,
    law: SizeLaw,
    solver: Solver,
    start: tuple[Array, float],
    subdomains: SubdomainSolver,
) -> tuple[ContactProblem, State, Subdomain]:
    """Return the problem under the hardness of its spots, its last state, and the window of the state."""
    contact, steps, last = np.zeros(problem.grid.shape, dtype=bool), 0, 0
    for _ in range(ROUNDS):
        here = replace(problem, hardness=_hardness_of(contact, problem, law))
        # The pressure changes little from solve to solve, so projection starts from the one before; other methods begin
        # with the elastic contact. Projection may stagnate if nearly all cells are plastic, so its products are limited
        # to the number of the solve before.
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
    """Return the problem under the hardness of single cells, which holds before the first touch."""
    return replace(problem, hardness=_hardness_of(np.zeros(problem.grid.shape, dtype=bool), problem, law))


def _hardness_of(contact: Mask, problem: ContactProblem, law: SizeLaw) -> Array:
    """Return the hardness of each cell from the size of its spot [Pa]; outside contact, that of a single cell."""
    if not problem.measure.on_host:
        raise InputError(
            "spots are labelled on the host: a hardness by their size needs heights in NumPy's memory"
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
