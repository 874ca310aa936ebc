"""The fields of a solve on a region in machine code: work follows the region, not the plane."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.contact.drivers import Driver
from roughcontact.halfspace.local_inverse import LocalInverse
from roughcontact.machine.region import Region, lower, take_in, with_margins

__all__ = ["CompiledFields"]

Field = npt.NDArray[Any]  # of single or double precision
Mask = npt.NDArray[np.bool_]


class CompiledFields:
    """What `Fields` says, for NumPy's arrays, cells of one size and no hardness."""

    held = None

    def __init__(self, driver: Driver, weight: float, kept: Mask, lacking: Field, base: Field) -> None:
        self.r, self._base = (np.ascontiguousarray(field, dtype=lacking.dtype) for field in (lacking, base))
        self.inside = with_margins(kept, lacking.dtype)
        self.change, self.t, self.v = self._zeros(), self._zeros(), self.r
        self._error, self._z = with_margins(self.change), self.r
        self._moved: Field | None = None  # zero everywhere, as long as it is kept
        self._driver, self._weight = driver, weight
        self._relief = driver.relief
        self._shares = False

    def is_empty(self) -> bool:
        """Return whether no cell is free."""
        return self._region.is_empty()

    def begin(self, conserve: bool) -> float:
        """Return the area of the region; take the mean lack off where the force is kept."""
        self._shares = False
        lack, _, _, area = self._sums("measure", 4, self.inside, self.r, self.inside, self.inside)
        if conserve:
            self.r -= lack / area
        return area

    def size(self) -> float:
        """Return the largest lack inside."""
        return self._advanced(0.0)

    def share(self) -> float:
        """Have changes shared; return the sum of the shares."""
        # The inverse with its relief answers to a constant with a part of this: only ratios count.
        self._shares = True
        constant = self._of_constant, self.inside, self.inside, self.v, self.inside, 0.0
        return self._sums("weigh", 3, *constant)[2]

    def precondition(self) -> tuple[float, float, float]:
        """Find z; return its products with r and v, and its sum."""
        self._z = self._inverse(self._error)
        constant = self._of_constant if self._relief else self._z
        a, b, c = self._sums("weigh", 3, self._z, self.inside, self._error, self.v, constant, self._relief)
        return a, b, c

    def turn(self, beta: float, shift: float) -> Field:
        """Turn t; return it."""
        shared, by = (self._of_constant, shift) if self._shares else (self._z, 0.0)
        self._region.run("turn", 0, self.t, self._z, shared, beta, by)
        return self.t

    def measure(self, v: Field) -> tuple[float, float, float, float]:
        """Take v; return t v, the sum of v, t r, and the sum of t."""
        self.v = np.ascontiguousarray(v, dtype=self.r.dtype)
        a, b, c, d = self._sums("measure", 4, self.t, self.v, self.inside, self._error)
        return a, b, c, d

    def advance(self, alpha: float, mean: float) -> float:
        """Go along t; return the largest lack inside."""
        lower(self.r, self.v, alpha, mean)
        return self._advanced(alpha)

    def let_go(self, conserve: bool) -> Field | None:
        """Let go of cells that pull; return what that moves."""
        region, moved = self._region, self._zeros() if self._moved is None else self._moved
        fields = self._base, self.change, self.inside, moved, self.t, self._error
        count, lost, carried, left = region.run("let_go", 4, *fields).sum(axis=0)
        if not count:
            self._moved = moved
            return None
        if conserve and left:
            # What cells carry tells their shares; new cells carry nothing yet.
            share, alike = (lost / carried, 0.0) if carried > 0 else (0.0, lost / left)
            region.run(
                "share_out", 0, self._base, self.change, self.inside, moved, float(share), float(alike)
            )
        self._moved = None
        self._changed()
        return moved

    def follow(self, displacement: Field) -> None:
        """Take what a change has caused off what is lacking."""
        lower(self.r, np.ascontiguousarray(displacement, dtype=self.r.dtype), 1.0, 0.0)

    def take_in(self, least: float) -> float:
        """Free the cells that lack more; return the largest lack."""
        worst = take_in(self.inside, self.r, least)
        if worst:
            self._changed()
        return worst

    def _zeros(self) -> Field:
        return np.zeros(self.r.shape, self.r.dtype)  # of memory that is touched where it is needed

    @cached_property
    def _region(self) -> Region:
        return Region(self.inside)

    @cached_property
    def _of_constant(self) -> Field:
        """What the inverse answers to a constant on the region."""
        return self._inverse(self.inside)

    def _changed(self) -> None:
        """Forget what hangs on the region."""
        for name in ("_region", "_of_constant"):
            self.__dict__.pop(name, None)

    def _advanced(self, alpha: float) -> float:
        fields = self.change, self.r, self._error, self.t, self.inside
        return float(self._region.run("advance", 1, *fields, alpha).max())

    def _inverse(self, field: Field) -> Field:
        """Return about the pressure under a field that is zero outside the region and has margins."""
        local: LocalInverse | None = getattr(self._driver, "local_inverse", None)
        if local is None:
            return np.ascontiguousarray(self._driver.approximate_inverse(field), dtype=field.dtype)
        return local.on(self._region, field)

    def _sums(self, name: str, count: int, *fields: Field | float) -> list[float]:
        sums = self._region.run(name, count, *fields).sum(axis=0)
        return [float(self._weight * one) for one in sums]
