"""The half-space by the moving grid: the influence function, shifted to every loaded cell and added up."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import require_numpy
from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.halfspace.sums.spectral import FreeOperator

__all__ = ["MovingGridOperator"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class MovingGridOperator:
    """A direct sum with the memory of four grids, not of a matrix (thesis, eqs A.48, A.49).

    Its time grows as loaded cells times all cells. Exact, and short enough to be seen to be right.

    Parameters
    ----------
    free : FreeOperator
        The same body by transforms.
    """

    free: FreeOperator

    @property
    def grid(self) -> Grid:
        """The grid it works on."""
        return self.free.grid

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            modulus=self.free.modulus,
            positive=self.free.positive,
            submatrix=self.submatrix,
            coarsened=self.coarsened,
            approximate_inverse=self.approximate_inverse,
        )

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.free.weights

    @cached_property
    def _shifted(self) -> Array:
        """The influence function at offsets from 1 - n to n - 1 along both axes [m/Pa]."""
        ny, nx = self.grid.shape
        table = self.free.influence.table(self.grid.shape)
        return table[np.ix_(abs(np.arange(1 - ny, ny)), abs(np.arange(1 - nx, nx)))]

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        require_numpy(pressure, "the moving grid")
        ny, nx = self.grid.shape
        influence, displacement = self._shifted, np.zeros((ny, nx))
        for i, j in np.argwhere(pressure):
            displacement += (
                pressure[i, j] * influence[ny - 1 - i : 2 * ny - 1 - i, nx - 1 - j : 2 * nx - 1 - j]
            )
        return displacement

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]: every wave by E* q/2."""
        return self.free.approximate_inverse(displacement)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        return self.free.as_matrix(cells)

    def restrict(self, window: tuple[slice, ...]) -> MovingGridOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        return replace(self, free=self.free.restrict(window))

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the map between a list of cells (flat indices), with no pressure elsewhere."""
        return self.free.submatrix(cells)

    def coarsened(self, grid: Grid) -> MovingGridOperator | None:
        """Return the same body on `grid`, whose cells are larger; None for a window of a periodic one."""
        coarse = self.free.coarsened(grid)
        return None if coarse is None else replace(self, free=coarse)
