"""What has flowed: the plastic part of a contact, kept for every load below the largest.

Where the pressure is at the hardness H the flat stands below the undeformed surface: that overlap f is the depth of
flow. The flattened surface h - f touches the flat under the same pressure at the same place, so that it is the contact
of an elastic body. As the load grows every pressure grows, and every overlap with it (a kernel with a maximum
principle). So the state at a load on the way up depends on that load alone, and no load below it makes the flattened
surface flow again.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias, TypeVar

import numpy as np

from roughcontact.arrays import is_numpy, namespace, on_host
from roughcontact.errors import InputError, about
from roughcontact.solver.inner_product import Measure
from roughcontact.surface.radial import RadialProfile
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, Mask

__all__ = ["Flow", "FlowModel", "flow_of", "flow_reading", "lifting_work"]

FlowModel: TypeAlias = Literal["removed", "raised"]
"""Where material that flows goes: it vanishes, or raises the whole surface (Pullen and Williamson 1972)."""

AnyBody = TypeVar("AnyBody", Surface, RadialProfile, Surface | RadialProfile)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Flow:
    """What a surface has lost and gained by plastic flow.

    Attributes
    ----------
    depth : array, shape of the grid
        Depth of flow f of each cell [m], zero where nothing flowed.
    hardness : float or array, shape of the grid
        Pressure at which they did [Pa].
    area : float
        Area of the cells that flowed [m^2]; on a line [m].
    volume : float
        Volume that flowed, the sum of f dA [m^3]; on a line [m^2].
    energy : float
        Work that first loading spent on flow, the sum of H f dA [J]; on a line [J/m]. Where the whole surface rises,
        less the work by which the rise lifts the force, an integral over the loads of the path; NaN where these are too
        few for a hundredth of the energy.
    rise : float
        By how much the whole surface rises where volume is conserved [m]; 0 where material vanishes.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> flow = rc.press(ball, 1e11, force=0.2, hardness=2e9).flow
    >>> f"{flow.depth.max() * 1e9:.0f} nm, {flow.volume * 1e18:.1f} um^3, {flow.energy * 1e9:.1f} nJ"
    '78 nm, 3.3 um^3, 6.5 nJ'
    """

    depth: Array
    hardness: float | Array
    area: float
    volume: float
    energy: float
    rise: float = 0.0

    def flatten(self, surface: AnyBody) -> AnyBody:
        """Return a surface without what flowed, and raised by where it went.

        Parameters
        ----------
        surface : Surface or RadialProfile
            The one that was pressed; or, of two that were pressed as one (`combined`), the softer of them on the same
            grid, to which the flow belongs.

        Returns
        -------
        Surface or RadialProfile
            With a line more in its provenance.

        Raises
        ------
        ValueError
            If it lies on another grid.

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
        >>> flow = rc.press(ball, 1e11, force=0.2, hardness=2e9).flow
        >>> flow.flatten(ball).provenance
        ('paraboloid, radius 0.0001 m', 'flattened by up to 7.801e-08 m')
        """
        if tuple(surface.heights.shape) != tuple(self.depth.shape):
            raise InputError(
                f"what flowed on cells of shape {tuple(self.depth.shape)} is not of a surface of shape "
                f"{tuple(surface.heights.shape)}",
                "bring it onto the grid that was pressed by resampled()",
            )
        xp = namespace(surface.heights)
        heights = xp.astype(surface.heights, xp.float64) - self.depth + self.rise
        line = f"flattened by up to {float(xp.max(self.depth)):.4g} m"
        if self.rise:
            line += f", raised by {self.rise:.4g} m"
        return replace(surface, heights=heights, provenance=(*surface.provenance, line))

    def on_host(self) -> Flow:
        """Return the same in NumPy's memory.

        Returns
        -------
        Flow

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
        >>> flow = rc.press(ball, 1e11, force=0.2, hardness=2e9).flow
        >>> type(flow.on_host().depth).__name__
        'ndarray'
        """
        uniform = isinstance(self.hardness, int | float)
        hardness = self.hardness if uniform else on_host(self.hardness)
        return replace(self, depth=on_host(self.depth), hardness=hardness)

    def __repr__(self) -> str:
        """Say how much flowed, not the field."""
        most = float(namespace(self.depth).max(self.depth))
        return f"Flow(volume {self.volume:.4g}, energy {self.energy:.4g}, up to {most:.4g} m deep)"


def flow_of(
    gap: Array,
    plastic: Mask,
    hardness: float | Array,
    measure: Measure,
    rise: float = 0.0,
    lifting: float = 0.0,
) -> Flow:
    """Return what has flowed where the cells that are `plastic` have a negative gap [m], less the work of its rise."""
    depth = measure.xp.where(plastic & (gap < 0), -gap, 0.0)
    if is_numpy(depth):
        depth.flags.writeable = False
    energy = measure.total(depth * hardness) - lifting
    return Flow(depth, hardness, measure.total(depth > 0), measure.total(depth), energy, rise)


def lifting_work(loads: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """Return the work of a rise against a force, both growing from zero: the integral of F dr [J], and its error.

    Between two loads, of a force and a rise, the rise is a cubic polynomial of the force, whose slopes are differences.
    The error is by how much that is more than a straight line. Fewer than three loads give no such slopes: the error is
    then bounded by the rise, which grows with the force.
    """
    force, rise = np.array([(0.0, 0.0), *loads]).T
    chords, steps = float(np.trapezoid(force, rise)), np.diff(force)
    if len(force) < 4:
        return chords, float(steps @ np.diff(rise)) / 2
    bend = float(steps**2 @ np.diff(np.gradient(rise, force))) / 12
    return chords + bend, abs(bend)


def flow_reading(flow: str) -> bool:
    """Return whether a reading of flow raises the surface; refuse what is none."""
    if flow not in ("removed", "raised"):
        raise about("flow", f"must be 'removed' or 'raised', not {flow!r}")
    return flow == "raised"
