"""The cells that a fluid passes, and the direction in which it flows."""

from __future__ import annotations

import math
from typing import Literal, TypeAlias

import numpy as np

from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.grid import AnyGrid, RadialGrid
from roughcontact.validation import Array, Mask, exactly_one

__all__ = ["Missing", "checked_direction", "open_gap"]

Missing: TypeAlias = Literal["closed", "open"]
OPEN = 1e4  # a missing cell that is open conducts this many times as well as the widest gap


def checked_direction(
    grid: AnyGrid, axis: int | None, between: tuple[Mask, Mask] | None
) -> tuple[Mask, Mask] | None:
    """Return the two regions; raise an error unless exactly one direction of the flow is given or follows."""
    if isinstance(grid, RadialGrid):
        if axis is not None or between is not None:
            raise InputError(
                "on rings the fluid flows between both rims", "leave axis and between out", "axis, between"
            )
        if not grid.edges[0] > 0:
            raise InputError(
                "these rings have no inner rim: they begin at the axis",
                "press rings with a hole, such as rc.RadialGrid(numpy.linspace(1e-3, 2e-3, 257))",
                "solution",
            )
        return None
    if grid.ndim != 2:
        raise InputError(
            "a fluid does not flow through the gap of a profile",
            "press a Surface with two axes, or a RadialProfile",
            "solution",
        )
    if axis is not None and (axis not in (0, 1) or grid.periodic[axis]):
        raise InputError(
            f"from side to side the fluid flows along an axis that is not periodic, 0 or 1, not {axis!r}",
            "leave axis out" if all(grid.periodic) else f"give axis={int(grid.periodic[0])}",
            "axis",
        )
    if not all(grid.periodic):
        exactly_one(axis=axis, between=between)
    if between is None:
        return None
    regions = [np.asarray(each, dtype=bool) for each in between]
    if [each.shape for each in regions] != [grid.shape] * 2 or (regions[0] & regions[1]).any():
        raise about("between", f"must be two regions of shape {grid.shape} without a common cell")
    return regions[0], regions[1]


def open_gap(solution: Solution | AdhesiveState, missing: Missing, closing_gap: float | None) -> Array:
    """Return the gap that the fluid passes."""
    if closing_gap is None and isinstance(solution, AdhesiveState):
        raise InputError(
            "which cells of an adhesive state are closed to a fluid does not follow from the attraction",
            "give closing_gap, such as 1e-9 [m]: cells with a smaller gap are closed",
            "closing_gap",
        )
    if closing_gap is not None and not 0 <= closing_gap < math.inf:
        raise about("the closing gap", f"must be 0 or more [m], not {closing_gap}")
    if missing not in ("closed", "open"):
        raise about("missing", f"must be 'closed' or 'open', not {missing!r}")
    measured = solution.problem.measured
    passes = measured & ~solution.contact & (solution.gap > 0) & (solution.gap >= (closing_gap or 0.0))
    gap = np.where(passes, solution.gap, 0.0)
    if not np.isfinite(gap).all():
        raise InputError(
            "the bodies are detached: the gap is infinite", "give a state in contact", "solution"
        )
    if missing == "open":
        gap[~measured] = OPEN ** (1 / 3) * gap.max()
    gap.flags.writeable = False
    return gap
