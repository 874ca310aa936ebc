"""Inexact operators may drive the iteration; the exact one certifies."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.halfspace.operators.operator import Operator, exact_of
from roughcontact.solver.complementarity import resolve_contact
from roughcontact.solver.control import Terms
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import Judge
from roughcontact.solver.projection import depth_of
from roughcontact.solver.state import Solver, State
from roughcontact.solver.status import Status

__all__ = ["run_certified"]

Array = npt.NDArray[np.float64]


def run_certified(
    solver: Solver, operator: Operator, separation: Array, terms: Terms, initial: Array
) -> State:
    """Run a solver with the operator or, where its sum is not exact, by defect correction with the exact one."""
    exact = exact_of(operator)

    def run(terms: Terms, initial: Array) -> State:
        if exact is operator:
            return solver.run(operator, separation, terms, initial)
        return _corrected(solver, operator, separation, terms, initial)

    return resolve_contact(run, exact, separation, terms, initial)


def _corrected(solver: Solver, operator: Operator, separation: Array, terms: Terms, initial: Array) -> State:
    """Run a solver; an inexact operator's separation is corrected by what its sum lacks until the exact one agrees."""
    exact = exact_of(operator)
    measure, judge = Measure(exact.weights), Judge.of(exact, terms)
    inner = replace(terms, tolerance=terms.tolerance / 2)
    lacking, pressure, steps, best = namespace(separation).zeros_like(separation), initial, 0, math.inf
    while True:
        state = solver.run(operator, separation + lacking, inner, pressure)
        pressure, steps = state.pressure, steps + state.steps + 1
        displacement = exact.apply(pressure)
        level = displacement + separation
        inside = (pressure > 0) & (pressure < terms.hardness)
        depth = depth_of(measure, level, pressure, inside) if terms.depth is None else terms.depth
        residual = judge.residual(pressure, displacement, level - depth)
        found = replace(
            state, depth=depth, residual=residual, steps=steps, tangent=None, displacement=displacement
        )
        if residual <= terms.tolerance:
            return replace(found, status=Status.CONVERGED)
        if not state.status.converged:
            return found
        if not residual < best / 2:
            return replace(found, status=Status.STAGNATED)
        best, lacking = residual, displacement - operator.apply(pressure)
