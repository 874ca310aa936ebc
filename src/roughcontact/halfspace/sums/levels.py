"""A sum over all pairs of nodes, replaced by one over pairs of coarser nodes and a correction of near pairs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.sums.near_sum import add_near
from roughcontact.halfspace.sums.transfer import NodeGrid, interpolation, offset_weights
from roughcontact.validation import Array

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = ["GridLevel", "Kernel", "LevelSum", "coarsen"]

Offsets = npt.NDArray[np.intp]
Transfer: TypeAlias = "csr_array | None"  # none along an axis that stays as it is

# Nodes up to which a full matrix between them costs no more than another level.
COARSEST_NODES = 512
LENGTH_ROUNDING = 1 + 1e-9  # a length that is a multiple of another is so whatever their last digits


@dataclass(frozen=True, slots=True, eq=False)
class Kernel:
    """An influence function between nodes that lie some cells apart, with other values near its origin.

    Parameters
    ----------
    at : function
        Values [m/Pa] at offsets of whole cells: rows and columns from zero up, broadcast against each other.
    sign : {1, -1}
        Even along both axes, or odd along both.
    stride : tuple of int
        Cells from node to node along each axis.
    chosen : array, shape (sy, sx)
        Values at the smallest offsets [m/Pa].
    """

    at: Callable[[Offsets, Offsets], Array]
    sign: int = 1
    stride: tuple[int, int] = (1, 1)
    chosen: Array = field(default_factory=lambda: np.zeros((0, 0)))

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the values [m/Pa] at offsets of whole nodes from zero up to `shape`."""
        rows, columns = (np.arange(n) * step for n, step in zip(shape, self.stride, strict=True))
        values = self.at(rows[:, None], columns)
        ny, nx = (min(n, s) for n, s in zip(shape, self.chosen.shape, strict=True))
        values[:ny, :nx] = self.chosen[:ny, :nx]
        return values

    def matrix(self, shape: tuple[int, int]) -> Array:
        """Return the matrix [m/Pa] between all nodes of a grid of `shape`, in flat order."""
        y, x = np.divmod(np.arange(shape[0] * shape[1]), shape[1])
        rows, columns = y[:, None] - y, x[:, None] - x
        mirrored = (rows < 0) != (columns < 0)
        return np.asarray(self.table(shape)[abs(rows), abs(columns)] * np.where(mirrored, self.sign, 1))


@dataclass(frozen=True, slots=True, eq=False)
class GridLevel:
    """What leads from nodes to coarser ones and back.

    Parameters
    ----------
    transfers : pair of sparse arrays
        Interpolation along y and x; None along an axis that stays.
    taps : array, shape (ay, ax, my + 1, 2 mx + 1)
        Correction of near pairs [m/Pa], and
    sign : {1, -1}
        that of its other side: see `add_near`.
    """

    transfers: tuple[Transfer, Transfer]
    taps: Array
    sign: int

    def restrict(self, loads: Array) -> Array:
        """Return the loads on the coarser nodes (thesis, eq. A.58; its factors 2^d cancel)."""
        along_y, along_x = self.transfers
        coarse = loads if along_y is None else along_y.T @ loads
        return np.ascontiguousarray(coarse if along_x is None else (along_x.T @ coarse.T).T)

    def prolong(self, coarse: Array, loads: Array) -> Array:
        """Return the sums at the nodes from those at the coarser ones and from the loads near by."""
        along_y, along_x = self.transfers
        sums = coarse if along_x is None else (along_x @ coarse.T).T
        sums = np.ascontiguousarray(sums if along_y is None else along_y @ sums)
        add_near(loads, self.taps, self.sign, sums)
        return sums


@dataclass(frozen=True, slots=True, eq=False)
class LevelSum:
    """Levels, finest first, and the matrix between the coarsest nodes [m/Pa]."""

    levels: tuple[GridLevel, ...]
    coarsest: Array

    @classmethod
    def of(cls, kernel: Kernel, nodes: NodeGrid, order: int, near: int) -> LevelSum:
        """Return the levels for a kernel between cells; see `coarsen`."""
        levels = []
        while nodes.size > COARSEST_NODES and 2 in nodes.steps(order):
            level, nodes, kernel = coarsen(nodes, kernel, order, near)
            levels.append(level)
        return cls(tuple(levels), kernel.matrix(nodes.shape))

    def product(self, loads: Array) -> Array:
        """Return the sum over all cells of the kernel times the loads, at every cell."""
        below = [loads]
        for level in self.levels:
            below.append(level.restrict(below[-1]))
        last = below.pop()
        sums = (self.coarsest @ last.ravel()).reshape(last.shape)
        for level in reversed(self.levels):
            sums = level.prolong(sums, below.pop())
        return sums


def coarsen(nodes: NodeGrid, kernel: Kernel, order: int, near: int) -> tuple[GridLevel, NodeGrid, Kernel]:
    """Return the level below `nodes`, the coarser nodes, and the kernel between those.

    Parameters
    ----------
    nodes : NodeGrid
        So many along one axis at least that coarsening makes them fewer.
    kernel : Kernel
        Between the nodes.
    order : int
        Of the interpolation.
    near : int
        Pairs up to this many nodes apart are corrected.

    Notes
    -----
    The thesis interpolates the kernel in the source (A.55) and the sum in the target, and corrects near pairs for
    either. Here one correction does for both: what a near pair is, less what interpolation in both indices makes of
    it. So the product stays symmetric: ``K = P G P^T + C`` with a symmetric C.

    Of G the distant pairs, which are not corrected, see what their stencils reach, and the farthest ends of these
    come near its origin. There G need not be the fine kernel, whose peak no polynomial follows: it takes the values
    with which the distant pairs err least. With the peak they would err hundreds of times more; and to find the values
    takes no knowledge of the kernel.
    """
    steps = nodes.steps(order)
    width = max(h for h, step in zip(nodes.spacing, steps, strict=True) if step == 2)
    radius = near * width * LENGTH_ROUNDING

    def along(axis: int) -> _Axis:
        count, spacing, step = nodes.shape[axis], nodes.spacing[axis], steps[axis]
        cell = spacing / kernel.stride[axis]
        reach = min(int((radius + cell / 2) / spacing), count - 1)
        chosen = int(order * width * LENGTH_ROUNDING / (step * spacing))  # within half a stencil
        if step == 1:
            weights = np.eye(min(max(reach, chosen), count - 1) + 1)[None]
        else:
            weights = offset_weights(max(reach, 2 * (chosen + order - 1)), order, kernel.sign)
        weights[..., 0] *= kernel.sign > 0  # an odd kernel has no value there to choose
        distances = np.maximum(0.0, spacing * np.arange(weights.shape[1]) - cell / 2)
        return _Axis(reach, min(chosen + 1, weights.shape[2]), weights, distances)

    y, x = along(0), along(1)
    distant = np.hypot(y.distances[:, None], x.distances) > radius
    coarse = Kernel(kernel.at, kernel.sign, (kernel.stride[0] * steps[0], kernel.stride[1] * steps[1]))
    table = coarse.table((y.weights.shape[2], x.weights.shape[2]))
    table[: y.chosen, : x.chosen] = 0.0
    # Entries (a, b, i, j): a target of parity a along y and b along x, and a source i and j nodes on.
    smooth = np.einsum("aid,de,bje->abij", y.weights, table, x.weights, optimize=True)
    lacking = kernel.table(distant.shape) - smooth
    parts = np.einsum("aid,bje->abijde", y.weights[..., : y.chosen], x.weights[..., : x.chosen])
    parts = parts.reshape(*lacking.shape, -1)
    system = parts[:, :, distant].reshape(-1, parts.shape[-1])
    # An odd kernel is zero along both axes, and must stay so to the last digit.
    free, chosen = system.any(axis=0), np.zeros(system.shape[1])
    chosen[free] = np.linalg.lstsq(system[:, free], lacking[:, :, distant].ravel())[0]
    taps = np.where(distant, 0.0, lacking - parts @ chosen)[:, :, : y.reach + 1, : x.reach + 1]
    taps = np.concatenate([kernel.sign * taps[..., :0:-1], taps], axis=-1)
    transfers = [
        interpolation(n, order) if step == 2 else None for n, step in zip(nodes.shape, steps, strict=True)
    ]
    level = GridLevel((transfers[0], transfers[1]), taps, kernel.sign)
    below = Kernel(kernel.at, kernel.sign, coarse.stride, chosen.reshape(y.chosen, x.chosen))
    return level, nodes.coarsened(steps, order), below


@dataclass(frozen=True, slots=True, eq=False)
class _Axis:
    """What a level looks at along one axis."""

    reach: int  # largest offset that may be corrected
    chosen: int  # number of coarse offsets whose values are free to choose
    weights: Array  # see `offset_weights`; one parity, and nothing interpolated, along an axis that stays
    distances: Array  # from the edge of a cell, of all offsets that are looked at [m]
