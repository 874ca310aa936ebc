"""The mesh under tiles: charge assignment to its nodes and interpolation from them, by B-splines (Essmann 1995)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.sums.tiles import SIDE, Tiles, count
from roughcontact.validation import Array

__all__ = ["SPLINE_ORDER", "Mesh", "deconvolved", "mesh_shape"]

Single = npt.NDArray[Any]  # of single precision
Cells = npt.NDArray[np.intp]
Pair = tuple[int, int]

SPLINE_ORDER = 6  # of the B-splines, nodes of a cell along each axis


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """Nodes every few cells, and how they lie under tiles.

    Attributes
    ----------
    shape : tuple of int
        Nodes along each axis.
    indices : int array, shape (tiles, m)
        The nodes that each tile is assigned to.
    weights : array, shape (SIDE * SIDE, m)
        The splines of these at the cells of a tile.
    """

    shape: Pair
    indices: Cells
    weights: Single

    @classmethod
    def under(cls, tiles: Tiles, step: Pair, periodic: bool) -> Mesh:
        """Return the nodes of a plane, `step` cells apart, and beyond its edges unless it is `periodic`."""
        shape, before = mesh_shape(tiles.shape, step, periodic), SPLINE_ORDER // 2 - 1
        ky, kx = (np.arange(-before, SIDE // s + before + 1) for s in step)
        y = tiles.rows[:, None] * (SIDE // step[0]) + ky
        x = tiles.columns[:, None] * (SIDE // step[1]) + kx
        y, x = (y % shape[0], x % shape[1]) if periodic else (y + before, x + before)
        indices = y[:, :, None] * shape[1] + x[:, None, :]
        weights = np.kron(_splines(ky, step[0]), _splines(kx, step[1])).T
        return cls(
            shape,
            indices.reshape(len(tiles), -1),
            np.ascontiguousarray(weights, dtype=np.float32),
        )

    def assign(self, values: Single) -> Single:
        """Return the field on the nodes to which values on the tiles are assigned (charge assignment)."""
        parts = (values @ self.weights).ravel()
        return (
            np.bincount(self.indices.ravel(), parts, math.prod(self.shape))
            .reshape(self.shape)
            .astype(np.float32)
        )

    def interpolate(self, field: Single) -> Single:
        """Return a field on the nodes in the cells of the tiles: the transpose of `assign`."""
        return np.asarray(field.ravel()[self.indices] @ self.weights.T)


def mesh_shape(cells: Pair, step: Pair, periodic: bool) -> Pair:
    """Return how many nodes a plane takes."""
    ny, nx = (
        n // s if periodic else count(n) * (SIDE // s) + SPLINE_ORDER - 1
        for n, s in zip(cells, step, strict=True)
    )
    return ny, nx


def deconvolved(transform: Array, lengths: Pair) -> Array:
    """Return the transfer function of a kernel on nodes over those of the splines before and after it (deconvolution).

    Parameters
    ----------
    transform : array, shape (lengths[0] // 2 + 1, lengths[1] // 2 + 1)
        Of the kernel.
    lengths : tuple of int
        Nodes along each axis.
    """
    ny, nx = lengths
    return np.asarray(transform / _spectrum(ny)[:, None] / _spectrum(nx))


def _spectrum(length: int) -> Array:
    """Return the square of the transform of a spline at the nodes."""
    angle = 2 * math.pi * np.arange(length // 2 + 1) / length
    k = np.arange(1, SPLINE_ORDER // 2)
    values = _spline(np.arange(SPLINE_ORDER // 2))
    return np.asarray((values[0] + 2 * np.cos(angle[:, None] * k) @ values[1:]) ** 2)


def _splines(nodes: Cells, step: int) -> Array:
    """Return the splines of nodes, counted from the edge of a tile, at its cells, shape (nodes, SIDE)."""
    return _spline((np.arange(SIDE) + 0.5) / step - nodes[:, None])


def _spline(x: npt.ArrayLike) -> Array:
    """Return the central B-spline at distances of `x` nodes."""
    n, inward = SPLINE_ORDER, SPLINE_ORDER / 2 - np.abs(np.asarray(x, dtype=float))
    # Its truncated powers, from the nearer end, where no more than half of them differ from zero and little cancels.
    powers = ((-1) ** k * math.comb(n, k) * np.maximum(inward - k, 0) ** (n - 1) for k in range(n // 2))
    return np.asarray(sum(powers) / math.factorial(n - 1))
