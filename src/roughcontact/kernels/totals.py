"""Sums that kernels share: over the cells near one, and over all that a loop finds, part by part."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import reduce
from operator import add

from roughcontact.kernels.code import Code, Local
from roughcontact.kernels.constants import REACH
from roughcontact.kernels.signature import Doubles, Vector
from roughcontact.kernels.values import Index, Number, maximum, where

__all__ = ["Totals", "sum_near"]


class Totals:
    """The largest of the first numbers that a loop finds, and sums of the others; in double precision.

    Parameters
    ----------
    code : Code
    memory : Doubles
        Where they are written, those of all at first, with room for those of each part.
    sums, largest : int
        How many numbers.
    least : float
        The largest of none.
    compensated : bool
        Whether rounding is taken off sums (Kahan 1965): the mean level of a million cells is known to its last digits.

    Notes
    -----
    NaN may be lost among the largest, and never among the sums.
    """

    def __init__(
        self,
        code: Code,
        memory: Doubles,
        sums: int,
        largest: int = 0,
        *,
        least: float = -math.inf,
        compensated: bool = False,
    ) -> None:
        self._code, self._memory, self._largest, self._compensated = code, memory, largest, compensated
        self._starts = [least] * largest + [0.0] * sums
        self._lanes, self._ones = (
            [(code.variable(zero), code.variable(zero)) for _ in self._starts]
            for zero in (code.lanes(0.0).double(), code.number(0.0).double())
        )

    def clear(self) -> None:
        """Begin with a part."""
        for kind in (self._lanes, self._ones):
            for start, (total, lost) in zip(self._starts, kind, strict=True):
                total.set(total.first.filled(start))
                lost.set(lost.first.filled(0.0))

    def add(self, *numbers: Number) -> None:
        """Count some numbers, one in each lane or single ones."""
        for place, number in enumerate(numbers):
            found = number.double()
            lanes, ones = self._lanes[place], self._ones[place]
            total, lost = lanes if found.value.type == lanes[0].first.value.type else ones
            if place < self._largest:
                total.set(maximum(found, total.get()))
            elif self._compensated:
                _add_compensated(total, lost, found)
            else:
                total.set(total.get() + found)

    def store(self, part: Index) -> None:
        """Write down those of a part."""
        first = part * len(self._starts)
        for place, ((lanes, _), (one, _)) in enumerate(zip(self._lanes, self._ones, strict=True)):
            combine = maximum if place < self._largest else Number.__add__
            found = combine(self._code.across(lanes.get(), combine), one.get())
            self._memory[first + place] = found

    def combine(self, parts: Index) -> None:
        """Write down those of all, in the order of the parts, when all are done: one thread does."""
        code, memory, count = self._code, self._memory, len(self._starts)
        with code.when(code.thread.equals(0)):
            for part in code.range(1, parts):
                for place in range(count):
                    combine = maximum if place < self._largest else Number.__add__
                    at = code.index(place)
                    memory[at] = combine(memory[part * count + place], memory[at])


def _add_compensated(total: Local[Number], lost: Local[Number], number: Number) -> None:
    before, added = total.get(), number - lost.get()
    after = before + added
    rest = (after - before) - added
    lost.set(where(abs(rest) < math.inf, rest, 0.0))  # of infinity nothing is lost
    total.set(after)


def sum_near(cell: Callable[[int, int], Number], weights: Vector, first: Index) -> Number:
    """Return the sum over the cells up to REACH away: of what `cell` gives so far down and across, by its weight.

    Weights are the same on all sides. They are numbered row by row from the first, of cells down and across from none
    to REACH.
    """
    terms = []
    for dy in range(REACH + 1):
        for dx in range(REACH + 1):
            around = [cell(y, x) for y in sorted({dy, -dy}) for x in sorted({dx, -dx})]
            terms.append(reduce(add, around) * weights[first + (dy * (REACH + 1) + dx)])
    return reduce(add, terms)
