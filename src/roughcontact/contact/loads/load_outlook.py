"""The number of given loads that the grid resolves, estimated before they are computed."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from roughcontact.contact.loads.load_search import pilot_of
from roughcontact.contact.press import grid_of, make_problem, solve
from roughcontact.contact.problem import Body, ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.materials import Modulus
from roughcontact.progress.events import task
from roughcontact.solver.control import Control
from roughcontact.solver.loads import Loads

__all__ = ["LoadOutlook", "load_outlook"]


@dataclass(frozen=True, slots=True)
class LoadOutlook:
    """The number of loads that the grid resolves.

    Attributes
    ----------
    count : int
        Number of loads.
    below : int
        Number of loads so small that the stiffness depends on the cells.
    above : int
        Number of loads so near full contact that the stiffness depends on the size of the map.
    """

    count: int
    below: int
    above: int

    @property
    def resolved(self) -> int:
        """Number of loads in between."""
        return self.count - self.below - self.above


def load_outlook(
    surface: Body,
    modulus: Modulus,
    loads: Loads,
    operator: Operator | None = None,
) -> LoadOutlook:
    """Return the number of loads of a curve that will be resolved, from the solutions of a few of them.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m].
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    loads : Loads
        Strictly increasing forces or nominal pressures.
    operator : Operator, optional
        A body other than the half-space on the surface's grid.

    Returns
    -------
    LoadOutlook
        For elastic bodies, by the limits of `Curve.resolved`.

    Raises
    ------
    ValueError
        If the input makes no sense.

    Notes
    -----
    The stiffness rises with the load, so that bisection of the list finds both limits. A map of more than 128 cells per
    side is pressed on blocks of cells first: if a load is resolved on blocks, it is resolved on cells. Only if it is
    not, the map itself is pressed, by a load under which little of it is in contact. The distance to full contact
    follows from the blocks.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.contact.loads.load_outlook import load_outlook
    >>> from roughcontact.solver.loads import Loads
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> load_outlook(ball, 1e9, Loads("force", [1e-6, 1e-5, 1e-2]))
    LoadOutlook(count=3, below=2, above=0)
    """
    controls = loads.controls(grid_of(surface))
    problem = make_problem(surface, modulus, controls[0], operator, tolerance=1e-8)
    pilot = pilot_of(problem)
    rough = problem if pilot is None else pilot

    def resolved_from_below(control: Control) -> bool:
        if _pressed(rough, control).resolved_from_below:
            return True
        return pilot is not None and _pressed(problem, control).resolved_from_below

    with task("Finding which of these loads the grid resolves"):
        below = _first(resolved_from_below, controls)
        near_full = _first(lambda control: _nearly_full(_pressed(rough, control)), controls[below:])
    return LoadOutlook(len(controls), below, len(controls) - below - near_full)


def _first(reached: Callable[[Control], bool], controls: Sequence[Control]) -> int:
    """Return the number of loads before the first one that reaches a limit; all loads after it reach it."""
    if not controls or not reached(controls[-1]):
        return len(controls)
    return bisect_left(controls, True, key=reached)


def _pressed(problem: ContactProblem, control: Control) -> Solution:
    return solve(problem.under(control))


def _nearly_full(solution: Solution) -> bool:
    """Return whether the contact is beyond the upper limit of resolved loads."""
    return solution.resolved_from_below and not solution.resolved
