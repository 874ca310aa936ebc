"""The half-space by fast Fourier transforms, free or periodic."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import convolve, even_multiplier, fast_even_length
from roughcontact.grid import Grid
from roughcontact.halfspace.influence import Influence, Periodic

__all__ = ["FreeOperator", "PeriodicOperator"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class FreeOperator:
    """A zero-padded convolution: exact on a free grid of any shape (thesis, eq. A.59 as corrected).

    Parameters
    ----------
    grid : Grid
        Grid of two axes; its boundary condition is not looked at.
    influence : Influence
        Influence function on cells of the grid's size.
    positive : bool
        Whether the influence function is nowhere negative.
    """

    grid: Grid
    influence: Influence
    positive: bool = True

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @cached_property
    def table(self) -> Array:
        """Displacement per pressure [m/Pa] at offsets of whole cells from zero up."""
        return self.influence.table(self.grid.shape)

    @cached_property
    def _padded(self) -> tuple[int, int]:
        # Offsets n - 1 and -(n - 1) may share a place, since the kernel is even: 2n - 2 is enough.
        ny, nx = self.grid.shape
        return fast_even_length(2 * ny - 2), fast_even_length(2 * nx - 2)

    @cached_property
    def _multiplier(self) -> Array:
        return even_multiplier(self.table, self._padded)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        return convolve(pressure, self._multiplier, self._padded)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        return gather(self.table, self.grid.shape, cells)

    def restrict(self, window: tuple[slice, ...]) -> FreeOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        restricted = FreeOperator(self.grid.window(window), self.influence, self.positive)
        if "table" in self.__dict__:  # a table at hand is cut, not made again
            ny, nx = restricted.grid.shape
            restricted.__dict__["table"] = np.ascontiguousarray(self.table[:ny, :nx])
        return restricted

    def coarsened(self, grid: Grid) -> FreeOperator:
        """Return the same body on `grid`, whose cells are larger."""
        return FreeOperator(grid, self.influence.coarsened(grid), self.positive)


@dataclass(frozen=True, eq=False)
class PeriodicOperator:
    """The periodic half-space: a product in Fourier space, mean displacement zero.

    Parameters
    ----------
    grid : Grid
        Periodic grid of two axes.
    influence : Periodic
        Its multiplier.
    """

    grid: Grid
    influence: Periodic
    positive: bool = False

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @cached_property
    def table(self) -> Array:
        """Displacement per pressure [m/Pa] at offsets of whole cells from zero up."""
        return self.influence.table(self.grid.shape)

    @cached_property
    def _multiplier(self) -> Array:
        return self.influence.multiplier()

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        ny, nx = self.grid.shape
        return convolve(pressure, self._multiplier, (ny, nx))

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        return gather(self.table, self.grid.shape, cells)

    def restrict(self, window: tuple[slice, ...]) -> FreeOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        return FreeOperator(self.grid.window(window), self.influence, self.positive)

    def coarsened(self, grid: Grid) -> PeriodicOperator:
        """Return the same body on `grid`, whose cells are larger."""
        return PeriodicOperator(grid, self.influence.coarsened(grid))


def gather(table: Array, shape: tuple[int, ...], cells: Cells | None = None) -> Array:
    """Return the matrix [m/Pa] between `cells` from the `table` of offsets."""
    width = shape[1]
    flat = np.arange(shape[0] * width) if cells is None else cells
    y, x = np.divmod(flat, width)
    matrix, values = np.empty((len(flat), len(flat))), table.ravel()
    for start in range(0, len(flat), 16):  # a few rows at a time, so that their indices stay in cache
        rows = slice(start, start + 16)
        index = np.abs(y[rows, None] - y)
        index *= width
        index += np.abs(x[rows, None] - x)
        values.take(
            index, out=matrix[rows], mode="clip"
        )  # "clip" writes without a buffer; none is out of range
    return matrix
