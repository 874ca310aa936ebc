"""The half-space between the cells of a region, about: its cost follows the region, not the domain.

Tiles cover the region. Between tiles that lie close together a direct sum over the cells that carry something does the
near part of the influence; nodes every few cells, and a transform of these, do the far part. What single precision, the
cut and splines of sixth order leave out is some 1e-4 of the answer at most: it drives solves that exact products
certify.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import over
from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.tables import Love, Periodic, Tables
from roughcontact.halfspace.sums.direct_sum import DirectSum
from roughcontact.halfspace.sums.ewald_split import DECAY, FreeSplit, PeriodicSplit
from roughcontact.halfspace.sums.local_inverse import RELIEF, LocalInverse
from roughcontact.halfspace.sums.mesh import ORDER, Nodes, node_shape, sharpened
from roughcontact.halfspace.sums.tile_inverse import TileInverse
from roughcontact.halfspace.sums.tiles import SIDE, TileMap, Tiles, count, list_loaded
from roughcontact.kernels import loader
from roughcontact.kernels.loader import functions
from roughcontact.threads import spread
from roughcontact.transforms import Convolution, padded_length

__all__ = ["ListPatches", "PatchOperator", "Patches", "patches_of"]

Mask = npt.NDArray[np.bool_]
Single = npt.NDArray[Any]  # of single precision
Pair = tuple[int, int]
Split = FreeSplit | PeriodicSplit

LEAST = 60_000  # cells of a plane from which on tiles may cost less
DIRECT = 120  # tiles up to which a direct sum over their cells costs less than one by nodes (tried by hand)
REACH = 3  # tiles: how far the near part of the influence goes
GROUP = 512  # tiles whose sums one thread adds up at a time
SMOOTH = 2 / 3  # of the width of what the far part smooths: how far apart nodes may be
STEPS = (1, 2, 4)  # cells from node to node: no more than the width of what the far part smooths


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """The two parts of an influence.

    Attributes
    ----------
    near : array, shape (SIDE**2, SIDE**2)
        At offsets of cells from the middle.
    far : Convolution
        Of fields on nodes.
    """

    near: Single
    far: Convolution

    @classmethod
    def of(cls, split: Split, step: Pair, lengths: Pair) -> Parts:
        """Return the parts of a split influence."""
        far = Convolution(sharpened(split.far(step, lengths), lengths), lengths)
        return cls(_kernel(split), far)


@dataclass(frozen=True, slots=True, eq=False)
class TileSum:
    """A sum over the cells of tiles, in single precision; what is near follows the cells that are not zero.

    Attributes
    ----------
    parts : Parts
    map : TileMap
        With room for the reach of the near part.
    nodes : Nodes
    """

    parts: Parts
    map: TileMap
    nodes: Nodes

    def apply(self, values: Single) -> Single:
        """Return the sum, shape (tiles, SIDE * SIDE)."""
        code, size = functions("tile_kernels", "float32"), len(self.map.places)
        given = np.ascontiguousarray(values, dtype=np.float32)
        waves: Single = self.parts.far.apply(self.nodes.spread(given))
        sums = np.ascontiguousarray(self.nodes.gather(waves))
        sources, add_near_sources = list_loaded(given), code["add_near_sources"]
        numbers, places = self.map.numbers, self.map.places

        def add_near(start: int) -> None:
            some = start, min(start + GROUP, size), numbers, numbers.shape[1], places, size, REACH
            add_near_sources(*some, *sources, self.parts.near, sums)

        spread(add_near, range(0, size, GROUP))
        return sums


@dataclass(frozen=True, slots=True, eq=False)
class PatchOperator:
    """A half-space between the cells of tiles, about: it drives solves.

    Fields have the shape ``(tiles, SIDE * SIDE)`` and single precision.

    Attributes
    ----------
    tiles : Tiles
    weights : float
        Area of a cell [m^2].
    forward : TileSum or DirectSum
    inverse : TileInverse
    contraction : float
        How far a round of a solve takes an error down; exact products find what it gets wrong.
    """

    tiles: Tiles
    weights: float
    forward: TileSum | DirectSum
    inverse: TileInverse
    contraction: float = 3e-5
    diagonal_correction: ClassVar[float] = RELIEF

    def gather(self, field: Any, beyond: float = 0.0) -> Any:
        """Return a field of the plane on the tiles, another value beyond the edge."""
        return self.tiles.gather(field, beyond)

    def scatter(self, values: Any) -> Any:
        """Return the field of the plane that has `values` on the tiles and is zero elsewhere."""
        return self.tiles.scatter(values)

    def scaled(self, values: Any, unit: float = 1.0) -> Any:
        """Return numbers over a unit, in single precision."""
        return over(values, unit, "float32")

    def apply(self, pressure: Single) -> Single:
        """Return the displacement [m] under `pressure` [Pa]."""
        return self.forward.apply(pressure)

    def approximate_inverse(self, displacement: Single) -> Single:
        """Return a pressure [Pa] that would cause about this `displacement` [m]."""
        return self.inverse.apply(displacement)


@dataclass(frozen=True, eq=False)
class Patches:
    """What all regions of a plane have in common.

    Parameters
    ----------
    kernel : Love or Periodic
        Its boundary condition is the one that counts.
    grid : Grid
    local_inverse : LocalInverse
        Of the whole plane.
    cover : float
        Part of the plane's tiles up to which they may cost less than the plane.
    """

    kernel: Love | Periodic
    grid: Grid
    local_inverse: LocalInverse
    cover: ClassVar[float] = 0.3

    @property
    def filled(self) -> float:
        """Part of the plane's cells up to which they do: a product on a periodic plane is not padded."""
        return 0.03 if self._periodic else 0.1

    @property
    def possible(self) -> bool:
        """Whether cells are not too slender for nodes, tiles fit the period, and there is machine code."""
        # A period holds all near tiles once: its images are in the near part already.
        least = (2 * REACH - 1) * SIDE
        fits = not self._periodic or all(n % SIDE == 0 and n >= least for n in self.grid.shape)
        return fits and 0 not in self._step and loader.is_available()

    def tiles(self, region: Mask) -> Tiles | None:
        """Return the tiles of a region; None where the whole plane costs less (benchmarks/patches.py)."""
        if region.size < LEAST or np.count_nonzero(region) > self.filled * region.size:
            return None
        tiles, (down, across) = Tiles.of(region), (count(n) for n in region.shape)
        return tiles if len(tiles) < self.cover * down * across else None

    def on(self, tiles: Tiles) -> PatchOperator:
        """Return the operator on some tiles."""
        nodes, map = Nodes.under(tiles, self._step, self._periodic), tiles.map(REACH, self._periodic)
        return self.around(TileSum(self._parts, map, nodes), tiles, map)

    def around(self, forward: TileSum | DirectSum, tiles: Tiles, map: TileMap) -> PatchOperator:
        """Return the operator that sums one way or another."""
        inverse = TileInverse.over(tiles, map, self.local_inverse)
        return PatchOperator(tiles, self.grid.cell_area, forward, inverse)

    @cached_property
    def _parts(self) -> Parts:
        """The parts of the influence."""
        step, kernel = self._step, self.kernel
        ny, nx = node_shape((self.grid.shape[0], self.grid.shape[1]), step, self._periodic)
        if isinstance(kernel, Periodic):
            return Parts.of(PeriodicSplit(kernel, self._reach), step, (ny, nx))
        # So much room that neither the far side of the influence nor a spline comes round.
        lengths = padded_length(ny + ORDER // 2 + 1), padded_length(nx + ORDER // 2 + 1)
        return Parts.of(FreeSplit(kernel, self._reach), step, lengths)

    @property
    def _periodic(self) -> bool:
        return isinstance(self.kernel, Periodic)

    @property
    def _reach(self) -> float:
        return REACH * SIDE * min(self.grid.spacing)

    @property
    def _step(self) -> Pair:
        """Cells from node to node along each axis, divisors of a tile; 0 where none is short enough."""
        widest = (SMOOTH * self._reach / DECAY / d for d in self.grid.spacing)
        down, across = (max((s for s in STEPS if s <= w), default=0) for w in widest)
        return down, across


@dataclass(frozen=True, slots=True, eq=False)
class ListPatches:
    """The same for a list of cells of a plane, of which all are on the tiles `whole`."""

    plane: Patches
    whole: Tiles
    influence: Tables

    def tiles(self, region: Mask) -> Tiles:
        """Return the tiles of a region of the list: to sum cell by cell would cost more."""
        return self.whole.those(region)

    def on(self, tiles: Tiles) -> PatchOperator:
        """Return the operator on some tiles."""
        if len(tiles) > DIRECT or not self.influence.covers(tiles.extent):
            return self.plane.on(tiles)
        return self.plane.around(DirectSum.over(tiles, self.influence, "float32"), tiles, tiles.map(1, False))


def patches_of(kernel: Love | Periodic, grid: Grid, inverse: LocalInverse | None) -> Patches | None:
    """Return what works on the tiles of a region of a half-space; None where they are not possible."""
    patches = None if inverse is None else Patches(kernel, grid, inverse)
    return patches if patches is not None and patches.possible else None


@lru_cache(maxsize=8)
def _kernel(split: Split) -> Single:
    """Return the near part at offsets of cells up to half the side of the kernel."""
    half, last = SIDE * SIDE // 2, REACH * SIDE
    table = np.zeros((half + 1, half + 1), dtype=np.float32)
    table[: last + 1, : last + 1] = split.near((last, last))
    offsets = np.abs(np.arange(-half, half))
    return table[offsets[:, None], offsets]
