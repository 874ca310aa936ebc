"""Flow of a fluid through the gap of a contact, by Reynolds' equation."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact import methods
from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.arrays import is_numpy
from roughcontact.cached import cached_property
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.fluid.constriction import Constriction, constriction_of
from roughcontact.fluid.interval import bilinear_bound, flux_bound
from roughcontact.fluid.network import Indices, Network, flow_network
from roughcontact.fluid.open_gap import Missing, checked_direction, open_gap
from roughcontact.fluid.solve import NetworkFlow, solve
from roughcontact.grid import AnyGrid, RadialGrid
from roughcontact.guesses import hinted
from roughcontact.labels.note import in_order
from roughcontact.solver.control import checked_tolerance
from roughcontact.validation import Array, Mask, numeric

__all__ = ["TOLERANCE", "GapFlow", "gap_flow"]

TOLERANCE = 1e-6  # largest relative difference of the two bounds


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class GapFlow:
    """Flow through a gap, for any viscosity and drop: ``q = -transmissivity/(12 viscosity) grad p`` on average.

    Attributes
    ----------
    solution : Solution or AdhesiveState
        The contact.
    gap : array, shape of the grid
        Gap that the fluid passes [m]; zero in contact and where missing cells are closed.
    axis : int or None
        Axis from side to side; None for a map that is periodic along both axes, for rings, or between two regions.
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

    solution: Solution | AdhesiveState
    gap: Array
    axis: int | None
    slip_length: float
    tolerance: float
    between: tuple[Mask, Mask] | None = None

    @property
    def percolates(self) -> bool:
        """Whether an open path leads through the gap."""
        return self._network is not None

    def percolates_along(self, direction: int) -> bool:
        """Return whether an open path leads along one direction.

        Parameters
        ----------
        direction : int
            Axis of a periodic map: a winding vector has a component along it; elsewhere 0.

        Returns
        -------
        bool

        Examples
        --------
        >>> import roughcontact as rc
        >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
        >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
        >>> rc.gap_flow(rc.press(surface, 1e9, pressure=2e6)).percolates_along(0)
        True
        """
        return bool(self.windings[:, direction].any()) if self._rank == 2 else self.percolates

    @cached_property
    def windings(self) -> Indices:
        """Independent vectors along which the open cells of a periodic map percolate [periods], shape (rank, 2)."""
        return self._network_and_windings[1]

    @property
    def transmissivity(self) -> Array:
        """Cubed hydraulic gap [m^3]: a tensor, shape (2, 2), or one number from side to side, shape (1, 1).

        Between two regions it is the flow itself for a unit drop and a viscosity of 1/12.
        """
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
        if self._flow is None or self._network is None or isinstance(self._grid, RadialGrid):
            # Of rings in series the discrete flow is exact.
            return self.lower_transmissivity, self.transmissivity
        if self.between is not None:
            raise InputError(
                "between two regions the flow has no interval",
                "leave between out, and give axis on a map that is not periodic",
                "between",
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
            From 1 to 0 along the flow; on rings, from the inner rim to the outer one.

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

        Raises
        ------
        ValueError
            On rings.

        Examples
        --------
        >>> import roughcontact as rc
        >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
        >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
        >>> flow = rc.gap_flow(rc.press(surface, 1e9, pressure=2e6))
        >>> [each.shape for each in flow.flux(1)]
        [(64, 64), (64, 64)]
        """
        grid, shape, network = self._grid, self._grid.shape, self._network
        if isinstance(grid, RadialGrid):
            raise InputError(
                "rings have no flux along y and x", "use transmissivity and pressure(), or press a Surface"
            )
        if network is None or self._flow is None:
            return np.zeros(shape), np.zeros(shape)
        # The potential of a period grows along the axis, that between reservoirs falls.
        factor = -self._scale / grid.lengths[direction] if network.drive.any() else self._scale
        found = []
        for axis in (0, 1):
            of = network.axis == axis
            through = sum(
                np.bincount(end[of], self._flow.flow[direction][of], network.count)
                for end in (network.first, network.second)
            )
            mean = np.append(0.5 * through, 0.0)[network.cells].reshape(shape)
            found.append(mean * (factor / grid.spacing[1 - axis]))
        return found[0], found[1]

    @cached_property
    def constriction(self) -> Constriction | None:
        """The critical constriction, of the better conducting principal direction; None without flow, and on rings."""
        return None if self._flow is None else self._constriction(np.linalg.eigh(self._flow.upper)[1][:, -1])

    def constriction_along(self, direction: int) -> Constriction | None:
        """Return the critical constriction of the flow by a drop along one direction; None without flow, and on rings.

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
        network, flow, grid = self._network, self._flow, self._grid
        if network is None or flow is None or isinstance(grid, RadialGrid):
            return None
        if not weights @ flow.upper @ weights > 0:
            return None
        return constriction_of(network, weights @ network.drops(flow.potential), self.gap, grid)

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences."""
        return in_order(methods.notes_on_flow(self))

    plot = methods.plot_flow
    to_dataset = methods.flow_dataset
    to_record = methods.flow_record

    def __repr__(self) -> str:
        """Return the main numbers."""
        if not self.percolates:
            return "GapFlow(no open path)"
        values = " and ".join(f"{value:.4g}" for value in self.eigenvalues[: len(self.windings) or 1])
        return f"GapFlow(transmissivity {values} m^3, bounds within {self.residual:.0e})"

    @property
    def _grid(self) -> AnyGrid:
        return self.solution.problem.grid

    @property
    def _rank(self) -> int:
        return 2 if self.between is None and all(self._grid.periodic) else 1

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
        grid = self._grid
        if self.between is not None:
            return self._scale
        if isinstance(grid, RadialGrid):
            return self._scale * math.log(grid.edges[-1] / grid.edges[0])
        if self.axis is None:
            return self._scale / grid.area
        return self._scale * grid.lengths[self.axis] / grid.lengths[1 - self.axis]

    @property
    def _network(self) -> Network | None:
        return self._network_and_windings[0]

    @cached_property
    def _network_and_windings(self) -> tuple[Network | None, Indices]:
        return flow_network(self._conductance, self._grid, self.axis, self.between)

    @cached_property
    def _flow(self) -> NetworkFlow | None:
        return None if self._network is None else solve(self._network, self.tolerance)


@numeric(slip_length="m", closing_gap="m")
def gap_flow(
    solution: Solution | AdhesiveState,
    *,
    axis: int | None = None,
    between: tuple[Mask, Mask] | None = None,
    missing: Missing = "closed",
    slip_length: float = 0.0,
    closing_gap: float | None = None,
    tolerance: float = TOLERANCE,
) -> GapFlow:
    """Return the flow of a fluid through the gap of a contact, by Reynolds' equation.

    The gap is that of the solution; cells in contact are closed. The fluid does not press on the bodies: its pressure
    must be small beside the nominal pressure. What flows, and how much of it, follows for any viscosity and drop from
    the transmissivity; see `leak`.

    Parameters
    ----------
    solution : Solution or AdhesiveState
        Of a map of heights, by `press`, `loading_path` or `adhesive_state`. On rings, the fluid flows between the inner
        and the outer rim.
    axis : int, optional
        Axis of the flow from side to side of a free map. Without it, a map must be periodic along both axes.
    between : tuple of two bool arrays, shape of the grid, optional
        Regions at the higher and at the lower pressure, in place of two sides: an inner and an outer rim.
    missing : {"closed", "open"}
        Whether a cell without a height is closed or wide open.
    slip_length : float
        Slip length at both walls [m]: the flow of a cell is proportional to ``g^3 + 6 b g^2``.
    closing_gap : float, optional
        Cells with a smaller gap are closed [m]; required for an adhesive state.
    tolerance : float
        Largest relative difference of the two bounds of the discrete flow.

    Returns
    -------
    GapFlow

    Raises
    ------
    ValueError
        If the contact is not that of a map of heights or of rings in memory of NumPy, no direction of the flow follows,
        the rings begin at the axis, or an adhesive state has no closing gap or is detached.

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
    grid = solution.problem.grid
    if not is_numpy(solution.pressure):
        raise InputError(
            "the flow through a gap needs arrays of NumPy on one process",
            "press a Surface whose heights are such an array",
            "solution",
        )
    if not slip_length >= 0:
        raise about("the slip length", f"must be 0 or more [m], not {slip_length}")
    between = checked_direction(grid, axis, between)
    return GapFlow(
        solution,
        open_gap(solution, missing, closing_gap),
        axis,
        slip_length,
        checked_tolerance(tolerance),
        between,
    )
