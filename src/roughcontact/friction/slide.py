"""Tangential loading of a pressed contact: one load, or a sequence of loads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from roughcontact.arrays import as_like, inner, is_numpy, namespace, on_host
from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.friction.coulomb import lengths
from roughcontact.friction.newton import SlipNewton
from roughcontact.friction.slip_problem import Load, Pull, Shift, SlipProblem, continued, make_problem
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.friction.slip_step import Slipped, SlipStep
from roughcontact.halfspace.shear.shear_operator import ShearOperator
from roughcontact.material import Bodies
from roughcontact.progress.events import tracked
from roughcontact.solver.control import Status
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, exactly_one, number, numeric

__all__ = ["Loads", "advance", "load_cycle", "slide", "slide_path"]


Loads = Sequence[Load] | Array
"""Loads in the order of time: numbers along one direction, or pairs (x, y), one a row."""


@numeric(force="N", displacement="m")
def slide(
    solution: Solution,
    bodies: Bodies,
    *,
    friction: float,
    force: Load | None = None,
    displacement: Load | None = None,
    initial: TangentialSolution | None = None,
    along: Sequence[float] | None = None,
    operator: ShearOperator | None = None,
    tolerance: float = 1e-8,
) -> TangentialSolution:
    """Load a pressed contact tangentially at constant pressure: stick, slip and traction, with a certificate.

    The computation runs in the array library of the pressure: traction and slip are arrays of the same library.

    Coulomb's law holds in every cell: traction is at most mu p, and a cell with less does not slip. The slip of a step
    is opposed to the traction at its end. This is exact if slip keeps its direction within the step, as for loading
    along a line, forwards or backwards, with nu = 0; if slip may rotate, take more steps. (Cattaneo 1938, Mindlin 1949
    for a sphere; Ciavarella 1998, Jaeger 1998 for any shape; thesis, chapter 7.)

    Parameters
    ----------
    solution : Solution
        The pressed contact, of a surface of two axes, free or periodic.
    bodies : Solid or pair of Solids
        The bodies of the pressed contact; a single one is pressed against a rigid body. The coupling of normal and
        tangential displacements of unlike bodies is neglected; the notes of the solution state this.
    friction : float
        Coefficient of friction mu.
    force, displacement : float or pair of floats
        Give exactly one: tangential force [N], at most mu times the normal force, under which the bodies slide
        steadily (docs/concepts/sliding.md), or displacement of body 2 against body 1 since the start [m]; as (x, y),
        or one number along x (along `along`, if given).
    initial : TangentialSolution, optional
        The state to continue from, of the same contact with the same friction; its `along` and `operator` are used. By
        default the contact is at rest and free of traction.
    along : pair of floats, optional
        Let traction act only in this direction (x, y), as in the closed forms, and neglect displacements across it. By
        default traction may rotate.
    operator : ShearOperator, optional
        Another body than the half-spaces on the grid of the contact, or another method of summation: see
        `shear_half_space`.
    tolerance : float
        Largest residual.

    Returns
    -------
    TangentialSolution
        Traction, displacement, stick and slip, with their certificate.

    Raises
    ------
    ValueError
        If the input is invalid; the message names the value and the remedy.
    ConvergenceError
        If the tolerance was not reached. The error holds the solution.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3)
    >>> pressed = rc.press(ball, rubber, force=1e-3)
    >>> state = rc.slide(pressed, rubber, friction=0.5, force=0.25e-3)  # half of what friction holds
    >>> f"{state.slip_area / pressed.contact_area:.1f} of the contact slips"
    '0.4 of the contact slips'
    """
    make = make_problem if initial is None else partial(continued, initial.problem)
    problem = make(solution, bodies, friction, along=along, operator=operator, tolerance=tolerance)
    answer = advance(problem, problem.load(force=force, displacement=displacement), initial)
    if not answer.status.converged:
        raise ConvergenceError(answer)
    return answer


@numeric(forces="N", displacements="m")
def slide_path(
    solution: Solution,
    bodies: Bodies,
    *,
    friction: float,
    forces: Loads | None = None,
    displacements: Loads | None = None,
    along: Sequence[float] | None = None,
    operator: ShearOperator | None = None,
    tolerance: float = 1e-8,
) -> Iterator[TangentialSolution]:
    """Yield the state at every load, in order: each state depends on the slip so far.

    Parameters
    ----------
    solution : Solution
        The pressed contact, of a surface of two axes, free or periodic.
    bodies : Solid or pair of Solids
        The bodies of the pressed contact; a single one is pressed against a rigid body.
    friction : float
        Coefficient of friction mu.
    forces, displacements : array, shape (n,) or (n, 2)
        Give exactly one: tangential forces [N] or displacements [m] in any order, up and down; see `load_cycle`.
    along : pair of floats, optional
        Direction (x, y) of the traction, see `slide`.
    operator : ShearOperator, optional
        Another body than the half-spaces on the grid, see `slide`.
    tolerance : float
        Largest residual.

    Yields
    ------
    TangentialSolution
        If a load misses its tolerance, its `status` shows it.

    Raises
    ------
    ValueError
        If the input is invalid; raised immediately, not at the first load.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3)
    >>> pressed = rc.press(ball, rubber, force=1e-3)
    >>> loads = rc.load_cycle(0.25e-3, steps=2)
    >>> energies = [state.dissipated for state in rc.slide_path(pressed, rubber, friction=0.5, forces=loads)]
    >>> len(energies), min(energies) >= 0
    (10, True)
    """
    problem = make_problem(solution, bodies, friction, along=along, operator=operator, tolerance=tolerance)
    name, given = exactly_one(forces=forces, displacements=displacements)
    if not (hasattr(given, "__len__") and len(given)):
        raise InputError(f"a path needs at least one load, in a row, not {given}")
    loads = [problem.load(**{name.removesuffix("s"): value}) for value in given]
    return tracked(_follow(problem, loads), "Sliding", "loads", len(loads))


def _follow(problem: SlipProblem, loads: list[Pull | Shift]) -> Iterator[TangentialSolution]:
    state: TangentialSolution | None = None
    for load in loads:
        state = advance(problem, load, state)
        yield state


@numeric
def load_cycle(amplitude: Load, *, cycles: int = 1, steps: int = 8) -> Array:
    """Return loads from zero to an amplitude, then back and forth between the amplitude and its opposite.

    Parameters
    ----------
    amplitude : float or pair of floats
        Largest force [N] or displacement [m]: a number, or (x, y).
    cycles : int
        Number of full cycles; 0 ends at the amplitude.
    steps : int
        Number of equal steps from zero to the amplitude. From one reversal to the next there are twice as many.

    Returns
    -------
    array, shape (n,) or (n, 2)
        ``n = steps * (1 + 4 * cycles)`` loads; the initial zero is not included.

    Raises
    ------
    ValueError
        If `steps` is not a whole number >= 1, or `cycles` not a whole number >= 0.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.load_cycle(1.0, steps=2).tolist()
    [0.5, 1.0, 0.5, 0.0, -0.5, -1.0, -0.5, 0.0, 0.5, 1.0]
    """
    if int(steps) != steps or steps < 1 or int(cycles) != cycles or cycles < 0:
        raise InputError(
            f"a cycle needs whole numbers, steps >= 1 and cycles >= 0, not {steps} and {cycles}",
            place="steps, cycles",
        )
    largest = np.asarray(number(amplitude, "amplitude"))
    if largest.shape not in ((), (2,)) or not np.isfinite(largest).all():
        raise InputError(
            f"an amplitude is one finite number, or two (x, y), not {amplitude}", place="amplitude"
        )
    since = np.arange(1 - steps, 4 * cycles * steps + 1) % (4 * steps)  # steps since the last upper reversal
    part = np.abs(since - 2 * steps) / steps - 1
    return np.multiply.outer(part, largest)


@one_blas_thread()
def advance(
    problem: SlipProblem, load: Pull | Shift, initial: TangentialSolution | None = None
) -> TangentialSolution:
    """Return the state under a load, from an initial state or from rest; its status shows whether it converged."""
    interface = problem.interface
    if initial is None:
        start = slipped = moved = interface.zeros()
    else:
        start, slipped = interface.restrict(initial.traction), interface.restrict(initial.slip)
        moved = slipped + as_like((interface.basis @ initial.displacement)[:, None], slipped)
    value = interface.basis @ np.array([load.x, load.y])
    step = SlipStep(
        interface,
        problem.limit,
        start,
        slipped,
        force=value if isinstance(load, Pull) else None,
        shift=value if isinstance(load, Shift) else None,
        scale=float(namespace(moved).max(lengths(moved))),
        tolerance=problem.tolerance,
    )
    found = _slid(step, value) if problem.slides_under(load) else SlipNewton().run(step)
    now = found.displacement - as_like(found.shift[:, None], found.displacement)
    fields = [interface.prolong(found.traction), interface.prolong(now)]
    for field in fields:
        if is_numpy(field):
            field.flags.writeable = False
    return TangentialSolution(
        problem,
        load,
        fields[0],
        interface.basis.T @ found.shift,
        fields[1],
        -inner(found.traction, now - slipped) * interface.area,
        found.status,
        found.residual,
        found.steps,
        step.residual(found.traction, found.displacement, now - slipped),
    )


def _slid(step: SlipStep, force: Array) -> Slipped:
    """Return the steady slide: the traction is at the limit of friction in every cell, along the force.

    No other traction adds up to the force. The traction and the elastic displacements are constant while the bodies
    move along the force: the slip rate of every cell is that of the bodies, opposed to the traction. Only the
    component along the force of the slip until then counts: none may be backward.
    """
    direction, xp = force / np.sqrt(force @ force), namespace(step.limit)
    q = step.limit * as_like(direction[:, None], step.limit)
    u = step.interface.apply(q)
    level = u - step.slip
    shift = on_host(xp.mean(level, axis=1))
    shift += (float(xp.max(as_like(direction, level) @ level)) - direction @ shift) * direction
    along = as_like(direction, level) @ step.slipped(u, shift)
    residual = step.residual(q, u, along * as_like(direction[:, None], along))
    status = Status.CONVERGED if residual <= step.tolerance else Status.STAGNATED
    return Slipped(q, u, shift, residual, 1, status)
