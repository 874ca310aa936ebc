"""The ways to do the sum of a half-space over its cells, but for the full matrix."""

from __future__ import annotations

from typing import Literal, get_args

from roughcontact.halfspace.operators.singly_periodic import SinglyPeriodicOperator
from roughcontact.halfspace.sums.moving_grid import MovingGridOperator
from roughcontact.halfspace.sums.multilevel import MultilevelOperator
from roughcontact.halfspace.sums.spectral import FreeOperator, PeriodicOperator

__all__ = ["Sum", "Summed", "summed"]

Sum = Literal["fft", "moving-grid", "multilevel"]
Summed = FreeOperator | PeriodicOperator | SinglyPeriodicOperator | MovingGridOperator | MultilevelOperator


def summed(operator: FreeOperator | PeriodicOperator | SinglyPeriodicOperator, method: str) -> Summed:
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
    if not isinstance(operator, FreeOperator):
        raise ValueError(f"the method {method!r} is for free grids; a periodic one is summed by 'fft'")
    return MovingGridOperator(operator) if method == "moving-grid" else MultilevelOperator(operator)
