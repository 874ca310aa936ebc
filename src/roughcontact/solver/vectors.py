"""The fields of a solve on a region: in machine code where there is some, else by the library of the arrays."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import largest, namespace
from roughcontact.kernels import loader
from roughcontact.kernels.active_cells import with_margins
from roughcontact.kernels.constants import NEVER, ROUNDINGS
from roughcontact.solver.bounded import Bounded, Measured, Preconditioned
from roughcontact.solver.compiled_vectors import CompiledFields
from roughcontact.solver.control import Terms
from roughcontact.solver.inner_operator import Driver
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.trial import Trial

__all__ = ["Fields", "fields_on", "scaled_fields"]

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

    def begin(self) -> float:
        """Have nothing shared as yet; return the area of the region."""
        ...

    def level(self, most: float) -> None:
        """Take what the region lacks on the mean as it has begun off all lacks, if that is more than `most`."""
        ...

    def size(self) -> float:
        """Return the largest lack inside."""
        ...

    def excess(self) -> float:
        """Return how far pressures are out of bounds at most, and those of other cells from the one that they keep."""
        ...

    def share(self) -> float:
        """Have changes of pressure shared by the region, as its inverse of a constant is; return the sum of that."""
        ...

    def precondition(self) -> Preconditioned:
        """Find z, and return what there is to know of it."""
        ...

    def turn(self, beta: float) -> Array:
        """Make t the direction ``beta t + z``, and return it."""
        ...

    def bound(self, beta: float, shift: float, step: float) -> Bounded:
        """Make t the change that a step along ``beta t + z``, less `shift` times what is shared, brings within bounds.

        Cells that it takes out of bounds go there and are free no longer, cells that are not free return to theirs.
        """
        ...

    def share_out(self, force: float) -> None:
        """Have the cells that are free share, as they carry it, what t changes of the force."""
        ...

    def measure(self, v: Array) -> Measured:
        """Take v, and return what there is to know of it and of t."""
        ...

    def advance(self, alpha: float, mean: float) -> float:
        """Add ``alpha t`` to the change, take ``alpha (v - mean)`` off r, and return the largest lack inside."""
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

    def begin(self) -> float:
        self._shared = None
        return self._measure.total(self.inside)

    def level(self, most: float) -> None:
        lack, area = self._measure.dot(self.inside, self.r), self._measure.total(self.inside)
        if abs(lack) > most * area:
            self.r -= lack / area

    def size(self) -> float:
        self._error = self.r * self.inside
        return largest(self._error)

    def excess(self) -> float:
        return largest(self._out_of_bounds())

    def share(self) -> float:
        self._shared = self._driver.approximate_inverse(self.inside) * self.inside
        return self._measure.total(self._shared)

    def precondition(self) -> Preconditioned:
        self._z = self._driver.approximate_inverse(self._error)
        self._z *= self.inside
        dot, shared = self._measure.dot, self._shared
        alike = 0.0 if shared is None else dot(shared, self.v)
        return Preconditioned(
            dot(self._error, self._z), dot(self._z, self.v), self._measure.total(self._z), alike
        )

    def turn(self, beta: float) -> Array:
        self.t *= beta
        self.t += self._z
        return self.t  # type: ignore[no-any-return]

    def bound(self, beta: float, shift: float, step: float) -> Bounded:
        xp, p, kept = namespace(self.r), self._base + self.change, self._kept
        self.turn(beta)
        if self._shared is not None:
            self.t -= shift * self._shared
        self.t *= step * self.inside
        low, high = kept & (p + self.t < 0), kept & (p + self.t > self._ceiling)
        if bool(xp.any(low | high)):
            self._now(kept & ~(low | high), self._held | high)
        lifted = xp.where(self._kept, 0.0, -self._out_of_bounds())
        new, total = self.t * self.inside + lifted, self._measure.total
        force, self.t = total(new - self.t), new
        return Bounded(float(xp.sum(xp.abs(lifted), dtype=xp.float64)), total(self.inside), force)

    def share_out(self, force: float) -> None:
        carried = (self._base + self.change + self.t) * self.inside
        total = self._measure.total(carried)
        if not total > 0:  # new cells only
            carried, total = self.inside, self._measure.total(self.inside)
        self.t = self.t - force / total * carried

    def measure(self, v: Array) -> Measured:
        self.v, dot, inside = v, self._measure.dot, self.inside
        alone = inside * self.t
        descents = dot(self.r, self.t), dot(self.r, alone)
        return Measured(
            dot(self.t, v), dot(inside, v), *descents, self._measure.total(alone), dot(inside, self.r)
        )

    def advance(self, alpha: float, mean: float) -> float:
        self.change += alpha * self.t
        self.r -= alpha * (self.v - mean if mean else self.v)
        self.t *= self.inside
        return self.size()

    def take_in(self, least: float) -> float:
        xp, lacking = namespace(self.r), self.r
        self.t *= self.inside
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

    def _out_of_bounds(self) -> Array:
        """Return how far pressures are beyond their bounds, and those of other cells from the one that they keep."""
        xp, p = namespace(self.r), self._base + self.change
        rounding = ROUNDINGS * float(xp.finfo(p.dtype).eps)
        p = xp.where(xp.abs(p) > rounding * xp.abs(self._base), p, 0.0)
        if self._ceiling == math.inf:
            return xp.where(self._kept, xp.minimum(p, 0.0), p)  # type: ignore[no-any-return]
        over = p - self._ceiling
        over = xp.where(xp.abs(over) > rounding * self._ceiling, over, 0.0)
        inside = xp.minimum(p, 0.0) + xp.maximum(over, 0.0)
        return xp.where(self._kept, inside, xp.where(self._held, over, p))  # type: ignore[no-any-return]

    def _now(self, kept: Mask, held: Mask) -> None:
        self._kept, self._held = kept, held
        self.inside = namespace(kept).astype(kept, self.inside.dtype)
