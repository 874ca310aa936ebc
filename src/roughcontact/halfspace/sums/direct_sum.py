"""The sum between the cells of a list, tile by tile: exact, at a cost that follows what carries pressure."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.influence.tables import Tables
from roughcontact.halfspace.sums.tiles import Tiles, list_loaded
from roughcontact.kernels.loader import functions
from roughcontact.threads import threads

__all__ = ["DirectSum"]

Field = npt.NDArray[Any]  # of single or double precision
Indices = npt.NDArray[np.int64]

PAIRS_FOR_THREADS = 100_000  # pairs of a loaded cell and a tile from which on a second thread comes in time


@dataclass(frozen=True, slots=True, eq=False)
class DirectSum:
    """A sum in machine code over the cells of tiles that carry pressure (thesis, eq. A.6).

    Fields have the shape ``(tiles, SIDE * SIDE)``, and the precision of the kernel.

    Attributes
    ----------
    rows, columns : int arrays, shape (tiles,)
        Where the tiles are.
    kernel : array
        Influence [m/Pa] at offsets of rows from zero up, and of columns to both sides of the middle one.
    """

    rows: Indices
    columns: Indices
    kernel: Field

    @classmethod
    def over(cls, tiles: Tiles, influence: Tables, precision: str) -> DirectSum:
        """Return the sum between the cells of tiles; there is one at least."""
        rows, columns = (np.ascontiguousarray(places, np.int64) for places in (tiles.rows, tiles.columns))
        return cls(rows, columns, influence.to_both_sides(tiles.extent, precision))

    def apply(self, pressure: Field) -> Field:
        """Return the displacement [m] under `pressure` [Pa]."""
        precision, size = self.kernel.dtype.name, len(self.rows)
        given = np.ascontiguousarray(pressure, dtype=precision)
        starts, shifts, loaded = list_loaded(given)
        sums, workers = (
            np.empty(given.shape, precision),
            threads() if starts[-1] * size >= PAIRS_FOR_THREADS else 1,
        )
        where, sources = (self.rows, self.columns), (starts, shifts, loaded)
        sum_pairs = functions("tile_kernels", precision)["sum_pairs"]
        sum_pairs(size, *where, *sources, self.kernel, self.kernel.shape[1], sums, workers=workers)
        return sums
