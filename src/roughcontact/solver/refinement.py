"""Defect correction: an inexact sum is iterated, and the exact one gives the residual that certifies."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.halfspace.operators.operator import Operator, exact_of
from roughcontact.solver.complementarity import resolve_contact
from roughcontact.solver.control import Solver, State, Status, Terms
from roughcontact.solver.optimality import Iterate, Optimality

__all__ = ["solve_refined"]

Array = npt.NDArray[np.float64]


def solve_refined(
    solver: Solver, operator: Operator, separation: Array, terms: Terms, initial: Array
) -> State:
    """Run a solver with the operator or, where its sum is not exact, by defect correction (D1 to D5)."""
    exact = exact_of(operator)

    def run(terms: Terms, initial: Array) -> State:
        if exact is operator:
            return solver.run(operator, separation, terms, initial)
        return _corrected(solver, operator, separation, terms, initial)

    return resolve_contact(run, exact, separation, terms, initial)


def _corrected(solver: Solver, operator: Operator, separation: Array, terms: Terms, initial: Array) -> State:
    """Add the defect of the inexact sum to the separation and solve again, until the exact residual is small."""
    exact = exact_of(operator)
    conditions = Optimality.of(exact, terms)
    inner = replace(terms, tolerance=terms.tolerance / 2)
    defect, pressure, steps, best = namespace(separation).zeros_like(separation), initial, 0, math.inf
    while True:
        # D1: the inexact problem, on which the defect acts as a part of the separation
        state = solver.run(operator, separation + defect, inner, pressure)
        pressure, steps = state.pressure, steps + state.steps + 1
        displacement = exact.apply(pressure)
        depth, residual, _, seen = conditions.evaluate(Iterate(pressure, displacement, separation))
        met, reduced = residual <= terms.tolerance, residual < best / 2
        if met or not reduced or not state.status.converged:
            status = Status.STAGNATED if state.status.converged else state.status
            status = Status.CONVERGED if met else status
            return State(pressure, depth, residual, steps, status, displacement=displacement, extremes=seen)
        best, defect = residual, displacement - operator.apply(pressure)  # D2: (A - A~) p
