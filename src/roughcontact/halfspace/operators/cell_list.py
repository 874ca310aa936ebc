"""The half-space between a list of cells: the cost follows the contact, not the domain."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.tables import Tables
from roughcontact.halfspace.operators.operator import Capabilities, capabilities
from roughcontact.halfspace.sums.direct_sum import DirectSum
from roughcontact.halfspace.sums.particle_mesh import ListPatches, Patches
from roughcontact.halfspace.sums.tiles import Tiles
from roughcontact.kernels import loader

__all__ = ["CellsOperator"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]

MANY = 50_000  # pairs of cells from which on sums go tile by tile
TABLE = 1.0  # pairs for each cell of a table that is not at hand
SUMS = 4.0  # over a tile for each cell, and cell of the plane: more cost more than its product
BLOCK = 16  # rows of a matrix that are made in one go, so that their offsets stay in cache


@dataclass(frozen=True, eq=False)
class CellsOperator:
    """A direct sum over the cells that carry pressure, for a list of cells of a grid (thesis, eq. A.6).

    Parameters
    ----------
    grid : Grid
        A line of as many cells as the list holds, each as long as a cell of the list is large.
    influence : Tables
        Influence function on the cells.
    rows, columns : int arrays, shape (n,)
        Where the cells are.
    positive : bool
        Whether the influence function is nowhere negative.
    plane : object, optional
        The operator whose cells they are, for what works on its tiles.
    """

    grid: Grid
    influence: Tables
    rows: Cells
    columns: Cells
    positive: bool = True
    plane: Any = None

    @classmethod
    def of(
        cls, grid: Grid, influence: Tables, cells: Cells | None, positive: bool, plane: Any = None
    ) -> CellsOperator:
        """Return the operator between `cells` (flat indices; all without) of a grid of two axes."""
        flat = np.arange(grid.size) if cells is None else cells
        rows, columns = np.divmod(flat, grid.shape[1])
        return cls(Grid(max(1, len(flat)), grid.cell_area), influence, rows, columns, positive, plane)

    @cached_property
    def _particle_mesh(self) -> ListPatches | None:
        """What works on the tiles of a region; None where nothing of the kind is known."""
        plane = capabilities(self.plane).particle_mesh()
        if not isinstance(plane, Patches) or not len(self.rows):
            return None
        return ListPatches(plane, self._tiles, self.influence)

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            positive=self.positive,
            listed=True,
            submatrix=self.submatrix,
            particle_mesh=lambda: self._particle_mesh,
        )

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa], both of shape (n,)."""
        loaded = np.flatnonzero(pressure)
        pairs = len(loaded) * len(pressure)
        table = 0.0 if self.influence.has(self._reach) else TABLE * math.prod(self._reach)
        if pairs < max(MANY, table) or not loader.is_available():
            return self._by_cells(pressure, loaded)
        sums = (len(loaded) + len(self._tiles)) * len(self._tiles)  # a tile without load is looked at too
        if self.plane is not None and sums > SUMS * math.prod(self.plane.grid.shape):
            return self._by_the_plane(pressure, loaded)
        return self._tiles.scatter(self._sum.apply(self._tiles.gather(pressure)))

    def _by_cells(self, pressure: Array, loaded: Cells) -> Array:
        p = pressure[loaded]
        displacement = np.empty(len(pressure))
        for part in self._blocks(len(loaded)):
            displacement[part] = self._influences(part, loaded) @ p
        return displacement

    def _by_the_plane(self, pressure: Array, loaded: Cells) -> Array:
        field = np.zeros(self.plane.grid.shape)
        field[self.rows[loaded], self.columns[loaded]] = pressure[loaded]
        displacement: Array = self.plane.apply(field)[self.rows, self.columns]
        return displacement

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` of the list (all without)."""
        some = self if cells is None else self.submatrix(cells)
        matrix = np.empty((len(some.rows), len(some.rows)))
        everything = slice(None)
        for part in some._blocks(len(some.rows)):
            matrix[part] = some._influences(part, everything)
        return matrix

    def restrict(self, window: tuple[slice, ...]) -> CellsOperator:
        """Return the map between a part of the list."""
        return self.submatrix(np.arange(len(self.rows))[window])

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the map between some cells of the list."""
        grid = Grid(max(1, len(cells)), self.grid.spacing)
        rows, columns = self.rows[cells], self.columns[cells]
        return CellsOperator(grid, self.influence, rows, columns, self.positive, self.plane)

    @cached_property
    def _tiles(self) -> Tiles:
        ends = int(self.rows.max()) + 1, int(self.columns.max()) + 1
        return Tiles.of_list(ends if self.plane is None else self.plane.grid.shape, self.rows, self.columns)

    @cached_property
    def _sum(self) -> DirectSum:
        return DirectSum.over(self._tiles, self.influence, "float64")

    @cached_property
    def _reach(self) -> tuple[int, int]:
        """Shape of the table that would hold every offset of the list."""
        if not len(self.rows):
            return 1, 1
        return int(np.ptp(self.rows)) + 1, int(np.ptp(self.columns)) + 1

    def _influences(self, to: slice, of: Cells | slice) -> Array:
        rows, columns = self.rows[to, None] - self.rows[of], self.columns[to, None] - self.columns[of]
        return self.influence.at(rows, columns, self._reach)

    def _blocks(self, width: int) -> list[slice]:
        size = max(BLOCK, 8192 // max(1, width))
        return [slice(start, start + size) for start in range(0, len(self.rows), size)]
