"""The fields of a solve on a region in machine code: work follows the region, not the plane."""

from __future__ import annotations

from functools import cached_property
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from roughcontact.contact.drivers import Driver
from roughcontact.contact.trial import Trial
from roughcontact.halfspace.local_inverse import LocalInverse
from roughcontact.machine import planes, room
from roughcontact.machine.region import Located, Region, lower, take_in, zeros_with_margins

__all__ = ["CompiledFields"]

Field = npt.NDArray[Any]  # of single or double precision
Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


class CompiledFields:
    """What `Fields` says, for NumPy's arrays, cells of one size and no hardness."""

    held = None

    def __init__(self, driver: Driver, weight: float, inside: Field, lacking: Field, base: Field) -> None:
        self._inside = Located.of(inside)  # with margins
        self._r, self._base = (self._located(field) for field in (lacking, base))
        self._change, self._t, self._v = self._zeros(), self._zeros(), self._r
        self._error, self._z = Located.of(zeros_with_margins(inside.shape, inside.dtype)), self._r
        self._moved: Located | None = None  # zero everywhere, as long as it is kept
        self._driver, self._weight = driver, weight
        self._relief = driver.relief
        self._shares = False

    @classmethod
    def scaled(
        cls,
        driver: Driver,
        weight: float,
        region: Mask,
        trial: Trial,
        *,
        depth: float | None,
        otherwise: float,
    ) -> tuple[Self, float]:
        """Return the fields of a solve that begins with a trial, and their unit; see `scaled_fields`."""
        start, displacement, separation = (np.ascontiguousarray(f, dtype=np.float64) for f in trial)
        region, precision = np.ascontiguousarray(region, dtype=bool), driver.narrow(np.empty(0)).dtype
        levels = planes.levels(separation, displacement, region)
        if depth is None:
            depth = levels.mean
        unit = max(depth - levels.lowest, levels.highest - depth) or otherwise or 1.0
        inside = zeros_with_margins(region.shape, precision)
        lacking, base = (room.empty(region.shape, precision) for _ in range(2))
        given = separation, displacement, start, region
        planes.narrow(*given, depth=depth, unit=unit, inside=inside, lacking=lacking, base=base)
        return cls(driver, weight, inside, lacking, base), unit

    @property
    def inside(self) -> Field:
        """One on the cells that are free, zero elsewhere."""
        return self._inside.field

    @property
    def change(self) -> Field:
        """Of the pressure, so far."""
        return self._change.field

    @property
    def r(self) -> Field:
        """What is lacking."""
        return self._r.field

    @property
    def t(self) -> Field:
        """The direction."""
        return self._t.field

    @property
    def v(self) -> Field:
        """What it causes."""
        return self._v.field

    def is_empty(self) -> bool:
        """Return whether no cell is free."""
        return self._region.is_empty()

    def begin(self, conserve: bool) -> float:
        """Return the area of the region; take the mean lack off where the force is kept."""
        self._shares = False
        lack, _, _, area = self._sums("measure", 4, self._inside, self._r, self._inside, self._inside)
        if conserve:
            self.r[...] -= lack / area
        return area

    def size(self) -> float:
        """Return the largest lack inside."""
        return self._advanced(0.0)

    def share(self) -> float:
        """Have changes shared; return the sum of the shares."""
        # The inverse with its relief answers to a constant with a part of this: only ratios count.
        self._shares = True
        constant = self._of_constant, self._inside, self._inside, self._v, self._inside, 0.0
        return self._sums("weigh", 3, *constant)[2]

    def precondition(self) -> tuple[float, float, float]:
        """Find z; return its products with r and v, and its sum."""
        self._z = self._inverse(self._error)
        constant = self._of_constant if self._relief else self._z
        a, b, c = self._sums("weigh", 3, self._z, self._inside, self._error, self._v, constant, self._relief)
        return a, b, c

    def turn(self, beta: float, shift: float) -> Field:
        """Turn t; return it."""
        shared, by = (self._of_constant, shift) if self._shares else (self._z, 0.0)
        self._region.run("turn", 0, self._t, self._z, shared, beta, by)
        return self.t

    def measure(self, v: Field) -> tuple[float, float, float, float]:
        """Take v; return t v, the sum of v, t r, and the sum of t."""
        self._v = self._located(v)
        a, b, c, d = self._sums("measure", 4, self._t, self._v, self._inside, self._error)
        return a, b, c, d

    def advance(self, alpha: float, mean: float) -> float:
        """Go along t; return the largest lack inside."""
        lower(self.r, self.v, alpha, mean)
        return self._advanced(alpha)

    def let_go(self, conserve: bool) -> Field | None:
        """Let go of cells that pull; return what that moves."""
        region, moved = self._region, self._zeros() if self._moved is None else self._moved
        fields = self._base, self._change, self._inside, moved, self._t, self._error
        count, *sums = region.run("let_go", 4, *fields)
        if not count:
            self._moved = moved
            return None
        if conserve:
            self._share_out(moved, *sums)
        self._moved = None
        self._changed()
        return moved.field

    def leave(self, conserve: bool) -> Field | None:
        """Take the pressure of other cells to zero; return what does."""
        moved = self._zeros()
        count, *sums = planes.leave(self.inside, self._base.field, self.change, moved.field)
        if not count:
            return None
        if conserve:
            self._share_out(moved, *sums)
        return moved.field

    def follow(self, displacement: Field) -> None:
        """Take what a change has caused off what is lacking."""
        lower(self.r, self._located(displacement).field, 1.0, 0.0)

    def take_in(self, least: float) -> float:
        """Free the cells that lack more; return the largest lack."""
        worst = take_in(self.inside, self.r, least)
        if worst:
            self._changed()
        return worst

    def pressure(self, start: Array, unit: float) -> Array:
        """Return the pressure that there is now."""
        return planes.widen(np.ascontiguousarray(start, dtype=np.float64), self.change, self.inside, unit)

    def _share_out(self, moved: Located, lost: float, carried: float, left: float) -> None:
        """Have the region keep the force that has been lost, and move as well."""
        if not left:
            return
        # What cells carry tells their shares; new cells carry nothing yet.
        share, alike = (lost / carried, 0.0) if carried > 0 else (0.0, lost / left)
        self._region.run("share_out", 0, self._base, self._change, self._inside, moved, share, alike)

    def _located(self, field: Field) -> Located:
        if field.shape != self.inside.shape:  # machine code looks at nothing twice
            raise ValueError(f"a field of shape {field.shape} where {self.inside.shape} is expected")
        return Located.of(np.ascontiguousarray(field, dtype=self.inside.dtype))

    def _zeros(self) -> Located:
        return Located.of(room.zeros(self.inside.shape, self.inside.dtype))

    @cached_property
    def _region(self) -> Region:
        return Region(self.inside)

    @cached_property
    def _of_constant(self) -> Located:
        """What the inverse answers to a constant on the region."""
        return self._inverse(self._inside)

    def _changed(self) -> None:
        """Forget what hangs on the region."""
        for name in ("_region", "_of_constant"):
            self.__dict__.pop(name, None)

    def _advanced(self, alpha: float) -> float:
        fields = self._change, self._r, self._error, self._t, self._inside
        return self._region.run("advance", 1, *fields, alpha, largest=True)[0]

    def _inverse(self, field: Located) -> Located:
        """Return about the pressure under a field that is zero outside the region and has margins."""
        local: LocalInverse | None = getattr(self._driver, "local_inverse", None)
        if local is None:
            return self._located(self._driver.approximate_inverse(field.field))
        return self._located(local.on(self._region, field.field))

    def _sums(self, name: str, count: int, *arguments: Located | float) -> list[float]:
        return [self._weight * one for one in self._region.run(name, count, *arguments)]
