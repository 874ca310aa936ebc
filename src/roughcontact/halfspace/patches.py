"""The half-space between the cells of a region, about: its cost follows the region, not the domain.

Tiles cover the region. Between tiles that lie close together a small matrix for each of their offsets does the near
part of the influence; nodes every few cells, and a transform of these, do the far part. What single precision, the cut
and splines of sixth order leave out is some 1e-3 of the answer at most: it drives solves that exact products certify.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import Placed, convolve, fast_even_length
from roughcontact.grid import Grid
from roughcontact.halfspace.influence import Love, Periodic
from roughcontact.halfspace.near_far import DECAY, FreeSplit, InverseSplit, PeriodicSplit
from roughcontact.halfspace.nodes import ORDER, Nodes, node_shape, sharpened
from roughcontact.halfspace.tiles import SIDE, Tiles

__all__ = ["PatchOperator", "Patches"]

Array = npt.NDArray[np.float64]
Single = npt.NDArray[Any]  # of single precision
Cells = npt.NDArray[np.intp]
Pair = tuple[int, int]
Split = FreeSplit | PeriodicSplit | InverseSplit

REACH = 2  # tiles: how far the near part of the influence goes
REACH_INVERSE = 1
STEPS = (1, 2, 4)  # cells from node to node: no more than the width of what the far part smooths


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """The two parts of an influence: matrices between near tiles, and what multiplies the waves of nodes."""

    reach: int
    blocks: dict[Pair, Single]
    far: Placed
    lengths: Pair

    @classmethod
    def of(cls, split: Split, reach: int, step: Pair, lengths: Pair) -> Parts:
        """Return the parts of a split influence."""
        far = Placed(sharpened(split.far(step, lengths), lengths))
        return cls(reach, _blocks(split, reach), far, lengths)


@dataclass(frozen=True, slots=True, eq=False)
class TileSum:
    """A sum over the cells of tiles, in single precision.

    Attributes
    ----------
    parts : Parts
    pairs : list of (offset, to, from)
        The pairs of tiles of each offset.
    nodes : Nodes
    """

    parts: Parts
    pairs: list[tuple[Pair, Cells, Cells]]
    nodes: Nodes

    def apply(self, values: Array) -> Array:
        """Return the sum, shape (tiles, SIDE * SIDE)."""
        size = float(np.abs(values).max(initial=0.0)) or 1.0  # so that single precision holds any number
        single = (values / size).astype(np.float32)
        parts, nodes = self.parts, self.nodes
        waves: Single = convolve(nodes.spread(single), parts.far, parts.lengths)
        sums = nodes.gather(waves)
        for offset, to, of in self.pairs:
            sums[to] += single[of] @ parts.blocks[offset]
        return size * sums.astype(np.float64)


@dataclass(frozen=True, slots=True, eq=False)
class PatchOperator:
    """A half-space between the cells of tiles, about.

    Fields have the shape ``(tiles, SIDE * SIDE)``; `tiles` brings them there and back.

    Attributes
    ----------
    tiles : Tiles
    weights : float
        Area of a cell [m^2].
    forward, inverse : TileSum
    """

    tiles: Tiles
    weights: float
    forward: TileSum
    inverse: TileSum

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        return self.forward.apply(pressure)

    def approximate_inverse(self, displacement: Array) -> Array:
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
    """

    kernel: Love | Periodic
    grid: Grid

    @property
    def possible(self) -> bool:
        """Whether cells are not too slender for nodes, and tiles fit the period."""
        fits = not self._periodic or not any(n % SIDE for n in self.grid.shape)
        return fits and 0 not in self._step

    def on(self, tiles: Tiles) -> PatchOperator:
        """Return the operator on some tiles."""
        nodes = Nodes.under(tiles, self._step, self._periodic)
        forward, inverse = (
            TileSum(parts, tiles.neighbours(parts.reach, self._periodic), nodes) for parts in self._parts
        )
        return PatchOperator(tiles, self.grid.cell_area, forward, inverse)

    @cached_property
    def _parts(self) -> tuple[Parts, Parts]:
        """The parts of the influence and of its inverse."""
        (dy, dx), step, kernel = self.grid.spacing, self._step, self.kernel
        ny, nx = node_shape((self.grid.shape[0], self.grid.shape[1]), step, self._periodic)
        split: Split
        if isinstance(kernel, Periodic):
            split, lengths, box = PeriodicSplit(kernel, self._reach), (ny, nx), (ny, nx)
        else:
            split = FreeSplit(kernel, self._reach)
            # So much room that neither the far side of the influence nor a spline comes round.
            lengths = fast_even_length(2 * ny + ORDER), fast_even_length(2 * nx + ORDER)
            box = fast_even_length(ny), fast_even_length(nx)
        inverse = InverseSplit(kernel.modulus, (dy, dx), self._reach)
        return Parts.of(split, REACH, step, lengths), Parts.of(inverse, REACH_INVERSE, step, box)

    @property
    def cover(self) -> float:
        """Part of the plane's tiles from which on transforms of the plane cost no more (benchmarks/patches.py)."""
        return 0.3 if self._periodic else 0.7

    @property
    def _periodic(self) -> bool:
        return isinstance(self.kernel, Periodic)

    @property
    def _reach(self) -> float:
        return REACH * SIDE * min(self.grid.spacing)

    @property
    def _step(self) -> Pair:
        """Cells from node to node along each axis, divisors of a tile; 0 where none is short enough."""
        widest = (self._reach / DECAY / d for d in self.grid.spacing)
        down, across = (max((s for s in STEPS if s <= w), default=0) for w in widest)
        return down, across


@lru_cache(maxsize=32)
def _blocks(split: Split, reach: int) -> dict[Pair, Single]:
    """Return the matrices from the cells of one tile to those of another, for each offset up to `reach` tiles."""
    last = reach * SIDE
    table = np.zeros((last + SIDE, last + SIDE), dtype=np.float32)
    table[: last + 1, : last + 1] = split.near((last, last))
    y, x = np.divmod(np.arange(SIDE * SIDE), SIDE)
    offsets = range(-reach, reach + 1)
    return {
        (dy, dx): table[np.abs(y[:, None] + dy * SIDE - y), np.abs(x[:, None] + dx * SIDE - x)]
        for dy in offsets
        for dx in offsets
    }
