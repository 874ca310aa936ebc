"""The search for the range of loads that a grid resolves.

A pilot search on at most 128 x 128 blocks of cells, each as high as its highest cell, finds roughly where the range
begins; then a few loads on the full grid go through the range.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Literal

import numpy as np

from roughcontact.arrays import is_numpy, on_host
from roughcontact.contact.continuation import follow
from roughcontact.contact.problem import Body, ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import cell_stiffness, full_contact_stiffness
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.progress.events import task
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Control, Force
from roughcontact.solver.nested_iteration import block_minimum, coarse_operator_on
from roughcontact.solver.projection import bearing_force
from roughcontact.statistics.fit_window import CELLS, DECADE, FULL_CONTACT_SHARE
from roughcontact.surface.preparation.polynomial import polynomial_trend
from roughcontact.validation import Array

__all__ = [
    "ON_ONE_FEATURE",
    "SEARCHED",
    "SPOT_CELLS",
    "STEPS_PER_DECADE",
    "LoadSearch",
    "SearchedLoad",
    "SurfaceKind",
    "find_range",
    "pilot_of",
]

SPOT_CELLS = 16  # cells of the mean spot, weighted by force: twenty separate cells resolve nothing
AREA_SHARE = 0.5  # of the nominal area in contact: beyond, the interface of a flat map is nearly closed
STRAINED = 0.5  # of the reduced modulus: mean pressure in contact beyond which strains are not small
ON_ONE_FEATURE = 0.5  # of the force on the largest spot when the contact is as stiff as twenty cells
PILOT_CELLS = 128  # per side of the pilot
STEPS_PER_DECADE = 4  # of force, in the search
SEARCHED = (1e-7, 1e4)  # of E* h L: range of forces of the search


class SurfaceKind(Enum):
    """The kind of a map: its upper limits depend on it."""

    PERIODIC = "periodic"
    FLAT = "nominally flat"
    FORM = "with form"
    PROFILE = "profile"

    @classmethod
    def of(cls, surface: Body) -> SurfaceKind:
        """Return the kind of a surface.

        A map is nominally flat if its least-squares quadratic form, without its plane, has a smaller rms height than
        the heights without both. Radial profiles, and maps that are periodic along one axis only, are with form.
        """
        grid = surface.grid
        if all(grid.periodic):
            return cls.PERIODIC
        if not isinstance(grid, Grid):
            return cls.FORM
        if grid.ndim == 1:
            return cls.PROFILE
        heights = on_host(surface.heights)
        plane, form = (polynomial_trend(heights, degree) for degree in (1, 2))
        return cls.FLAT if np.std(form - plane) < np.nanstd(heights - form) else cls.FORM


@dataclass(frozen=True, slots=True)
class SearchedLoad:
    """One load of the search. Its levels are 1 at a limit, and larger beyond it.

    Attributes
    ----------
    force, stiffness, area : float
        [N], [N/m], [m^2].
    share : float
        Part of the force on the largest spot.
    stiff : float
        Level of the stiffness: 1 at the stiffness of twenty cells.
    resolved : float
        The lower of `stiff` and of the level of the mean spot, weighted by force, which is 1 at sixteen cells.
    ended : float
        The highest level of the upper limits; for contact at the border it is either zero or infinity.
    reason : str
        The limit that ends the range here; empty if the range goes on.
    """

    force: float
    stiffness: float
    area: float
    share: float
    stiff: float
    resolved: float
    ended: float
    reason: str

    @classmethod
    def of(cls, solution: Solution, kind: SurfaceKind, lighter: Iterable[SearchedLoad]) -> SearchedLoad:
        """Return the levels of a solution, after the lighter loads of the search."""
        problem = solution.problem
        share, cells = _largest_spot(solution)
        stiffness = solution.flattened.stiffness  # cells that flow are in contact too
        stiff = stiffness / (CELLS * cell_stiffness(problem.operator))
        spots = cells / SPOT_CELLS if problem.geometry is Geometry.SURFACE else math.inf
        shares = [load.share for load in lighter if load.stiff >= 1] + ([share] if stiff >= 1 else [])
        on_one_feature = bool(shares) and min(shares) > ON_ONE_FEATURE
        ends = list(_ends(solution, kind, on_one_feature=on_one_feature))
        reason = next((words for level, words in ends if level >= 1), "")
        ended = max(level for level, _ in ends)
        area = solution.contact_area
        return cls(solution.force, stiffness, area, share, stiff, min(stiff, spots), ended, reason)


@dataclass(frozen=True, slots=True, eq=False)
class LoadSearch:
    """A few rising loads; the last is the first one beyond the range, if the range ends."""

    problem: ContactProblem
    kind: SurfaceKind
    loads: tuple[SearchedLoad, ...]

    @property
    def reason(self) -> str:
        """The limit that ends the range; empty if the search ends first."""
        return self.loads[-1].reason

    @property
    def lowest(self) -> float:
        """The force [N] at which the range begins; the last force of the search if it does not begin.

        It begins with spots of sixteen cells, or, if that leaves less than a decade, at the stiffness of twenty cells.
        """
        return self.spots_from if self.highest >= DECADE * self.spots_from else self._least("stiff")

    @property
    def spots_from(self) -> float:
        """The smallest force [N] with spots of sixteen cells in a contact as stiff as twenty; or the last force."""
        return self._least("resolved")

    @property
    def start(self) -> str:
        """The limit at which the range begins."""
        if self.loads[-1].stiff < 1:
            return f"{CELLS} cells, which no load reaches before the range ends"
        if self.lowest == self.loads[0].force:
            return "the smallest force of the search"
        return f"{CELLS} cells" if self.lowest <= self._least("stiff") else f"spots of {SPOT_CELLS} cells"

    def _least(self, what: Literal["stiff", "resolved"]) -> float:
        return next((load.force for load in self.loads if getattr(load, what) >= 1), self.loads[-1].force)

    @property
    def highest(self) -> float:
        """The last force within the range."""
        return self.loads[-2 if self.reason and len(self.loads) > 1 else -1].force

    @property
    def single_feature(self) -> bool:
        """Whether the largest spot carries more than half of the force when the contact is as stiff as twenty cells."""
        return next((load.share > ON_ONE_FEATURE for load in self.loads if load.stiff >= 1), False)

    @property
    def shared_from(self) -> float | None:
        """The force [N] from which the largest spot carries less than half, if it lies in the range."""
        light = (load.force for load in self.loads if load.stiff >= 1 and load.share < ON_ONE_FEATURE)
        return next(light, None)

    def column(self, name: Literal["force", "stiffness", "area"]) -> Array:
        """Return one quantity of all loads."""
        return np.array([getattr(load, name) for load in self.loads])


def search_upwards(
    problem: ContactProblem, kind: SurfaceKind, start: float, most: float, above: LoadSearch | None = None
) -> LoadSearch:
    """Press by ever larger forces until the range ends, or until the loads of an earlier search continue."""
    steps = round(STEPS_PER_DECADE * math.log10(most / start)) + (above is None)
    controls: list[Control] = [Force(start * 10 ** (k / STEPS_PER_DECADE)) for k in range(steps)]
    loads: list[SearchedLoad] = []
    with task("Searching upwards", unit="loads") as search:
        for solution in follow(problem, controls, ActiveSet()):
            loads.append(SearchedLoad.of(solution, kind, loads))
            if search is not None:
                search.advance()
            if loads[-1].reason:
                return LoadSearch(problem, kind, tuple(loads))
    return LoadSearch(problem, kind, (*loads, *(above.loads if above else ())))


def _largest_spot(solution: Solution) -> tuple[float, float]:
    """Return the part of the force on the largest spot, and the cells of the mean one, weighted by force."""
    if not solution.problem.measure.on_host:
        return 0.0, math.inf
    spots = solution.spots
    cells = float(spots.loads @ spots.areas) / (
        solution.force * float(np.ravel(solution.problem.operator.weights)[0])
    )
    return float(spots.loads.max()) / solution.force, cells


def _force_carried(solution: Solution) -> float:
    """Return the force [N] at which half of the map would carry the hardness of the contact."""
    problem, measure = solution.problem, solution.problem.measure
    hardness = bearing_force(measure, solution.contact, problem.spec)
    return AREA_SHARE * measure.total(problem.measured) * hardness / solution.contact_area


def _ends(solution: Solution, kind: SurfaceKind, *, on_one_feature: bool) -> Iterator[tuple[float, str]]:
    """Yield the upper limits of a range, each with its level at a load; a level of 1 or more ends the range."""
    problem = solution.problem
    full = FULL_CONTACT_SHARE * full_contact_stiffness(problem)
    yield solution.flattened.stiffness / full, f"{FULL_CONTACT_SHARE:g} of the full-contact stiffness"
    if kind in (SurfaceKind.PERIODIC, SurfaceKind.FLAT):
        yield solution.contact_fraction / AREA_SHARE, "half of the area in contact"
    if kind is SurfaceKind.FORM:
        yield math.inf if solution.touches_edge else 0.0, "contact at the border of the map"
    if problem.plastic:
        yield (
            solution.force / _force_carried(solution),
            f"{AREA_SHARE:g} of the force that the hardness can carry",
        )
    elif problem.geometry is not Geometry.FOUNDATION and not on_one_feature:
        pressure = solution.force / solution.contact_area
        yield (
            pressure / (STRAINED * problem.modulus),
            "a mean pressure in contact of half the reduced modulus",
        )


def find_range(problem: ContactProblem, kind: SurfaceKind, scale: float) -> LoadSearch:
    """Return rising loads beyond both ends of the range, within the searched multiples of `scale` [N]."""
    start, most = (part * scale for part in SEARCHED)
    pilot = pilot_of(problem)
    if (
        pilot is not None
    ):  # from a tenth of the force at which so rough a map reaches the stiffness of twenty cells
        few, rough = CELLS * cell_stiffness(problem.operator), search_upwards(pilot, kind, start, most)
        stiff = (load.force for load in rough.loads if load.stiffness >= few)
        start = max(start, next(stiff, rough.highest) / 10)
    search = search_upwards(problem, kind, start, most)
    while search.loads[0].stiff >= 1 and start > SEARCHED[0] * scale:  # the pilot began too late
        search, start = search_upwards(problem, kind, start / 10, start, search), start / 10
    return search


def pilot_of(problem: ContactProblem) -> ContactProblem | None:
    """Return the problem on blocks of cells, each as high as its highest cell; None if the map is small."""
    shape = problem.separation.shape
    factors = tuple(-(-n // PILOT_CELLS) for n in shape)
    if max(factors) == 1 or not is_numpy(problem.separation):
        return None
    coarse = coarse_operator_on(problem.operator, shape, factors)
    if coarse is None:
        return None
    blocks = block_minimum(problem.separation, factors)
    return ContactProblem(
        blocks,
        coarse,
        problem.control,
        problem.tolerance,
        modulus=problem.modulus,
        hardness=problem.spec.largest_hardness,
        size_law=problem.size_law,
    )
