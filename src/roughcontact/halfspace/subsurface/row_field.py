"""The stresses below a uniformly loaded rectangle that repeats itself along one axis."""

from __future__ import annotations

import numpy as np

from roughcontact.halfspace.subsurface.love_field import STRESS_PARITY, love_stress
from roughcontact.validation import Array

__all__ = ["row_stress_table"]


# Images on either side that are summed one by one; the others are a strip, and what that lacks is of the order of the
# fifth power of their distance: below 1e-8 of the mean pressure (tests/halfspace/subsurface/test_fields_below.py).
IMAGES = 12
ENDLESS = 1e9  # periods


def row_stress_table(
    shape: tuple[int, ...], spacing: tuple[float, ...], depth: float, poisson_ratio: float
) -> Array:
    """Return the stresses at offsets of whole cells, the images `shape[0]` cells apart along y; unit pressure.

    Returns
    -------
    array, shape (6, ny, nx)
        xx, yy, zz, xy, xz and yz at offsets along y once around the period, and along x from zero up.
    """
    (ny, nx), (dy, dx) = shape, spacing
    x = dx * np.arange(nx, dtype=np.float64)
    y = dy * np.arange(ny // 2 + 1, dtype=np.float64)[:, None]
    period = ny * dy

    def cell(y: Array) -> Array:
        return love_stress(x, y, depth, (dy, dx), poisson_ratio)

    table = cell(y)
    for side in (-period, period):
        for m in range(1, IMAGES):
            last = cell(y + m * side)
            table += last
        # The load of the others, spread out evenly from the middle between two images on; what that lacks is a sum
        # of second derivatives.
        length = ENDLESS * period
        start = (IMAGES - 0.5) * period
        middle = y + np.sign(side) * (start + length / 2)
        table += dy / period * love_stress(x, middle, depth, (length, dx), poisson_ratio)
        table += (1 - (dy / period) ** 2) / 24 * (cell(y + IMAGES * side) - last)
    back = table[:, (ny - 1) // 2 : 0 : -1]
    signs = np.array([-1.0 if odd_y else 1.0 for odd_y, _ in STRESS_PARITY])
    return np.concatenate([table, back * signs[:, None, None]], axis=1)
