"""The weighted sum over the cells near one, with weights that are the same on all sides."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from operator import add

from roughcontact.kernels.constants import REACH
from roughcontact.kernels.signature import Vector
from roughcontact.kernels.values import Index, Number

__all__ = ["sum_near"]


def sum_near(cell: Callable[[int, int], Number], weights: Vector, first: Index) -> Number:
    """Return the sum over the cells up to REACH away: of what `cell` gives so far down and across, by its weight.

    Weights are numbered row by row from the first, of cells down and across from none to REACH.
    """
    terms = []
    for dy in range(REACH + 1):
        for dx in range(REACH + 1):
            around = [cell(y, x) for y in sorted({dy, -dy}) for x in sorted({dx, -dx})]
            terms.append(reduce(add, around) * weights[first + (dy * (REACH + 1) + dx)])
    return reduce(add, terms)
