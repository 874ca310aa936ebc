r"""Limits of the models of adhesion: the contact of the highest summit relative to its radius, and notes.

For a sphere of radius R (Proc. R. Soc. A 324, 301 (1971); Maugis, J. Colloid Interface Sci. 150, 243 (1992)) and a
cylinder (Barquins, J. Adhes. 26, 1 (1988)), where a is the radius or half width of the contact,

    F = 4 E* a^3/(3 R) - (8 pi E* w a^3)^(1/2)        F' = pi E* a^2/(4 R) - (2 pi E* w a)^(1/2)

Without load ``a0^3 = 9 pi w R^2/(2 E*)``, and ``32 w R^2/(pi E*)``. Under the largest tension a is a0/4^(1/3), and
a0/16^(1/3). The first terms are Hertz's force. On the latter contact Hertz's force equals the largest tension of a
sphere, 3/2 pi w R, and a third of that of a cylinder: a smaller preload leaves a contact smaller than that at the
pull-off.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.lowest_force import FORCE_TOLERANCE
from roughcontact.grid import RadialGrid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, geometry_of
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import Note, Rank
from roughcontact.solver.control import Status
from roughcontact.surface.generation.about_centre import RIM, squared
from roughcontact.validation import Array

__all__ = [
    *("SHALLOW", "SHORT_RANGE", "HighestSummit", "highest_summit"),
    *("notes_on_loads", "notes_on_model", "notes_on_range", "notes_on_status"),
]

# Part of the radius up to which a contact is small. At half the radius the force on a sphere (Sneddon, Int. J. Eng.
# Sci. 3, 47 (1965)) exceeds Hertz's force on a paraboloid by 2/5 (a/R)^2, a tenth.
SHALLOW = 0.5
NARROWEST = 2  # cells: the smallest distance for the fit of a curvature
# Part of the radius over which a paraboloid is fitted. The radius of a sphere by least squares is too small by SPHERE.
FITTED = 0.75
SPHERE = 0.16
# Tabor's number below which the pull-off force of a sphere by Maugis' equations (`theory.maugis`) exceeds that of
# Johnson, Kendall and Roberts by more than a tenth: lambda is 0.725 there, and 1.127 times Tabor's number.
SHORT_RANGE = 0.64


@dataclass(frozen=True, slots=True)
class HighestSummit:
    """The highest summit as an adhesive sphere, or on a line as a cylinder.

    Attributes
    ----------
    radius : float
        Radius R [m]; infinite if the body is flat.
    modulus, work : float
        Reduced modulus E* [Pa], and work of adhesion w [J/m^2].
    line : bool
        Whether it is a cylinder.
    """

    radius: float
    modulus: float
    work: float
    line: bool

    @property
    def unloaded_radius(self) -> float:
        """Radius or half width of the contact without load [m]."""
        factor = 32 / math.pi if self.line else 4.5 * math.pi
        return math.cbrt(factor * self.work * self.radius**2 / self.modulus)

    @property
    def shallow(self) -> bool:
        """Whether the contact without load is small relative to the radius."""
        return math.isinf(self.radius) or self.unloaded_radius <= SHALLOW * self.radius

    @property
    def least_preload(self) -> float:
        """Hertz's force on the contact under the largest tension [N]; [N/m] for a cylinder."""
        if not self.line:
            return 1.5 * math.pi * self.work * self.radius
        narrow = self.unloaded_radius / math.cbrt(16)
        return math.pi * self.modulus * narrow**2 / (4 * self.radius)


def highest_summit(
    operator: Operator, separation: Array, modulus: float, work: float | Array
) -> HighestSummit:
    """Return the highest summit, with the radius of the body over the contact without load.

    The radius is that of the least-squares paraboloid within a distance of the highest cell. This is the smallest
    distance that contains the contact for this radius, if the contact is small relative to the radius; roughness that
    is much smaller than the contact therefore has no effect. If there is no such distance, the largest one below three
    quarters of the radius is used.

    Parameters
    ----------
    operator : Operator
        The body.
    separation : array, shape of the grid
        Undeformed gap at first touch [m]; infinite where nothing was measured.
    modulus : float
        Reduced modulus E* [Pa].
    work : float or array
        Work of adhesion [J/m^2], of which the largest value is used.
    """
    grid, most = operator.grid, float(np.max(work))
    line = geometry_of(operator) is Geometry.LINE
    top = np.unravel_index(int(np.argmin(separation)), separation.shape)
    if isinstance(grid, RadialGrid):
        width = float(np.diff(grid.edges).max())
        distances = (grid.radii - (grid.radii[top] if top[0] else 0.0)) ** 2
    else:
        width = max(grid.spacing)
        distances = squared(grid, [(k + 0.5) * step for k, step in zip(top, grid.spacing, strict=True)])
    there = np.isfinite(separation)
    farthest = float(distances[there].max())
    found = HighestSummit(math.inf, modulus, most, line)
    reach = NARROWEST * width
    while True:
        near = there & (distances <= reach**2 * (1 + RIM))
        summit = HighestSummit(_radius(distances[near], separation[near]), modulus, most, line)
        if math.isinf(found.radius) or reach <= FITTED * summit.radius:
            found = summit
        if reach**2 >= farthest or (summit.shallow and summit.unloaded_radius <= reach):
            return found
        reach *= math.sqrt(2)


def notes_on_model(summit: HighestSummit, unresolved: bool = False) -> Iterator[Note]:
    """Yield notes if the grid or linear elasticity does not describe these bodies."""
    if unresolved:
        yield Note(
            Rank.WRONG,
            "Unresolved: the attraction varies from cell to cell beside a contact, so that the grid traps every state; "
            "jumps and pull-off force depend on the grid, not on the body.",
        )
    if not summit.shallow:
        a, r = summit.unloaded_radius, summit.radius
        yield Note(
            Rank.DOUBTFUL,
            "The contact is not small against the body: without load, the contact of Johnson, Kendall and Roberts has "
            f"a radius of {written(a, 'm')}, {a / r:.2g} times the radius of the highest summit, {written(r, 'm')} "
            f"(w/(E* R) is {summit.work / (summit.modulus * r):.2g}). Linear elasticity of half-spaces holds up to "
            f"{SHALLOW:g} times that radius: take these numbers as orders of magnitude. The radius is that of a "
            f"paraboloid, fitted to the heights within {FITTED:g} times it (at least two cells) of the highest point: "
            f"for a sphere it is up to {100 * SPHERE:.0f} % too small, and roughness changes it.",
        )


def notes_on_status(status: Sequence[Status], residual: Sequence[float] | Array) -> Iterator[Note]:
    """Yield a note on the loads of a path that missed the tolerance; for a single load, with the remedy."""
    missed = [k for k, each in enumerate(status) if not each.converged]
    if missed and len(status) == 1:
        yield Note(Rank.WRONG, f"Residual {residual[0]:.1e}: {status[0].message}")
    elif missed:
        text = f"{len(missed)} of {len(status)} loads missed the tolerance: see their residual."
        yield Note(Rank.WRONG, text)


def notes_on_loads(
    *, lowest: float, first: float, last: float, unit: str, control: Literal["depth", "force"]
) -> Iterator[Note]:
    """Yield a note if the lowest force of a retreat is that of its first or last load: it is not a pull-off force.

    Equal forces differ by rounding, because they are computed in different orders.
    """
    force = f"its lowest force, {written(lowest, unit)} (tension is negative)"
    if lowest >= last - FORCE_TOLERANCE * abs(last):
        yield Note(
            Rank.WRONG,
            f"The retreat ends at {force}, with the surfaces still together: that is not their pull-off force. "
            f"Continue to lower {control}s until they are apart.",
        )
    elif lowest >= first - FORCE_TOLERANCE * abs(first):
        yield Note(
            Rank.WRONG,
            f"The retreat begins at {force}, so that this force depends on where it begins: it is not the pull-off "
            "force. Bring the surfaces closer before the retreat.",
        )


def notes_on_range(summit: HighestSummit, adhesion: Adhesion) -> Iterator[Note]:
    """Yield a note if a pull-off force depends on the range of the attraction."""
    number = adhesion.tabor(summit.radius, summit.modulus)
    if not summit.line and number < SHORT_RANGE:
        yield Note(
            Rank.LIMITED,
            f"The pull-off force depends on the range of {written(adhesion.range, 'm')}: Tabor's number of the highest "
            f"summit is {number:.2g}, and below {SHORT_RANGE:g} a sphere's pull-off force exceeds the limit of a "
            "vanishing range by more than a tenth. State the range with the force.",
        )


def _radius(distances: Array, gaps: Array) -> float:
    """Return the radius of the least-squares paraboloid through gaps at squared distances [m^2] from its apex."""
    spread = distances - distances.mean()
    curvature = 2 * float((spread * gaps).sum()) / max(float((spread**2).sum()), math.ulp(0.0))
    return 1 / curvature if curvature > 0 else math.inf
