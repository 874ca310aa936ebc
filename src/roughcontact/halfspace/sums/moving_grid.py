"""Sums by the moving grid: the influence function, shifted to every loaded cell and added up."""

from __future__ import annotations

import numpy as np

from roughcontact.arrays import require_numpy
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.shear_influence import Influences
from roughcontact.validation import Array

__all__ = ["MovingGrid"]


class MovingGrid:
    """A direct sum with the memory of four grids for each component, not of a matrix (thesis, eqs A.48, A.49).

    Its time grows as loaded cells times all cells. Exact, and short enough to be seen to be right.
    """

    def __init__(self, influence: Influences, grid: Grid) -> None:
        ny, nx = grid.shape
        down, right = np.arange(1 - ny, ny)[:, None], np.arange(1 - nx, nx)
        values = influence.table(grid.shape)[..., np.abs(down), np.abs(right)]
        if values.ndim == 2:
            self._shifted = values[None, None]
        else:  # the tensor, whose coupling of both components is odd along both axes
            xx, xy, yy = values
            xy *= np.sign(down) * np.sign(right)
            self._shifted = np.array([[xx, xy], [xy, yy]])

    def apply(self, field: Array) -> Array:
        """Return the displacement [m] under a pressure or traction [Pa]."""
        require_numpy(field, "the moving grid")
        ny, nx = field.shape[-2:]
        fields = field.reshape(-1, ny, nx)
        displacement = np.zeros(fields.shape)
        for i, j in np.argwhere(fields.any(axis=0)):
            influence = self._shifted[..., ny - 1 - i : 2 * ny - 1 - i, nx - 1 - j : 2 * nx - 1 - j]
            for column, value in zip(influence, fields[:, i, j], strict=True):
                displacement += value * column
        return displacement.reshape(field.shape)
