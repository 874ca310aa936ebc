"""Continuation in load: each solve starts from the prediction of the tangent at the load before."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from roughcontact.contact.press import lock, solve_state
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import FrozenContact, elastic_contact, frozen_contact
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.solver.control import Control, Force, Solver, Start, State, Tangent
from roughcontact.solver.subdomain import Subdomain, SubdomainSolver, prolong, restrict, restrict_hardness

__all__ = ["follow", "settled", "tangent_of"]


def follow(
    problem: ContactProblem,
    controls: list[Control],
    solver: Solver,
    *,
    start: Solution | None = None,
    subdomains: SubdomainSolver | None = None,
) -> Iterator[Solution]:
    """Yield the solutions of the same bodies under a sequence of controls.

    Nothing is predicted from a load that missed its tolerance: the load after it starts as a single load does.

    Parameters
    ----------
    problem : ContactProblem
    controls : list of Force or Depth
        Rising, or falling.
    solver : Solver
    start : Solution, optional
        A state of the same bodies, from which the first load is predicted if it met its tolerance.
    subdomains : SubdomainSolver, optional
        Of the operator; it keeps restricted operators.
    """
    subdomains = subdomains or SubdomainSolver(problem.operator)
    guess: Start | None = None
    last: Tangent | None = None
    if start is not None:
        guess, last = _predicted(start, controls[0]), tangent_of(start)
    for control, following in zip(controls, [*controls[1:], None], strict=True):
        here, state, subdomain = solve_state(problem.under(control), solver, guess, subdomains)
        solution = settled(here, state, subdomain, subdomains.operator_on(subdomain), last)
        last = tangent_of(solution)
        yield solution
        if following is not None:
            advance = _advance(solution, following)
            if advance is None:
                guess = None
            elif not advance:
                guess = Start(solution.pressure, state.depth)
            else:  # only on the window: the plane is large
                moved = state.pressure + advance * restrict(solution.frozen.tangent, subdomain)
                guess = Start(prolong(moved, subdomain, problem.grid.shape), state.depth + advance)
                del moved
        del state, solution  # releases the memory before the next load


def settled(
    problem: ContactProblem, state: State, subdomain: Subdomain, part: Operator, last: Tangent | None
) -> Solution:
    """Return the solution of a state on a window, with its stiffness, whose search starts from the `last` tangent."""
    shape = problem.grid.shape
    frozen = frozen_contact(
        part,
        elastic_contact(state.pressure, restrict_hardness(problem.hardness, subdomain)),
        tangent=state.tangent or (last and Tangent(restrict(last.pressure, subdomain), math.inf)),
    )
    pressure = prolong(state.pressure, subdomain, shape)
    lock(pressure)
    whole = FrozenContact(frozen.stiffness, frozen.residual, prolong(frozen.tangent, subdomain, shape))
    return Solution(problem, pressure, state.depth, state.status, state.residual, state.steps, whole)


def _predicted(start: Solution, control: Control) -> Start | None:
    """Return the pressure [Pa] and the depth [m] that the tangent of a solution predicts under another control."""
    advance = _advance(start, control)
    if advance is None:
        return None
    pressure = start.pressure + advance * start.frozen.tangent if advance else start.pressure
    return Start(pressure, start.depth + advance)


def tangent_of(solution: Solution) -> Tangent | None:
    """Return the start of the search for the next tangent; None after a missed load or in full contact."""
    known = solution.status.converged and solution.stiffness < math.inf
    return Tangent(solution.frozen.tangent, math.inf) if known else None


def _advance(solution: Solution, following: Control) -> float | None:
    """Return the growth of the depth [m] to the next load if the contact region stays as it is.

    None without contact, or after a load that missed its tolerance.

    The force is convex in the depth, so this overestimates the depth at a given force: the window found
    from it is safe.
    """
    k = solution.stiffness
    if k == 0 or not solution.status.converged:
        return None
    if not np.isfinite(k):  # full contact of a periodic surface: only the mean pressure grows
        return 0.0
    forced = isinstance(following, Force)
    return (following.value - solution.force) / k if forced else following.value - solution.depth
