"""Which cells of a solve are free: those between the bounds, that are let go of and taken in again."""

from __future__ import annotations

import math
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy, largest, namespace
from roughcontact.contact.measure import Measure
from roughcontact.machine import loader
from roughcontact.machine.region import Region, take_in

__all__ = ["FreeCells", "free_cells"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]
Field = npt.NDArray[Any]  # of single or double precision


class FreeCells(Protocol):
    """The cells whose pressure is free, and those that are held at the hardness."""

    @property
    def inside(self) -> Array:
        """One on the cells that are free, zero elsewhere; not to be kept."""
        ...

    @property
    def held(self) -> Mask | None:
        """Cells at the hardness; None without one."""
        ...

    def let_go(self, base: Array, change: Array, conserve: bool) -> Array | None:
        """Free no longer the cells whose pressure is out of bounds; return what takes it there, None if none is.

        Where the force is kept, the rest of the cells shares what they leave.
        """
        ...

    def take_in(self, lacking: Array, least: float) -> float:
        """Free the cells that lack more than `least`, or as much too little; return the largest lack, 0 if none."""
        ...


def free_cells(kept: Mask, held: Mask, ceiling: float, measure: Measure, like: Array) -> FreeCells:
    """Return the cells that are free at first, for fields like one.

    Parameters
    ----------
    kept, held : bool array
        Cells that are free, and cells at the hardness.
    ceiling : float
        The hardness.
    """
    inside = namespace(like).astype(kept, like.dtype)
    if is_numpy(like) and not measure.varies and ceiling == math.inf and loader.takes(like):
        return _Compiled(np.ascontiguousarray(inside))
    return _Generic(kept, held, ceiling, measure, inside)


class _Generic:
    def __init__(self, kept: Mask, held: Mask, ceiling: float, measure: Measure, inside: Array) -> None:
        self._kept, self._held, self._ceiling, self._measure, self.inside = (
            kept,
            held,
            ceiling,
            measure,
            inside,
        )

    @property
    def held(self) -> Mask | None:
        return self._held if self._ceiling < math.inf else None

    def let_go(self, base: Array, change: Array, conserve: bool) -> Array | None:
        xp, p = namespace(base), base + change
        low, high = self._kept & (p < 0), self._kept & (p > self._ceiling)
        if not bool(xp.any(low | high)):
            return None
        moved = xp.where(low, -p, 0.0)
        if self._ceiling < math.inf:
            moved = xp.where(high, self._ceiling - p, moved)
        self._now(self._kept & ~(low | high), self._held | high)
        return shared(moved, p, self.inside, self._measure) if conserve else moved

    def take_in(self, lacking: Array, least: float) -> float:
        xp = namespace(lacking)
        added = ((lacking > least) & ~self._kept & ~self._held) | ((lacking < -least) & self._held)
        if not bool(xp.any(added)):
            return 0.0
        self._now(self._kept | added, self._held & ~added)
        return largest(xp.where(added, lacking, 0.0))

    def _now(self, kept: Mask, held: Mask) -> None:
        self._kept, self._held = kept, held
        self.inside = namespace(kept).astype(kept, self.inside.dtype)


class _Compiled:
    """The same in machine code, for NumPy's arrays, cells of one size and no hardness."""

    held = None

    def __init__(self, inside: Field) -> None:
        self.inside = inside

    def let_go(self, base: Array, change: Array, conserve: bool) -> Array | None:
        region, moved = Region(self.inside), np.zeros(base.shape, dtype=self.inside.dtype)
        base, change = (np.ascontiguousarray(field, dtype=self.inside.dtype) for field in (base, change))
        count, lost, carried, left = region.run("let_go", 4, base, change, self.inside, moved).sum(axis=0)
        if not count:
            return None
        if conserve and left:
            # What cells carry tells their shares; new cells carry nothing yet.
            share, alike = (lost / carried, 0.0) if carried > 0 else (0.0, lost / left)
            region.run("share_out", 0, base, change, self.inside, moved, float(share), float(alike))
        return moved

    def take_in(self, lacking: Array, least: float) -> float:
        return take_in(self.inside, lacking, least)


def shared(change: Array, p: Array, inside: Array, measure: Measure) -> Array:
    """Return a change of pressure together with what keeps the force, shared by the cells inside."""
    carrying = p * inside
    total = measure.total(carrying)
    if not total > 0:  # new cells only
        carrying, total = inside, measure.total(inside)
    if not total > 0:
        return change
    # A ratio of sums of the same size: in single precision a whole is not known as well as its part.
    return change - measure.total(change) / total * carrying
