"""What the cells of an operator are, and with it what a force or a pressure on them is."""

from __future__ import annotations

import math
from enum import Enum

from roughcontact.grid import AnyGrid, RadialGrid

__all__ = ["Geometry", "length_scale"]


class Geometry(Enum):
    """The four geometries of the thesis: three of its half-space and that of the Winkler foundation.

    On a line every force, stiffness, energy and contact area is per unit length along the cylinder; on a
    Winkler foundation forces are forces, the pressure is a force per length, and areas are lengths.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grids = rc.Grid((8, 8), 1e-6), rc.Grid(8, 1e-6), rc.RadialGrid.uniform(8, 1e-6)
    >>> [rc.Geometry.of(grid).value for grid in grids]
    ['surface', 'line', 'ring']
    >>> rc.Geometry.RING.axes
    ('r',)
    """

    SURFACE = "surface"
    RING = "ring"
    LINE = "line"
    FOUNDATION = "foundation"

    @classmethod
    def of(cls, grid: AnyGrid) -> Geometry:
        """Return the geometry that a grid suggests.

        Parameters
        ----------
        grid : Grid or RadialGrid
            The cells.

        Returns
        -------
        Geometry
            RING of a `RadialGrid`, SURFACE of two axes, LINE of one.
        """
        if isinstance(grid, RadialGrid):
            return cls.RING
        return cls.SURFACE if grid.ndim == 2 else cls.LINE

    @property
    def axes(self) -> tuple[str, ...]:
        """Names of the axes of its grid."""
        return {"surface": ("y", "x"), "ring": ("r",)}.get(self.value, ("x",))


def length_scale(geometry: Geometry, lengths: tuple[float, ...]) -> float:
    """Return the length L of the dimensionless numbers [m]."""
    if geometry is Geometry.RING:
        return math.sqrt(math.pi) * lengths[0]
    return math.sqrt(math.prod(lengths)) if len(lengths) == 2 else lengths[0]
