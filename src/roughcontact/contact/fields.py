"""The fields of a solve on a region: in machine code where there is some, else by the library of the arrays."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import largest, namespace
from roughcontact.contact.compiled_fields import CompiledFields
from roughcontact.contact.drivers import Driver
from roughcontact.contact.measure import Measure
from roughcontact.contact.problem import Terms
from roughcontact.contact.trial import Trial
from roughcontact.machine import loader
from roughcontact.machine.layout import NEVER
from roughcontact.machine.region import with_margins

__all__ = ["Fields", "fields_on", "scaled_fields", "shared"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


class Fields(Protocol):
    """The fields of one solve, and what is done to them; sums are weighted.

    Inside the region are the cells whose pressure is free, between its bounds. There t is the direction, v what it
    causes, and z the lack after the preconditioner; outside only r and the change mean anything.
    """

    @property
    def inside(self) -> Array:
        """One on the cells that are free, zero elsewhere."""
        ...

    @property
    def change(self) -> Array:
        """Of the pressure, so far."""
        ...

    @property
    def r(self) -> Array:
        """Displacement that is lacking."""
        ...

    @property
    def t(self) -> Array:
        """The direction."""
        ...

    @property
    def v(self) -> Array:
        """What it causes."""
        ...

    @property
    def held(self) -> Mask | None:
        """Cells at the hardness; None without one."""
        ...

    def is_empty(self) -> bool:
        """Whether no cell is free."""
        ...

    def begin(self, conserve: bool) -> float:
        """Return the area of the region; where the force is kept, take the mean lack inside off all lacks."""
        ...

    def size(self) -> float:
        """Return the largest lack inside."""
        ...

    def share(self) -> float:
        """Have changes of pressure shared by the region, as its inverse of a constant is; return the sum of that."""
        ...

    def precondition(self) -> tuple[float, float, float]:
        """Find z, and return its products with r and with v, and its sum."""
        ...

    def turn(self, beta: float, shift: float) -> Array:
        """Make t the direction ``beta t + z``, less `shift` times what is shared, and return it."""
        ...

    def measure(self, v: Array) -> tuple[float, float, float, float]:
        """Take v, and return the product of t and v, the sum of v, the product of t and r, and the sum of t."""
        ...

    def advance(self, alpha: float, mean: float) -> float:
        """Add ``alpha t`` to the change, take ``alpha (v - mean)`` off r, and return the largest lack inside."""
        ...

    def let_go(self, conserve: bool) -> Array | None:
        """Free no longer the cells whose pressure is out of bounds; return what takes it there, None if none is.

        Where the force is kept, the rest of the cells shares what they leave. The change has it already, r has not.
        """
        ...

    def leave(self, conserve: bool) -> Array | None:
        """Take the pressure of cells that are not free to zero; return what does, None if they have none.

        It is for the beginning; cells at the hardness keep it. The change has what is returned already, see `let_go`.
        """
        ...

    def follow(self, displacement: Array) -> None:
        """Take what a change has caused off what is lacking."""
        ...

    def take_in(self, least: float) -> float:
        """Free the cells that lack more than `least`, or as much too little; return the largest lack, 0 if none."""
        ...

    def pressure(self, start: Array, unit: float) -> Array:
        """Return the pressure in the region that began as `start` and has changed, in a `unit`; nowhere negative."""
        ...


def fields_on(
    driver: Driver,
    measure: Measure,
    kept: Mask,
    lacking: Array,
    base: Array,
    held: Mask | None = None,
    ceiling: float = math.inf,
) -> Fields:
    """Return the fields of a solve.

    Parameters
    ----------
    driver : Driver
        Its precision is that of the fields.
    kept : bool array
        Cells that are free at first.
    lacking, base : array
        Displacement that is lacking, finite, which is overwritten, and the pressure that changes.
    held : bool array, optional
        Cells at the hardness at first.
    ceiling : float
        The hardness.
    """
    if _has_machine_code(lacking, measure, ceiling):
        inside = with_margins(kept, lacking.dtype)
        return CompiledFields(driver, float(measure.weights), inside, lacking, base)
    return _Generic(driver, measure, kept, lacking, base, held, ceiling)


def scaled_fields(
    driver: Driver, measure: Measure, terms: Terms, region: Mask, trial: Trial, *, otherwise: float
) -> tuple[Fields, float]:
    """Return the fields of a solve for what is lacking of a depth, and their unit.

    Parameters
    ----------
    driver : Driver
    measure : Measure
    terms : Terms
        Where no depth is prescribed it is the mean level of the region.
    region : bool array
        Cells that are free at first, one at least, on those of the driver.
    trial : Trial
        Where the solve begins, there too.
    otherwise : float
        Unit where nothing is lacking, if it is not zero [m].

    Returns
    -------
    fields : Fields
    unit : float
        What is lacking in the region at most [m]: then single precision holds all numbers. Pressures are in the unit
        too [Pa].
    """
    start, displacement, separation = trial
    ceiling = terms.hardness
    if _has_machine_code(separation, measure, ceiling):
        area = float(measure.weights)
        return CompiledFields.scaled(driver, area, region, trial, depth=terms.depth, otherwise=otherwise)
    xp = namespace(separation)
    level = separation + displacement
    depth = measure.mean(level, region) if terms.depth is None else terms.depth
    unit = largest((depth - level)[region]) or otherwise or 1.0
    there = xp.isfinite(separation)
    lacking = driver.narrow((depth - xp.where(there, level, 0.0)) / unit)
    lacking = xp.where(there, lacking, NEVER)
    held = (start >= ceiling) & ~region
    base = driver.narrow(start / unit)
    return _Generic(driver, measure, region, lacking, base, held, ceiling / unit), unit


def _has_machine_code(field: Array, measure: Measure, ceiling: float) -> bool:
    """Whether there is machine code for such fields."""
    return not measure.varies and ceiling == math.inf and loader.takes(field)


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


class _Generic:
    def __init__(
        self,
        driver: Driver,
        measure: Measure,
        kept: Mask,
        lacking: Array,
        base: Array,
        held: Mask | None,
        ceiling: float,
    ) -> None:
        xp = namespace(lacking)
        self.inside, self.r, self.change = xp.astype(kept, lacking.dtype), lacking, xp.zeros_like(lacking)
        self.t, self.v = xp.zeros_like(lacking), lacking
        self._driver, self._measure, self._base, self._ceiling = driver, measure, base, ceiling
        self._kept, self._held = kept, xp.zeros_like(kept) if held is None else held
        self._error, self._z = lacking, lacking
        self._shared: Array | None = None

    @property
    def held(self) -> Mask | None:
        return self._held if self._ceiling < math.inf else None

    def is_empty(self) -> bool:
        return not bool(namespace(self._kept).any(self._kept))

    def begin(self, conserve: bool) -> float:
        self._shared, area = None, self._measure.total(self.inside)
        if conserve:
            self.r -= self._measure.dot(self.inside, self.r) / area
        return area

    def size(self) -> float:
        self._error = self.r * self.inside
        return largest(self._error)

    def share(self) -> float:
        self._shared = self._driver.approximate_inverse(self.inside) * self.inside
        return self._measure.total(self._shared)

    def precondition(self) -> tuple[float, float, float]:
        self._z = self._driver.approximate_inverse(self._error)
        self._z *= self.inside
        dot = self._measure.dot
        return dot(self._error, self._z), dot(self._z, self.v), self._measure.total(self._z)

    def turn(self, beta: float, shift: float) -> Array:
        self.t *= beta
        self.t += self._z
        if self._shared is not None:
            self.t -= shift * self._shared
        return self.t  # type: ignore[no-any-return]

    def measure(self, v: Array) -> tuple[float, float, float, float]:
        self.v, dot = v, self._measure.dot
        return dot(self.t, v), dot(self.inside, v), dot(self._error, self.t), self._measure.total(self.t)

    def advance(self, alpha: float, mean: float) -> float:
        self.change += alpha * self.t
        self.r -= alpha * (self.v - mean if mean else self.v)
        return self.size()

    def let_go(self, conserve: bool) -> Array | None:
        xp, p = namespace(self.r), self._base + self.change
        low, high = self._kept & (p < 0), self._kept & (p > self._ceiling)
        if not bool(xp.any(low | high)):
            return None
        moved = xp.where(low, -p, 0.0)
        if self._ceiling < math.inf:
            moved = xp.where(high, self._ceiling - p, moved)
        self._now(self._kept & ~(low | high), self._held | high)
        self.t *= self.inside
        if conserve:
            moved = shared(moved, p, self.inside, self._measure)
        self.change += moved
        return moved  # type: ignore[no-any-return]

    def leave(self, conserve: bool) -> Array | None:
        left = (self._base > 0) & ~self._kept & ~self._held
        if not bool(namespace(left).any(left)):
            return None
        moved = namespace(left).where(left, -self._base, 0.0)
        if conserve:
            moved = shared(moved, self._base, self.inside, self._measure)
        self.change += moved
        return moved  # type: ignore[no-any-return]

    def follow(self, displacement: Array) -> None:
        self.r -= displacement

    def take_in(self, least: float) -> float:
        xp, lacking = namespace(self.r), self.r
        added = ((lacking > least) & ~self._kept & ~self._held) | ((lacking < -least) & self._held)
        if not bool(xp.any(added)):
            return 0.0
        self._now(self._kept | added, self._held & ~added)
        return largest(xp.where(added, lacking, 0.0))

    def pressure(self, start: Array, unit: float) -> Array:
        xp = namespace(start)
        p = xp.astype(self.change, xp.float64)  # in place: planes are large
        p *= unit
        p += start
        p = xp.where(p > 0, p, 0.0)
        p *= self.inside
        return p  # type: ignore[no-any-return]

    def _now(self, kept: Mask, held: Mask) -> None:
        self._kept, self._held = kept, held
        self.inside = namespace(kept).astype(kept, self.inside.dtype)
