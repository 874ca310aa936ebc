"""What pressure a displacement takes, about, by a sum over near cells: a preconditioner without transforms.

``E* q/2`` falls off with the third power of distance: a few cells on each side, with weights fitted to it, are nearly
as good. On large planes, where a wide region may answer with long waves, blocks of cells carry these.

On a region that would be the inverse if cells outside stayed where they are, and they are free to move: with Q the
inverse on the whole plane, it is ``Q_RR - Q_RO Q_OO^-1 Q_OR``. What is taken off is the more the nearer the edge. Most
of what ``Q_RR`` answers to a constant, cell by cell, stands for it here (`benchmarks/ideas.py` shows the steps that it
saves). What remains is definite as far as weights of other cells are negative, and all but the smallest are. Fields in
machine code do that, see `roughcontact.solver.compiled_vectors`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid
from roughcontact.halfspace.influence.tables import ALL, definite, definite_columns, wavenumbers
from roughcontact.kernels.active_cells import ActiveCells, add_blocks, sum_blocks, sum_stencil
from roughcontact.kernels.constants import REACH
from roughcontact.transforms import Convolution, fast_even_length
from roughcontact.validation import Array

__all__ = ["BLOCK", "DIAGONAL_CORRECTION", "LocalInverse", "local_inverse"]

Field = npt.NDArray[Any]  # of single or double precision
Pair = tuple[int, int]

FITTED = 64  # cells of the longest wave that the weights are fitted to
BLOCK = 4  # cells to the side of a block
# Exponent over the square of a wavenumber times a block: how short waves of blocks are damped.
BLOCK_DAMPING = 0.125
# Of its answer to a constant on a region, taken off its diagonal (benchmarks/ideas.py).
DIAGONAL_CORRECTION = 0.7
# Cells of a plane from which on long waves are worth a transform of blocks.
LARGE_PLANE = 2**19


@dataclass(frozen=True, slots=True, eq=False)
class LocalInverse:
    """A symmetric and definite inverse of a half-space, about.

    Attributes
    ----------
    near : array, shape (REACH + 1, REACH + 1)
        Weights [Pa/m] of the cells so far away.
    far : Convolution, optional
        From the sums over blocks of displacements [m] to the pressure [Pa] that is added to each of their cells.
    """

    near: Array
    far: Convolution | None

    @classmethod
    def of(cls, modulus: float, shape: Pair, spacing: tuple[float, ...]) -> LocalInverse:
        """Return the inverse for a plane of cells.

        Parameters
        ----------
        modulus : float
            Reduced modulus E* [Pa].
        shape, spacing : tuple
            Cells along each axis, and their size [m].
        """
        large = math.prod(shape) >= LARGE_PLANE
        near = modulus / 2 / spacing[1] * _near(spacing[0] / spacing[1], large)
        if not large:
            return cls(near, None)
        blocks = tuple(fast_even_length(-(-n // BLOCK)) for n in shape)
        box = blocks[0], blocks[1]
        return cls(near, Convolution(partial(_far, modulus, box, tuple(BLOCK * d for d in spacing)), box))

    def on(self, region: ActiveCells, field: Field) -> Field:
        """Return the pressure [Pa] on a region under a displacement [m] that is zero elsewhere, and has margins."""
        pressure = sum_stencil(region, field, self.near.astype(field.dtype))
        if self.far is not None:
            add_blocks(region, pressure, self.far.apply(sum_blocks(region, field, BLOCK)), BLOCK)
        return pressure


def local_inverse(modulus: float, grid: Grid) -> LocalInverse | None:
    """Return the inverse for the cells of a half-space; None for a single row, which has no plane of waves."""
    ny, nx = grid.shape
    return LocalInverse.of(modulus, (ny, nx), grid.spacing) if min(ny, nx) > 1 else None


def _far(modulus: float, box: Pair, spacing: tuple[float, ...], columns: slice = ALL) -> Array:
    """Return the transfer function of blocks [Pa/m]; of some columns, if no others are wanted."""
    q = definite_columns(box, spacing, columns)
    down, across = (np.exp(-BLOCK_DAMPING * (2 * math.pi / n * np.arange(n // 2 + 1)) ** 2) for n in box)
    return np.asarray(modulus / 2 / BLOCK**2 * q * np.outer(down, across[columns]))


@lru_cache(maxsize=64)
def _near(ratio: float, large: bool) -> Array:
    """Return the weights of near cells, as long as `ratio` widths, for ``q``; with blocks for the rest of it."""
    wanted = definite(wavenumbers((FITTED, FITTED), (ratio, 1.0)))
    if not large:
        return _fitted(wanted, wanted)
    angle = 2 * math.pi / FITTED * np.arange(FITTED // 2 + 1) * BLOCK
    damped = np.sinc(angle / (2 * math.pi)) ** 2 * np.exp(-BLOCK_DAMPING * angle**2)
    seen = np.where(angle <= math.pi, damped, 0.0)
    return _fitted(wanted - wanted * np.outer(seen, seen), wanted)


def _fitted(wanted: Array, scale: Array) -> Array:
    """Return the weights whose transform is the nearest to the one that is wanted, over the scale of each wave."""
    cosines = np.cos(2 * math.pi / FITTED * np.outer(np.arange(REACH + 1), np.arange(FITTED // 2 + 1)))
    cosines[1:] *= 2
    waves = np.einsum("iy,jx->ijyx", cosines, cosines).reshape((REACH + 1) ** 2, -1)
    often = np.where(np.arange(FITTED // 2 + 1) % (FITTED // 2) == 0, 1.0, 2.0)
    share = np.sqrt(np.outer(often, often)).ravel() / scale.ravel()
    near = np.linalg.lstsq((waves * share).T, wanted.ravel() * share, rcond=None)[0]
    # Definite, whatever the fit: no wave is answered with less than nothing.
    near[0] += max(0.0, -1.01 * float((near @ waves).min()))
    return np.asarray(near.reshape(REACH + 1, REACH + 1))
