"""The vectors of an inner solve in machine code: work follows the free set, not the grid.

For NumPy's arrays, cells of one size and no upper bound. Every member does what `vectors.ArrayVectors` documents.
"""

from __future__ import annotations

from typing import Any, Self

import numpy as np
import numpy.typing as npt

from roughcontact.cached import cached_property
from roughcontact.errors import InputError
from roughcontact.kernels import buffers, planes
from roughcontact.kernels.active_cells import ActiveCells, mask_above, subtract_shifted, zeros_with_margins
from roughcontact.kernels.calls import Operand
from roughcontact.kernels.constants import ROUNDINGS
from roughcontact.solver import tuning
from roughcontact.solver.inner_operator import InnerOperator
from roughcontact.solver.inner_product import Preconditioned, Products, Projected
from roughcontact.solver.optimality import Iterate
from roughcontact.validation import Array, Mask

__all__ = ["CompiledVectors"]

Field = npt.NDArray[Any]  # of single or double precision


class CompiledVectors:
    """The vectors of one inner solve; fields as operands of kernels, and F as a list of groups of cells."""

    upper = None

    def __init__(
        self, inner: InnerOperator, weight: float, free: Field, residual: Field, base: Field
    ) -> None:
        self.free, self._free = free, Operand(free)  # with margins
        self._r, self._base = (self._located(field) for field in (residual, base))
        self._correction, self._s, self._q = self._zeros(), self._zeros(), self._r
        self._r_free, self._z = Operand(zeros_with_margins(free, free.dtype)), self._r
        self.correction, self.r = self._correction.field, self._r.field
        self.s, self.q = self._s.field, self._q.field
        self._inner, self._weight = inner, weight
        self._local, self._theta = inner.local_inverse, inner.diagonal_correction
        self._uses_w, self._lost = False, 0.0
        # Sums over F as the solve began: of the pressure, of its cells (this one is kept up to date), of r.
        self._p_sum, self._count, self._r_sum = 0.0, 0.0, 0.0
        self._w_sum: float | None = None

    @classmethod
    def scaled(
        cls,
        inner: InnerOperator,
        weight: float,
        free: Mask,
        iterate: Iterate,
        *,
        depth: float | None,
        otherwise: float,
    ) -> tuple[Self, float]:
        """Return the vectors of a solve from an iterate, and their unit; see `scaled_vectors`."""
        start, displacement, separation = (np.ascontiguousarray(field, np.float64) for field in iterate)
        free, precision = np.ascontiguousarray(free, bool), inner.scaled(np.empty(0)).dtype
        levels = planes.level_range(separation, displacement, free, inner.combine)
        if depth is None:
            depth = levels.mean
        unit = max(depth - levels.lowest, levels.highest - depth) or otherwise or 1.0
        inside = zeros_with_margins(free, precision)
        residual, base = (buffers.empty(free.shape, precision) for _ in range(2))
        into = inside, residual, base
        planes.scale_down(start, displacement, separation, free, into, depth=depth, unit=unit)
        return cls(inner, weight, inside, residual, base), unit

    def restart(self) -> float:
        """Forget the constraint direction; return the area of F."""
        self._uses_w = False
        fields = self._base, self._correction, self._free, self._r
        self._p_sum, self._count, self._r_sum = self._region.run("masked_sums", 3, *fields)
        return self._weight * self._count

    def remove_mean(self, threshold: float) -> None:
        """Subtract the mean of r over F, as it was at `restart`."""
        if abs(self._r_sum) > threshold * self._count:
            self.r[...] -= self._r_sum / self._count

    def residual_max(self) -> float:
        """Return the largest size of r on F."""
        return self._advanced(0.0)

    def bound_violation(self) -> float:
        """Return how far pressures are out of bounds at most."""
        fields = self._base, self._correction, self._free
        return self._region.run("max_violation", 1, *fields, largest=True)[0]

    def constraint_direction(self) -> float:
        """Use w; return 1.w."""
        self._uses_w = True
        if self._w_sum is None:
            # With the Schur correction w is a constant part of M^-1 1, which cancels in all that is made of it.
            args = self._inverse_of_one, self._free, self._free, self._q, self._free, 0.0
            self._w_sum = self._region.run("correct_and_dot", 4, *args, weight=self._weight)[2]
        return self._w_sum

    def precondition(self) -> Preconditioned:
        """Make z = M^-1 r on F; return its inner products."""
        self._z = self._inverse(self._r_free)
        one = self._inverse_of_one if self._theta or self._uses_w else self._z
        fields = self._z, self._free, self._r_free, self._q, one
        found = self._region.run("correct_and_dot", 4, *fields, self._theta, weight=self._weight)
        return Preconditioned(*found)

    def update_direction(self, beta: float) -> Field:
        """Make s = z + beta s, and return it."""
        self._region.run("xpay", 0, self._s, self._z, beta)
        self._forget_directions()
        return self.s

    def project(self, beta: float, mu: float, step: float) -> Projected:
        """Make s the step along z + beta s - mu w, projected onto the bounds."""
        w, mu = (self._inverse_of_one, mu) if self._uses_w else (self._z, 0.0)
        fields = self._base, self._correction, self._free, self._s, self._z, w
        lost, bound_correction, force, w_lost = self._region.run("project_step", 4, *fields, beta, mu, step)
        self._forget_directions()
        self._lost, self._count = self._lost + lost, self._count - lost
        if self._lost > tuning.STALE_CONSTRAINT_DIRECTION * self._count:
            self._forget_inverse_of_one()
        elif lost:  # where w is not used, its sum over the lost cells was not made
            known = self._w_sum if self._uses_w else None
            self._w_sum = None if known is None else known - self._weight * w_lost
        return Projected(bound_correction, self._weight * self._count, self._weight * force)

    def redistribute(self, force: float) -> None:
        """Subtract a force from s on F, in proportion to the pressure."""
        fields = self._base, self._correction, self._free, self._s
        added = force / self._weight
        p_sum, rounding = self._p_sum + added, ROUNDINGS * float(np.finfo(self.s.dtype).eps)
        # In proportion to the pressure; where all cells of F are new they have none yet, and share alike.
        if p_sum > rounding * abs(self._p_sum):
            self._region.run("subtract_affine", 0, *fields, added / p_sum, 0.0)
        else:
            self._region.run("subtract_affine", 0, *fields, 0.0, added / self._count)

    def inner_products(self, q: Field) -> Products:
        """Take q = A s; return the inner products of s, q and r."""
        self._q = self._located(q)
        self.q = self._q.field
        fields = self._s, self._q, self._free, self._r
        return Products(*self._region.run("dot_products", 6, *fields, weight=self._weight))

    def advance(self, alpha: float, mean: float) -> float:
        """Add alpha s to the pressure, subtract alpha (q - mean) from r; return the largest size of r on F."""
        subtract_shifted(self.r, self.q, alpha, mean)
        return self._advanced(alpha)

    def free_violated(self, threshold: float) -> float:
        """Free the cells whose residual is larger than a threshold; return the largest of these."""
        # Cells that drop out of the list of groups are never visited again.
        self._region.run("multiply", 0, self._s, self._free)
        worst = mask_above(self.free, self.r, threshold, self._inner.combine)
        if worst:
            self.__dict__.pop("_region", None)
            self._forget_inverse_of_one()
        return worst

    def pressure(self, start: Array, unit: float) -> Array:
        """Return the pressure that there is now."""
        self._forget_directions()
        self._forget_inverse_of_one()
        return planes.add_scaled(np.ascontiguousarray(start, np.float64), self.correction, self.free, unit)

    def _located(self, field: Field) -> Operand:
        if field.shape != self.free.shape:  # machine code checks no shape
            raise InputError(
                f"a field of shape {field.shape} where {self.free.shape} is expected", place="field"
            )
        return Operand(np.ascontiguousarray(field, self.free.dtype))

    def _zeros(self) -> Operand:
        return Operand(buffers.zeros(self.free.shape, self.free.dtype))

    @cached_property
    def _region(self) -> ActiveCells:
        return ActiveCells(self.free, (self._base.field, self.correction), self._inner.combine)

    @cached_property
    def _inverse_of_one(self) -> Operand:
        """M0^-1 1, with 1 on F: the constraint direction, and what the Schur correction is made of."""
        return self._inverse(self._free)

    def _forget_directions(self) -> None:
        """Let go of z, and of q, which is another after the next product: planes are large."""
        self._z = self._q = self._s
        self.q = self.s

    def _forget_inverse_of_one(self) -> None:
        self.__dict__.pop("_inverse_of_one", None)
        self._w_sum, self._lost = None, 0.0

    def _advanced(self, alpha: float) -> float:
        fields = self._correction, self._r, self._r_free, self._s, self._free
        return self._region.run("axpy_and_max", 1, *fields, alpha, largest=True)[0]

    def _inverse(self, field: Operand) -> Operand:
        """Return M0^-1 of a field that is zero outside F and has margins, without the Schur correction."""
        if self._local is None:
            return self._located(self._inner.approximate_inverse(field.field))
        return self._located(self._local.on(self._region, field.field))
