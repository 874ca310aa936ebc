"""The fields of a solve on a region in machine code: work follows the region, not the plane."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
import numpy.typing as npt

from roughcontact.cached import cached_property
from roughcontact.halfspace.sums.local_inverse import LocalInverse
from roughcontact.kernels import buffers as room
from roughcontact.kernels import planes
from roughcontact.kernels.active_cells import ActiveCells, mask_above, subtract_shifted, zeros_with_margins
from roughcontact.kernels.calls import Operand
from roughcontact.kernels.constants import ROUNDINGS
from roughcontact.solver.bounded import Bounded, Measured, Preconditioned
from roughcontact.solver.inner_operator import Driver
from roughcontact.solver.trial import Trial

__all__ = ["CompiledFields"]

Field = npt.NDArray[Any]  # of single or double precision
Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

FEW = 0.03  # of a region: cells it may lose before it answers otherwise to a constant


class CompiledFields:
    """What `Fields` says, for NumPy's arrays, cells of one size and no hardness."""

    held = None

    def __init__(self, driver: Driver, weight: float, inside: Field, lacking: Field, base: Field) -> None:
        self._inside = Operand(inside)  # with margins
        self._r, self._base = (self._located(field) for field in (lacking, base))
        self._change, self._t, self._v = self._zeros(), self._zeros(), self._r
        self._error, self._z = Operand(zeros_with_margins(inside.shape, inside.dtype)), self._r
        self._driver, self._weight = driver, weight
        self._relief = driver.relief
        self._shares, self._lost = False, 0.0
        self._carried, self._count, self._lack = 0.0, 0.0, 0.0  # as it began, but for the count
        self._resultant: float | None = None

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
        levels = planes.level_range(separation, displacement, region)
        if depth is None:
            depth = levels.mean
        unit = max(depth - levels.lowest, levels.highest - depth) or otherwise or 1.0
        inside = zeros_with_margins(region.shape, precision)
        lacking, base = (room.empty(region.shape, precision) for _ in range(2))
        given = separation, displacement, start, region
        planes.scale_down(*given, depth=depth, unit=unit, inside=inside, lacking=lacking, base=base)
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

    def begin(self) -> float:
        """Return the area of the region."""
        self._shares = False
        fields = self._base, self._change, self._inside, self._r
        self._carried, self._count, self._lack = self._region.run("masked_sums", 3, *fields)
        return self._weight * self._count

    def level(self, most: float) -> None:
        """Take off what the region lacks on the mean, as it began, if that is more than so much."""
        if abs(self._lack) > most * self._count:
            self.r[...] -= self._lack / self._count

    def size(self) -> float:
        """Return the largest lack inside."""
        return self._advanced(0.0)

    def excess(self) -> float:
        """Return how far pressures are out of bounds."""
        fields = self._base, self._change, self._inside
        return self._region.run("max_violation", 1, *fields, largest=True)[0]

    def share(self) -> float:
        """Have changes shared; return the sum of the shares."""
        self._shares = True
        if self._resultant is None:
            # The inverse with its relief answers to a constant with a part of this: only ratios count.
            constant = self._of_constant, self._inside, self._inside, self._v, self._inside, 0.0
            self._resultant = self._sums("correct_and_dot", 4, *constant)[2]
        return self._resultant

    def precondition(self) -> Preconditioned:
        """Find z; return what there is to know of it."""
        self._z = self._inverse(self._error)
        constant = self._of_constant if self._relief or self._shares else self._z
        fields = self._z, self._inside, self._error, self._v, constant
        return Preconditioned(*self._sums("correct_and_dot", 4, *fields, self._relief))

    def turn(self, beta: float) -> Field:
        """Turn t; return it."""
        self._region.run("xpay", 0, self._t, self._z, beta)
        return self.t

    def bound(self, beta: float, shift: float, step: float) -> Bounded:
        """Turn t, take a step of it as far as cells may go; return what comes of it."""
        shared, by = (self._of_constant, shift) if self._shares else (self._z, 0.0)
        fields = self._base, self._change, self._inside, self._t, self._z, shared
        gone, lifted, force, uniform = self._region.run("project_step", 4, *fields, beta, by, step)
        self._lost, self._count = self._lost + gone, self._count - gone
        if self._lost > FEW * self._count:
            self._forget_constant()
        elif gone:  # what is not shared says nothing of it
            known = self._resultant if self._shares else None
            self._resultant = None if known is None else known - self._weight * uniform
        return Bounded(lifted, self._weight * self._count, self._weight * force)

    def share_out(self, force: float) -> None:
        """Have the cells that are free share what t changes of the force."""
        fields = self._base, self._change, self._inside, self._t
        added = force / self._weight
        # What cells carry tells their shares; new cells carry nothing yet. The rest is as it was at the beginning.
        carried, rounding = self._carried + added, ROUNDINGS * float(np.finfo(self.t.dtype).eps)
        some = carried > rounding * abs(self._carried)
        share, alike = (added / carried, 0.0) if some else (0.0, added / self._count)
        self._region.run("subtract_affine", 0, *fields, share, alike)

    def measure(self, v: Field) -> Measured:
        """Take v; return what there is to know of it and of t."""
        self._v = self._located(v)
        return Measured(*self._sums("dot_products", 6, self._t, self._v, self._inside, self._r))

    def advance(self, alpha: float, mean: float) -> float:
        """Go along t; return the largest lack inside."""
        subtract_shifted(self.r, self.v, alpha, mean)
        return self._advanced(alpha)

    def take_in(self, least: float) -> float:
        """Free the cells that lack more; return the largest lack."""
        # What is listed no more is never looked at again.
        self._region.run("multiply", 0, self._t, self._inside)
        worst = mask_above(self.inside, self.r, least)
        if worst:
            self._changed()
        return worst

    def pressure(self, start: Array, unit: float) -> Array:
        """Return the pressure that there is now."""
        return planes.add_scaled(
            np.ascontiguousarray(start, dtype=np.float64), self.change, self.inside, unit
        )

    def _located(self, field: Field) -> Operand:
        if field.shape != self.inside.shape:  # machine code looks at nothing twice
            raise ValueError(f"a field of shape {field.shape} where {self.inside.shape} is expected")
        return Operand(np.ascontiguousarray(field, dtype=self.inside.dtype))

    def _zeros(self) -> Operand:
        return Operand(room.zeros(self.inside.shape, self.inside.dtype))

    @cached_property
    def _region(self) -> ActiveCells:
        return ActiveCells(self.inside, (self._base.field, self.change))

    @cached_property
    def _of_constant(self) -> Operand:
        """What the inverse answers to a constant on the region."""
        return self._inverse(self._inside)

    def _changed(self) -> None:
        """Forget what hangs on the region."""
        self.__dict__.pop("_region", None)
        self._forget_constant()

    def _forget_constant(self) -> None:
        self.__dict__.pop("_of_constant", None)
        self._resultant, self._lost = None, 0.0

    def _advanced(self, alpha: float) -> float:
        fields = self._change, self._r, self._error, self._t, self._inside
        return self._region.run("axpy_and_max", 1, *fields, alpha, largest=True)[0]

    def _inverse(self, field: Operand) -> Operand:
        """Return about the pressure under a field that is zero outside the region and has margins."""
        local: LocalInverse | None = getattr(self._driver, "local_inverse", None)
        if local is None:
            return self._located(self._driver.approximate_inverse(field.field))
        return self._located(local.on(self._region, field.field))

    def _sums(self, name: str, count: int, *arguments: Operand | float) -> list[float]:
        return [self._weight * one for one in self._region.run(name, count, *arguments)]
