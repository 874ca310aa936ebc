"""Loads up and down: flow is kept, and the surface is elastic up to the largest load so far."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import groupby

from roughcontact.contact.continuation import follow
from roughcontact.contact.flow import lifting_work
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.solver.control import Control, Depth, Solver, Status
from roughcontact.solver.subdomain import SubdomainSolver

__all__ = ["follow_history"]

KNOWN = 1e-2  # of the energy of flow: the error of the work of a rise


def follow_history(
    problem: ContactProblem, controls: list[Control], solver: Solver, *, raises: bool = False
) -> Iterator[Solution]:
    """Yield the solutions under a sequence of controls, up and down.

    The flow under a load that missed its tolerance is kept until a larger load follows. The surface below that load is
    therefore not accurate to the tolerance; the status of its states is ``AFTER_MISSED``.

    Parameters
    ----------
    problem : ContactProblem
        The original surface, under a hardness.
    controls : list of Force or Depth
        In any order.
    solver : Solver
    raises : bool
        Whether flow raises the whole surface.
    """
    subdomains = SubdomainSolver(problem.operator)
    top: Solution | None = None
    rises: list[tuple[float, float]] = []  # forces and rises of first loading
    for first, run in _runs(controls):
        if first or top is None:
            for solution in follow(problem, run, solver, start=top, subdomains=subdomains):
                top, shown = solution, _raised(solution, rises) if raises else solution
                if top.status.converged:
                    rises.append((top.force, shown.problem.rise))
                yield shown
            continue
        turn = shown.flattened
        elastic = turn.problem
        for solution in follow(elastic, _reachable(elastic, run), solver, start=turn, subdomains=subdomains):
            # Flow is no more accurate than the load that caused it.
            doubtful = solution.status.converged and not turn.status.converged
            yield replace(solution, status=Status.AFTER_MISSED) if doubtful else solution


def _runs(controls: list[Control]) -> Iterator[tuple[bool, list[Control]]]:
    """Yield the loads in runs: whether a run exceeds all loads before it, and its loads."""
    largest, marked = -1.0, []
    for control in controls:
        marked.append((control.value > largest, control))
        largest = max(largest, control.value)
    for first, run in groupby(marked, key=lambda each: each[0]):
        yield first, [control for _, control in run]


def _reachable(problem: ContactProblem, controls: list[Control]) -> list[Control]:
    """Return depths, limited to full contact, which is known only to the tolerance."""
    if not problem.semidefinite or problem.missing:
        return controls
    mean = problem.mean_separation
    return [Depth(min(each.value, mean)) if isinstance(each, Depth) else each for each in controls]


def _raised(solution: Solution, lighter: list[tuple[float, float]]) -> Solution:
    """Return a state of first loading on the surface that flow has raised as a whole; depths count as before.

    The work of the rise follows from the forces and rises of lighter loads; it is NaN if these are too few.
    """
    flow, problem = solution.flow, solution.problem
    if flow is None or not flow.volume:
        return solution
    rise = flow.volume / problem.measure.total(problem.measured)
    lifting, error = lifting_work([*lighter, (solution.force, rise)])
    known = error <= KNOWN * (flow.energy - lifting)
    return replace(
        solution, problem=problem.raised(rise, lifting if known else math.nan), depth=solution.depth - rise
    )
