"""The local inverse of a half-space where fields lie tile by tile."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.sums.local_inverse import BLOCK, LocalInverse
from roughcontact.halfspace.sums.tiles import SIDE, TileMap, Tiles, count
from roughcontact.kernels.constants import NEAR_ROWS
from roughcontact.kernels.loader import functions
from roughcontact.threads import threads

__all__ = ["TileInverse"]

Single = npt.NDArray[Any]  # of single precision
Indices = npt.NDArray[np.int64]

TILES_FOR_THREADS = 256  # tiles from which on a second thread comes in time


@dataclass(frozen=True, slots=True, eq=False)
class TileInverse:
    """What pressure a displacement on tiles takes, about; fields have the shape ``(tiles, SIDE * SIDE)``.

    Attributes
    ----------
    local : LocalInverse
    map : TileMap
        With room for one tile at least.
    places : int array, shape (tiles,)
        Where the first block of each is among the blocks of the plane.
    shape : tuple of int
        Blocks of the plane.
    """

    local: LocalInverse
    map: TileMap
    places: Indices
    shape: tuple[int, int]

    @classmethod
    def over(cls, tiles: Tiles, map: TileMap, local: LocalInverse) -> TileInverse:
        """Return the inverse on some tiles."""
        many = SIDE // BLOCK
        down, across = (count(n) * many for n in tiles.shape)
        places = tiles.rows * (many * across) + tiles.columns * many
        return cls(local, map, np.asarray(places, dtype=np.int64), (down, across))

    def apply(self, displacement: Single) -> Single:
        """Return the pressure [Pa] under a displacement [m] that is zero outside the region."""
        code, size = functions("tile_kernels", "float32"), len(self.places)
        # One tile more, of zeros, stands for all that are not there.
        field = np.zeros((size + 1, SIDE * SIDE), dtype=np.float32)
        field[:size] = displacement
        pressure = np.empty(displacement.shape, dtype=np.float32)
        weights = self.local.near.astype(np.float32)
        numbers, places = self.map.numbers, self.map.places
        workers = threads() if size >= TILES_FOR_THREADS else 1
        scratch = np.empty((workers, NEAR_ROWS), dtype=np.float32)
        map_ = numbers, numbers.shape[1], places
        code["sum_stencil_on_tiles"](size, *map_, field, pressure, weights, scratch, workers=workers)
        if self.local.far is not None:
            blocks: Single = np.zeros(self.shape, dtype=np.float32)
            all_ = size, self.places, self.shape[1], BLOCK
            code["sum_blocks_of_tiles"](*all_, field, blocks, workers=workers)
            far = np.ascontiguousarray(self.local.far.apply(blocks))
            code["add_blocks_to_tiles"](*all_, pressure, far, workers=workers)
        return pressure
