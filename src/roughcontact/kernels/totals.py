"""Sums, and largest ones, of what a loop finds."""

from __future__ import annotations

import math

from roughcontact.kernels.code import Code, Local
from roughcontact.kernels.signature import Doubles
from roughcontact.kernels.values import Number, maximum, where

__all__ = ["Totals"]


class Totals:
    """The largest of the first numbers that a loop finds, and sums of the others; in double precision.

    Parameters
    ----------
    code : Code
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
        self, code: Code, sums: int, largest: int = 0, *, least: float = -math.inf, compensated: bool = False
    ) -> None:
        self._code, self._largest, self._compensated = code, largest, compensated
        starts = [least] * largest + [0.0] * sums
        self._lanes, self._ones = (
            [(code.variable(zero.filled(start)), code.variable(zero.filled(0.0))) for start in starts]
            for zero in (code.lanes(0.0).double(), code.number(0.0).double())
        )

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

    def store(self, memory: Doubles) -> None:
        """Write them down one after the other."""
        for place, ((lanes, _), (one, _)) in enumerate(zip(self._lanes, self._ones, strict=True)):
            combine = maximum if place < self._largest else Number.__add__
            found = combine(self._code.across(lanes.get(), combine), one.get())
            memory[self._code.index(place)] = found


def _add_compensated(total: Local[Number], lost: Local[Number], number: Number) -> None:
    before, added = total.get(), number - lost.get()
    after = before + added
    rest = (after - before) - added
    lost.set(where(abs(rest) < math.inf, rest, 0.0))  # of infinity nothing is lost
    total.set(after)
