"""The leak of a joint: what flows through its gap under a drop of pressure."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact import methods
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.fluid.constriction import Constriction, cells_near
from roughcontact.fluid.fluids import Gas, Liquid
from roughcontact.fluid.gap_flow import GapFlow, gap_flow
from roughcontact.fluid.open_gap import Missing
from roughcontact.grid import AnyGrid, RadialGrid
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import in_order
from roughcontact.validation import Mask, numeric

__all__ = ["Leak", "leak", "shape_factor"]

RAREFIED = 5.0  # rarefaction parameter from which a slip length describes the flow


@dataclass(frozen=True, slots=True)
class Leak:
    """A leak rate.

    Attributes
    ----------
    flow : GapFlow
        The flow that it follows from.
    fluid : Liquid or Gas
    upstream, downstream : float
        Pressures on both sides [Pa]; the drop and zero where only the drop of a liquid was given.
    volume : float
        Volume flow [m^3/s]; of a gas, at the mean pressure.
    direction : int
        Axis of the mean drop on a periodic map; 0 otherwise.
    seal_width, circumference : float or None
        Length of the seal along the flow, and across it [m]; None if the map is the seal.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> solution = rc.press(surface, 1e9, pressure=2e6)
    >>> found = rc.leak(solution, rc.Liquid(1e-3), drop=1e5, axis=0, seal_width=1e-3, circumference=0.1)
    >>> found.drop, found.constriction.cells
    (100000.0, 28)
    """

    flow: GapFlow
    fluid: Liquid | Gas
    upstream: float
    downstream: float
    volume: float
    direction: int = 0
    seal_width: float | None = None
    circumference: float | None = None

    @property
    def constriction(self) -> Constriction | None:
        """The critical constriction of this flow; None without flow."""
        return self.flow.constriction_along(self.direction)

    @property
    def drop(self) -> float:
        """Drop of pressure [Pa]."""
        return self.upstream - self.downstream

    @property
    def mass(self) -> float:
        """Mass flow [kg/s]; NaN for a liquid without density."""
        return self.volume * self._density

    @property
    def throughput(self) -> float:
        """Pressure times volume flow of a gas [Pa m^3/s]; NaN for a liquid."""
        return self.volume * self._mean if isinstance(self.fluid, Gas) else math.nan

    @property
    def reynolds(self) -> float:
        """Reduced Reynolds number of the film in the critical constriction [1]; NaN without density."""
        place = self.constriction
        grid = self.flow.solution.problem.grid
        if place is None or isinstance(grid, RadialGrid):
            return 0.0
        length = grid.lengths[self.direction if self.flow.axis is None else self.flow.axis]
        drop = self.drop * (length / self.seal_width if self.seal_width is not None else 1.0)  # over the map
        flux = float(np.hypot(*self.flow.flux(self.direction))[cells_near(place, grid)].max())
        return self._density * flux * drop / (12 * self.fluid.viscosity**2) * place.gap / place.width

    @property
    def rarefaction(self) -> float:
        """Rarefaction parameter in the critical constriction at the mean pressure [1]; infinite for a liquid."""
        place = self.constriction
        if place is None or not isinstance(self.fluid, Gas):
            return math.inf
        return self.fluid.rarefaction(place.gap, self._mean)

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these numbers, in sentences; those of the flow among them."""
        return in_order(methods.notes_on_leak(self))

    to_dataset = methods.flow_dataset
    to_record = methods.flow_record

    @property
    def _mean(self) -> float:
        return 0.5 * (self.upstream + self.downstream)

    @property
    def _density(self) -> float:
        if isinstance(self.fluid, Gas):
            return self._mean / (self.fluid.gas_constant * self.fluid.temperature)
        return math.nan if self.fluid.density is None else self.fluid.density


@numeric(drop="Pa", upstream="Pa", downstream="Pa", seal_width="m", circumference="m")
def leak(
    solution: Solution,
    fluid: Liquid | Gas,
    *,
    drop: float | None = None,
    upstream: float | None = None,
    downstream: float | None = None,
    axis: int | None = None,
    between: tuple[Mask, Mask] | None = None,
    seal_width: float | None = None,
    circumference: float | None = None,
    missing: Missing = "closed",
) -> Leak:
    """Return the leak rate of a joint.

    Parameters
    ----------
    solution : Solution
        Of a map of heights or of rings, see `gap_flow`.
    fluid : Liquid or Gas
        A gas flows with slip at the walls.
    drop : float, optional
        Drop of pressure of a liquid [Pa].
    upstream, downstream : float, optional
        Absolute pressures [Pa]: in place of the drop, and always for a gas.
    axis : int, optional
        Axis along which the pressure falls; required for a map, free or periodic, without `between`.
    between : tuple of two bool arrays, optional
        Regions at both pressures in place of an axis, see `gap_flow`.
    seal_width, circumference : float, optional
        Length of the seal along the flow, and across it [m]: the map is then a sample of the seal. Without them the
        map is the seal, from side to side; a periodic map needs them.
    missing : {"closed", "open"}
        See `gap_flow`.

    Returns
    -------
    Leak

    Raises
    ------
    ValueError
        If the pressures do not suit the fluid, the direction of the drop is not given, the drop exceeds the nominal
        pressure, or the gas is too rarefied in the critical constriction for a slip length.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> solution = rc.press(surface, 1e9, pressure=2e6)
    >>> water = rc.Liquid(viscosity=1e-3, density=1000)
    >>> found = rc.leak(solution, water, drop=1e5, axis=0, seal_width=1e-3, circumference=0.1)
    >>> f"{found.volume * 6e7:.2g} ml/min"
    '1.1e-05 ml/min'
    """
    if not isinstance(fluid, Liquid | Gas):
        raise about("the fluid", f"must be an rc.Liquid or an rc.Gas, not {fluid!r}")
    upstream, downstream = _pressures(fluid, drop, upstream, downstream)
    if upstream - downstream > solution.nominal_pressure:
        raise InputError(
            f"the drop of {written(upstream - downstream, 'Pa')} exceeds the nominal pressure of "
            f"{written(solution.nominal_pressure, 'Pa')}, so the fluid separates the bodies",
            "press harder, or give a smaller drop",
            "drop",
        )
    shape = shape_factor(solution.problem.grid, axis, seal_width, circumference, between is not None)
    is_periodic = all(solution.problem.grid.periodic) and between is None
    slip = fluid.slip_length(0.5 * (upstream + downstream)) if isinstance(fluid, Gas) else 0.0
    flow = gap_flow(
        solution, axis=None if is_periodic else axis, between=between, missing=missing, slip_length=slip
    )
    direction = axis if is_periodic and axis is not None else 0
    conductance = flow.transmissivity[direction, direction] * shape / (12 * fluid.viscosity)
    volume = float(conductance * (upstream - downstream))
    found = Leak(flow, fluid, upstream, downstream, volume, direction, seal_width, circumference)
    if not found.rarefaction >= RAREFIED:
        raise InputError(
            f"the gas is too rarefied in the critical constriction for a slip length: its rarefaction parameter is "
            f"{found.rarefaction:.2g}, less than {RAREFIED:g}",
            "raise the pressures, or press less",
            "upstream, downstream",
        )
    return found


def _pressures(
    fluid: Liquid | Gas, drop: float | None, upstream: float | None, downstream: float | None
) -> tuple[float, float]:
    """Return the pressures on both sides [Pa]."""
    if upstream is None and downstream is None and drop is not None and isinstance(fluid, Liquid):
        upstream, downstream = drop, 0.0
    elif drop is not None or upstream is None or downstream is None:
        remedy = "give upstream= and downstream=, absolute" + (
            "" if isinstance(fluid, Gas) else ", or only drop="
        )
        raise InputError("the pressures on both sides do not follow", remedy, "upstream, downstream")
    if not 0 <= downstream < upstream < math.inf:
        raise InputError(
            f"the upstream pressure of {upstream:g} Pa must be finite and exceed the downstream pressure of "
            f"{downstream:g} Pa, which is 0 or more",
            "exchange or correct both pressures",
            "upstream, downstream",
        )
    return upstream, downstream


def shape_factor(
    grid: AnyGrid,
    axis: int | None,
    seal_width: float | None,
    circumference: float | None,
    between: bool = False,
) -> float:
    """Return the flow over the transmissivity, for a unit drop and a viscosity of 1/12 [1]."""
    if (seal_width is None) != (circumference is None):
        raise InputError("a seal has a width and a circumference", "give both", "seal_width, circumference")
    if (between or isinstance(grid, RadialGrid)) and seal_width is not None:
        raise InputError(
            "between two rims the flow has no seal width",
            "leave seal_width and circumference out",
            "seal_width, circumference",
        )
    if isinstance(grid, RadialGrid):
        return 2 * math.pi / math.log(grid.edges[-1] / grid.edges[0]) if grid.edges[0] > 0 else 0.0
    if between:
        return 1.0
    if axis not in (0, 1):
        raise InputError("the direction of the drop must be given", "give axis=0 or axis=1", "axis")
    if seal_width is not None and circumference is not None:
        return circumference / seal_width
    if all(grid.periodic):
        raise InputError(
            "a periodic map is a sample of a seal",
            "give the width and the circumference of the seal",
            "seal_width, circumference",
        )
    return grid.lengths[1 - axis] / grid.lengths[axis]
