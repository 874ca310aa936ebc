"""Blocks of cells as one cell: which height they have."""

from __future__ import annotations

from functools import reduce

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace

__all__ = ["lowest", "raised"]

Array = npt.NDArray[np.float64]

STANDING_OUT = 2.0  # times as far as its cells stand out of it a block is raised above its plane
SLAB = 128  # rows of cells that are worked on at once, even


def raised(separation: Array, factors: tuple[int, ...]) -> Array:
    """Return a separation for each block of cells, from which the contact of the cells is best guessed.

    Where long waves carry the contact that is the mean: slopes do not count. Where the cells of a block are rough it is
    their summits that touch, and the block is raised above the plane through them by twice as far as they stand out of
    it, never above its highest cell. Half as much misleads on surfaces without long waves, H < 0 (tried by hand); the
    highest cell itself costs smooth ones up to twice the steps (`benchmarks/ideas.py`).

    Parameters
    ----------
    separation : array
        Of cells [m], infinite where one is missing.
    factors : tuple of int
        Cells of a block along each axis, 1, 2 or 4: blocks of four are blocks of blocks. Only blocks of two by two tell
        slopes from roughness, and only where they are whole; of others it is the lowest separation.
    """
    for _ in range(max(factors).bit_length() - 1):
        halves = tuple(min(f, 2) for f in factors)
        separation = _raised(separation, halves)
        factors = tuple(f // half for f, half in zip(factors, halves, strict=True))
    return separation


def _raised(separation: Array, factors: tuple[int, ...]) -> Array:
    low = lowest(separation, factors)
    if factors != (2, 2):
        return low
    xp, (ny, nx) = namespace(separation), (n // 2 * 2 for n in separation.shape)
    for start in range(0, ny, SLAB):  # planes are large, and fresh memory is slow
        upper, lower = (separation[start + k : min(start + SLAB, ny) : 2, :nx] for k in (0, 1))
        with np.errstate(invalid="ignore"):  # missing cells
            both, apart = upper + lower, upper - lower
            out_of_it = xp.abs(apart[:, ::2] - apart[:, 1::2])
            block = (both[:, ::2] + both[:, 1::2] - STANDING_OUT * out_of_it) / 4
        whole = low[start // 2 : start // 2 + block.shape[0], : nx // 2]
        whole[...] = xp.where(block > whole, block, whole)
    return low


def lowest(separation: Array, factors: tuple[int, ...]) -> Array:
    """Return the lowest value of each block; infinite for a block of missing cells."""
    xp, padded = namespace(separation), separation
    for axis, factor in enumerate(factors):
        lacking = [n if a != axis else -n % factor for a, n in enumerate(padded.shape)]
        if lacking[axis]:
            edge = xp.full(tuple(lacking), np.inf, dtype=padded.dtype, device=padded.device)
            padded = xp.concat([padded, edge], axis=axis)
    for axis, factor in enumerate(factors):
        # Slices, not an axis of blocks: a reduction along two numbers takes several times as long.
        parts = [padded[(slice(None),) * axis + (slice(k, None, factor), ...)] for k in range(factor)]
        padded = reduce(xp.minimum, parts)
    return padded
