"""A loop over all numbers of some fields that leaves sums, and largest ones, of what its body finds."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from roughcontact.kernels.code import Code, Take
from roughcontact.kernels.values import Index, Number, Reals

__all__ = ["leave_totals"]


def leave_totals(
    code: Code,
    n: Index,
    body: Callable[[Index, Take], Sequence[Number]],
    totals: Reals,
    most: int,
    count: int,
) -> None:
    """Go through `n` numbers; of the `count` that the body finds leave the largest of the first `most`, sums of others.

    They are of double precision, and sums are compensated (Kahan 1965): the mean level of a million cells is known to
    its last digits. What is no number may be lost among the largest, and never among the sums.
    """

    def both(place: int) -> Callable[[Number, Number], Number]:
        return Number.larger if place < most else Number.__add__

    def begin(number: Number) -> list[Number]:
        nothing = number.in_double()
        return [nothing.replaced(-math.inf if k < most else 0.0) for k in range(count)]

    lanes, ones = (
        [(code.variable(first), code.variable(first.replaced(0.0))) for first in begin(none)]
        for none in (code.zero(), code.one(0.0))
    )
    for at, take in code.each(n):
        for place, number in enumerate(body(at, take)):
            total, lost = (lanes if take.lanes else ones)[place]
            if place < most:
                total.set(number.in_double().larger(total.get()))
                continue
            before, added = total.get(), number.in_double() - lost.get()
            after = before + added
            rest = (after - before) - added
            lost.set(rest.where(rest.larger(-rest).is_below(math.inf)))  # of infinity nothing is lost
            total.set(after)
    for place, ((many, _), (one, _)) in enumerate(zip(lanes, ones, strict=True)):
        found = both(place)(code.across(many.get(), both(place)), one.get())
        totals.put(code.index(place), found)
