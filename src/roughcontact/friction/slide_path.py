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
    solution, bodies, friction, along, operator, tolerance
        As for `slide`.
    forces, displacements : array, shape (n,) or (n, 2)
        Exactly one: tangential forces [N] or displacements [m] in any order, up and down; see `load_cycle`.

    Yields
    ------
    TangentialSolution
        A load that missed its tolerance says so in its `status`.

    Raises
    ------
    ValueError
        If the input makes no sense, at once and not at the first load.
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
    """
    if int(steps) != steps or steps < 1 or int(cycles) != cycles or cycles < 0:
        raise ValueError(f"a cycle needs whole numbers, steps >= 1 and cycles >= 0, not {steps} and {cycles}")
    largest = np.asarray(number(amplitude, "amplitude"))
    if largest.shape not in ((), (2,)) or not np.isfinite(largest).all():
        raise ValueError(f"an amplitude is one finite number, or two (x, y), not {amplitude}")
    turned = np.arange(1 - steps, 4 * cycles * steps + 1) % (4 * steps)  # steps since the last upper turn
    part = np.abs(turned - 2 * steps) / steps - 1
    return np.multiply.outer(part, largest)
