"""Defect correction: an inexact sum is iterated, and the exact one gives the residual that certifies."""

from __future__ import annotations

import math
from dataclasses import replace

from roughcontact.halfspace.operators.operator import Operator
from roughcontact.solver.control import Solver, State, Status
from roughcontact.solver.optimality import Iterate, Optimality
from roughcontact.validation import Array

__all__ = ["defect_correction"]


def defect_correction(
    solver: Solver,
    operator: Operator,
    exact: Operator,
    separation: Array,
    conditions: Optimality,
    initial: Array,
) -> State:
    """Run a solver with an inexact sum until the residual with the exact one is small.

    Labels D1 to D5 are the lines of the algorithm in docs/concepts/method.md.

    Parameters
    ----------
    solver : Solver
    operator, exact : Operator
        The body with the inexact sum, and with the exact one.
    separation : array
        Undeformed gap [m].
    conditions : Optimality
        Of the problem with the exact sum.
    initial : array
        Pressure to begin with [Pa].
    """
    spec = conditions.spec
    inner = replace(spec, tolerance=spec.tolerance / 2)
    defect, pressure, steps, best = conditions.measure.xp.zeros_like(separation), initial, 0, math.inf
    while True:
        # D1, later D3: the inexact problem, on which the defect acts as a part of the separation
        state = solver.run(operator, separation + defect, inner, pressure)
        pressure, steps = state.pressure, steps + state.steps + 1  # D4: it is corrected already
        displacement = exact.apply(pressure)  # D2
        depth, residual, _, extremes = conditions.evaluate(Iterate(pressure, displacement, separation))
        met, reduced = residual <= spec.tolerance, residual < best / 2
        if met or not reduced or not state.status.converged:  # D3, D5
            status = Status.STAGNATED if state.status.converged else state.status
            status = Status.CONVERGED if met else status
            return State(
                pressure, depth, residual, steps, status, displacement=displacement, extremes=extremes
            )
        best, defect = residual, displacement - operator.apply(pressure)  # the defect (A - A~) p
