"""The current or heat through a contact, cell by cell and spot by spot, from the tangent of its stiffness."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from scipy.ndimage import find_objects

from roughcontact import methods
from roughcontact.cached import cached_property
from roughcontact.contact.solution import Solution
from roughcontact.contact.spots import Spots
from roughcontact.contact.stiffness import contact_stiffness
from roughcontact.errors import InputError
from roughcontact.evaluation.conduction import Conductors, conductance
from roughcontact.grid import Grid
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.build import half_space
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.engineering_units import written
from roughcontact.progress.events import tracked
from roughcontact.validation import Array, Mask, exactly_one, numeric, positive_scalar

__all__ = ["ContactFlux", "contact_flux"]


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class ContactFlux:
    """The electrical current or the heat through a contact, and the part of each spot; `contact_flux` returns it.

    Currents are in amperes, or in watts for heat, and resistances in ohms or K/W. Arrays of shape ``(n,)`` have a value
    for each spot, in the order of ``solution.spots``.

    The density rises without limit toward the edge of a spot, so that the largest density depends on the grid. The
    current of a spot converges as the grid is refined, and so does `largest`.

    Attributes
    ----------
    solution : Solution
        The contact that conducts; under a hardness, that of the flattened surface.
    conductors : Conductors
        The two bodies.
    drop : float
        Voltage [V] or temperature difference [K] across the contact.
    of : {"interface", "total"}
        The part over which `drop` lies, see `contact_flux`.
    conductance : float
        Current per drop [S], or heat per drop [W/K].

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> flux = rc.contact_flux(rc.press(surface, 1e11, force=0.1), resistivities=(1.7e-8, 1.7e-8), drop=1e-3)
    >>> flux
    ContactFlux(current 759 mA at 1 mV through 7 spots, at most 461 mA (60.7 %) through one)
    >>> flux.to_dataset()["current_density"].attrs["units"]
    'A m-2'
    >>> flux.to_dataframe()["spot_share"].round(3).tolist()
    [0.189, 0.023, 0.027, 0.024, 0.607, 0.086, 0.044]
    """

    solution: Solution
    conductors: Conductors
    drop: float
    of: str
    conductance: float

    @property
    def kind(self) -> Literal["electrical", "thermal"]:
        """Whether a current flows or heat."""
        return "thermal" if self.conductors.resistivities is None else "electrical"

    @property
    def spots(self) -> Spots:
        """The spots of the contact, with their areas, loads and labels."""
        return self.solution.spots

    @property
    def total(self) -> float:
        """Current [A] or heat [W] through the whole contact."""
        return self.conductance * self.drop

    @property
    def resistance(self) -> float:
        """Resistance of the whole contact [ohm] or [K/W]; infinite if a body is an insulator."""
        return 1 / self.conductance if self.conductance else math.inf

    @cached_property
    def density(self) -> Array:
        """Current density [A/m^2] or heat flux [W/m^2] of each cell, shape of the grid; 0 outside the contact."""
        sizes = self._cell_sizes
        return self.solution.frozen.tangent * (self.total / (float(sizes.sum()) or 1.0))

    @cached_property
    def shares(self) -> Array:
        """Part of the current or heat that flows through each spot, shape ``(n,)``; the sum is 1."""
        sizes = np.bincount(
            self.spots.labels.ravel(), self._cell_sizes.ravel(), minlength=self.spots.count + 1
        )[1:]
        return np.asarray(sizes / sizes.sum())

    @property
    def fluxes(self) -> Array:
        """Current [A] or heat [W] through each spot, shape ``(n,)``."""
        return self.shares * self.total

    @property
    def largest(self) -> float:
        """Largest current [A] or heat [W] through one spot."""
        return self.largest_share * self.total

    @property
    def largest_share(self) -> float:
        """Largest share of one spot."""
        return float(self.shares.max(initial=0.0))

    @property
    def resistances(self) -> Array:
        """Resistance of each spot among the other spots, drop over flux [ohm] or [K/W], shape ``(n,)``."""
        return self.resistance / self.shares

    @cached_property
    def resistances_alone(self) -> Array:
        """Resistance of each spot between two half-spaces that touch nowhere else [ohm] or [K/W], shape ``(n,)``.

        Each needs a solve on the cells of the spot. NaN for a spot that extends over a whole period.
        """
        return self._resistances(_stiffness_alone(self.solution))

    @property
    def resistances_holm(self) -> Array:
        """Holm's (rho1 + rho2)/(4a) with the radius a of the circle of equal area [ohm] or [K/W], shape ``(n,)``."""
        return self._resistances(2 * self.solution.problem.modulus * np.sqrt(self.spots.areas / np.pi))

    def _resistances(self, stiffness: Array) -> Array:
        """Return the resistances of contacts from their stiffnesses, which are in proportion."""
        known = self.conductors.of(np.ones(1), self.solution.problem.modulus)
        return np.asarray(known[f"{self.kind}_resistance"] / stiffness)

    @cached_property
    def _cell_sizes(self) -> Array:
        """Flux of each cell in arbitrary units."""
        return self.solution.problem.operator.weights * self.solution.frozen.tangent

    def __repr__(self) -> str:
        """Return the main numbers."""
        name, unit, cause = ("current", "A", "V") if self.kind == "electrical" else ("heat", "W", "K")
        count = self.spots.count
        return (
            f"ContactFlux({name} {written(self.total, unit)} at {written(self.drop, cause)} through {count} "
            f"spot{'s' if count != 1 else ''}, at most {written(self.largest, unit)} "
            f"({written(100 * self.largest_share, '%')}) through one)"
        )

    plot = methods.plot_flux
    to_csv = methods.csv_of
    to_dataframe = methods.flux_dataframe
    to_dataset = methods.flux_dataset


def _unit_of_drop(arguments: Mapping[str, Any]) -> str:
    """Return the unit of the drop: that of a voltage if resistivities are given."""
    return "K" if arguments.get("resistivities") is None else "V"


@numeric(resistivities="ohm*m", conductivities="W/m/K", drop=_unit_of_drop)
def contact_flux(
    solution: Solution,
    *,
    resistivities: tuple[float, float] | None = None,
    conductivities: tuple[float, float] | None = None,
    drop: float = 1.0,
    of: Literal["interface", "total"] = "total",
) -> ContactFlux:
    """Return the current or heat through a contact, cell by cell and spot by spot.

    The density is the pressure of the contact region displaced as a whole, times a constant (Barber 2003), exactly as
    the conductance is the stiffness times that constant. Current and heat cross only in the contact: films, gas and
    radiation are not included.

    Parameters
    ----------
    solution : Solution
        A contact of a surface or of rings between half-spaces. Under a hardness, plastic cells conduct like the others.
    resistivities : tuple of float, optional
        Electrical resistivity of both bodies [ohm m].
    conductivities : tuple of float, optional
        Thermal conductivity of both bodies [W/(m K)]; give these or the resistivities.
    drop : float
        Voltage [V] or temperature difference [K].
    of : {"interface", "total"}
        What `drop` lies across: two half-spaces that touch only here, far from the contact (`total`), or the
        interface without the spreading resistance of the patch, as in `conductance`. On a periodic map without
        missing cells both are the same. The shares of the spots do not depend on it.

    Returns
    -------
    ContactFlux
        The density of each cell, the flux, share and resistance of each spot.

    Raises
    ------
    ValueError
        If both or neither of resistivities and conductivities are given; if the drop is not positive; if the contact
        is that of a line, a Winkler foundation or a layer; if the whole of a periodic map is in contact; or if `of` is
        ``"total"`` for a map that is periodic along one axis, whose total depends on the size of the bodies.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> flux = rc.contact_flux(rc.press(ball, 1e9, force=5e-3), conductivities=(400.0, 50.0), drop=20.0)
    >>> f"{flux.total * 1e3:.1f} mW", f"{flux.resistances[0] / flux.resistances_holm[0]:.2f} of Holm's"
    ('25.3 mW', "1.02 of Holm's")
    """
    exactly_one(resistivities=resistivities, conductivities=conductivities)
    drop = positive_scalar(drop, "the drop [V or K]")
    solution = solution.on_host().flattened  # plastic cells conduct as well
    found = conductance(solution, resistivities=resistivities, conductivities=conductivities, of=of)
    if solution.problem.geometry is Geometry.FOUNDATION:
        raise InputError(
            "the flux through springs is not that of their stiffness", "press a map of heights", "solution"
        )
    total = float(next(value for name, value in found.items() if name.endswith("_conductance")))
    if math.isinf(solution.stiffness):
        raise InputError("the whole period is in contact: the interface has no resistance", "press less hard")
    return ContactFlux(solution, Conductors(resistivities, conductivities), drop, of, total)


def _stiffness_alone(solution: Solution) -> Array:
    """Return the stiffness of each spot on a free half-space [N/m]; NaN for a spot as long as a period."""
    problem, labels = solution.problem, solution.spots.labels
    grid, body = problem.grid, problem.operator
    periodic = grid.periodic
    if isinstance(grid, Grid) and any(periodic):
        body = half_space(Grid(grid.shape, grid.spacing), problem.modulus)
    found = np.full(solution.spots.count, np.nan)
    windows = find_objects(labels)
    for spot in tracked(range(len(windows)), "Resistance of each spot", "spots"):
        window = windows[spot]
        mask = _unwrapped(labels[window] == spot + 1, labels.shape, periodic)
        if mask is not None:
            part = body.restrict(window)
            found[spot] = contact_stiffness(mask, part.grid, problem.modulus, operator=part)
    return found


def _unwrapped(spot: Mask, whole: tuple[int, ...], periodic: tuple[bool, ...]) -> Mask | None:
    """Return a spot in one piece if it crosses the edge of a periodic map; None if no row or column is free of it."""
    for axis in range(spot.ndim):
        if periodic[axis] and spot.shape[axis] == whole[axis]:
            free = np.flatnonzero(~spot.any(axis=1 - axis))
            if not free.size:
                return None
            spot = np.roll(spot, -free[0], axis=axis)
    return spot
