"""The sum over near cells: in loops compiled by Numba where it is installed, else in products of matrices."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.processor import is_off

__all__ = ["add_near", "add_near_by_products", "compiled_loops"]

Array = npt.NDArray[np.float64]
Loops = Callable[[Array, Array, int, Array], None]

WIDTH = 1024  # nodes of a row that the loops take at once, so that all they touch stays in the first cache
BLOCK = 32  # nodes of a row that one product of matrices takes


def add_near(field: Array, taps: Array, sign: int, total: Array) -> None:
    """Add to `total` the weighted sum of `field` over the nodes near each.

    Parameters
    ----------
    field, total : array, shape (ny, nx)
        What is summed, and what is added to; nothing lies outside.
    taps : array, shape (ay, ax, my + 1, 2 mx + 1)
        Weight of the node at ``(s, t - mx)`` from one whose row and column leave the remainders a and b when divided
        by ay and ax: entry (a, b, s, t).
    sign : {1, -1}
        Of the weight of the node at ``(-s, t - mx)``, s > 0.
    """
    loops = compiled_loops()
    if loops is None:
        add_near_by_products(field, taps, sign, total)
    else:
        loops(field, taps, sign, total)


@cache
def compiled_loops() -> Loops | None:
    """Return the loops as machine code; None without Numba (``pip install 'roughcontact[compiled]'``).

    None too where the environment wants no machine code. Compiling takes about a second, once: Numba keeps the code on
    disk where it finds a place.
    """
    if is_off():
        return None
    try:
        import numba
    except ImportError:
        return None
    # Only multiply and add may be fused: numbers that are none stay what they are.
    settings: dict[str, Any] = {"nogil": True, "fastmath": {"contract"}}
    try:
        loops: Loops = numba.njit(cache=True, **settings)(_loops)
    except RuntimeError:  # no place to keep it
        loops = numba.njit(**settings)(_loops)
    return loops


def _loops(field: Array, taps: Array, sign: int, total: Array) -> None:
    rows, columns = field.shape
    row_classes, column_classes, far, across = taps.shape
    side = across // 2
    margin = side // column_classes + 1
    width = min(WIDTH, columns) // column_classes + 1
    # Nodes of one class of columns lie side by side: only then does a processor take several at a time.
    folded = np.empty((column_classes, width + 2 * margin))
    sums = np.empty((column_classes, width))
    for start in range(0, columns, width * column_classes):
        folded[:] = 0.0
        for row in range(rows):
            sums[:] = 0.0
            for s in range(far):
                above, below = row - s, row + s
                if above < 0 and below >= rows:
                    break
                for q in range(column_classes):
                    first = start + q - margin * column_classes  # the column at place 0, which may be outside
                    low = max(0, -(first // column_classes))
                    high = min(width + 2 * margin, (columns - 1 - first) // column_classes + 1)
                    for k in range(low, high):
                        column = first + k * column_classes
                        value = field[below, column] if below < rows else 0.0
                        if s > 0 and above >= 0:
                            value += sign * field[above, column]
                        folded[q, k] = value
                for b in range(column_classes):
                    for t in range(across):
                        weight = taps[row % row_classes, b, s, t]
                        if weight != 0.0:
                            offset = b + t - side
                            shift = margin + offset // column_classes
                            source_row = folded[offset % column_classes, shift : shift + width]
                            target_row = sums[b]
                            for k in range(width):
                                target_row[k] += weight * source_row[k]
            for b in range(column_classes):
                for k in range(min(width, (columns - start - b + column_classes - 1) // column_classes)):
                    total[row, start + b + k * column_classes] += sums[b, k]


def add_near_by_products(field: Array, taps: Array, sign: int, total: Array) -> None:
    """Do the same without Numba: a block of columns at a time is a product with a banded matrix."""
    rows, columns = field.shape
    row_classes, column_classes, far, across = taps.shape
    reach, side = far - 1, across // 2
    wide = BLOCK + 2 * side
    band = np.zeros((row_classes, far, wide, BLOCK))
    for x in range(BLOCK):
        band[:, :, x : x + across, x] = taps[:, x % column_classes]
    band = band.reshape(row_classes, far * wide, BLOCK)
    padded = np.pad(field, ((reach, reach), (side, side + BLOCK)))
    for start in range(0, columns, BLOCK):
        part = np.ascontiguousarray(padded[:, start : start + wide])
        stop = min(start + BLOCK, columns)
        for a in range(min(row_classes, rows)):
            targets = slice(a + reach, rows + reach, row_classes)
            folded = np.empty((len(range(a, rows, row_classes)), far, wide))
            folded[:, 0] = part[targets]
            for s in range(1, far):
                above = part[a + reach - s : rows + reach - s : row_classes]
                below = part[a + reach + s : rows + reach + s : row_classes]
                np.add(below, sign * above, out=folded[:, s])
            product = folded.reshape(len(folded), -1) @ band[a]
            total[a::row_classes, start:stop] += product[:, : stop - start]
