"""Plastic flow: the permanent part of a contact, kept for every load below the largest.

Where the pressure equals the hardness H, the flat stands below the undeformed surface: this overlap f is the depth of
flow. The flattened surface h - f touches the flat under the same pressure at the same place, so that it is in elastic
contact. As the load grows, no pressure and no overlap decreases (the maximum principle of the half-space). Therefore a
state of first loading depends only on its load, and no smaller load makes the flattened surface flow again.
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
"""What happens to material that flows: it vanishes, or raises the whole surface (Pullen and Williamson 1972)."""

AnyBody = TypeVar("AnyBody", Surface, RadialProfile, Surface | RadialProfile)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Flow:
    """The change of a surface by plastic flow.

    Attributes
    ----------
    depth : array, shape of the grid
        Depth of flow f of each cell [m], zero where nothing flowed.
    hardness : float or array, shape of the grid
        Pressure at which the cells flow [Pa].
    area : float
        Area of the cells that flowed [m^2]; [m] on a line.
    volume : float
        Volume that flowed, the sum of f dA [m^3]; [m^2] on a line.
    energy : float
        Work that first loading spent on flow, the sum of H f dA [J]; [J/m] on a line. If the whole surface rises, the
        work of the rise against the force is subtracted. This is an integral over the loads of the path; the energy is
        NaN if they are too few for an error below a hundredth.
    rise : float
        Rise of the whole surface if volume is conserved [m]; 0 if material vanishes.

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
        """Return a surface without the material that flowed, raised by `rise`.

        Parameters
        ----------
        surface : Surface or RadialProfile
            The surface that was pressed; or, if two were pressed as one (`combined`), the softer of them on the same
            grid, to which the flow belongs.

        Returns
        -------
        Surface or RadialProfile
            With one more line in its provenance.

        Raises
        ------
        ValueError
            If the surface lies on another grid.

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
                f"the flow is that of a grid of shape {tuple(self.depth.shape)}, not of a surface of shape "
                f"{tuple(surface.heights.shape)}",
                "bring the surface onto the grid that was pressed by resampled()",
            )
        xp = namespace(surface.heights)
        heights = xp.astype(surface.heights, xp.float64) - self.depth + self.rise
        line = f"flattened by up to {float(xp.max(self.depth)):.4g} m"
        if self.rise:
            line += f", raised by {self.rise:.4g} m"
        return replace(surface, heights=heights, provenance=(*surface.provenance, line))

    def on_host(self) -> Flow:
        """Return the flow in NumPy's memory.

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
        """Return the volume, energy and largest depth, without the field."""
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
    """Return the flow of the `plastic` cells, from their negative gap [m]; the work of its rise is subtracted."""
    depth = measure.xp.where(plastic & (gap < 0), -gap, 0.0)
    if is_numpy(depth):
        depth.flags.writeable = False
    energy = measure.total(depth * hardness) - lifting
    return Flow(depth, hardness, measure.total(depth > 0), measure.total(depth), energy, rise)


def lifting_work(loads: Sequence[tuple[float, float]]) -> tuple[float, float]:
    """Return the work of a rise against a force, both growing from zero: the integral of F dr [J] and its error.

    Between two loads (a force and a rise each) the rise is a cubic polynomial of the force, whose slopes are finite
    differences. The error is the difference from straight lines. Fewer than three loads give no such slopes: the error
    is then bounded because the rise grows with the force.
    """
    force, rise = np.array([(0.0, 0.0), *loads]).T
    chords, steps = float(np.trapezoid(force, rise)), np.diff(force)
    if len(force) < 4:
        return chords, float(steps @ np.diff(rise)) / 2
    bend = float(steps**2 @ np.diff(np.gradient(rise, force))) / 12
    return chords + bend, abs(bend)


def flow_reading(flow: str) -> bool:
    """Return whether `flow` raises the surface; raise an error if it is neither 'removed' nor 'raised'."""
    if flow not in ("removed", "raised"):
        raise about("flow", f"must be 'removed' or 'raised', not {flow!r}")
    return flow == "raised"
