"""The sum over near cells with weights that change from cell to cell with a small period."""

from __future__ import annotations

from typing import NamedTuple

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import CHUNK
from roughcontact.kernels.signature import Indices, Scalar, Vector, kernel
from roughcontact.kernels.values import Index, where


class Taps(NamedTuple):
    """Weights by class of the row and of the column, row and column of the tap, and how many there are of each.

    At last where each tap of each class of columns begins among columns that lie class by class.
    """

    weights: Vector
    row_classes: Index
    classes: Index
    far: Index
    across: Index
    places: Indices


class Folded(NamedTuple):
    """A field whose columns lie class by class, with far - 1 rows more on both sides: its numbers and sizes.

    Each class has a number of rows and a number of columns, a multiple of the lanes.
    """

    numbers: Vector
    rows: Index
    columns: Index


@kernel
def sum_taps(
    code: Code, first: Index, x: Folded, taps: Taps, sign: Scalar, pair: Vector, sums: Vector, width: Index
) -> None:
    """Write the sums over near cells for the rows of x from the number `first` on, class by class of columns.

    The weight of a tap as many rows above as another is below is that of the other times the sign. `pair` is scratch
    for the columns of all classes, and the width of the sums a multiple of CHUNK times the lanes.
    """
    rows = x.rows - (taps.far - 1) * 2
    for row in code.range(0, rows):
        for b in code.range(0, taps.classes):
            for k in code.range(0, width, code.count):
                sums[((b * rows + row) * width + k).lanes] = 0.0
        for s in code.range(0, taps.far):
            factor = where(s.equals(0), code.number(0.0), sign)
            for q in code.range(0, taps.classes):
                middle = q * x.rows + row + taps.far - 1
                for k in code.range(0, x.columns, code.count):
                    below, above = (x.numbers[(y * x.columns + k).lanes] for y in (middle + s, middle - s))
                    pair[(q * x.columns + k).lanes] = below + above * factor
            for b in code.range(0, taps.classes):
                weights = (((row + first) % taps.row_classes * taps.classes + b) * taps.far + s) * taps.across
                for k in code.range(0, width, CHUNK * code.count):
                    places = [(b * rows + row) * width + k + j * code.count for j in range(CHUNK)]
                    totals = [code.variable(sums[place.lanes]) for place in places]
                    for t in code.range(0, taps.across):
                        weight, begin = taps.weights[weights + t], taps.places[b * taps.across + t] + k
                        for j, total in enumerate(totals):
                            total.set(total.get() + pair[(begin + j * code.count).lanes] * weight)
                    for place, total in zip(places, totals, strict=True):
                        sums[place.lanes] = total.get()
