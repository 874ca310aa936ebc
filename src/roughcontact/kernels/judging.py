"""Machine code that looks at a pressure, the displacement that it causes, and the separation: one pass each."""

from __future__ import annotations

import math
from typing import Any

from roughcontact.kernels.code import Code, Take
from roughcontact.kernels.totals import leave_totals
from roughcontact.kernels.values import Index, Number

__all__ = ["KINDS", "write"]

KINDS = {
    "look": "index doubles doubles doubles doubles",
    "levels": "index doubles doubles flags doubles",
    "mark": "index doubles doubles doubles double double double flags doubles",
}


def write(module: Any, precision: str) -> None:
    """Write all of them."""
    with Code(module, "look", precision, KINDS["look"]) as code:
        n, pressure, displacement, separation, totals = code.arguments

        def look(at: Index, take: Take) -> tuple[Number, ...]:
            p, u = take(pressure, at), take(displacement, at)
            level, carries = u + take(separation, at), p.is_more_than(0.0)
            return (
                level.where(carries, -math.inf),
                -level,
                u.larger(-u),
                p,
                -p,
                (-p).where(carries, -math.inf),
                (-level).where(code.opposite(carries), -math.inf),
                level.where(carries),
                p.replaced(1.0).where(carries),
                (p - p) + (u - u),  # nothing, where both are numbers
            )

        leave_totals(code, n, look, totals, 7, 10)
    with Code(module, "mark", precision, KINDS["mark"]) as code:
        n, pressure, displacement, separation, depth, least, own, region, totals = code.arguments

        def mark(at: Index, take: Take) -> tuple[Number, ...]:
            p = take(pressure, at)
            gap = take(displacement, at) + take(separation, at) - take.alike(depth)
            # Whether one cell by itself would press no more. Nothing times infinity is no number, and not below.
            wrong = (p.larger(p.replaced(0.0)) * take.alike(own)).is_below(gap)
            asked = code.either(p.is_more_than(0.0), gap.is_below(take.alike(least)))
            stays = code.both(asked, code.opposite(wrong))
            region.put(at, stays)
            one = p.replaced(1.0)
            return one.where(stays), one.where(code.both(asked, wrong))

        leave_totals(code, n, mark, totals, 0, 2)
    with Code(module, "levels", precision, KINDS["levels"]) as code:
        n, separation, displacement, region, totals = code.arguments

        def levels(at: Index, take: Take) -> tuple[Number, ...]:
            level, inside = take(separation, at) + take(displacement, at), take(region, at)
            high, low = (x.where(inside, -math.inf) for x in (level, -level))
            return high, low, level.where(inside), level.replaced(1.0).where(inside)

        leave_totals(code, n, levels, totals, 2, 4)
