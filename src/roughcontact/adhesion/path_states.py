"""The states of a body along a list of prescribed depths or forces."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from roughcontact.adhesion.adhesive_state import AdhesiveProblem, AdhesiveState, state_of
from roughcontact.adhesion.attraction import LAWS, REACH, Adhesion, Attraction
from roughcontact.adhesion.control_form import DepthControl, ForceControl
from roughcontact.adhesion.elastic_form import ElasticForm, elastic_form
from roughcontact.adhesion.exponential_law import ExponentialLaw
from roughcontact.adhesion.gradient_flow import detached
from roughcontact.adhesion.quasi_static import PathPoint, QuasiStatic
from roughcontact.adhesion.truncated_newton import Counter, minimise
from roughcontact.errors import InputError
from roughcontact.halfspace.operators.operator import Operator, capabilities
from roughcontact.progress.events import task
from roughcontact.solver.loads import Loads
from roughcontact.surface.radial import RadialProfile
from roughcontact.surface.surface import Surface
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array

__all__ = ["is_resolved", "states_along"]

# Precision of the end of a branch, as a part of the way from beyond the attraction to the largest depth (or of the
# largest force). It is a hundredth of the documented one, because next to its end a branch moves by the square root of
# the remaining distance.
BRACKET = 1e-8
HARD = 1e-3  # residual of the contact without attraction, from which the flow starts
POLISHED, STEPS = (
    1e-13,
    4,
)  # residual of a state under a prescribed force, and largest number of steps toward it
CELLS = 1.5  # smallest length of Irwin


def is_resolved(adhesion: Adhesion, operator: Operator, modulus: float) -> bool:
    """Whether Irwin's length spans 1.5 cells; otherwise the attraction varies from cell to cell."""
    return adhesion.process_zone(modulus) >= CELLS * max(operator.grid.spacing)


def require_resolved(adhesion: Adhesion, operator: Operator, modulus: float) -> None:
    """Raise an error for an attraction that varies from cell to cell, so that the grid would trap every state.

    Raises
    ------
    ValueError
        If Irwin's length spans fewer than 1.5 cells.
    """
    if not is_resolved(adhesion, operator, modulus):
        zone, cell = adhesion.process_zone(modulus), max(operator.grid.spacing)
        # Rounded so that the printed value is accepted.
        finest = _three_digits(zone / CELLS, math.floor)
        longest = _three_digits(adhesion.range * math.sqrt(CELLS * cell / zone), math.ceil)
        raise InputError(
            f"the attraction varies over {_three_digits(zone / cell, math.floor):g} cells beside a contact (Irwin's "
            f"length E* w/(pi s^2)), and below {CELLS:g} the grid would trap every state",
            f"take cells of at most "
            f"{finest:g} m or a range of at least {longest:g} m, use detachment_path, which needs no range, or give "
            "the adhesion allow_unresolved=True",
        )


def _three_digits(value: float, rounded: Callable[[float], int]) -> float:
    """Return a number with three digits, rounded up or down."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{rounded(value / unit) * unit:.3g}")


def states_along(
    operator: Operator,
    separation: Array,
    adhesion: Adhesion,
    loads: Loads,
    *,
    modulus: float,
    surface: Surface | RadialProfile | None = None,
    tolerance: float = 1e-8,
) -> Iterator[AdhesiveState]:
    """Yield the state at each depth, force or mean gap, in order, of a body that approaches from afar.

    Parameters
    ----------
    operator : Operator
    separation : array, shape of the grid
        Undeformed gap at first touch [m]; infinite where nothing was measured.
    adhesion : Adhesion
    loads : Loads
        Depths or forces of either sign, up and down, where the first force is at least 0; or mean gaps of a whole
        periodic surface, above 0.
    modulus : float
        Reduced modulus E* [Pa].
    surface : Surface or RadialProfile, optional
        The surface that the separation comes from, for the record.
    tolerance : float
        Largest residual.

    Raises
    ------
    ValueError
        If the grid would trap every state, if the work does not have the shape of the grid, or if a depth, a force or a
        mean gap cannot be reached.
    """
    if not adhesion.allow_unresolved:
        require_resolved(adhesion, operator, modulus)
    if np.shape(adhesion.work) not in ((), separation.shape):
        raise InputError(
            f"the work of adhesion has shape {np.shape(adhesion.work)}, and the grid {separation.shape}",
            "give one number, or one for each cell",
        )
    if capabilities(operator).listed:
        raise InputError("adhesion needs a body on a whole grid, not on a list of cells")
    form = elastic_form(operator)
    control: DepthControl | ForceControl
    control = DepthControl(form, _law_on(adhesion, form, separation, modulus), separation)
    if loads.kind == "force":
        control, goals = ForceControl.of(control), _checked_forces(loads.values)
        scale = max(float(np.max(np.abs(goals))), adhesion.strength * float(np.min(operator.weights)))
    else:
        goals = _checked_depths(loads, form, separation)
        scale = max(0.0, *goals) + REACH * adhesion.range
    resolved = is_resolved(adhesion, operator, modulus)
    problem = AdhesiveProblem(
        operator, separation, adhesion, modulus, surface, form, control, tolerance, resolved
    )
    return _states(problem, goals, BRACKET * scale)


def _checked_depths(loads: Loads, form: ElasticForm, separation: Array) -> list[float]:
    """Return the depths; mean gaps become depths of a periodic surface, whose mean displacement is zero."""
    whole, values = form.mean_free and np.isfinite(separation).all(), loads.values
    full = float(separation.mean()) if whole else math.inf
    if loads.kind == "mean gap":
        if not whole:
            why = "some cells are missing" if form.mean_free else "the body is not periodic"
            raise InputError(
                "a mean gap is prescribed on a whole periodic grid, where it is the mean separation less the depth; "
                f"here {why}",
                "give depths or forces",
            )
        if not values.min() > 0:
            raise InputError(
                f"a mean gap of {values.min():.6g} m is full contact or beyond it", "give mean gaps above 0"
            )
        values = full - values
    if values.max() >= full:
        raise InputError(
            f"a depth of {values.max():.6g} m is not below the mean separation {full:.6g} m: there a periodic surface "
            "is in full contact",
            "give a smaller depth",
        )
    return [float(depth) for depth in values]


def _checked_forces(forces: Array) -> list[float]:
    if forces[0] < 0:
        raise InputError(
            "a path under prescribed forces begins with an approach, and cannot begin under the tension "
            f"{forces[0]:g}",
            "begin with 0 or more, and let the tension follow (adhesive_path, adhesive_loop)",
        )
    return [float(force) for force in forces]


def _initial_displacement(control: DepthControl | ForceControl, value: float, counter: Counter) -> Array:
    """Return the displacement of equilibrium without attraction, from which the approach starts."""
    form, law = control.form, control.attraction
    hard = replace(control, attraction=ExponentialLaw(0.0, law.range)).energy_at(value)
    if isinstance(control, ForceControl) and value <= 0:
        return form.extended(np.full(control.separation.shape, law.start_gap), 0.0)
    if isinstance(control, DepthControl) and not hard.obstacle.max() > 0:
        return np.zeros(form.shape)
    return minimise(hard, np.zeros(form.shape), counter, tolerance=HARD).point.displacement


def _polished(path: QuasiStatic, reached: PathPoint) -> PathPoint:
    """Return a state with a residual close to rounding, because its sum over all cells is an error of the force."""
    energy = path.control.energy_at(reached.value)
    if not reached.converged or detached(energy, reached.point):
        return reached
    start = reached.point.displacement
    better = minimise(energy, start, path.counter, tolerance=POLISHED, iterations=STEPS, convex_only=True)
    return replace(reached, point=better.point, residual=better.residual)


def _states(problem: AdhesiveProblem, goals: list[float], bracket: float) -> Iterator[AdhesiveState]:
    path = QuasiStatic(problem.control, bracket)
    reached: PathPoint | None = None
    for goal in goals:
        before = path.counter.products
        with one_blas_thread():
            if reached is None or (
                detached(problem.control.energy_at(reached.value), reached.point) and goal >= 0
            ):
                # From afar: if the tension has ended, the bodies approach again.
                reached = path.start(goal, _initial_displacement(problem.control, goal, path.counter))
            else:
                with task("Following the branch", 100, "%") as path.task:
                    reached = path.continue_to(reached, goal)
            if isinstance(problem.control, ForceControl):
                reached = _polished(path, reached)
            state = state_of(problem, reached, path.counter.products - before)
        yield state


def _law_on(adhesion: Adhesion, form: ElasticForm, separation: Array, modulus: float) -> Attraction:
    """Return the law on the cells of a computation.

    Parameters
    ----------
    adhesion : Adhesion
    form : ElasticForm
    separation : array, shape of the grid
        Undeformed gap [m]; infinite where nothing was measured, without attraction.
    modulus : float
        Reduced modulus E* [Pa].
    """
    work = form.extended(np.where(np.isfinite(separation), adhesion.work, 0.0), 0.0)
    law = LAWS[adhesion.law]
    return law.on_cells(work, adhesion.range, adhesion.strength, form, separation, modulus)
