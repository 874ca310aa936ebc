"""Loads that suit a surface: the range of forces that the grid resolves, and the reasons for its ends."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from roughcontact.arrays import is_numpy, on_host
from roughcontact.contact.loads.load_ends import with_ends
from roughcontact.contact.loads.load_search import SEARCHED, SPOT_CELLS, LoadSearch, SurfaceKind, find_range
from roughcontact.contact.press import grid_of, make_problem
from roughcontact.contact.problem import Body
from roughcontact.contact.size_law import Hardness
from roughcontact.contact.stiffness import cell_stiffness, full_contact_stiffness
from roughcontact.errors import InputError
from roughcontact.halfspace.operators.geometry import Geometry, length_scale
from roughcontact.halfspace.operators.operator import Operator, geometry_of
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.labels.variables import unit_of
from roughcontact.materials import Modulus, as_modulus
from roughcontact.progress.events import task
from roughcontact.solver.control import Force
from roughcontact.statistics.fit_window import CELLS, DECADE, FULL_CONTACT_SHARE
from roughcontact.surface.preparation.spikes import find_spikes
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, whole

__all__ = ["LoadRange", "load_range"]

FORCES = 24
FORCES_BELOW = 4  # of these below the range, within a decade
DIGITS = 3  # of the forces: far fewer than the digits of the stiffness on which machines agree
STEEP = 0.6  # rms slope: asperities then bear about 0.4 of it times E*, half of what ends elasticity here
ON_LINES = (3e-2, 3.0)  # over E* h: on a line, no single summit carries all of the load


@dataclass(frozen=True, slots=True, eq=False)
class LoadRange:
    """The loads that suit a surface, and why.

    Attributes
    ----------
    kind : SurfaceKind
    single_feature : bool
        Whether the largest spot carries more than half of the force when the contact is as stiff as twenty cells.
    forces : array, shape (n,)
        Forces for a curve [N], increasing; those in the range are evenly spaced in the sum of ln k and ln A, each
        relative to its range.
    lowest, highest : float
        The range that the grid resolves [N]; on a line the suggested range [N/m]. If there is none, `highest` is not
        above `lowest`.
    reasons : tuple of str
        The limit that is reached at each of its two ends; or the end of the search, which goes from 1e-7 to 1e4 of E* h
        L.
    notes : tuple of str
        Limits of the range, in sentences, with a remedy if it is short.
    """

    kind: SurfaceKind
    single_feature: bool
    forces: Array
    lowest: float
    highest: float
    reasons: tuple[str, str]
    notes: tuple[str, ...]

    @property
    def below(self) -> int:
        """Number of forces below the range."""
        return int(np.count_nonzero(self.forces < self.lowest * (1 - 10.0 ** (1 - DIGITS))))


@numeric(modulus="Pa", hardness="Pa")
def load_range(
    surface: Body,
    modulus: Modulus,
    *,
    count: int = FORCES,
    operator: Operator | None = None,
    hardness: Hardness | None = None,
) -> LoadRange:
    """Return the loads that suit a surface; the surface is pressed by a few loads, first on larger cells.

    The range begins where the contact is as stiff as twenty cells and its mean spot, weighted by force, has sixteen
    cells. If that leaves less than a decade, only the first condition holds, and there is a note. The range ends with
    the first of: 0.9 of the full-contact stiffness; half of the area in contact (on nominally flat and periodic maps);
    contact at the border (on maps with form, whose body continues beyond it); a mean pressure in contact of half the
    reduced modulus or, under a hardness, half of the largest force that the map can carry. Both ends are solved for, to
    a hundredth of these limits, or of the force if a limit is passed in a jump. Under a hardness the stiffness here is
    that of unloading, because cells that flow are in contact too. For a line contact the range is 0.03 to 3 of E* h.

    Parameters
    ----------
    surface : Surface or RadialProfile
        Heights [m], see `press`.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    count : int
        Number of forces.
    operator : Operator, optional
        A body other than the half-space on the surface's grid.
    hardness : float, array, function, Material or str, optional
        Pressure that no cell exceeds [Pa].

    Returns
    -------
    LoadRange
        Forces are rounded to three digits, so that machines whose last digits differ almost always suggest the same
        forces.

    Raises
    ------
    ValueError
        If the surface is flat, so that its rms height h is no scale, or `count` is below 1.

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
        raise InputError("a flat surface has no scale of forces", "name the forces, depths or pressures")
    geometry = Geometry.of(grid) if operator is None else geometry_of(operator)
    length = 1.0 if geometry is Geometry.LINE else length_scale(geometry, grid.lengths)
    scale = as_modulus(modulus) * surface.rms * length
    kind = SurfaceKind.of(surface)
    if geometry is Geometry.LINE:
        low, high = (part * scale for part in ON_LINES)
        ends = (f"{ON_LINES[0]:g} E* h", f"{ON_LINES[1]:g} E* h")
        return LoadRange(kind, False, np.geomspace(low, high, count), low, high, ends, ())
    first = Force(SEARCHED[0] * scale)  # of the search; a body of low hardness may not carry much more
    problem = make_problem(surface, modulus, first, operator, tolerance=1e-8, hardness=hardness)
    with task("Finding the loads that suit the surface"):
        return _loads(with_ends(find_range(problem, kind, scale)), count, surface)


def _loads(search: LoadSearch, count: int, surface: Body) -> LoadRange:
    """Return the forces: some below the range, the others evenly spaced in ln k and ln A."""
    low, high = search.lowest, search.highest
    reasons = (search.start, search.reason or "the largest force of the search")
    if low < high:
        below = min(FORCES_BELOW, count // 6)
        less = np.geomspace(low / 10, low, below, endpoint=False)
        forces = np.concatenate([less, _even(search, low, high, count - below)])
    else:
        forces = np.geomspace(high / 100, high, count)
    forces = _distinct(forces, count)
    notes = in_order(_notes(search, forces, surface))
    return LoadRange(search.kind, search.single_feature, forces, low, high, reasons, notes)


def _even(search: LoadSearch, low: float, high: float, count: int) -> Array:
    """Return the forces of a range, evenly spaced in the sum of ln k and ln A, each relative to its range.

    Punches with flat ends change neither: their forces are evenly spaced in ln F.
    """
    force, ends = np.log(search.column("force")), np.log([low, high])
    rising = [np.log(np.maximum.accumulate(search.column(name))) for name in ("stiffness", "area")]
    changed = [each for each in rising if np.ptp(np.interp(ends, force, each)) > 10.0**-DIGITS] or [force]
    way = np.zeros(len(force))
    for each in changed:
        start, end = np.interp(ends, force, each)
        way += (each - start) / (end - start)
    return np.asarray(np.exp(np.interp(np.linspace(0, len(changed), count), way, force)))


def _distinct(forces: Array, count: int) -> Array:
    """Return `count` increasing forces of few digits: the widest intervals are halved until there are enough."""

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


def _notes(search: LoadSearch, forces: Array, surface: Body) -> Iterator[Note]:
    """Yield the notes on the range."""
    low, high, force_unit = search.lowest, search.highest, unit_of("force", search.problem.geometry)
    if search.single_feature:
        end = search.shared_from
        until = "over the whole range" if end is None else f"up to {written(end, force_unit)}"
        yield Note(
            Rank.DOUBTFUL,
            f"The map stands on one feature: the largest spot carries more than half of the force {until}. If it does "
            "not belong to the surface, mask it (masked, surface prepare --mask) or crop it away (cropped, --crop).",
        )
    if low < high and low < search.spots_from:
        where = (
            f"below {written(search.spots_from, force_unit)}"
            if search.spots_from <= high
            else "over the whole range"
        )
        yield Note(
            Rank.DOUBTFUL,
            f"Spots have fewer than {SPOT_CELLS} cells {where}: contact area and pressure are those of the grid there, "
            "the stiffness almost not. Take a finer map if you need area or pressure.",
        )
    if low < high and high >= DECADE * low:
        return
    few = CELLS * cell_stiffness(search.problem.operator)
    if few >= FULL_CONTACT_SHARE * full_contact_stiffness(search.problem):
        few_cells = f"the map has too few cells, {surface.grid.shape}; take a finer one"
        yield Note(Rank.WRONG, f"No load is resolved: {few_cells}.")
    elif not low < high:
        until = search.reason or "the search ends"
        yield Note(Rank.WRONG, f"No load is resolved before {until}: {_remedy(search, surface)}.")
    else:
        yield Note(
            Rank.LIMITED,
            f"The grid resolves forces over a factor of {high / low:.2g} only, less than a power law takes "
            f"(a decade): {_remedy(search, surface)}.",
        )


def _remedy(search: LoadSearch, surface: Body) -> str:
    """Return the remedy for a short range."""
    if isinstance(surface, Surface) and surface.grid.ndim == 2 and is_numpy(surface.heights):
        if (spikes := find_spikes(surface)).count:
            return f"{spikes} may carry the load; remove those that are faulty (despiked, --despike)"
        if (slope := _slope(surface)) > STEEP and "reduced modulus" in search.reason:
            return (
                f"with an rms slope of {slope:.2g} the surface is so steep that elasticity ends at first touch; give a "
                "hardness, or filter the short waves if they are noise"
            )
    return "take a finer map, or crop to the part in contact"


def _slope(surface: Surface) -> float:
    """Return the rms slope of the measured cells."""
    slopes = np.gradient(on_host(surface.heights), *surface.grid.spacing)
    return math.sqrt(sum(float(np.nanmean(slope**2)) for slope in slopes))
