"""Where a solve begins on the coarsest cells: the contact of only the summits, one for each block of cells.

All force on the lowest cell would press far too deep, and predict a contact of most cells.
"""

from __future__ import annotations

import math
from contextlib import suppress

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.operators.operator import Operator, is_semidefinite, self_influence
from roughcontact.solver.control import Control, Depth
from roughcontact.solver.direct import press_cells
from roughcontact.solver.subdomain import prolong
from roughcontact.validation import Array

__all__ = ["summit_start"]

BLOCKS = 8  # of a side


def summit_start(operator: Operator, separation: Array, control: Control) -> tuple[Array, float]:
    """Return the pressure [Pa] and the depth [m] of a contact of only the summits; fields of two axes, on the host.

    It is no pressure, and the solve begins with the lowest cell, where no more cells than summits are in reach of the
    depth at which that cell would carry all. Nor is there any at a given depth of a periodic body: at given depth that
    single cell is not pressed too deep, and a start with more of them saved no product.
    """
    if isinstance(control, Depth):
        deepest = 0.0 if is_semidefinite(operator) else control.value
    else:
        alone = self_influence(operator) * control.value / float(np.min(operator.weights))
        deepest = float(separation.min()) + alone
    if np.count_nonzero(separation < deepest) > BLOCKS**2:
        cells = _summits(separation)
        cells = cells[separation.ravel()[cells] <= deepest]
        with suppress(np.linalg.LinAlgError):  # not definite to working precision
            found = press_cells(operator, separation, control, cells)
            return prolong(found.pressure, found.cells, separation.shape), found.depth
    return np.zeros(separation.shape), 0.0


def _summits(separation: Array) -> npt.NDArray[np.intp]:
    """Return the cell of the lowest separation in each block that has one (flat indices)."""
    ny, nx = separation.shape
    height, width = (-(-n // BLOCKS) for n in separation.shape)
    down, across = -(-ny // height), -(-nx // width)
    padded = np.full((down * height, across * width), math.inf)
    padded[:ny, :nx] = separation
    blocks = padded.reshape(down, height, across, width).swapaxes(1, 2).reshape(down * across, -1)
    place, block = blocks.argmin(axis=1), np.arange(down * across)
    rows = block // across * height + place // width
    columns = block % across * width + place % width
    return np.asarray((rows * nx + columns)[np.isfinite(blocks[block, place])])
