"""Machine code for the way from fields of double precision to those of a solve, and back: one pass each."""

from __future__ import annotations

from typing import Any

from roughcontact.kernels.code import PRECISIONS, Code
from roughcontact.kernels.constants import NEVER

__all__ = ["KINDS", "write"]

KINDS = {
    "narrow": "index doubles doubles doubles flags double double reals reals reals",
    "widen": "index doubles reals reals double doubles",
}


def write(module: Any, precision: str) -> None:
    """Write all of them."""
    real = PRECISIONS[precision][0]
    with Code(module, "narrow", precision, KINDS["narrow"]) as code:
        n, separation, displacement, pressure, region, depth, scale, inside, lacking, base = code.arguments
        for at, take in code.each(n):
            by = take.alike(scale)
            lack = (take.alike(depth) - (take(separation, at) + take(displacement, at))) * by
            lacking.put(at, lack.larger(lack.replaced(NEVER)).rounded_to(real))
            base.put(at, (take(pressure, at) * by).rounded_to(real))
            inside.put(at, lack.replaced(1.0).where(take(region, at)).rounded_to(real))
    with Code(module, "widen", precision, KINDS["widen"]) as code:
        n, pressure, change, inside, unit, answer = code.arguments
        for at, take in code.each(n):
            new = take(pressure, at) + take(change, at).in_double() * take.alike(unit)
            answer.put(at, new.where(new.is_more_than(0.0)) * take(inside, at).in_double())
