"""The foundation of independent springs on which the method of dimensionality reduction presses its lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.material import Solid, as_modulus

__all__ = ["Foundation", "foundation"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Foundation:
    """Springs of stiffness E* times their width, which know nothing of each other (thesis, eq. A.60).

    Its pressure is a force per length [N/m]: E* times the depth to which a spring is pressed.
    """

    grid: Grid
    modulus: float

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            geometry=Geometry.FOUNDATION,
            modulus=self.modulus,
            positive=True,
            semidefinite=False,  # it sinks under a constant pressure, whether or not the line repeats itself
            submatrix=self.submatrix,
        )

    @property
    def weights(self) -> float:
        """Width of a spring [m]."""
        return self.grid.cell_area

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under a force per length [N/m]."""
        return pressure / self.modulus

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the diagonal matrix [m^2/N] between `cells` (all without)."""
        return np.eye(self.grid.size if cells is None else len(cells)) / self.modulus

    def restrict(self, window: tuple[slice, ...]) -> Foundation:
        """Return the springs of `window`."""
        if self.grid.window(window).shape == self.grid.shape:
            return self
        return Foundation(self.grid.window(window), self.modulus)

    def submatrix(self, cells: Cells) -> Foundation:
        """Return the springs of a list."""
        return Foundation(Grid(max(1, len(cells)), self.grid.spacing), self.modulus)


def foundation(grid: Grid, modulus: float | Solid | tuple[Solid, Solid]) -> Foundation:
    """Return the elastic foundation of the method of dimensionality reduction.

    Parameters
    ----------
    grid : Grid
        Of one axis; the springs sit side by side. Whether it repeats itself makes no difference to them.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.

    Raises
    ------
    ValueError
        If the grid has two axes, or is one of rings.
    """
    if not isinstance(grid, Grid) or grid.ndim != 1:
        raise ValueError("a foundation of springs carries a line: give a grid of one axis, Grid(n, spacing)")
    return Foundation(grid, as_modulus(modulus))
