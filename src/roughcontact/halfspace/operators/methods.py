"""The ways to do the sum of a body over its cells, but for the full matrix."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal, get_args

from roughcontact.halfspace.operators.influence_operator import InfluenceOperator
from roughcontact.halfspace.sums.moving_grid import MovingGrid
from roughcontact.halfspace.sums.multilevel import Multilevel

__all__ = ["Sum", "summed"]

Sum = Literal["fft", "moving-grid", "multilevel"]


def summed(operator: InfluenceOperator, method: str) -> InfluenceOperator:
    """Return the same body with its sum done by `method`.

    Raises
    ------
    ValueError
        If there is no such method, or the body is periodic and the method needs a free one.
    """
    if method not in get_args(Sum):
        names = ", ".join(map(repr, get_args(Sum)))
        raise ValueError(f"method must be one of {names}, or 'dense' on a plane, not {method!r}")
    if method == "fft":
        return operator
    if any(operator.grid.periodic):
        raise ValueError(f"the method {method!r} is for free grids; a periodic one is summed by 'fft'")
    return replace(operator, summation=MovingGrid if method == "moving-grid" else Multilevel())
