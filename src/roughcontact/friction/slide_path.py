"""A sequence of tangential loads, forth and back, each from where the one before has left the contact."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt

from roughcontact.contact.solution import Solution
from roughcontact.friction.slide import advance
from roughcontact.friction.slip_problem import (
    Load,
    Pull,
    Shift,
    SlipProblem,
    load_of,
    make_problem,
)
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.halfspace.shear.shear_operator import ShearOperator
from roughcontact.material import Bodies
from roughcontact.validation import number, numeric

__all__ = ["Loads", "load_cycle", "slide_path"]

Array = npt.NDArray[np.float64]

Loads = Sequence[Load] | Array
"""Loads in the order of time: numbers along one direction, or pairs (x, y), one a row."""


@numeric
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
    """Yield the state at every load, in order: the contact remembers where it has slipped.

    Parameters
    ----------
    solution : Solution
        The pressed contact, of a surface of two axes, free or periodic.
    bodies : Solid or pair of Solids
        Those it was pressed with; a single one against a rigid body.
    friction : float
        Coefficient of friction mu.
    forces, displacements : array, shape (n,) or (n, 2)
        Exactly one: tangential forces [N] or displacements [m] in any order, up and down; see `load_cycle`.
    along : pair of floats, optional
        Direction (x, y) of the traction, see `slide`.
    operator : ShearOperator, optional
        Another body than the half-spaces on the grid, see `slide`.
    tolerance : float
        Largest residual.

    Yields
    ------
    TangentialSolution
        A load that missed its tolerance says so in its `status`.

    Raises
    ------
    ValueError
        If the input makes no sense, at once and not at the first load.

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
    if (forces is None) == (displacements is None):
        raise ValueError("give exactly one of forces and displacements")
    given = forces if forces is not None else displacements
    assert given is not None
    if not (hasattr(given, "__len__") and len(given)):
        raise ValueError(f"a path needs at least one load, in a row, not {given}")
    loads = [
        load_of(problem.along, force=value)
        if displacements is None
        else load_of(problem.along, displacement=value)
        for value in given
    ]
    for load in loads:
        problem.check(load)
    return _follow(problem, loads)


def _follow(problem: SlipProblem, loads: list[Pull | Shift]) -> Iterator[TangentialSolution]:
    state: TangentialSolution | None = None
    for load in loads:
        state = advance(problem, load, state)
        yield state


@numeric
def load_cycle(amplitude: Load, *, cycles: int = 1, steps: int = 8) -> Array:
    """Return loads from zero to an amplitude, and from there back and forth between it and its opposite.

    Parameters
    ----------
    amplitude : float or pair of floats
        Largest force [N] or displacement [m]: a number, or (x, y).
    cycles : int
        Number of full cycles; 0 ends at the amplitude.
    steps : int
        Number of equal steps from zero to the amplitude. From one turn to the next there are twice as many.

    Returns
    -------
    array, shape (n,) or (n, 2)
        ``n = steps * (1 + 4 * cycles)`` loads; zero, where it begins, is not among them.

    Raises
    ------
    ValueError
        If `steps` is not a whole number from 1 up, or `cycles` not one from 0 up.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.load_cycle(1.0, steps=2).tolist()
    [0.5, 1.0, 0.5, 0.0, -0.5, -1.0, -0.5, 0.0, 0.5, 1.0]
    """
    if int(steps) != steps or steps < 1 or int(cycles) != cycles or cycles < 0:
        raise ValueError(f"a cycle needs whole numbers, steps >= 1 and cycles >= 0, not {steps} and {cycles}")
    largest = np.asarray(number(amplitude, "amplitude"))
    if largest.shape not in ((), (2,)) or not np.isfinite(largest).all():
        raise ValueError(f"an amplitude is one finite number, or two (x, y), not {amplitude}")
    turned = np.arange(1 - steps, 4 * cycles * steps + 1) % (4 * steps)  # steps since the last upper turn
    part = np.abs(turned - 2 * steps) / steps - 1
    return np.multiply.outer(part, largest)
