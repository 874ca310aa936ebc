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
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import Optimality
from roughcontact.solver.projection import force_multiplier

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
    measure, optimality = Measure(exact.weights), Optimality.of(exact, terms)
    inner = replace(terms, tolerance=terms.tolerance / 2)
    defect, pressure, steps, best = namespace(separation).zeros_like(separation), initial, 0, math.inf
    while True:
        # D1: the inexact problem, on which the defect acts as a part of the separation
        state = solver.run(operator, separation + defect, inner, pressure)
        pressure, steps = state.pressure, steps + state.steps + 1
        displacement = exact.apply(pressure)
        level = displacement + separation
        free = (pressure > 0) & (pressure < terms.hardness)
        depth = force_multiplier(measure, level, pressure, free) if terms.depth is None else terms.depth
        residual = optimality.residual(pressure, displacement, level - depth)
        found = replace(
            state,
            depth=depth,
            residual=residual,
            steps=steps,
            tangent=None,
            displacement=displacement,
            extremes=None,
        )
        if residual <= terms.tolerance:
            return replace(found, status=Status.CONVERGED)
        if not state.status.converged:
            return found
        if not residual < best / 2:
            return replace(found, status=Status.STAGNATED)
        best, defect = residual, displacement - operator.apply(pressure)  # D2: (A - A~) p
