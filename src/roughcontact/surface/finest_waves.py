"""Test whether a map is rough down to its cells, which means that the surface has finer waves than the map."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["is_rough_to_cells"]

ROUGH = 1.25  # H of the heights from one cell to two: 2 for smooth heights, 1.4 for waves of five cells


def is_rough_to_cells(surface: Surface) -> bool:
    """Return whether the heights of a map are as rough from cell to cell as those of a self-affine surface.

    Second differences at a distance of two cells are 2^H times those at a distance of one. H is the Hurst exponent for
    a self-affine surface without a shortest wave, and 2 if the shortest wave has many cells. Differences with a
    missing height are left out, and so is an axis of fewer than five cells.
    """
    near, far = (
        sum(_mean_square(np.moveaxis(surface.heights, axis, 0), lag) for axis in range(surface.grid.ndim))
        for lag in (1, 2)
    )
    return 0 < far < 2 ** (2 * ROUGH) * near


def _mean_square(heights: np.ndarray, lag: int) -> float:
    """Return the mean square of the second differences of rows at a distance; 0 without any."""
    if len(heights) < 5:
        return 0.0
    bends = heights[2 * lag :] - 2 * heights[lag:-lag] + heights[: -2 * lag]
    known = bends[np.isfinite(bends)]
    return float(np.mean(known**2)) if known.size else 0.0
