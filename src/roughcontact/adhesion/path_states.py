"""The states of a body along a list of prescribed depths or forces."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from roughcontact.adhesion.adhesive_state import AdhesiveState, Blank, state_of
from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.control_form import DepthControl, ForceControl
from roughcontact.adhesion.elastic_form import elastic_form
from roughcontact.adhesion.gradient_flow import REACH, released
from roughcontact.adhesion.law_on_cells import law_on
from roughcontact.adhesion.quasi_static import QuasiStatic, Station
from roughcontact.adhesion.sharp_path import require_drawn_back, sharp_states
from roughcontact.adhesion.truncated_newton import minimise
from roughcontact.halfspace.operators.operator import Operator, capabilities
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array

__all__ = ["is_resolved", "states_along"]

# Of the way from beyond the attraction to the largest depth (or of the largest force): how closely the end of a branch
# is found. A hundredth of what is promised, since next to its end a branch moves by the root of what is left.
BRACKET = 1e-8
SHARP, STEPS = 1e-13, 4  # residual of a state under a given force, and steps toward it at most
CELLS = 1.5  # that Irwin's length must span


def is_resolved(adhesion: Adhesion, operator: Operator, modulus: float) -> bool:
    """Whether Irwin's length spans 1.5 cells, or the law is sharp: else the attraction varies from cell to cell."""
    return adhesion.law == "sharp" or adhesion.process_zone(modulus) >= CELLS * max(operator.grid.spacing)


def require_resolved(adhesion: Adhesion, operator: Operator, modulus: float) -> None:
    """Refuse an attraction that varies from cell to cell, so that the lattice would trap every state.

    Raises
    ------
    ValueError
        If Irwin's length spans fewer than 1.5 cells.
    """
    if not is_resolved(adhesion, operator, modulus):
        zone, cell = adhesion.process_zone(modulus), max(operator.grid.spacing)
        finest = adhesion.range * (CELLS * cell / zone) ** 0.5
        raise ValueError(
            f"the attraction varies over {zone / cell:.2g} cells beside a contact (Irwin's length E* w/(pi s^2)), and "
            f"the lattice would trap every state: take cells of at most {zone / CELLS:.3g} m or a range of at least "
            f"{finest:.3g} m, or give the adhesion allow_unresolved=True"
        )


def states_along(
    operator: Operator,
    separation: Array,
    adhesion: Adhesion,
    *,
    modulus: float,
    depths: Array | None = None,
    forces: Array | None = None,
    tolerance: float = 1e-8,
) -> Iterator[AdhesiveState]:
    """Yield the state at each depth or under each force, in order, of a body that comes from afar.

    Parameters
    ----------
    operator : Operator
    separation : array, shape of the grid
        Undeformed gap at first touch [m]; infinite where nothing was measured.
    adhesion : Adhesion
    modulus : float
        Reduced modulus E* [Pa].
    depths, forces : array
        One of them: [m] or [N]; of either sign, up and down, the first force at least 0.
    tolerance : float
        Largest residual.

    Raises
    ------
    ValueError
        If the lattice would trap every state, the work has another shape than the grid, or a depth or force cannot be
        reached.
    """
    if not adhesion.allow_unresolved:
        require_resolved(adhesion, operator, modulus)
    if np.shape(adhesion.work) not in ((), separation.shape):
        raise ValueError(
            f"the work of adhesion has shape {np.shape(adhesion.work)}, and the grid {separation.shape}: "
            "give one number, or one for each cell"
        )
    if capabilities(operator).listed:
        raise ValueError("adhesion needs a body on a whole grid, not on a list of cells")
    values = depths if forces is None else forces
    goals = [] if values is None else [float(value) for value in values]
    if adhesion.law == "sharp":
        require_drawn_back(goals)
    form = elastic_form(operator)
    measured = np.isfinite(separation)
    by_depth = DepthControl(form, law_on(adhesion, form, separation, modulus), separation)
    resolved = is_resolved(adhesion, operator, modulus)
    if forces is not None:
        control = ForceControl.of(by_depth)
        blank = Blank(operator, separation, form, control, tolerance, resolved)
        if adhesion.law == "sharp":
            return sharp_states(blank, goals, modulus)
        return _walk(blank, goals, *_first_force(blank, forces, adhesion))
    if form.mean_free and measured.all() and max(goals) >= (full := float(separation.mean())):
        raise ValueError(
            f"a depth of {max(goals):.6g} m is not below the mean separation {full:.6g} m: there a periodic surface is "
            "in full contact; give a smaller depth"
        )
    far = -REACH * adhesion.range
    blank = Blank(operator, separation, form, by_depth, tolerance, resolved)
    if adhesion.law == "sharp":
        return sharp_states(blank, goals, modulus)
    first = min(far, goals[0])
    return _walk(blank, goals, first, np.zeros(form.shape), BRACKET * (max(0.0, *goals) - far))


def _first_force(blank: Blank, forces: Array, adhesion: Adhesion) -> tuple[float, Array, float]:
    """Return the first force, the displacement to start from and the bracket."""
    first = float(forces[0])
    if first < 0:
        raise ValueError(
            "a path under given forces begins with the bodies drawing near, and cannot begin under the tension "
            f"{first:g}: begin with 0 or more, and let the tension follow (loading_path, adhesive_loop)"
        )
    apart = blank.form.extended(np.full(blank.separation.shape, blank.control.attraction.near), 0.0)
    cell = float(np.min(blank.operator.weights))
    return first, apart, BRACKET * max(float(np.max(np.abs(forces))), adhesion.strength * cell)


def _sharpened(walk: QuasiStatic, station: Station) -> Station:
    """Return a state with as little residual as rounding allows: over all cells its sum is an error of the force."""
    energy = walk.control.energy_at(station.value)
    if not station.converged or released(energy, station.point):
        return station
    start = station.point.displacement
    better = minimise(energy, start, walk.counter, tolerance=SHARP, iterations=STEPS, convex_only=True)
    return replace(station, point=better.point, residual=better.residual)


def _walk(
    blank: Blank, goals: list[float], first: float, displacement: Array, bracket: float
) -> Iterator[AdhesiveState]:
    walk = QuasiStatic(blank.control, bracket)
    with one_blas_thread():
        station = walk.start(first, displacement)
    for goal in goals:
        before = walk.counter.products
        with one_blas_thread():
            if released(blank.control.energy_at(station.value), station.point) and goal >= 0:
                station = walk.start(goal, displacement)  # nothing pulls any more: the bodies draw near again
            station = walk.go(station, goal)
            if isinstance(blank.control, ForceControl):
                station = _sharpened(walk, station)
            state = state_of(blank, station, walk.counter.products - before)
        yield state
