"""The law of adhesion: attraction as a function of the gap."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np

from roughcontact.adhesion.dugdale_law import DugdaleLaw
from roughcontact.adhesion.exponential_law import ExponentialLaw
from roughcontact.errors import InputError, about
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Operator, geometry_of
from roughcontact.validation import Array, numeric, positive, positive_scalar, require_numbers, shown

if TYPE_CHECKING:
    from roughcontact.adhesion.elastic_form import ElasticForm

__all__ = ["LAWS", "Adhesion", "Attraction", "Law", "require_areas"]

REACH = 40.0  # ranges; at larger gaps an exponential attraction is below the rounding of its largest value

# The laws by name. Checks of names, choices of names and computations all read this table.
LAWS: dict[str, type[Attraction]] = {"exponential": ExponentialLaw, "dugdale": DugdaleLaw}

if TYPE_CHECKING:
    Law = str
else:
    Law = Literal[tuple(LAWS)]  # parameters of studies and commands are checked against it


@hinted
@dataclass(frozen=True, slots=True, eq=False)
class Adhesion:
    """Work of adhesion, and the decrease of the attraction with the gap.

    Parameters
    ----------
    work : float or array, shape of the grid
        Work of adhesion w [J/m^2]: the work to separate a unit area.
    range : float
        Length over which the attraction falls, or largest gap of the attraction [m].
    law : {"exponential", "dugdale"}
        Attraction ``(w/range) exp(-gap/range)``, or the constant w/range up to the gap `range`, with a hard wall at the
        gap zero. For a range that no grid resolves, see `detachment_path`.
    allow_unresolved : bool
        Whether to compute although the attraction varies from cell to cell beside a contact (`process_zone` below 1.5
        cells), which raises an error otherwise. Every state then depends on the grid, and is marked as unresolved.

    Raises
    ------
    ValueError
        If a number is not positive, or the law is unknown.

    Examples
    --------
    >>> import roughcontact as rc
    >>> adhesion = rc.Adhesion(work=50e-3, range=2e-9)
    >>> f"{adhesion.strength / 1e6:.0f} MPa"
    '25 MPa'
    >>> f"{adhesion.process_zone(1e9) * 1e9:.1f} nm"
    '25.5 nm'
    """

    work: float | Array
    range: float
    law: Law = "exponential"
    allow_unresolved: bool = False

    def __post_init__(self) -> None:
        require_numbers(self, work="J/m^2", range="m")
        work = positive(self.work, "work of adhesion [J/m^2]", zero=True)
        if not np.any(work > 0):
            raise about("the work", "of adhesion is zero everywhere", "leave the adhesion out")
        object.__setattr__(self, "work", float(work) if np.ndim(work) == 0 else np.array(work))
        object.__setattr__(self, "range", positive_scalar(self.range, "range of the attraction [m]"))
        if self.law not in tuple(LAWS):  # the value may be of any type, even without a hash
            names = ", ".join(map(repr, LAWS))
            raise about("the law", f"of adhesion must be one of {names}, not {shown(self.law)}")

    def __eq__(self, other: object) -> bool:
        """Whether both have the same attraction on every cell."""
        return isinstance(other, Adhesion) and self._parts() == other._parts()

    def __hash__(self) -> int:
        return hash(self._parts())

    def _parts(self) -> tuple[object, ...]:
        work = np.asarray(self.work)
        return work.shape, work.tobytes(), self.range, self.law, self.allow_unresolved

    @property
    def strength(self) -> float:
        """Largest attraction of the law [Pa]."""
        return float(np.max(self.work)) / self.range

    @numeric(modulus="Pa")
    def process_zone(self, modulus: float) -> float:
        """Return Irwin's length ``E* w/(pi s^2)`` [m], over which the attraction varies beside a contact.

        Parameters
        ----------
        modulus : float
            Reduced modulus E* [Pa].

        Returns
        -------
        float
            [m], for the largest attraction s.
        """
        return modulus * float(np.max(self.work)) / (math.pi * self.strength**2)

    @numeric(radius="m", modulus="Pa")
    def tabor(self, radius: float, modulus: float) -> float:
        """Return Tabor's number ``(R w^2/(E*^2 range^3))^(1/3)`` of a sphere.

        Parameters
        ----------
        radius : float
            Radius R [m].
        modulus : float
            Reduced modulus E* [Pa].

        Returns
        -------
        float
            Large values: Johnson, Kendall and Roberts; small values: Derjaguin, Muller and Toporov.

        Examples
        --------
        >>> import roughcontact as rc
        >>> adhesion = rc.Adhesion(work=50e-3, range=2e-9)
        >>> f"{adhesion.tabor(radius=1e-5, modulus=1e9):.2f}, on rubber {adhesion.tabor(radius=1e-5, modulus=1e6):.0f}"
        '1.46, on rubber 146'
        """
        w = float(np.max(self.work))
        return float(np.cbrt(radius * w**2 / (modulus**2 * self.range**3)))


class Attraction(Protocol):
    """A law on the cells of a computation: one of `LAWS`."""

    @classmethod
    def on_cells(
        cls, work: Array, length: float, strength: float, form: ElasticForm, separation: Array, modulus: float
    ) -> Attraction:
        """Return the law on the cells of a computation.

        Work [J/m^2] of each cell, range [m] and strength [Pa] of the adhesion; undeformed gap [m], E* [Pa].
        """

    @property
    def work(self) -> float | Array:
        """Work of adhesion [J/m^2]."""

    @property
    def range(self) -> float:
        """Length of the law [m]."""

    @property
    def strength(self) -> float:
        """Largest attraction [Pa]."""

    @property
    def steepest(self) -> float:
        """Largest curvature [Pa/m]."""

    @property
    def start_gap(self) -> float:
        """Gap [m] at which the approach under a prescribed force starts."""

    def on(self, cells: tuple[slice, ...]) -> Attraction:
        """Return the law on some of the cells."""

    def traction(self, gap: Array) -> Array:
        """Return the attraction [Pa], positive, at a gap [m]."""

    def curvature(self, gap: Array) -> Array:
        """Return the decrease of the attraction with the gap [Pa/m], positive."""

    def curvature_between(self, nearest: Array, farthest: Array) -> Array:
        """Return the largest curvature [Pa/m] of the gaps from `nearest` to `farthest`."""

    def energy(self, gap: Array) -> Array:
        """Return the energy per area [J/m^2], negative."""

    def energy_change(self, gap: Array, step: Array) -> Array:
        """Return the change of the energy per area [J/m^2] when the gap grows by `step`, without cancellation."""


def require_areas(body: Operator) -> None:
    """Raise an error for a foundation of springs, which has no areas.

    Raises
    ------
    ValueError
        If the body is a foundation.
    """
    if geometry_of(body) is Geometry.FOUNDATION:
        raise InputError(
            "springs carry forces per length, so a work of adhesion per area does not apply",
            "press a half-space, a line or rings; for bodies of revolution see mdr.adhesion",
        )
