"""Rows or columns of a map that hold random numbers after damage: uncorrelated, and rougher than the others."""

from __future__ import annotations

import numpy as np

from roughcontact.validation import Array

__all__ = ["noisy_rows"]

_ENOUGH = 32  # pairs of neighbours in a row
_DEVIATIONS = 3.0  # standard deviations within which a correlation counts as zero
_ROUGHER = 4.0  # times the mean step of a typical row


def noisy_rows(heights: Array) -> int:
    """Count the rows, or the columns, with unrelated heights and large steps; 0 if no two are adjacent.

    Columns are counted too, because some formats store a map by columns.
    """
    return max(map(_count, (heights, heights.T))) if heights.ndim == 2 else 0


def _count(heights: Array) -> int:
    if heights.shape[1] <= _ENOUGH:
        return 0
    steps = np.abs(np.diff(heights, axis=1))
    known = ~np.isnan(steps)
    count = np.count_nonzero(known, axis=1)
    enough = count >= _ENOUGH
    if not enough.any():
        return 0
    mean = np.sum(steps, axis=1, where=known) / np.maximum(count, 1)
    rough = enough & (mean > _ROUGHER * np.median(mean[enough]))
    noisy = np.zeros(len(heights), dtype=np.bool_)
    noisy[rough] = [_unrelated(row) for row in heights[rough]]
    return int(np.count_nonzero(noisy)) if (noisy[1:] & noisy[:-1]).any() else 0


def _unrelated(row: Array) -> bool:
    """Whether two neighbours lie on one side of the median as often as on both."""
    signs = np.sign(row - np.nanmedian(row))
    products = signs[1:] * signs[:-1]
    return bool(np.abs(np.nansum(products)) < _DEVIATIONS * np.sqrt(np.nansum(np.abs(products))))
