"""Which loads suit a surface: what kind of map it is, between which forces the grid resolves it, and why it ends there.

A pilot on cells of at most 128 x 128 blocks, each as high as its highest cell, finds the range roughly; a path of few
loads on the full grid then brackets it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Literal

import numpy as np

from roughcontact.arrays import is_numpy, on_host
from roughcontact.contact.continuation import follow
from roughcontact.contact.curve import DECADE, length_scale
from roughcontact.contact.press import grid_of, make_problem
from roughcontact.contact.problem import Body, ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import cell_stiffness, full_contact_stiffness
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, geometry_of
from roughcontact.labels.variables import unit_of
from roughcontact.material import Solid, as_modulus
from roughcontact.solver.active_set import ActiveSet
from roughcontact.solver.control import Control, Force
from roughcontact.solver.nested_iteration import block_minimum, coarse_operator_on
from roughcontact.statistics.fit_window import CELLS, FULL_CONTACT_SHARE
from roughcontact.surface.polynomial import polynomial_trend
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, whole

__all__ = ["LoadRange", "SurfaceKind", "load_range", "suggested_forces"]

SPOT_CELLS = 16  # cells of the mean spot, weighted by force: twenty lone cells resolve nothing
AREA_SHARE = 0.5  # of the nominal area in contact: beyond, the interfaces of flat maps are nearly closed
STRAINED = 0.5  # of the reduced modulus: mean pressure in contact beyond which small strains are none
PLASTIC = 0.9  # of the hardness: mean pressure in contact at which nearly all of it is plastic
ON_ONE_FEATURE = 0.5  # of the force on the largest spot where the contact is as stiff as twenty cells
PILOT_CELLS = 128  # to a side of the pilot
STEPS_PER_DECADE = 4  # of force, in the search
SEARCHED = (1e-7, 1e4)  # of E* h L: forces that the search goes through
FORCES = 24
FORCES_BELOW = 4  # of these below the range, within a decade
DIGITS = 3  # of the forces: fewer than those in which machines agree on the stiffness by far
LEAST_RESOLVED = 10  # loads
ON_LINES = (3e-2, 3.0)  # over E* h: a line contact knows no summits that carry all


class SurfaceKind(Enum):
    """What a map is to a contact."""

    PERIODIC = "periodic"
    FLAT = "nominally flat"
    FORM = "with form"
    PROFILE = "profile"

    @classmethod
    def of(cls, surface: Body) -> SurfaceKind:
        """Return the kind of a surface.

        Nominally flat: the least-squares quadratic form, beyond its plane, has a smaller rms height than what is left
        without both. A radial profile, and one axis of a map that is periodic along the other, are with form.
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


@dataclass(frozen=True, slots=True, eq=False)
class LoadRange:
    """The loads that suit a surface, and why.

    Attributes
    ----------
    kind : SurfaceKind
    one_feature : bool
        Whether the largest spot carries more than half where the contact is as stiff as twenty cells.
    forces : array, shape (n,)
        Forces for a curve [N], increasing; half of those in the range are even in ln k, half in ln A.
    lowest, highest : float
        The range that the grid resolves [N]; on a line what is suggested [N/m]. Not above each other where there is
        none.
    reasons : tuple of str
        What sets its two ends.
    notes : tuple of str
        What a reader should know, in sentences: with the remedy where the range is short.
    """

    kind: SurfaceKind
    one_feature: bool
    forces: Array
    lowest: float
    highest: float
    reasons: tuple[str, str]
    notes: tuple[str, ...]

    @property
    def below(self) -> int:
        """How many forces lie below the range."""
        return int(np.count_nonzero(self.forces < self.lowest * (1 - 10.0 ** (1 - DIGITS))))


@numeric
def suggested_forces(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    count: int = FORCES,
    operator: Operator | None = None,
    hardness: float | None = None,
) -> Array:
    """Return forces over the range in which a rough surface is worth a curve.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    count : int
        Number of forces.
    operator : Operator, optional
        Another body than the half-space on the surface's grid; it says whether the contact is that of a line.
    hardness : float, optional
        Pressure that no cell exceeds [Pa].

    Returns
    -------
    array, shape (n,)
        Forces [N], on a line per unit length [N/m], increasing; see `load_range`.

    Raises
    ------
    ValueError
        If the surface is flat, so that its rms height h gives no scale, or `count` is below 1.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> forces = rc.suggested_forces(surface, 1e9)
    >>> len(forces), bool((np.diff(forces) > 0).all())
    (24, True)
    """
    return load_range(surface, modulus, count=count, operator=operator, hardness=hardness).forces


@numeric
def load_range(
    surface: Body,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    count: int = FORCES,
    operator: Operator | None = None,
    hardness: float | None = None,
) -> LoadRange:
    """Return the loads that suit a surface: it is pressed by a few, first on larger cells.

    From below the range begins where the contact is as stiff as twenty cells and its mean spot, weighted by force, has
    sixteen cells. It ends with the first of: 0.9 of the full-contact stiffness; on nominally flat and periodic maps
    half of the area in contact; on maps with form contact at the border, beyond which the body goes on; a mean pressure
    in contact of 0.9 of the hardness or, without one, of half the reduced modulus. On a line contact it is 0.03 to 3 of
    E* h.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    count : int
        Number of forces.
    operator : Operator, optional
        Another body than the half-space on the surface's grid.
    hardness : float, optional
        Pressure that no cell exceeds [Pa].

    Returns
    -------
    LoadRange
        Forces rounded to three digits, equal on all machines.

    Raises
    ------
    ValueError
        If the surface is flat, so that its rms height h gives no scale, or `count` is below 1.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), rolloff=16e-6)
    >>> loads = rc.load_range(surface, 1e9)
    >>> loads.kind.value, loads.below
    ('periodic', 4)
    """
    whole(count, "count, the number of forces,")
    grid = grid_of(surface)
    if not surface.rms > 0:
        raise ValueError("a flat surface gives forces no scale: name the forces, depths or pressures")
    geometry = Geometry.of(grid) if operator is None else geometry_of(operator)
    length = 1.0 if geometry is Geometry.LINE else length_scale(geometry, grid.lengths)
    scale = as_modulus(modulus) * surface.rms * length
    kind = SurfaceKind.of(surface)
    if geometry is Geometry.LINE:
        low, high = (part * scale for part in ON_LINES)
        return LoadRange(kind, False, np.geomspace(low, high, count), low, high, ("of E* h", "of E* h"), ())
    problem = make_problem(surface, modulus, Force(scale), operator, tolerance=1e-8, hardness=hardness)
    start, most = (part * scale for part in SEARCHED)
    pilot = _pilot(problem)
    if pilot is not None:  # from a tenth of the force at which so rough a map is as stiff as twenty cells
        few, rough = CELLS * cell_stiffness(problem.operator), _search(pilot, kind, start, most)
        stiff = (load.force for load in rough.loads if load.stiffness >= few)
        start = max(start, next(stiff, rough.highest) / 10)
    search = _search(problem, kind, start, most)
    while search.loads[0].resolved and start > SEARCHED[0] * scale:  # the pilot began too late
        search, start = _search(problem, kind, start / 10, start, search), start / 10
    return _loads(search, count, surface)


def _pilot(problem: ContactProblem) -> ContactProblem | None:
    """Return the problem on larger cells, as high as the highest of each block; None where the map is small."""
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
        hardness=problem.hardness,
    )


@dataclass(frozen=True, slots=True)
class _Load:
    """What one load of the search says: the part of the force on the largest spot, and whether it is resolved."""

    force: float
    stiffness: float
    area: float
    share: float
    stiff: bool  # as twenty cells
    resolved: bool


@dataclass(frozen=True, slots=True, eq=False)
class _Search:
    """What a few rising loads say; the last is the first beyond the range, whose end is `reason`."""

    problem: ContactProblem
    kind: SurfaceKind
    loads: tuple[_Load, ...]
    reason: str

    @property
    def lowest(self) -> float:
        """The least force that is resolved; without any the last."""
        return next((load.force for load in self.loads if load.resolved), self.loads[-1].force)

    @property
    def highest(self) -> float:
        """The last force of the range, before that of its end."""
        return self.loads[-2 if self.reason and len(self.loads) > 1 else -1].force

    @property
    def one_feature(self) -> bool:
        """Whether the largest spot carries more than half where the contact is as stiff as twenty cells."""
        return next((load.share > ON_ONE_FEATURE for load in self.loads if load.stiff), False)

    @property
    def released(self) -> float | None:
        """From where the largest spot carries less than half [N], if it does so in the range."""
        light = (load.force for load in self.loads if load.stiff and load.share < ON_ONE_FEATURE)
        return next(light, None)

    def column(self, name: Literal["force", "stiffness", "area"]) -> Array:
        """Return one quantity of all loads."""
        return np.array([getattr(load, name) for load in self.loads])


def _search(
    problem: ContactProblem, kind: SurfaceKind, start: float, most: float, above: _Search | None = None
) -> _Search:
    """Press by ever larger forces until the range ends, or the loads of an earlier search follow."""
    steps = round(STEPS_PER_DECADE * math.log10(most / start)) + (above is None)
    controls: list[Control] = [Force(start * 10 ** (k / STEPS_PER_DECADE)) for k in range(steps)]
    few, full = CELLS * cell_stiffness(problem.operator), full_contact_stiffness(problem)
    loads: list[_Load] = []
    for solution in follow(problem, controls, ActiveSet()):
        share, cells = _largest_spot(solution)
        stiff = solution.stiffness >= few
        resolved = stiff and (cells >= SPOT_CELLS or problem.geometry is not Geometry.SURFACE)
        area = solution.contact_area
        loads.append(_Load(solution.force, solution.stiffness, area, share, stiff, resolved))
        shares = [load.share for load in loads if load.stiff]
        on_one_feature = bool(shares) and min(shares) > ON_ONE_FEATURE
        reason = _end(solution, kind, full, on_one_feature=on_one_feature)
        if reason:
            return _Search(problem, kind, tuple(loads), reason)
    return _Search(problem, kind, (*loads, *(above.loads if above else ())), above.reason if above else "")


def _largest_spot(solution: Solution) -> tuple[float, float]:
    """Return the part of the force on the largest spot, and the cells of the mean one, weighted by force."""
    if not solution.problem.measure.on_host:
        return 0.0, math.inf
    spots = solution.spots
    cells = float(spots.loads @ spots.areas) / (
        solution.force * float(np.ravel(solution.problem.operator.weights)[0])
    )
    return float(spots.loads.max()) / solution.force, cells


def _end(solution: Solution, kind: SurfaceKind, full: float, *, on_one_feature: bool) -> str:
    """Return what ends the range at this load; nothing if it goes on."""
    problem = solution.problem
    if solution.stiffness >= FULL_CONTACT_SHARE * full:
        return f"{FULL_CONTACT_SHARE:g} of the full-contact stiffness"
    if kind in (SurfaceKind.PERIODIC, SurfaceKind.FLAT) and solution.contact_fraction >= AREA_SHARE:
        return "half of the area in contact"
    if kind is SurfaceKind.FORM and solution.touches_edge:
        return "contact at the border of the map"
    pressure = solution.force / solution.contact_area
    if problem.hardness < math.inf:
        return "" if pressure < PLASTIC * problem.hardness else "a mean pressure in contact near the hardness"
    strained = pressure > STRAINED * problem.modulus and problem.geometry is not Geometry.FOUNDATION
    return "a mean pressure in contact of half the reduced modulus" if strained and not on_one_feature else ""


def _loads(search: _Search, count: int, surface: Body) -> LoadRange:
    """Return the forces: some below the range, and half of the others even in ln k, half in ln A."""
    low, high = search.lowest, search.highest
    reasons = (
        f"{CELLS} cells and spots of {SPOT_CELLS} cells",
        search.reason or "the largest force of the search",
    )
    if low < high:
        below = min(FORCES_BELOW, count // 6)
        half = (count - below) // 2
        ends = np.linspace(0, 1, count - below - half)
        between = (np.arange(half) + 0.5) / max(1, half)
        forces = np.concatenate(
            [
                np.geomspace(low / 10, low, below, endpoint=False),
                _even(search, "stiffness", low, high, ends),
                _even(search, "area", low, high, between),
            ]
        )
    else:
        forces = np.geomspace(high / 100, high, count)
    forces = _distinct(forces, count)
    notes = tuple(_notes(search, forces, surface))
    return LoadRange(search.kind, search.one_feature, forces, low, high, reasons, notes)


def _even(
    search: _Search, name: Literal["stiffness", "area"], low: float, high: float, parts: Array
) -> Array:
    """Return the forces of a range at which the logarithm of a quantity is at some parts of its way."""
    force, rising = np.log(search.column("force")), np.log(np.maximum.accumulate(search.column(name)))
    ends = np.interp(np.log([low, high]), force, rising)
    return np.asarray(np.exp(np.interp(ends[0] + parts * (ends[1] - ends[0]), rising, force)))


def _distinct(forces: Array, count: int) -> Array:
    """Return forces of few digits, increasing, as many as are wanted: the widest gaps are halved."""

    def rounded(values: Array) -> Array:
        return np.unique(np.array([float(f"{value:.{DIGITS - 1}e}") for value in values]))

    forces = rounded(forces)
    while len(forces) < count:
        widest = int(np.argmax(np.diff(np.log(forces))))
        more = rounded(np.append(forces, math.sqrt(forces[widest] * forces[widest + 1])))
        if len(more) == len(forces):
            break
        forces = more
    return forces


def _notes(search: _Search, forces: Array, surface: Body) -> Iterator[str]:
    """Yield what a reader should know of the range."""
    low, high, force_unit = search.lowest, search.highest, unit_of("force", search.problem.geometry)
    if search.one_feature:
        until = (
            "over the whole range" if search.released is None else f"up to {search.released:.3g} {force_unit}"
        )
        yield (
            f"The map stands on one feature: the largest spot carries more than half of the force {until}. If it does "
            "not belong to the surface, crop it away or remove the form of the map."
        )
    resolved = int(np.count_nonzero((forces >= low) & (forces <= high)))
    if low < high and resolved >= LEAST_RESOLVED and high >= DECADE * low:
        return
    few = CELLS * cell_stiffness(search.problem.operator)
    if few >= FULL_CONTACT_SHARE * full_contact_stiffness(search.problem):
        yield f"No load is resolved: the map has too few cells, {surface.grid.shape}; take a finer one."
    elif not low < high and "reduced modulus" in search.reason and isinstance(surface, Surface):
        yield (
            f"No load is resolved: with an rms slope of {_slope(surface):.2g} the surface is so steep that elasticity "
            "ends at first touch; give a hardness, or filter the short waves if they are noise."
        )
    elif not low < high:
        yield "No load is resolved: take a finer map, or crop to the part in contact and remove outliers."
    else:
        yield (
            f"The grid resolves forces over a factor of {high / low:.2g} only, less than a power law takes "
            "(a decade): take a finer map, or crop to the part in contact and remove outliers."
        )


def _slope(surface: Surface) -> float:
    """Return the rms slope of the measured cells."""
    slopes = np.gradient(on_host(surface.heights), *surface.grid.spacing)
    return math.sqrt(sum(float(np.nanmean(slope**2)) for slope in slopes))
