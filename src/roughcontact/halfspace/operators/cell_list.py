"""The half-space between a list of cells: the cost follows the contact, not the domain."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.tables import Tables, blocks
from roughcontact.halfspace.operators.operator import Capabilities, capabilities
from roughcontact.halfspace.sums.direct_sum import DirectSum
from roughcontact.halfspace.sums.particle_mesh import ListParticleMesh, ParticleMesh
from roughcontact.halfspace.sums.tiles import Tiles
from roughcontact.kernels import loader
from roughcontact.validation import Array

__all__ = ["CellsOperator"]

Cells = npt.NDArray[np.intp]

PAIRS_FOR_TILES = 50_000  # pairs of a loaded cell and a cell from which on sums go tile by tile
PAIRS_PER_ENTRY = 1.0  # pairs for each entry of a table that is not at hand, from which on it is made
# Sums over a tile for each cell of the plane, up to which they cost less than its product (benchmarks/lists.py).
TILE_SUMS_PER_CELL = 4.0


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
        return cls(grid.listed(max(1, len(flat))), influence, rows, columns, positive, plane)

    @cached_property
    def _particle_mesh(self) -> ListParticleMesh | None:
        """What works on the tiles of a region; None where nothing of the kind is known."""
        plane = capabilities(self.plane).particle_mesh()
        if not isinstance(plane, ParticleMesh) or not len(self.rows):
            return None
        return ListParticleMesh(plane, self._tiles, self.influence)

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
        return self.grid.spacing[0]

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa], both of shape (n,)."""
        loaded = np.flatnonzero(pressure)
        pairs = len(loaded) * len(pressure)
        reach = self.influence.reach(self.rows, self.columns)
        table = 0.0 if self.influence.has(reach) else PAIRS_PER_ENTRY * math.prod(reach)
        if pairs < max(PAIRS_FOR_TILES, table) or not loader.is_available():
            return self._by_cells(pressure, loaded, reach)
        sums = (len(loaded) + len(self._tiles)) * len(self._tiles)  # a tile without load is looked at too
        if self.plane is not None and sums > TILE_SUMS_PER_CELL * math.prod(self.plane.grid.shape):
            return self._by_the_plane(pressure, loaded)
        return self._tiles.scatter(self._sum.apply(self._tiles.gather(pressure)))

    def _by_cells(self, pressure: Array, loaded: Cells, reach: tuple[int, ...]) -> Array:
        p = pressure[loaded]
        displacement = np.empty(len(pressure))
        for part in blocks(len(self.rows), len(loaded)):
            down = self.rows[part, None] - self.rows[loaded]
            across = self.columns[part, None] - self.columns[loaded]
            displacement[part] = self.influence.at(down, across, reach) @ p
        return displacement

    def _by_the_plane(self, pressure: Array, loaded: Cells) -> Array:
        field = np.zeros(self.plane.grid.shape)
        field[self.rows[loaded], self.columns[loaded]] = pressure[loaded]
        displacement: Array = self.plane.apply(field)[self.rows, self.columns]
        return displacement

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` of the list (all without)."""
        some = slice(None) if cells is None else cells
        return self.influence.matrix(self.rows[some], self.columns[some])

    def restrict(self, window: tuple[slice, ...]) -> CellsOperator:
        """Return the map between a part of the list."""
        return self.submatrix(np.arange(len(self.rows))[window])

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the map between some cells of the list."""
        grid = self.grid.listed(max(1, len(cells)))
        rows, columns = self.rows[cells], self.columns[cells]
        return CellsOperator(grid, self.influence, rows, columns, self.positive, self.plane)

    @cached_property
    def _tiles(self) -> Tiles:
        ends = int(self.rows.max()) + 1, int(self.columns.max()) + 1
        return Tiles.of_list(ends if self.plane is None else self.plane.grid.shape, self.rows, self.columns)

    @cached_property
    def _sum(self) -> DirectSum:
        return DirectSum.over(self._tiles, self.influence, "float64")
