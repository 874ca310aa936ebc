"""Between nodes and nodes twice as far apart: high-order interpolation and its transpose."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.validation import Array

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = ["NodeGrid", "coarse_count", "interpolation", "offset_weights"]


# Axes are coarsened together while their spacings differ by less than this factor; otherwise the finer one goes first.
SAME_SPACING = math.sqrt(2)


@dataclass(frozen=True, slots=True)
class NodeGrid:
    """Equally spaced nodes along two axes: the centres of cells, or every second one of finer nodes.

    Parameters
    ----------
    shape : tuple of int
        Number of nodes along each axis.
    spacing : tuple of float
        Their distance along each axis [m].
    """

    shape: tuple[int, int]
    spacing: tuple[float, float]

    @property
    def size(self) -> int:
        """Number of nodes."""
        return self.shape[0] * self.shape[1]

    def steps(self, order: int) -> tuple[int, int]:
        """Return 2 for each axis to coarsen next and 1 for the others: those that it would not shorten."""
        able = [coarse_count(n, order) < n for n in self.shape]
        finest = min((h for h, yes in zip(self.spacing, able, strict=True) if yes), default=0.0)
        y, x = (
            2 if yes and h < SAME_SPACING * finest else 1 for h, yes in zip(self.spacing, able, strict=True)
        )
        return y, x

    def coarsened(self, steps: tuple[int, int], order: int) -> NodeGrid:
        """Return the coarser nodes, with those outside that the interpolation needs."""
        y, x = (n if step == 1 else coarse_count(n, order) for n, step in zip(self.shape, steps, strict=True))
        return NodeGrid((y, x), (self.spacing[0] * steps[0], self.spacing[1] * steps[1]))


def coarse_count(count: int, order: int) -> int:
    """Return how many coarse nodes the interpolation to `count` nodes needs."""
    return count // 2 + order - 1


def interpolation(count: int, order: int) -> csr_array:
    """Return Lagrange's interpolation from every second node to all of them (thesis, eq. A.52).

    Its transpose restricts loads on the nodes to the coarse ones (A.53).

    Parameters
    ----------
    count : int
        Number of nodes.
    order : int
        Number of coarse nodes that an odd node takes part in; even. Even nodes are coarse nodes themselves.

    Returns
    -------
    sparse array, shape (count, coarse_count(count, order))
        Coarse node c lies at node ``2 (c + 1) - order``. Some lie outside the grid: without this ring, pressures
        that do not vanish at the edge would be off by a per cent.
    """
    from scipy.sparse import csr_array

    even, odd = np.arange(0, count, 2), np.arange(1, count, 2)
    rows = np.concatenate([even, np.repeat(odd, order)])
    columns = np.concatenate([even // 2 + order // 2 - 1, np.add.outer(odd // 2, np.arange(order)).ravel()])
    values = np.concatenate([np.ones(len(even)), np.tile(_midpoint_weights(order), len(odd))])
    return csr_array((values, (rows, columns)), shape=(count, coarse_count(count, order)))


def offset_weights(reach: int, order: int, sign: int) -> Array:
    """Return what a kernel on the coarse nodes becomes when both its indices are interpolated.

    Parameters
    ----------
    reach : int
        Largest offset of a source from its target, in nodes.
    order : int
        Of the interpolation.
    sign : {1, -1}
        Of the kernel on the other side: whether it is even or odd.

    Returns
    -------
    array, shape (2, reach + 1, distances)
        Entry (a, o, d): weight of the kernel at a distance of d coarse nodes, for a target at an even (a = 0) or
        odd node and a source o nodes on. The other side mirrors this one: an odd node's weights are symmetric.
    """
    nodes = interpolation(reach + 2, order).toarray()
    zero = nodes.shape[1] - 1  # where a full correlation keeps the distance zero
    weights = np.zeros((2, reach + 1, zero + 1))
    for parity in range(2):
        for offset in range(reach + 1):
            pairs = np.correlate(nodes[parity + offset], nodes[parity], "full")
            weights[parity, offset] = pairs[zero:]
            weights[parity, offset, 1:] += sign * pairs[:zero][::-1]
    farthest = np.flatnonzero(weights.any(axis=(0, 1)))[-1]
    return weights[..., : farthest + 1]


def _midpoint_weights(order: int) -> Array:
    """Return Lagrange's weights of the values at ..., -3, -1, 1, 3, ... for the one at 0."""
    x = 2.0 * np.arange(order) - (order - 1)
    itself = np.eye(order, dtype=bool)
    return np.asarray(np.prod(np.where(itself, 1.0, -x) / np.where(itself, 1.0, x[:, None] - x), axis=1))
