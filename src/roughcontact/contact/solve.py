"""From a problem to its solution: window, first guess, solver, certificate."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Depth, Solver, State, Status
from roughcontact.solver.nested_iteration import nested_start
from roughcontact.solver.subdomain import Subdomain, SubdomainSolver, prolong
from roughcontact.threads import one_blas_thread

__all__ = ["lock", "solve", "solve_state"]

Array = npt.NDArray[np.float64]


def solve(
    problem: ContactProblem,
    *,
    solver: Solver | None = None,
    initial: tuple[Array, float] | None = None,
    subdomains: SubdomainSolver | None = None,
) -> Solution:
    """Return the solution of a contact problem; its status says whether the tolerance was met.

    Parameters
    ----------
    problem : ContactProblem
    solver : Solver, optional
        Settings of the method; the active set without.
    initial : tuple of array and float, optional
        Pressure [Pa] on the whole grid and depth [m] to start from; without, coarser grids are solved first.
    subdomains : SubdomainSolver, optional
        Keeps restricted operators from one load to the next.
    """
    state, subdomain = solve_state(
        problem, solver or ActiveSet(), initial, subdomains or SubdomainSolver(problem.operator)
    )
    pressure = prolong(state.pressure, subdomain, problem.grid.shape)
    lock(pressure)
    return Solution(problem, pressure, state.depth, state.status, state.residual, state.steps)


def solve_state(
    problem: ContactProblem, solver: Solver, initial: tuple[Array, float] | None, subdomains: SubdomainSolver
) -> tuple[State, Subdomain]:
    """Return the solver's last state on its window, and where that lies."""
    if isinstance(solver, type) or not hasattr(solver, "run"):
        raise ValueError(f"a solver is wanted, such as ActiveSet() or PolonskyKeer(), not {solver!r}")
    if isinstance(problem.control, Depth) and problem.control.value == 0:
        return _untouched(problem)
    with one_blas_thread():
        guess = initial or nested_start(problem.operator, problem.separation, problem.control, solver)
        return subdomains.solve(solver, problem.separation, problem.terms, guess)


def lock(pressure: Array) -> None:
    """Make an answer read-only, where its library can."""
    if is_numpy(pressure):
        pressure.flags.writeable = False


def _untouched(problem: ContactProblem) -> tuple[State, Subdomain]:
    """At depth 0 the bodies touch and carry nothing."""
    shape = problem.grid.shape
    zero = problem.measure.xp.zeros_like(problem.separation)
    whole = tuple(slice(0, n) for n in shape)
    return State(zero, 0.0, 0.0, 0, Status.NO_CONTACT), whole
