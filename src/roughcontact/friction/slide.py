"""The front door: pull at a pressed contact."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import beside, inner, is_numpy, namespace, numbers
from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.solution import Solution
from roughcontact.friction.coulomb import lengths
from roughcontact.friction.newton import SlipNewton
from roughcontact.friction.slip_problem import (
    Load,
    Pull,
    Shift,
    SlipProblem,
    continued,
    load_of,
    make_problem,
)
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.friction.slip_step import Slipped, Step
from roughcontact.halfspace.shear.shear_operator import ShearOperator
from roughcontact.material import Bodies
from roughcontact.solver.status import Status
from roughcontact.threads import one_blas_thread
from roughcontact.validation import numeric

__all__ = ["advance", "slide"]

Array = npt.NDArray[np.float64]


@numeric
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
    """Pull at a pressed contact whose pressure is held, and return what sticks and what slips, with a certificate.

    Done where the pressure lives: on arrays of other libraries traction and slip come back as arrays of theirs.

    Coulomb's law in every cell: traction is at most mu p, and where it is less nothing slips. The slip of a step is
    opposed to the traction at its end: exact where slip does not turn within the step, as from rest along a line, or
    back along it, for nu = 0; where it may turn, take more steps. (Cattaneo 1938, Mindlin 1949 for a sphere;
    Ciavarella 1998, Jaeger 1998 for any shape; thesis, chapter 7.)

    Parameters
    ----------
    solution : Solution
        The pressed contact, of a surface of two axes, free or periodic.
    bodies : Solid or pair of Solids
        Those it was pressed with; a single one against a rigid body. That normal and tangential displacements of
        unlike bodies couple is left out; the solution says so in its notes.
    friction : float
        Coefficient of friction mu.
    force, displacement : float or pair of floats
        Exactly one: tangential force [N], at most mu times the normal one, under which the bodies slide steadily
        (docs/conventions.md), or displacement of body 2 against body 1 since the start [m]; as (x, y), or one number
        along x (along `along`, if given).
    initial : TangentialSolution, optional
        The state to go on from, of the same contact with the same friction; `along` and `operator` are then as they
        were. Without one the contact is at rest and free of traction.
    along : pair of floats, optional
        Let traction act in this direction (x, y) only, as the closed forms do, and leave out what moves the surfaces
        across it. Without, it may turn.
    operator : ShearOperator, optional
        Another body than the half-spaces on the grid of the contact, or another way to sum them: see
        `shear_half_space`.
    tolerance : float
        Largest residual.

    Returns
    -------
    TangentialSolution

    Raises
    ------
    ValueError
        If the input makes no sense; the message names the value and the remedy.
    ConvergenceError
        If the tolerance was missed. It carries the solution.
    """
    make = make_problem if initial is None else partial(continued, initial.problem)
    problem = make(solution, bodies, friction, along=along, operator=operator, tolerance=tolerance)
    load = load_of(problem.along, force=force, displacement=displacement)
    problem.check(load)
    answer = advance(problem, load, initial)
    if not answer.status.converged:
        raise ConvergenceError(answer)  # type: ignore[arg-type]  # it has all that the error tells
    return answer


@one_blas_thread()
def advance(
    problem: SlipProblem, load: Pull | Shift, initial: TangentialSolution | None = None
) -> TangentialSolution:
    """Return the state under a load, from an initial one or from rest; its status says whether it is good."""
    interface = problem.interface
    if initial is None:
        start = slipped = moved = interface.zeros()
    else:
        start, slipped = interface.take(initial.traction), interface.take(initial.slip)
        moved = slipped + beside((interface.basis @ initial.displacement)[:, None], slipped)
    value = interface.basis @ np.array([load.x, load.y])
    step = Step(
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
    now = found.displacement - beside(found.shift[:, None], found.displacement)
    fields = [interface.embed(found.traction), interface.embed(now)]
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


def _slid(step: Step, force: Array) -> Slipped:
    """Return the steady slide: all the traction that friction holds, along the force.

    No other traction adds up to the force. It stays as it is while the bodies move on along the force, and so do the
    elastic displacements: the slip rate of every cell is that of the bodies, opposed to the traction. Of the slip until
    then, what lies along the force counts: none may be backward.
    """
    direction, xp = force / np.sqrt(force @ force), namespace(step.limit)
    q = step.limit * beside(direction[:, None], step.limit)
    u = step.interface.apply(q)
    level = u - step.slip
    shift = numbers(xp.mean(level, axis=1))
    shift += (float(xp.max(beside(direction, level) @ level)) - direction @ shift) * direction
    along = beside(direction, level) @ step.slipped(u, shift)
    residual = step.residual(q, u, along * beside(direction[:, None], along))
    status = Status.CONVERGED if residual <= step.tolerance else Status.STAGNATED
    return Slipped(q, u, shift, residual, 1, status)
