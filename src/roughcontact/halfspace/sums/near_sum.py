"""The sum over near cells: in machine code where there is some, otherwise in products of matrices."""

from __future__ import annotations

import numpy as np

from roughcontact.kernels import loader
from roughcontact.kernels.constants import CHUNK, WIDTH
from roughcontact.validation import Array

__all__ = ["add_near", "add_near_by_products"]


CELLS = 2**18  # nodes whose rows machine code takes at once
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
    if loader.is_available():
        _add_near_by_kernel(field, taps, sign, total)
    else:
        add_near_by_products(field, taps, sign, total)


def _add_near_by_kernel(field: Array, taps: Array, sign: int, total: Array) -> None:
    sum_taps = loader.functions("near_kernels", "float64")["sum_taps"]
    (rows, columns), (_, classes, far, across) = field.shape, taps.shape
    reach, side, lanes = far - 1, across // 2, WIDTH // field.itemsize
    margin, step = side // classes + 1, CHUNK * lanes
    width = -(-columns // (classes * step)) * step
    length = -(-(width + 2 * margin) // lanes) * lanes
    offsets = np.add.outer(np.arange(classes), np.arange(-side, side + 1))
    places = offsets % classes * length + offsets // classes + margin
    given = np.ascontiguousarray(taps), *taps.shape, places
    pair, part = np.empty(classes * length), max(4 * far, CELLS // columns)
    for start in range(0, rows, part):
        stop = min(start + part, rows)
        low, high = max(start - reach, 0), min(stop + reach, rows)
        folded = np.zeros((classes, stop - start + 2 * reach, length))
        for q in range(classes):
            some = field[low:high, q::classes]
            folded[q, low - start + reach : high - start + reach, margin : margin + some.shape[1]] = some
        sums = np.empty((classes, stop - start, width))
        sum_taps(start, folded, *folded.shape[1:], *given, sign, pair, sums, width)
        for b in range(classes):
            whole = total[start:stop, b::classes]
            whole += sums[b, :, : whole.shape[1]]


def add_near_by_products(field: Array, taps: Array, sign: int, total: Array) -> None:
    """Do the same in products of matrices: a block of columns at a time is a product with a banded matrix."""
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
