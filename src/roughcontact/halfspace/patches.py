"""The half-space between the cells of a region, about: its cost follows the region, not the domain.

Tiles cover the region. Between tiles that lie close together a small matrix for each of their offsets does the near
part of the influence; nodes every few cells, and a transform of these, do the far part. What single precision, the cut
and splines of sixth order leave out is some 1e-4 of the answer at most: it drives solves that exact products certify.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import Placed, convolve, fast_even_length
from roughcontact.grid import Grid
from roughcontact.halfspace.influence import Love, Periodic
from roughcontact.halfspace.near_far import DECAY, FreeSplit, InverseSplit, PeriodicSplit
from roughcontact.halfspace.nodes import ORDER, Nodes, node_shape, sharpened
from roughcontact.halfspace.tiles import SIDE, Tiles
from roughcontact.threads import spread

__all__ = ["PatchOperator", "Patches"]

Array = npt.NDArray[np.float64]
Single = npt.NDArray[Any]  # of single precision
Cells = npt.NDArray[np.intp]
Pair = tuple[int, int]
Pairs = list[tuple[Pair, Cells, Cells]]
Split = FreeSplit | PeriodicSplit | InverseSplit

REACH = 3  # tiles: how far the near part of the influence goes
REACH_INVERSE = 1
SMOOTH_INVERSE = 2  # tiles: what the far part of the inverse smooths, as a reach
GROUP = 256  # tiles whose sums one thread adds up: as many as its cache holds
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
    groups : list of lists of (offset, to, from)
        For some tiles each, the pairs of each offset that lead to them.
    nodes : Nodes
    """

    parts: Parts
    groups: list[Pairs]
    nodes: Nodes

    @classmethod
    def over(cls, tiles: Tiles, parts: Parts, nodes: Nodes, periodic: bool) -> TileSum:
        """Return the sum over tiles."""
        pairs = tiles.neighbours(parts.reach, periodic)
        ends = np.arange(GROUP, len(tiles), GROUP)
        groups: list[Pairs] = [[] for _ in range(len(ends) + 1)]
        for offset, to, of in pairs:  # in the order of the tiles that they lead to
            cuts = np.searchsorted(to, ends)
            for group, *some in zip(groups, np.split(to, cuts), np.split(of, cuts), strict=True):
                if len(some[0]):
                    group.append((offset, some[0], some[1]))
        return cls(parts, groups, nodes)

    def apply(self, values: Single) -> Single:
        """Return the sum, shape (tiles, SIDE * SIDE)."""
        parts, nodes = self.parts, self.nodes
        waves: Single = convolve(nodes.spread(values), parts.far, parts.lengths)
        sums = nodes.gather(waves)

        def add_near(pairs: Pairs) -> None:
            for offset, to, of in pairs:
                sums[to] += values[of] @ parts.blocks[offset]

        spread(add_near, self.groups)
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
    forward, inverse : TileSum
    gain : float
        How far a round of a solve takes an error down; exact products find what it gets wrong.
    """

    tiles: Tiles
    weights: float
    forward: TileSum
    inverse: TileSum
    gain: float = 3e-5

    def gather(self, field: Any) -> Any:
        """Return a field of the plane on the tiles, zero beyond the edge."""
        return self.tiles.gather(field)

    def scatter(self, values: Any) -> Any:
        """Return the field of the plane that has `values` on the tiles and is zero elsewhere."""
        return self.tiles.scatter(values)

    def narrow(self, values: Any) -> Any:
        """Return numbers in single precision."""
        return values.astype(np.float32)

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
    cover : float
        Part of the plane's tiles up to which they cost less than the plane (benchmarks/patches.py).
    """

    kernel: Love | Periodic
    grid: Grid
    cover: ClassVar[float] = 0.1

    @property
    def possible(self) -> bool:
        """Whether cells are not too slender for nodes, and tiles fit the period."""
        fits = not self._periodic or not any(n % SIDE for n in self.grid.shape)
        return fits and 0 not in self._step

    def on(self, tiles: Tiles) -> PatchOperator:
        """Return the operator on some tiles."""
        nodes = Nodes.under(tiles, self._step, self._periodic)
        forward, inverse = (TileSum.over(tiles, parts, nodes, self._periodic) for parts in self._parts)
        return PatchOperator(tiles, self.grid.cell_area, forward, inverse)

    @cached_property
    def _parts(self) -> tuple[Parts, Parts]:
        """The parts of the influence and of its inverse."""
        (dy, dx), step, kernel = self.grid.spacing, self._step, self.kernel
        ny, nx = node_shape((self.grid.shape[0], self.grid.shape[1]), step, self._periodic)
        split: Split
        if isinstance(kernel, Periodic):
            split, lengths, box = PeriodicSplit(kernel, self._reach(REACH)), (ny, nx), (ny, nx)
        else:
            split = FreeSplit(kernel, self._reach(REACH))
            # So much room that neither the far side of the influence nor a spline comes round.
            lengths = fast_even_length(2 * ny + ORDER), fast_even_length(2 * nx + ORDER)
            box = fast_even_length(ny), fast_even_length(nx)
        inverse = InverseSplit(kernel.modulus, (dy, dx), self._reach(SMOOTH_INVERSE))
        return Parts.of(split, REACH, step, lengths), Parts.of(inverse, REACH_INVERSE, step, box)

    @property
    def _periodic(self) -> bool:
        return isinstance(self.kernel, Periodic)

    def _reach(self, tiles: int) -> float:
        return tiles * SIDE * min(self.grid.spacing)

    @property
    def _step(self) -> Pair:
        """Cells from node to node along each axis, divisors of a tile; 0 where none is short enough."""
        widest = (self._reach(SMOOTH_INVERSE) / DECAY / d for d in self.grid.spacing)
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
