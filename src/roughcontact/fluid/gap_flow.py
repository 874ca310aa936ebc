"""Flow of a fluid through the gap of a contact, by Reynolds' equation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from roughcontact import methods
from roughcontact.arrays import is_numpy
from roughcontact.cached import cached_property
from roughcontact.contact.problem import ContactProblem
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.fluid.constriction import Constriction, constriction_of
from roughcontact.fluid.interval import bilinear_bound, flux_bound
from roughcontact.fluid.network import Indices, Network, faces_of, joined_network, winding_network
from roughcontact.fluid.solve import NetworkFlow, solve
from roughcontact.grid import Grid
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.note import in_order
from roughcontact.solver.control import checked_tolerance
from roughcontact.validation import Array, Mask, numeric

__all__ = ["GapFlow", "gap_flow", "require_flow"]

Missing: TypeAlias = Literal["closed", "open"]
TOLERANCE = 1e-6  # largest relative difference of the two bounds
OPEN = 1e4  # a missing cell that is open conducts this many times as well as the widest gap


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class GapFlow:
    """Flow through a gap, for any viscosity and drop: ``q = -transmissivity/(12 viscosity) grad p`` on average.

    Attributes
    ----------
    solution : Solution
        The contact.
    gap : array, shape of the grid
        Gap that the fluid passes [m]; zero in contact and where missing cells are closed.
    axis : int or None
        Axis from side to side; None for a map that is periodic along both axes, or between two regions.
    slip_length : float
        Slip length at both walls [m].
    tolerance : float
        Largest relative difference of the two bounds.
    between : tuple of two bool arrays, optional
        Regions at the higher and at the lower pressure.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> flow = rc.gap_flow(rc.press(surface, 1e9, pressure=2e6))
    >>> flow.percolates, [f"{value:.3g}" for value in flow.eigenvalues]
    (True, ['2.19e-22', '1.48e-22'])
    """

    solution: Solution
    gap: Array
    axis: int | None
    slip_length: float
    tolerance: float
    between: tuple[Mask, Mask] | None = None

    @property
    def percolates(self) -> bool:
        """Whether an open path leads through the gap."""
        return self._network is not None

    @cached_property
    def windings(self) -> Indices:
        """Independent vectors along which the open cells of a periodic map percolate [periods], shape (rank, 2)."""
        return self._network_and_windings[1]

    @property
    def transmissivity(self) -> Array:
        """Cubed hydraulic gap [m^3]: a tensor, shape (2, 2), or one number from side to side, shape (1, 1)."""
        return self._flow.upper * self._unit if self._flow is not None else np.zeros((self._rank,) * 2)

    @property
    def lower_transmissivity(self) -> Array:
        """The lower bound of `transmissivity` [m^3], by a flow without sources; `transmissivity` is the upper one."""
        return self._flow.lower * self._unit if self._flow is not None else np.zeros((self._rank,) * 2)

    @property
    def residual(self) -> float:
        """Difference of both bounds of the discrete transmissivity, relative to the upper one: its certificate."""
        return 0.0 if self._flow is None else self._flow.gap

    @cached_property
    def interval(self) -> tuple[Array, Array]:
        """Bounds of the transmissivity of the gap that is constant in each cell [m^3], shape of `transmissivity` each.

        They contain neither the difference to the gap between the cell centres, nor the error of the contact on its
        grid, nor that of Reynolds' equation.
        """
        if self._flow is None or self._network is None:
            return self.transmissivity, self.transmissivity
        if self.between is not None:
            raise InputError(
                "between two regions the flow has no interval",
                "use the flow from side to side, or on a period",
            )
        lower = flux_bound(self._network, self._flow.flow, self._conductance, self._grid)
        upper = bilinear_bound(self._conductance, self._grid, self.axis)
        return lower * self._unit, upper * self._unit

    @property
    def eigenvalues(self) -> Array:
        """Eigenvalues of the transmissivity, the larger first [m^3]; one from side to side."""
        found: Array = np.linalg.eigvalsh(self.transmissivity)[::-1].astype(np.float64)
        return found

    @property
    def hydraulic_gap(self) -> float:
        """Uniform gap with the same mean transmissivity [m]."""
        return float(np.cbrt(np.trace(self.transmissivity) / self._rank))

    def pressure(self, direction: int = 0) -> Array:
        """Return the pressure of a unit drop; NaN for cells without flow.

        Parameters
        ----------
        direction : int
            Axis of the mean drop on a periodic map, over one period; 0 otherwise.

        Returns
        -------
        array, shape of the grid
            From 1 to 0 along the flow.

        Examples
        --------
        >>> import roughcontact as rc
        >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
        >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
        >>> flow = rc.gap_flow(rc.press(surface, 1e9, pressure=2e6))
        >>> flow.pressure().shape
        (64, 64)
        """
        if self._network is None or self._flow is None:
            return np.full(self._grid.shape, math.nan)
        values = np.append(self._flow.potential[direction], math.nan)[self._network.cells].reshape(
            self._grid.shape
        )
        if self._network.drive.any():
            x = np.expand_dims(self._grid.coordinates[direction], 1 - direction)
            values = 1 - (values + x) / self._grid.lengths[direction]
        return values

    def flux(self, direction: int = 0) -> tuple[Array, Array]:
        """Return the flux along both axes for a unit drop and a viscosity of 1/12 [m^2], in the middle of the cells.

        Parameters
        ----------
        direction : int
            Axis of the mean drop on a periodic map, over one period; 0 otherwise.

        Returns
        -------
        tuple of two arrays, shape of the grid
            Along y and along x.

        Examples
        --------
        >>> import roughcontact as rc
        >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
        >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
        >>> flow = rc.gap_flow(rc.press(surface, 1e9, pressure=2e6))
        >>> [each.shape for each in flow.flux(1)]
        [(64, 64), (64, 64)]
        """
        shape = self._grid.shape
        if self._network is None or self._flow is None:
            return np.zeros(shape), np.zeros(shape)
        network = self._network
        # The potential of a period grows along the axis, that between reservoirs falls.
        factor = -self._scale / self._grid.lengths[direction] if network.drive.any() else self._scale
        found = []
        for axis in (0, 1):
            of = network.axis == axis
            through = sum(
                np.bincount(end[of], self._flow.flow[direction][of], network.count)
                for end in (network.first, network.second)
            )
            mean = np.append(0.5 * through, 0.0)[network.cells].reshape(shape)
            found.append(mean * (factor / self._grid.spacing[1 - axis]))
        return found[0], found[1]

    @cached_property
    def constriction(self) -> Constriction | None:
        """The critical constriction, of the better conducting principal direction; None without flow."""
        return None if self._flow is None else self._constriction(np.linalg.eigh(self._flow.upper)[1][:, -1])

    def constriction_along(self, direction: int) -> Constriction | None:
        """Return the critical constriction of the flow by a drop along one direction; None without flow.

        Parameters
        ----------
        direction : int
            Axis of the mean drop on a periodic map; 0 otherwise.

        Returns
        -------
        Constriction or None

        Examples
        --------
        >>> import roughcontact as rc
        >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
        >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
        >>> flow = rc.gap_flow(rc.press(surface, 1e9, pressure=2e6))
        >>> flow.constriction_along(0).cells
        28
        """
        return self._constriction(np.eye(self._rank)[direction])

    def _constriction(self, weights: Array) -> Constriction | None:
        if self._network is None or self._flow is None or not weights @ self._flow.upper @ weights > 0:
            return None
        return constriction_of(
            self._network, weights @ self._network.drops(self._flow.potential), self.gap, self._grid
        )

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences."""
        return in_order(methods.notes_on_flow(self))

    plot = methods.plot_flow
    to_dataset = methods.flow_dataset

    def __repr__(self) -> str:
        """Return the main numbers."""
        if not self.percolates:
            return "GapFlow(no open path)"
        values = " and ".join(f"{value:.4g}" for value in self.eigenvalues[: len(self.windings) or 1])
        return f"GapFlow(transmissivity {values} m^3, bounds within {self.residual:.0e})"

    @property
    def _grid(self) -> Grid:
        grid = self.solution.problem.grid
        assert isinstance(grid, Grid)
        return grid

    @property
    def _rank(self) -> int:
        return 2 if self.axis is None and self.between is None else 1

    @cached_property
    def _scale(self) -> float:
        """Unit of the conductances of cells [m^3], so that these are about one."""
        return float(np.mean(self.gap)) ** 3 or 1.0

    @property
    def _conductance(self) -> Array:
        """Conductances of the cells, in units of `_scale`."""
        return (self.gap**3 + 6 * self.slip_length * self.gap**2) / self._scale

    @property
    def _unit(self) -> float:
        """Transmissivity [m^3] by the dissipation of a unit drive."""
        lengths = self._grid.lengths
        if self.between is not None:
            return self._scale
        if self.axis is None:
            return self._scale / self._grid.area
        return self._scale * lengths[self.axis] / lengths[1 - self.axis]

    @property
    def _network(self) -> Network | None:
        return self._network_and_windings[0]

    @cached_property
    def _network_and_windings(self) -> tuple[Network | None, Indices]:
        grid, conductance = self._grid, self._conductance
        faces = faces_of(conductance, grid)
        if self.between is not None:
            # The pressure is given in the cells of both regions: they join the reservoirs without resistance.
            flat = conductance.ravel()
            best = 1e6 * float(flat.max()) if flat.size else 1.0
            ends = [np.flatnonzero(each.ravel() & (flat > 0)) for each in self.between]
            inlet, outlet = ((each, np.full(len(each), best)) for each in ends)
            return joined_network(faces, grid, 0, inlet, outlet), np.zeros((0, 2), np.intp)
        if self.axis is None:
            return winding_network(faces, grid)
        index = np.arange(grid.size).reshape(grid.shape)
        wide = grid.spacing[1 - self.axis] / grid.spacing[self.axis]
        sides = []
        for at in (0, -1):
            cells = np.take(index, at, self.axis)
            of = conductance.ravel()[cells]
            sides.append((cells[of > 0], 2 * of[of > 0] * wide))
        return joined_network(faces, grid, self.axis, sides[0], sides[1]), np.zeros((0, 2), np.intp)

    @cached_property
    def _flow(self) -> NetworkFlow | None:
        return None if self._network is None else solve(self._network, self.tolerance)


@numeric(slip_length="m")
def gap_flow(
    solution: Solution,
    *,
    axis: int | None = None,
    between: tuple[Mask, Mask] | None = None,
    missing: Missing = "closed",
    slip_length: float = 0.0,
    tolerance: float = TOLERANCE,
) -> GapFlow:
    """Return the flow of a fluid through the gap of a contact, by Reynolds' equation.

    The gap is that of the solution; cells in contact are closed. The fluid does not press on the bodies: its pressure
    must be small beside the nominal pressure. What flows, and how much of it, follows for any viscosity and drop from
    the transmissivity; see `leak`.

    Parameters
    ----------
    solution : Solution
        Of a map of heights, by `press` or `loading_path`.
    axis : int, optional
        Axis of the flow from side to side of a free map. Without it, a map must be periodic along both axes.
    between : tuple of two bool arrays, shape of the grid, optional
        Regions at the higher and at the lower pressure, in place of two sides: an inner and an outer rim.
    missing : {"closed", "open"}
        Whether a cell without a height is closed or wide open.
    slip_length : float
        Slip length at both walls [m]: the flow of a cell is proportional to ``g^3 + 6 b g^2``.
    tolerance : float
        Largest relative difference of the two bounds of the discrete flow.

    Returns
    -------
    GapFlow

    Raises
    ------
    ValueError
        If the contact is not that of a map of heights in memory of NumPy, or no direction of the flow follows.

    Notes
    -----
    Finite volumes with harmonic means at the faces. The bounds are those of Dirichlet and Thomson, see
    docs/concepts/gap-flow.md.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> flow = rc.gap_flow(rc.press(surface, 1e9, pressure=2e6))
    >>> flow.percolates, flow.transmissivity.shape, flow.residual < 1e-6
    (True, (2, 2), True)
    """
    problem, grid = solution.problem, solution.problem.grid
    require_flow(problem, axis, sides=between is None)
    if missing not in ("closed", "open"):
        raise about("missing", f"must be 'closed' or 'open', not {missing!r}")
    if not slip_length >= 0:
        raise about("the slip length", f"must be 0 or more [m], not {slip_length}")
    if between is not None:
        between = tuple(np.asarray(each, dtype=bool) for each in between)  # type: ignore[assignment]
        assert between is not None
        if (
            len(between) != 2
            or any(each.shape != grid.shape for each in between)
            or (between[0] & between[1]).any()
        ):
            raise about("between", f"must be two regions of shape {grid.shape} without a common cell")
    gap = np.where(solution.contact | ~(solution.gap > 0), 0.0, solution.gap)
    if missing == "open" and solution.missing:
        gap[~problem.measured] = OPEN ** (1 / 3) * gap.max()
    gap.flags.writeable = False
    return GapFlow(solution, gap, axis, slip_length, checked_tolerance(tolerance), between)


def require_flow(problem: ContactProblem, axis: int | None, *, sides: bool = True) -> None:
    """Raise an error unless a contact is that of a map; `sides`: unless an axis leads through it."""
    grid = problem.grid
    if problem.geometry is not Geometry.SURFACE or not is_numpy(problem.separation):
        raise InputError(
            "the flow through a gap needs a map of heights in NumPy's memory", "press a Surface", "solution"
        )
    if sides and axis is None and not all(grid.periodic):
        raise InputError(
            "on a map that is not periodic the direction of the flow must be given",
            "give axis=0 or axis=1",
            "axis",
        )
    if sides and axis is not None and (axis not in (0, 1) or grid.periodic[axis]):
        raise about("the axis", f"must be one that is not periodic, 0 or 1, not {axis!r}")
