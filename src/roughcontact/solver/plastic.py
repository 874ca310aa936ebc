"""Perfectly plastic contact, limited by the hardness: by projection, or from the depth that carries the force."""

from __future__ import annotations

from dataclasses import replace

from roughcontact.halfspace.operators.operator import Operator
from roughcontact.solver import tuning
from roughcontact.solver.control import Depth, Specification, State
from roughcontact.solver.optimality import Optimality
from roughcontact.solver.polonsky_keer import PolonskyKeer
from roughcontact.solver.projection import bearing_level
from roughcontact.validation import Array

__all__ = ["press_plastic"]


def press_plastic(
    operator: Operator, separation: Array, spec: Specification, start: Array, max_steps: int
) -> State:
    """Press under a specification with a hardness, from a `start` of the pressure [Pa].

    Where nearly every cell in contact is plastic, the few between the bounds determine the depth poorly at a given
    force, and the projected method may cycle. At given depth it does not; the force grows with the depth.
    """
    solver = PolonskyKeer(max_steps=max_steps)
    state = replace(solver, patience=tuning.PLASTIC_PATIENCE).run(operator, separation, spec, start)
    if state.status.converged or spec.depth is not None:
        return state
    pressure, steps = _by_depth(operator, separation, spec, solver)
    last = solver.run(operator, separation, spec, pressure)
    return replace(last, steps=state.steps + steps + last.steps)


def _by_depth(
    operator: Operator, separation: Array, spec: Specification, solver: PolonskyKeer
) -> tuple[Array, int]:
    """Return a pressure whose force is nearly the one prescribed, and the products that it took."""
    conditions = Optimality.of(operator, spec, separation)
    measure, force = conditions.measure, spec.control.value
    pressure, steps = measure.xp.zeros_like(separation), 0

    def excess(depth: float) -> float:
        nonlocal pressure, steps
        state = solver.run(operator, separation, replace(spec, control=Depth(depth)), pressure)
        pressure, steps = state.pressure, steps + state.steps
        return measure.total(pressure) / force - 1

    # At least what the hardness does to a single cell: a flat body bears at depth zero, which cannot be doubled.
    bearing = bearing_level(measure, separation, measure.xp.isfinite(separation), spec, force)
    low, high = 0.0, max(bearing, conditions.self_influence * spec.largest_hardness)
    below, above = -1.0, excess(high)
    for _ in range(tuning.DEPTH_TRIALS):
        if above >= 0:
            break
        low, below = high, above
        high *= 2
        above = excess(high)
    if above < 0:  # the solver has too few steps to press at all
        return pressure, steps
    for trial in range(tuning.DEPTH_TRIALS):
        # The chord where it is safe, the middle where the curve is a staircase.
        chord = low - below * (high - low) / (above - below)
        middle = (low + high) / 2
        depth = chord if abs(chord - middle) < 0.4 * (high - low) and trial % 2 else middle
        found = excess(depth)
        if abs(found) <= tuning.FORCE_CLOSE or not low < depth < high:
            break
        if found < 0:
            low, below = depth, found
        else:
            high, above = depth, found
    return pressure, steps
