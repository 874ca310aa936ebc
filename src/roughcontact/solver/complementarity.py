"""Strict complementarity: a rounding floor for the pressure, and cells that have neither pressure nor gap.

The conditions of contact are strictly complementary where each cell has either a pressure or a gap. A cell with neither
is weakly active: the solution does not depend on whether it is in contact, but the stiffness does. On loading it joins,
on unloading it leaves. In floating-point numbers its pressure is rounding, of either sign.

A displacement is known to some units in the last place of the largest one, ``u_max``. So a pressure p is
rounding, and set to zero, where its own displacement ``A_ii p`` is no more than a few times that. An iteration that
stops at a residual r has a displacement only to ``r u_max``. Where more depends on such cells than the stiffness may
err by, it goes on to the last digits. Random surfaces rarely have such cells.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import as_like, max_abs, namespace, on_host
from roughcontact.halfspace.operators.operator import Operator, exact_of, self_influences
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.solver.control import Force, Solver, Specification, Start, State, Status
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import ROUNDING_FLOOR, Iterate, Optimality
from roughcontact.solver.refinement import defect_correction
from roughcontact.validation import Array, Mask

__all__ = ["SLIGHT", "added_stiffness", "resolve_contact", "weakly_active"]


FINEST = 1.01e-14  # tolerance of the last digits: 45 units in the last place, reached by all operators here
# Of what a displacement is known to, times what the pressure on a cell then is known to displace there: the sum of a
# row of the inverse, in its sizes, times the cell's own influence. That is 2.6 on squares, 11 on long lines and 13 on
# rings, of which solutions with cells that have neither pressure nor gap reach 2.3.
AMPLIFIED = 4.0
SLIGHT = 1e-3  # of the stiffness: by how much it may depend on cells that are not known to be in contact
NEAR = 5  # cells to either side of one
MANY = 300  # cells that are not known to be in contact: they matter
LOOSE = 1e-6  # tolerance from which on the contact is asked for roughly: coarse grids


def weakly_active(pressure: Array, gap: Array, allowed: float) -> Mask:
    """Return the cells without pressure whose gap is no more than is `allowed` [m]; none of them is missing."""
    return (pressure == 0) & (gap <= allowed)  # type: ignore[no-any-return]


def _pressed_by_rounding(pressure: Array, a_ii: Any, allowed: float) -> Mask:
    """Return the cells whose pressure is no more than displacements that are known to what is `allowed` [m] make it."""
    return (pressure > 0) & (pressure * a_ii <= AMPLIFIED * allowed)  # type: ignore[no-any-return]


def added_stiffness(operator: Operator, pressed: Any, weak: Any) -> float:
    """Return by how much the stiffness grows at most where weakly active cells join those that are pressed [N/m].

    The stiffness of a region is a capacity, which is submodular: a cell adds no more to the whole than to those pressed
    cells that are near it. Infinite for many cells.
    """
    if int(namespace(weak).count_nonzero(weak)) > MANY:
        return math.inf
    if isinstance(pressed, SlabArray):  # each process sees to its own cells: no other has room for all
        functions, edges = pressed.functions, pressed.edges
        rows, begin = functions.with_rows_beside(pressed, NEAR)
        places = np.argwhere(weak.local)
        places[:, 0] += edges[functions.rank]
        return float(functions.combined([_added_at(operator, places, rows, begin, pressed.shape)], 0)[0])
    here = on_host(pressed) > 0
    return _added_at(operator, np.argwhere(on_host(weak) > 0), here, 0, here.shape)


def _added_at(
    operator: Operator, places: npt.NDArray[np.intp], rows: Mask, begin: int, shape: tuple[int, ...]
) -> float:
    """Return by how much the stiffness grows with the cells at some places [N/m].

    `rows` holds the rows from `begin` on of the pressed cells of a field of some shape.
    """
    total, shift = 0.0, np.zeros(rows.ndim, np.intp)
    shift[0] = begin
    for place in places:
        start = np.maximum(place - NEAR, 0)
        box = tuple(map(slice, start - shift, place + NEAR + 1 - shift))
        near = np.ravel_multi_index(tuple((np.argwhere(rows[box]) + start).T), shape)
        cells = np.append(near, np.ravel_multi_index(tuple(place), shape))
        total += _stiffness(operator, cells) - (_stiffness(operator, near) if len(near) else 0.0)
    return total


def _stiffness(operator: Operator, cells: npt.NDArray[np.intp]) -> float:
    """Return the stiffness of few cells [N/m]."""
    tangent = np.linalg.solve(operator.as_matrix(cells), np.ones(len(cells)))
    return float(Measure(operator.weights).on(cells) @ tangent)


def resolve_contact(
    solver: Solver, operator: Operator, separation: Array, spec: Specification, start: Start
) -> State:
    """Run a solver, by defect correction where the sum is not exact, and set pressures that are but rounding to zero.

    Parameters
    ----------
    solver : Solver
    operator, separation, spec
        The problem, as `Solver.run` takes it.
    start : Start
        The pressure to begin with is handed over.
    """
    exact = exact_of(operator)
    conditions = Optimality.of(exact, spec, separation)

    def run(spec: Specification, start: Start) -> State:
        if exact is operator:
            return solver.run(operator, separation, spec, start.move())
        asked = replace(conditions, spec=spec)
        return defect_correction(solver, operator, exact, separation, asked, start.move())

    state = run(spec, start)
    if state.status is not Status.CONVERGED:
        return replace(state, displacement=None)
    iterated = state.residual > FINEST and spec.tolerance <= LOOSE
    known = ROUNDING_FLOOR + (state.residual if iterated or state.residual <= FINEST else 0.0)
    weak = _weak(exact, separation, conditions, state, known)
    if weak is not None and iterated and _matter(exact, conditions.measure, state, weak):
        finer = run(replace(spec, tolerance=FINEST), Start(state.pressure, state.depth))
        steps = state.steps + finer.steps
        state = finer if finer.residual <= spec.tolerance else state
        state = replace(state, steps=steps, status=Status.CONVERGED)
        known = ROUNDING_FLOOR + state.residual
    elif iterated:
        known = ROUNDING_FLOOR
    if weak is not None:
        state = _floored(exact, separation, conditions, state, known)
    return replace(state, displacement=None, extremes=None)


def _weak(
    operator: Operator, separation: Array, conditions: Optimality, state: State, known: float
) -> Mask | None:
    """Return the cells whose pressure or gap is known to nothing; None without any.

    Displacements are `known` to so much of the largest.
    """
    p, u, a_ii = state.pressure, _displacement(operator, state), _self_influences(operator, state.pressure)
    extremes, passes = state.extremes, conditions.passes
    if extremes is None and passes is not None and passes.fit(p, u, separation):
        extremes = passes.extremes(p, u, separation)
    if (  # nearly always there is no such cell
        isinstance(a_ii, float)
        and extremes is not None
        and min(a_ii * extremes.least / AMPLIFIED, extremes.nearest - state.depth)
        > known * extremes.displacement
    ):
        return None
    allowed = known * max_abs(u)
    weak = weakly_active(p, u + separation - state.depth, allowed) | _pressed_by_rounding(p, a_ii, allowed)
    return weak if bool(conditions.measure.xp.any(weak)) else None


def _matter(operator: Operator, measure: Measure, state: State, weak: Mask) -> bool:
    """Whether some cells may change the stiffness by more than is slight.

    Force is a convex function of depth, so that the stiffness is at least the ratio of the two.
    """
    p = state.pressure
    least = measure.total(p) / state.depth if state.depth > 0 else math.inf
    return added_stiffness(operator, (p > 0) & ~weak, weak) > SLIGHT * least


def _floored(
    operator: Operator, separation: Array, conditions: Optimality, state: State, known: float
) -> State:
    """Return the state without pressures whose own displacement is no more than is `known` of the largest."""
    p, spec, measure, xp = state.pressure, conditions.spec, conditions.measure, conditions.measure.xp
    allowed = known * max_abs(_displacement(operator, state))
    weak = _pressed_by_rounding(p, _self_influences(operator, p), allowed)
    if not bool(xp.any(weak)):
        return state
    p = xp.where(weak, 0.0, p)
    if isinstance(spec.control, Force) and not spec.plastic:
        total = measure.total(p)
        if not total > 0:  # nothing displaces anything, as on one periodic cell
            return state
        p *= spec.control.value / total
    iterate = Iterate(p, operator.apply(p), separation)
    depth, residual, *_ = conditions.evaluate(iterate)
    if residual > spec.tolerance:  # which then is below the rounding floor
        return state
    return replace(state, pressure=p, depth=depth, residual=residual, steps=state.steps + 1, tangent=None)


def _displacement(operator: Operator, state: State) -> Array:
    return operator.apply(state.pressure) if state.displacement is None else state.displacement


def _self_influences(operator: Operator, pressure: Array) -> Any:
    a_ii = self_influences(operator)
    return a_ii if isinstance(a_ii, float) else as_like(a_ii, pressure)
