"""A rough surface on a viscoelastic half-space under a history of force, depth or nominal pressure."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from roughcontact.contact.measures import StateMeasure
from roughcontact.contact.press import grid_of, make_problem
from roughcontact.contact.problem import ROUNDING, Body, ContactProblem
from roughcontact.errors import InputError, about
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.labels.variables import force_unit
from roughcontact.progress.events import tracked
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Depth, Solver
from roughcontact.solver.loads import Loads
from roughcontact.validation import Array, numeric, require, scalar, whole
from roughcontact.viscoelastic.checkpoint import Checkpoint
from roughcontact.viscoelastic.contact_in_time import ContactInTime
from roughcontact.viscoelastic.growing_curve import GrowingCurve
from roughcontact.viscoelastic.prony_series import Viscoelastic
from roughcontact.viscoelastic.time_history import checked_history
from roughcontact.viscoelastic.time_steps import AdaptiveSteps, FixedSteps, History
from roughcontact.viscoelastic.viscoelastic_curve import ViscoelasticCurve
from roughcontact.viscoelastic.viscoelastic_state import ViscoelasticState

__all__ = ["growing_curve", "viscoelastic_curve", "viscoelastic_path"]

TIME_TOLERANCE = 1e-3
NOISE = 10  # least ratio of the tolerance of time to that of a solve, whose error a difference contains


@numeric(times="s", forces=force_unit, depths="m", pressures="Pa")
def viscoelastic_path(
    surface: Body,
    material: Viscoelastic,
    *,
    times: Sequence[float] | Array,
    forces: Sequence[float] | Array | None = None,
    depths: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    time_tolerance: float = TIME_TOLERANCE,
    steps: int | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
) -> Iterator[ViscoelasticState]:
    """Press a rough surface against a viscoelastic half-space in time; yield the state at each step.

    The load is linear between the given times, and two equal times are a jump. The body is at rest before the first
    time. Each step is one elastic contact problem, see docs/concepts/time.md.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], positive toward the half-space, on a free or periodic grid.
    material : Viscoelastic
        A Prony series, for example by `standard_solid` or `from_dma` of `roughcontact.viscoelastic`.
    times : array, shape (n,)
        Times that do not decrease [s].
    forces, depths, pressures : array, shape (n,)
        Exactly one: normal forces [N] and nominal pressures [Pa], 0 or more, or depths [m], negative where the bodies
        are apart. On a line, forces are per unit length [N/m].
    time_tolerance : float
        Largest estimated error of time over the whole history: of force or depth, of the total strain and of the
        balance of energy, each over its largest value. The steps between the given times are adapted to it.
    steps : int, optional
        Number of equal steps in each interval instead, without an estimate.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, with the modulus ``material.instantaneous`` (1 Pa if
        this is 0). A surface of one axis needs one: `line`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each step.

    Yields
    ------
    ViscoelasticState
        All given times are among the states. Check `status`: a step may miss its tolerance.

    Raises
    ------
    ValueError
        If the input makes no sense, or the depth jumps although there is a dashpot; raised by the call.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> path = rc.viscoelastic_path(ball, rubber, times=[0, 1, 9], depths=[0, 1e-7, 1e-7])
    >>> [f"{state.force * 1e6:.2f} uN at {state.time:g} s" for state in path if state.prescribed]
    ['0.00 uN at 0 s', '3.16 uN at 1 s', '0.44 uN at 9 s']
    """
    history = _history(
        surface,
        material,
        times=times,
        forces=forces,
        depths=depths,
        pressures=pressures,
        time_tolerance=time_tolerance,
        steps=steps,
        operator=operator,
        solver=solver,
        tolerance=tolerance,
    )
    return tracked((state for state, _ in history.states()), "Pressing", "steps")


@numeric(times="s", forces=force_unit, depths="m", pressures="Pa")
def viscoelastic_curve(
    surface: Body,
    material: Viscoelastic,
    *,
    times: Sequence[float] | Array,
    forces: Sequence[float] | Array | None = None,
    depths: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    time_tolerance: float = TIME_TOLERANCE,
    steps: int | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
    measures: Sequence[StateMeasure] = (),
    checkpoint: str | os.PathLike[str] | None = None,
) -> ViscoelasticCurve:
    """Return force, depth, contact area, stiffness and energies of a viscoelastic contact against time.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `viscoelastic_path`.
    material : Viscoelastic
        See `viscoelastic_path`.
    times : array, shape (n,)
        Times that do not decrease [s]; two equal times are a jump.
    forces, depths, pressures : array, shape (n,)
        Exactly one: forces [N], depths [m] or nominal pressures [Pa], linear between the times.
    time_tolerance : float
        Largest estimated error of time, see `viscoelastic_path`.
    steps : int, optional
        Number of equal steps in each interval instead, without an estimate.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `viscoelastic_path`.
    solver : Solver, optional
        Settings of the method: `ActiveSet` (default) or `PolonskyKeer`.
    tolerance : float
        Largest residual of each step.
    measures : sequence of functions
        Each returns numbers of a `Solution` by name, which become columns of the curve, see `loading_curve`.
    checkpoint : path, optional
        File (.npz) to which the computation is written once a minute, at its end, and when it is interrupted. If it
        holds a part of the same computation, the rest is computed, with the same numbers to the last bit.

    Returns
    -------
    ViscoelasticCurve
        One point for each step; fields are not kept, see `viscoelastic_path`.

    Raises
    ------
    ValueError
        If the input makes no sense.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> curve = rc.viscoelastic_curve(ball, rubber, times=[0, 100], forces=[1e-4, 1e-4])
    >>> f"{(curve.depth[-1] / curve.depth[0]) ** 1.5:.1f}"  # by Hertz J(100 s)/J(0), which is 10
    '10.3'
    """
    growing = growing_curve(
        surface,
        material,
        times=times,
        forces=forces,
        depths=depths,
        pressures=pressures,
        time_tolerance=time_tolerance,
        steps=steps,
        operator=operator,
        solver=solver,
        tolerance=tolerance,
        measures=measures,
        checkpoint=checkpoint,
    )
    growing.grow()
    return growing.curve()


def growing_curve(
    surface: Body,
    material: Viscoelastic,
    *,
    measures: Sequence[StateMeasure] = (),
    checkpoint: str | os.PathLike[str] | None = None,
    **given: Any,
) -> GrowingCurve:
    """Return the curve of `viscoelastic_curve` before it is computed; it holds what the checkpoint holds."""
    history = _history(surface, material, **given)
    file = None if checkpoint is None else Checkpoint.of(checkpoint, history, measures)
    return GrowingCurve(history, measures, file)


def _history(
    surface: Body,
    material: Viscoelastic,
    *,
    times: Sequence[float] | Array,
    forces: Sequence[float] | Array | None = None,
    depths: Sequence[float] | Array | None = None,
    pressures: Sequence[float] | Array | None = None,
    time_tolerance: float = TIME_TOLERANCE,
    steps: int | None = None,
    operator: Operator | None = None,
    solver: Solver | None = None,
    tolerance: float = 1e-8,
) -> History:
    """Return a history whose arguments are checked, see `viscoelastic_path`."""
    loads = Loads.of(forces=forces, depths=depths, pressures=pressures)
    t, values = checked_history(material, times, loads.values)
    grid = grid_of(surface)
    forced = loads.kind != "depth"
    if forced:
        require(
            values >= 0,
            f"the {loads.kind}s must not be negative",
            "surfaces without adhesion do not pull",
            value=values,
            place=f"{loads.kind}s",
        )
        values = Loads(loads.kind, values).as_forces(grid).values
    accuracy = scalar(time_tolerance, "time_tolerance")
    reference = material.instantaneous or 1.0
    problem = make_problem(surface, reference, Depth(0.0), operator, tolerance=tolerance, curve=True)
    if not NOISE * problem.tolerance <= accuracy < 1:
        raise about(
            "time_tolerance",
            f"must be below 1 and at least {NOISE} times the tolerance {problem.tolerance:g}, not {accuracy:g}",
            "give a larger time_tolerance, or a smaller tolerance",
        )
    if not forced:
        _require_depths(problem, material, t, values)
    rule = AdaptiveSteps(accuracy) if steps is None else FixedSteps(whole(steps, "steps"))
    contact = ContactInTime(problem, material, forced, solver or ActiveSet(), float(np.abs(values).max()))
    return History(contact, t, values, rule)


def _require_depths(problem: ContactProblem, material: Viscoelastic, times: Array, depths: Array) -> None:
    """Refuse depths that cannot be met."""
    jumps = np.diff(depths, prepend=0.0)[np.diff(times, prepend=times[0]) == 0]
    if material.dashpot and (jumps != 0).any() and not (jumps[0] < 0 and not jumps[1:].any()):
        raise InputError(
            "the depth jumps, and a material with a dashpot needs an infinite force for this",
            "let the depth change over some time, start from depth 0, or give a material without a dashpot",
            "depths",
        )
    if problem.semidefinite and not problem.missing:
        deepest, mean = float(depths.max()), problem.mean_separation
        if deepest > mean * (1 + ROUNDING):
            raise InputError(
                f"a depth of {deepest:.6g} m exceeds the mean separation {mean:.6g} m: there a periodic surface is in "
                "full contact and its stiffness infinite",
                "give smaller depths, or forces",
                "depths",
            )
