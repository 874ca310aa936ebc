"""The load at which the open cells of a map cease to percolate: from there on nothing flows through the gap."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from roughcontact.cached import cached_property
from roughcontact.contact.continuation import follow
from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.press import grid_of, make_problem, solve
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.size_law import Hardness
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.fluid.constriction import Constriction
from roughcontact.fluid.gap_flow import GapFlow, gap_flow
from roughcontact.fluid.open_gap import Missing, checked_direction
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator
from roughcontact.materials import Modulus
from roughcontact.progress.events import task
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Depth, Force
from roughcontact.solver.projection import bearing_force
from roughcontact.surface.moments import surface_moments
from roughcontact.surface.surface import Surface
from roughcontact.theory.persson_theory.persson import pressure_for
from roughcontact.validation import numeric, require

__all__ = ["SealingLoad", "sealing_load"]

AREA = 0.45  # relative contact area of the first load of the search, by Persson's theory
FIRST, LARGEST = 1.2, 4.0  # ratio of the first two loads, squared until a path opens or closes; its limit


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class SealingLoad:
    """The last load with an open path, and the first without.

    Attributes
    ----------
    last_open, first_closed : GapFlow
        Through the gaps at both loads, with their contacts (``last_open.solution``).
    axis : int or None
        Axis along which the path leads; None on a periodic map for any direction.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> sealed = rc.sealing_load(surface, 1e9)
    >>> sealed.last_open.percolates, sealed.first_closed.percolates
    (True, False)
    """

    last_open: GapFlow
    first_closed: GapFlow
    axis: int | None

    @property
    def pressures(self) -> tuple[float, float]:
        """Nominal pressures of both loads [Pa]."""
        return self.last_open.solution.nominal_pressure, self.first_closed.solution.nominal_pressure

    @property
    def contact_fractions(self) -> tuple[float, float]:
        """Relative real contact areas A/A0 at both loads [1]."""
        return self.last_open.solution.contact_fraction, self.first_closed.solution.contact_fraction

    @cached_property
    def constriction(self) -> Constriction | None:
        """The critical constriction at the last open load; the flow is solved when it is first asked for."""
        flow = self.last_open
        if self.axis is None:
            return flow.constriction
        return flow.constriction_along(self.axis if flow.axis is None else 0)

    def __repr__(self) -> str:
        """Return the main numbers."""
        (low, high), (less, more) = self.pressures, self.contact_fractions
        return f"SealingLoad(pressure {low:.4g} to {high:.4g} Pa, A/A0 {less:.3f} to {more:.3f})"


@numeric(modulus="Pa", hardness="Pa")
def sealing_load(
    surface: Surface,
    modulus: Modulus,
    *,
    axis: int | None = None,
    missing: Missing = "closed",
    operator: Operator | None = None,
    hardness: Hardness | None = None,
    ratio: float = 0.01,
    tolerance: float = 1e-8,
) -> SealingLoad:
    """Return the load at which the open cells cease to percolate, between two computed loads.

    The flow itself is not computed. On a free map a path of open cells, joined by their faces, leads from side to side.
    On a periodic map it leads along `axis` if it meets itself again, displaced by a number of periods along this axis
    that is not zero; by periods along the other axis, too, on a diagonal channel.

    Parameters
    ----------
    surface : Surface
        Heights of a map [m].
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    axis : int, optional
        Axis of the path. On a map that is periodic along both axes, by default any direction.
    missing : {"closed", "open"}
        Whether a cell without a height is closed or wide open.
    operator : Operator, optional
        A body other than the half-space on the surface's grid, see `press`.
    hardness : float, array, function, Material or str, optional
        Pressure that no cell exceeds [Pa], see `press`.
    ratio : float
        Largest relative difference of both loads.
    tolerance : float
        Largest residual of each load.

    Returns
    -------
    SealingLoad

    Raises
    ------
    ValueError
        If the surface is not a map in NumPy's memory, no direction follows, or missing cells close or open the map at
        any load.
    ConvergenceError
        If a load missed its tolerance.

    Notes
    -----
    The first load is that of Persson's theory for A/A0 = 0.45. From there the loads go up or down until a path closes
    or opens; then their geometric means halve the interval.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> low, high = rc.sealing_load(surface, 1e9).pressures
    >>> f"{low / 1e6:.2f} to {high / 1e6:.2f} MPa"
    '8.44 to 8.49 MPa'
    """
    if not ratio > 0:
        raise about("ratio", f"must be positive, not {ratio}")
    if axis not in (None, 0, 1):
        raise about("the axis", f"must be 0 or 1, not {axis!r}")
    grid = grid_of(surface)
    problem = make_problem(surface, modulus, Depth(0.0), operator, tolerance=tolerance, hardness=hardness)
    along = None if grid.ndim == 2 and all(grid.periodic) else axis
    if problem.geometry is not Geometry.SURFACE:
        raise InputError("the load that seals is that of a map of heights", "press a Surface", "surface")
    if axis is None and not all(grid.periodic):
        raise InputError(
            "on a map that is not periodic the direction of the flow must be given",
            "give axis=0 or axis=1",
            "axis",
        )
    checked_direction(grid, along, None)
    search = _Search(problem, along, axis, missing)
    search.require_both_ends()
    with task("Finding the load that closes the gap", shape=grid.shape):
        low, high = search.between(ratio, _first_force(problem, surface))
    return SealingLoad(search.flow(low), search.flow(high), axis)


@dataclass(frozen=True, eq=False)
class _Search:
    """States of one map, and whether they are open."""

    problem: ContactProblem
    along: int | None
    axis: int | None
    missing: Missing

    def flow(self, solution: Solution) -> GapFlow:
        """Return the flow, of which nothing is computed yet."""
        return gap_flow(solution, axis=self.along, missing=self.missing)

    def leads(self, flow: GapFlow) -> bool:
        """Return whether an open path leads along the axis."""
        return flow.percolates if self.axis is None else flow.percolates_along(self.axis)

    def require_both_ends(self) -> None:
        """Raise an error if no load opens a path, or none closes it."""
        untouched = self.flow(solve(self.problem))
        if not self.leads(untouched):
            with_holes = self.problem.missing > 0
            raise InputError(
                "no open path leads through the gap, even at first touch",
                "fill the cells without a height, or use missing='open'"
                if with_holes
                else "use the other axis",
                "missing" if with_holes else "axis",
            )
        holes = (~self.problem.measured).astype(float)
        if self.missing == "open" and self.leads(replace(untouched, gap=holes)):
            raise InputError(
                "cells without a height leave a path open at any load",
                "fill them, or use missing='closed'",
                "missing",
            )

    def at(self, force: float, near: Solution | None) -> tuple[Solution, bool]:
        """Return the state at a force [N], predicted from another one, and whether it is open."""
        (state,) = follow(self.problem, [Force(force)], ActiveSet(), start=near)
        if not state.status.converged:
            raise ConvergenceError(state)
        return state, self.leads(self.flow(state))

    def between(self, ratio: float, first: float) -> tuple[Solution, Solution]:
        """Return the last open and the first closed state, within a ratio of their forces."""
        problem, most = self.problem, math.inf
        if problem.plastic:
            most = bearing_force(problem.measure, problem.measured, problem.spec)
        there, was_open = self.at(min(first, 0.5 * most), None)
        here, is_open, factor = there, was_open, FIRST
        while is_open == was_open and 1e-12 * first < there.force < 1e12 * first:
            here, beyond = there, there.force * factor if was_open else there.force / factor
            there, is_open = self.at(min(beyond, 0.5 * (here.force + most)), here)
            factor = min(factor**2, LARGEST)
        words = f"at {there.force:.3g} N a path is still {'open' if was_open else 'closed'}"
        require(is_open != was_open, words, "check the heights and their unit", place="surface")
        low, high = (here, there) if was_open else (there, here)
        while high.force > (1 + ratio) * low.force:
            middle, is_open = self.at(math.sqrt(low.force * high.force), low)
            low, high = (middle, high) if is_open else (low, middle)
        return low, high


def _first_force(problem: ContactProblem, surface: Surface) -> float:
    return float(pressure_for(AREA, problem.modulus, surface_moments(surface))) * problem.grid.area
