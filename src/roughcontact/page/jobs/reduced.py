"""Maps for a screen: at most n cells a side, and no peak lost."""

from __future__ import annotations

import numpy as np

from roughcontact.validation import Array

__all__ = ["as_seen", "factor_for"]


def factor_for(shape: tuple[int, ...], most: int) -> int:
    """Return the side of the block of cells that one point of the screen shows."""
    return max(1, -(-max(shape) // max(1, most)))


def as_seen(field: Array, factor: int, *, lowest: bool = False) -> Array:
    """Return the highest value of each block of `factor` x `factor` cells, or the `lowest`; NaN where all are missing.

    Parameters
    ----------
    field : array, shape (ny, nx)
        NaN where a value is missing.
    factor : int
    lowest : bool

    Returns
    -------
    array of float, shape (ceil(ny/factor), ceil(nx/factor))
    """
    if factor == 1:
        return field
    beyond = np.inf if lowest else -np.inf
    known = np.where(np.isnan(field), beyond, field)
    rows = np.arange(0, field.shape[0], factor)
    columns = np.arange(0, field.shape[1], factor)
    choose = np.minimum if lowest else np.maximum
    blocks = choose.reduceat(choose.reduceat(known, rows, axis=0), columns, axis=1)
    return np.where(blocks == beyond, np.nan, blocks)
