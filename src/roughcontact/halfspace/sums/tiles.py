"""Tiles: small squares of cells that hold a region of a plane, so that work follows the region."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, overload

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.constants import SIDE
from roughcontact.kernels.loader import functions
from roughcontact.validation import Array, Mask

__all__ = ["SIDE", "TileMap", "Tiles", "count", "list_loaded"]

Cells = npt.NDArray[np.intp]
Field = npt.NDArray[Any]  # of single or double precision
Indices = npt.NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Tiles:
    """The tiles of a plane in which a region has cells; fields on them have shape ``(n, SIDE * SIDE)``.

    Attributes
    ----------
    shape : tuple of int
        Cells of the plane.
    fields : tuple of int
        Shape of the fields that tiles are taken from: the plane, or a list of its cells.
    rows, columns : int arrays, shape (n,)
        Where the tiles are, counted in tiles.
    cells : int array, shape (n, SIDE * SIDE)
        Flat index of each cell in the fields; -1 of one that is not there.
    """

    shape: tuple[int, int]
    fields: tuple[int, ...]
    rows: Cells
    columns: Cells
    cells: Cells

    @classmethod
    def of(cls, region: Mask) -> Tiles:
        """Return the tiles of a region of shape (ny, nx)."""
        ny, nx = region.shape
        down, across = count(ny), count(nx)
        padded = np.zeros((down * SIDE, across * SIDE), dtype=bool)
        padded[:ny, :nx] = region
        rows, columns = np.nonzero(padded.reshape(down, SIDE, across, SIDE).any(axis=(1, 3)))
        inside = np.arange(SIDE)
        y, x = rows[:, None] * SIDE + inside, columns[:, None] * SIDE + inside
        cells = y[:, :, None] * nx + x[:, None, :]
        beyond = (y >= ny)[:, :, None] | (x >= nx)[:, None, :]
        cells[beyond] = -1
        return cls((ny, nx), (ny, nx), rows, columns, cells.reshape(len(rows), SIDE * SIDE))

    @classmethod
    def of_list(cls, shape: tuple[int, int], rows: Cells, columns: Cells) -> Tiles:
        """Return the tiles of a list of cells of a plane, which no cell is in twice."""
        across = count(shape[1])
        found, tile = np.unique(rows // SIDE * across + columns // SIDE, return_inverse=True)
        cells = np.full((len(found), SIDE * SIDE), -1)
        cells[tile, rows % SIDE * SIDE + columns % SIDE] = np.arange(len(rows))
        return cls(shape, (len(rows),), *np.divmod(found, across), cells)

    @property
    def extent(self) -> tuple[int, int]:
        """Cells from the first row and column of tiles to the last; there is one tile at least."""
        down, across = (int(np.ptp(places) + 1) * SIDE for places in (self.rows, self.columns))
        return down, across

    def those(self, region: Mask) -> Tiles:
        """Return the tiles in which a region, a field like others, has cells."""
        some = self.gather(region).any(axis=1)
        return Tiles(self.shape, self.fields, self.rows[some], self.columns[some], self.cells[some])

    def __len__(self) -> int:
        return len(self.rows)

    @overload
    def gather(self, field: Mask, beyond: float = 0.0) -> Mask: ...
    @overload
    def gather(self, field: Array, beyond: float = 0.0) -> Array: ...
    def gather(self, field: Any, beyond: float = 0.0) -> Any:
        """Return the values of a field on the tiles, another where it has none."""
        return np.where(self.cells >= 0, field.ravel()[self.cells], field.dtype.type(beyond))

    def scatter(self, values: Array) -> Array:
        """Return the field that has `values` on the tiles and is zero elsewhere."""
        field = np.zeros(self.fields, dtype=values.dtype)
        inside = self.cells >= 0
        field.ravel()[self.cells[inside]] = values[inside]
        return field

    def hold(self, region: Mask) -> bool:
        """Whether every cell of a region lies on a tile."""
        inside = self.cells[self.cells >= 0]
        return int(np.count_nonzero(region)) == int(np.count_nonzero(region.ravel()[inside]))

    def map(self, reach: int, periodic: bool) -> TileMap:
        """Return where each tile is, with `reach` tiles of room on each side."""
        down, across = (count(n) for n in self.shape)
        numbers = np.full((down, across), len(self), dtype=np.int64)
        numbers[self.rows, self.columns] = np.arange(len(self))
        margin = {"mode": "wrap"} if periodic else {"constant_values": len(self)}
        numbers = np.pad(numbers, reach, **margin)
        places = (self.rows + reach) * numbers.shape[1] + self.columns + reach
        return TileMap(np.ascontiguousarray(numbers), np.asarray(places, dtype=np.int64))


@dataclass(frozen=True, slots=True, eq=False)
class TileMap:
    """Which tile is where.

    Attributes
    ----------
    numbers : int array, shape (down, across)
        The number of the tile at each place; where there is none, how many there are.
    places : int array, shape (n,)
        Flat index in it of each tile.
    """

    numbers: Indices
    places: Indices


def list_loaded(values: Field) -> tuple[Indices, Indices, Field]:
    """Return the cells of tiles that are not zero, in machine code's order.

    Parameters
    ----------
    values : array, shape (n, SIDE * SIDE)
        Contiguous, in single or double precision.

    Returns
    -------
    tuple of arrays
        Where the list of each tile begins, and at last how many cells there are, shape (n + 1,); how far back in the
        kernel each cell is; and its value.
    """
    precision, capacity = values.dtype.name, values.size + 1
    starts, shifts = np.empty(len(values) + 1, np.int64), np.empty(capacity, np.int64)
    loaded = np.empty(capacity, precision)
    functions("tile_kernels", precision)["list_nonzero"](len(values), values, starts, shifts, loaded)
    return starts, shifts, loaded


def count(cells: int) -> int:
    """Return the number of tiles along a side of `cells` cells."""
    return -(-cells // SIDE)
