"""Particle-mesh operators on tiles: about the half-space between the cells of a region, at a cost that follows it.

Tiles cover the region. The influence is split by Ewald's way, as in the smooth particle-mesh Ewald method (Essmann et
al., J. Chem. Phys. 103, 8577, 1995). Between tiles that lie close together a direct sum over the cells that carry
something does the short-range part. Charge assignment to nodes every few cells, a convolution on these and
interpolation from them do the long-range part. What single precision, the cut-off and splines of sixth order leave out
is some 1e-4 of the answer at most: it drives solves that exact products certify.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import divide
from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.tables import Love, Periodic, Tables
from roughcontact.halfspace.sums.direct_sum import DirectSum
from roughcontact.halfspace.sums.ewald_split import SCREENING, FreeSplit, PeriodicSplit
from roughcontact.halfspace.sums.local_inverse import DIAGONAL_CORRECTION, LocalInverse
from roughcontact.halfspace.sums.mesh import SPLINE_ORDER, Mesh, deconvolved, mesh_shape
from roughcontact.halfspace.sums.tile_inverse import TileInverse
from roughcontact.halfspace.sums.tiles import SIDE, TileMap, Tiles, count, list_loaded
from roughcontact.kernels import loader
from roughcontact.kernels.loader import functions
from roughcontact.threads import threads
from roughcontact.transforms import Convolution, padded_length
from roughcontact.validation import Mask

__all__ = ["ListParticleMesh", "ParticleMesh", "TileOperator", "particle_mesh_on"]

Single = npt.NDArray[Any]  # of single precision
Pair = tuple[int, int]
Split = FreeSplit | PeriodicSplit

LEAST_PLANE = 60_000  # cells of a plane from which on tiles may cost less (benchmarks/patches.py)
# Tiles up to which a direct sum over their cells costs less than one by nodes (benchmarks/pairs.py --tuning MOST).
MOST_DIRECT_TILES = 120
SHORT_RANGE = 3  # tiles to which the short-range part of the influence goes
TILES_FOR_THREADS = 64  # tiles from which on a second thread comes in time
WIDEST_STEP = 2 / 3  # of the screening length, between nodes at most
STEPS = (1, 2, 4)  # cells from node to node that may be taken


@dataclass(frozen=True, slots=True, eq=False)
class EwaldParts:
    """The two parts of an influence.

    Attributes
    ----------
    short_range : array, shape (SIDE**2, SIDE**2)
        At offsets of cells from the middle.
    long_range : Convolution
        Of fields on nodes.
    """

    short_range: Single
    long_range: Convolution

    @classmethod
    def of(cls, split: Split, step: Pair, lengths: Pair) -> EwaldParts:
        """Return the parts of a split influence."""
        transfer = deconvolved(split.long_range(step, lengths), lengths)
        return cls(_kernel(split), Convolution(transfer, lengths))


@dataclass(frozen=True, slots=True, eq=False)
class MeshSum:
    """A sum over the cells of tiles, in single precision; the short-range part follows the cells that are not zero.

    Attributes
    ----------
    parts : EwaldParts
    map : TileMap
        With room for the reach of the short-range part.
    mesh : Mesh
    """

    parts: EwaldParts
    map: TileMap
    mesh: Mesh

    def apply(self, values: Single) -> Single:
        """Return the sum, shape (tiles, SIDE * SIDE)."""
        code, size = functions("tile_kernels", "float32"), len(self.map.places)
        given = np.ascontiguousarray(values, dtype=np.float32)
        waves: Single = self.parts.long_range.apply(self.mesh.assign(given))
        sums = np.ascontiguousarray(self.mesh.interpolate(waves))
        numbers, workers = self.map.numbers, threads() if size >= TILES_FOR_THREADS else 1
        given_ = size, numbers, numbers.shape[1], self.map.places, SHORT_RANGE, *list_loaded(given)
        code["add_near_sources"](*given_, self.parts.short_range, sums, workers=workers)
        return sums


@dataclass(frozen=True, slots=True, eq=False)
class TileOperator:
    """A half-space between the cells of tiles, about: it drives solves.

    Fields have the shape ``(tiles, SIDE * SIDE)`` and single precision.

    Attributes
    ----------
    tiles : Tiles
    weights : float
        Area of a cell [m^2].
    forward : MeshSum or DirectSum
    inverse : TileInverse
    contraction : float
        How far a round of a solve takes an error down; exact products find what it gets wrong.
    """

    tiles: Tiles
    weights: float
    forward: MeshSum | DirectSum
    inverse: TileInverse
    contraction: float = 3e-5
    diagonal_correction: ClassVar[float] = DIAGONAL_CORRECTION
    local_inverse: ClassVar[None] = None  # `inverse` is that of the tiles
    combine: ClassVar[None] = None

    def gather(self, field: Any, beyond: float = 0.0) -> Any:
        """Return a field of the plane on the tiles, another value beyond the edge."""
        return self.tiles.gather(field, beyond)

    def scatter(self, values: Any) -> Any:
        """Return the field of the plane that has `values` on the tiles and is zero elsewhere."""
        return self.tiles.scatter(values)

    def scaled(self, values: Any, unit: float = 1.0) -> Any:
        """Return numbers over a unit, in single precision."""
        return divide(values, unit, "float32")

    def apply(self, pressure: Single) -> Single:
        """Return the displacement [m] under `pressure` [Pa]."""
        return self.forward.apply(pressure)

    def approximate_inverse(self, displacement: Single) -> Single:
        """Return a pressure [Pa] that would cause about this `displacement` [m]."""
        return self.inverse.apply(displacement)


@dataclass(frozen=True, eq=False)
class ParticleMesh:
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
        # A period holds all near tiles once: its images are in the short-range part already.
        least = (2 * SHORT_RANGE - 1) * SIDE
        fits = not self._periodic or all(n % SIDE == 0 and n >= least for n in self.grid.shape)
        return fits and 0 not in self._step and loader.is_available()

    def tiles(self, region: Mask) -> Tiles | None:
        """Return the tiles of a region; None where the whole plane costs less (benchmarks/patches.py)."""
        if region.size < LEAST_PLANE or np.count_nonzero(region) > self.filled * region.size:
            return None
        tiles, (down, across) = Tiles.of(region), (count(n) for n in region.shape)
        return tiles if len(tiles) < self.cover * down * across else None

    def on(self, tiles: Tiles) -> TileOperator:
        """Return the operator on some tiles."""
        mesh, map = Mesh.under(tiles, self._step, self._periodic), tiles.map(SHORT_RANGE, self._periodic)
        return self.around(MeshSum(self._parts, map, mesh), tiles, map)

    def around(self, forward: MeshSum | DirectSum, tiles: Tiles, map: TileMap) -> TileOperator:
        """Return the operator that sums one way or another."""
        inverse = TileInverse.over(tiles, map, self.local_inverse)
        return TileOperator(tiles, self.grid.cell_area, forward, inverse)

    @cached_property
    def _parts(self) -> EwaldParts:
        """The parts of the influence."""
        step, kernel = self._step, self.kernel
        ny, nx = mesh_shape((self.grid.shape[0], self.grid.shape[1]), step, self._periodic)
        if isinstance(kernel, Periodic):
            return EwaldParts.of(PeriodicSplit(kernel, self._reach), step, (ny, nx))
        # So much room that neither the far side of the influence nor a spline comes round.
        lengths = padded_length(ny + SPLINE_ORDER // 2 + 1), padded_length(nx + SPLINE_ORDER // 2 + 1)
        return EwaldParts.of(FreeSplit(kernel, self._reach), step, lengths)

    @property
    def _periodic(self) -> bool:
        return isinstance(self.kernel, Periodic)

    @property
    def _reach(self) -> float:
        return SHORT_RANGE * SIDE * min(self.grid.spacing)

    @property
    def _step(self) -> Pair:
        """Cells from node to node along each axis, divisors of a tile; 0 where none is short enough."""
        widest = (WIDEST_STEP * self._reach / SCREENING / d for d in self.grid.spacing)
        down, across = (max((s for s in STEPS if s <= w), default=0) for w in widest)
        return down, across


@dataclass(frozen=True, slots=True, eq=False)
class ListParticleMesh:
    """The same for a list of cells of a plane, of which all are on the tiles `whole`."""

    plane: ParticleMesh
    whole: Tiles
    influence: Tables

    def tiles(self, region: Mask) -> Tiles:
        """Return the tiles of a region of the list: to sum cell by cell would cost more."""
        return self.whole.those(region)

    def on(self, tiles: Tiles) -> TileOperator:
        """Return the operator on some tiles."""
        if len(tiles) > MOST_DIRECT_TILES or not self.influence.covers(tiles.extent):
            return self.plane.on(tiles)
        return self.plane.around(DirectSum.over(tiles, self.influence, "float32"), tiles, tiles.map(1, False))


def particle_mesh_on(
    kernel: Love | Periodic, grid: Grid, inverse: LocalInverse | None
) -> ParticleMesh | None:
    """Return what works on the tiles of a region of a half-space; None where they are not possible."""
    mesh = None if inverse is None else ParticleMesh(kernel, grid, inverse)
    return mesh if mesh is not None and mesh.possible else None


@lru_cache(maxsize=8)
def _kernel(split: Split) -> Single:
    """Return the short-range part at offsets of cells up to half the side of the kernel."""
    half, last = SIDE * SIDE // 2, SHORT_RANGE * SIDE
    table = np.zeros((half + 1, half + 1), dtype=np.float32)
    table[: last + 1, : last + 1] = split.short_range((last, last))
    offsets = np.abs(np.arange(-half, half))
    return table[offsets[:, None], offsets]
