"""Tangential traction by the moving grid: the influence tensor, shifted to every loaded cell and added up."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import require_numpy
from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.shear.shear_sums import FreeShear

__all__ = ["MovingGridShear"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class MovingGridShear:
    """A direct sum with the memory of a dozen grids, not of a matrix (thesis, eqs A.48, A.49, for a tensor).

    Its time grows as loaded cells times all cells. Exact, and short enough to be seen to be right.

    Parameters
    ----------
    free : FreeShear
        The same body by transforms.
    """

    free: FreeShear

    @property
    def grid(self) -> Grid:
        """The grid it works on."""
        return self.free.grid

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.free.weights

    @cached_property
    def _shifted(self) -> Array:
        """The tensor's xx, yy and xy at offsets from 1 - n to n - 1 along both axes [m/Pa]."""
        ny, nx = self.grid.shape
        down, right = np.arange(1 - ny, ny), np.arange(1 - nx, nx)
        xx, yy, xy = self.free.influence.table(self.grid.shape)[:, abs(down)[:, None], abs(right)]
        return np.stack([xx, yy, xy * np.sign(down)[:, None] * np.sign(right)])

    def apply(self, traction: Array) -> Array:
        """Return the displacement [m] under `traction` [Pa]."""
        require_numpy(traction, "the moving grid")
        ny, nx = self.grid.shape
        influence, displacement = self._shifted, np.zeros((2, ny, nx))
        for i, j in np.argwhere(traction.any(axis=0)):
            xx, yy, xy = influence[:, ny - 1 - i : 2 * ny - 1 - i, nx - 1 - j : 2 * nx - 1 - j]
            qx, qy = traction[:, i, j]
            displacement[0] += qx * xx + qy * xy
            displacement[1] += qx * xy + qy * yy
        return displacement

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a traction [Pa] that would cause about this `displacement` [m]: every wave by itself."""
        return self.free.approximate_inverse(displacement)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells`, shape ``(2 n, 2 n)``."""
        return self.free.as_matrix(cells)

    def restrict(self, window: tuple[slice, ...]) -> MovingGridShear:
        """Return the map between the cells of `window`, with no traction outside."""
        part = self.free.restrict(window)
        return self if part is self.free else MovingGridShear(part)
