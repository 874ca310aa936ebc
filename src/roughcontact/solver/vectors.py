"""The vectors of an inner solve, by the library of the arrays; `compiled_vectors` has the same in machine code.

The names are those of docs/concepts/method.md: residual r, preconditioned residual z, search direction s, its image
q = A s, and constraint direction w, on the free set F.
"""

from __future__ import annotations

import math

from roughcontact.arrays import max_abs
from roughcontact.kernels import loader
from roughcontact.kernels.active_cells import with_margins
from roughcontact.kernels.constants import NEVER, ROUNDINGS
from roughcontact.solver import tuning
from roughcontact.solver.compiled_vectors import CompiledVectors
from roughcontact.solver.control import Specification
from roughcontact.solver.inner_operator import InnerOperator
from roughcontact.solver.inner_product import Measure, Preconditioned, Products, Projected
from roughcontact.solver.optimality import Iterate
from roughcontact.validation import Array, Mask

__all__ = ["ArrayVectors", "Vectors", "scaled_vectors", "vectors_on"]


class ArrayVectors:
    """The vectors of one inner solve and what is done to them; sums are weighted by the areas of the cells.

    Parameters
    ----------
    inner : InnerOperator
        Its precision is that of the vectors.
    measure : Measure
    free : bool array
        The free set F at first: cells whose pressure lies between its bounds.
    residual, base : array
        Residual, finite, which is overwritten, and the pressure that is corrected.
    upper : bool array, optional
        Cells that are active at the upper bound at first.
    bound : float
        The upper bound: the hardness.

    Attributes
    ----------
    free : array
        One on F, zero elsewhere.
    correction : array
        Of the pressure, so far.
    r, s, q : array
        Residual, search direction, and its image. Outside F only r and the correction have a meaning.
    """

    def __init__(
        self,
        inner: InnerOperator,
        measure: Measure,
        free: Mask,
        residual: Array,
        base: Array,
        upper: Mask | None = None,
        bound: float = math.inf,
    ) -> None:
        xp = self._xp = measure.xp
        self.free, self.r = xp.astype(free, residual.dtype), residual
        self.correction, self.s, self.q = xp.zeros_like(residual), xp.zeros_like(residual), residual
        self._inner, self._measure, self._base, self._bound = inner, measure, base, bound
        self._free, self._upper = free, xp.zeros_like(free) if upper is None else upper
        self._r_free, self._z = residual, residual
        self._w: Array | None = None
        self._w_area = 0.0

    @property
    def upper(self) -> Mask | None:
        """Cells that are active at the upper bound; None without one."""
        return self._upper if self._bound < math.inf else None

    def restart(self) -> float:
        """Forget the constraint direction; return the area of F."""
        self._w = None
        return self._measure.total(self.free)

    def remove_mean(self, threshold: float) -> None:
        """Subtract the mean of the residual over F, if it is larger than a threshold (B2)."""
        r_sum, area = self._measure.dot(self.free, self.r), self._measure.total(self.free)
        if abs(r_sum) > threshold * area:
            self.r -= r_sum / area

    def residual_max(self) -> float:
        """Return the largest size of r on F."""
        self._r_free = self.r * self.free
        return max_abs(self._r_free)

    def bound_violation(self) -> float:
        """Return how far a pressure is out of its bounds at most, or that of an active cell from its bound."""
        return max_abs(self._out_of_bounds())

    def constraint_direction(self) -> float:
        """Make w = M^-1 1 on F, again where F has lost many cells; return its sum 1.w (B4)."""
        area = self._measure.total(self.free)
        if self._w is None or area < (1 - tuning.STALE_CONSTRAINT_DIRECTION) * self._w_area:
            self._w, self._w_area = self._inner.approximate_inverse(self.free), area
        self._w *= self.free
        return self._measure.total(self._w)

    def precondition(self) -> Preconditioned:
        """Make z = M^-1 r on F; return its inner products (B5)."""
        self._z = self._inner.approximate_inverse(self._r_free)
        self._z *= self.free
        dot, w = self._measure.dot, self._w
        wq = 0.0 if w is None else dot(w, self.q)
        return Preconditioned(
            rz=dot(self._r_free, self._z), zq=dot(self._z, self.q), z_sum=self._measure.total(self._z), wq=wq
        )

    def update_direction(self, beta: float) -> Array:
        """Make s = z + beta s, and return it (C4)."""
        self.s *= beta
        self.s += self._z
        return self.s  # type: ignore[no-any-return]

    def project(self, beta: float, mu: float, step: float) -> Projected:
        """Make s the step along z + beta s - mu w, projected onto the bounds (B8).

        Cells that it takes out of bounds go to their bound and leave F; active cells return to theirs.
        """
        xp, p, free = self._xp, self._base + self.correction, self._free
        self.update_direction(beta)
        if self._w is not None:
            self.s -= mu * self._w
        self.s *= step * self.free
        low, high = free & (p + self.s < 0), free & (p + self.s > self._bound)
        if bool(xp.any(low | high)):
            self._set_free(free & ~(low | high), self._upper | high)
        bound_correction = xp.where(self._free, 0.0, -self._out_of_bounds())
        projected, total = self.s * self.free + bound_correction, self._measure.total
        force, self.s = total(projected - self.s), projected
        return Projected(float(xp.sum(xp.abs(bound_correction), dtype=xp.float64)), total(self.free), force)

    def redistribute(self, force: float) -> None:
        """Subtract a force from s on F, in proportion to the pressure (B9)."""
        p = (self._base + self.correction + self.s) * self.free
        total = self._measure.total(p)
        if not total > 0:  # all cells of F are new
            p, total = self.free, self._measure.total(self.free)
        self.s = self.s - force / total * p

    def inner_products(self, q: Array) -> Products:
        """Take q = A s; return the inner products of s, q and r (B11)."""
        self.q, dot, free = q, self._measure.dot, self.free
        s_free = free * self.s
        return Products(
            sq=dot(self.s, q),
            q_sum=dot(free, q),
            rs=dot(self.r, self.s),
            rs_free=dot(self.r, s_free),
            s_sum=self._measure.total(s_free),
            r_sum=dot(free, self.r),
        )

    def advance(self, alpha: float, mean: float) -> float:
        """Add alpha s to the pressure, subtract alpha (q - mean) from r; return the largest size of r on F (B14)."""
        self.correction += alpha * self.s
        self.r -= alpha * (self.q - mean if mean else self.q)
        self.s *= self.free  # B15
        return self.residual_max()

    def free_violated(self, threshold: float) -> float:
        """Free the active cells whose residual has the wrong sign by more than a threshold (B16).

        Return the largest residual of these, 0 without any.
        """
        xp, r = self._xp, self.r
        self.s *= self.free
        freed = ((r > threshold) & ~self._free & ~self._upper) | ((r < -threshold) & self._upper)
        if not bool(xp.any(freed)):
            return 0.0
        self._set_free(self._free | freed, self._upper & ~freed)
        return max_abs(xp.where(freed, r, 0.0))

    def pressure(self, start: Array, unit: float) -> Array:
        """Return the pressure on F that began as `start` and was corrected, in a `unit`; nowhere negative."""
        xp = self._xp
        p = xp.astype(self.correction, xp.float64)  # in place: planes are large
        p *= unit
        p += start
        p = xp.where(p > 0, p, 0.0)
        p *= self.free
        return p  # type: ignore[no-any-return]

    def _out_of_bounds(self) -> Array:
        """Return how far pressures are beyond their bounds, and those of active cells from theirs."""
        xp, p = self._xp, self._base + self.correction
        rounding = ROUNDINGS * float(xp.finfo(p.dtype).eps)
        p = xp.where(xp.abs(p) > rounding * xp.abs(self._base), p, 0.0)
        if self._bound == math.inf:
            return xp.where(self._free, xp.minimum(p, 0.0), p)  # type: ignore[no-any-return]
        over = p - self._bound
        over = xp.where(xp.abs(over) > rounding * self._bound, over, 0.0)
        violation = xp.minimum(p, 0.0) + xp.maximum(over, 0.0)
        return xp.where(self._free, violation, xp.where(self._upper, over, p))  # type: ignore[no-any-return]

    def _set_free(self, free: Mask, upper: Mask) -> None:
        self._free, self._upper = free, upper
        self.free = self._xp.astype(free, self.free.dtype)


Vectors = ArrayVectors | CompiledVectors


def vectors_on(
    inner: InnerOperator,
    measure: Measure,
    free: Mask,
    residual: Array,
    base: Array,
    upper: Mask | None = None,
    bound: float = math.inf,
) -> Vectors:
    """Return the vectors of a solve, in machine code where there is some; parameters as of `ArrayVectors`."""
    if _has_machine_code(residual, measure, bound):
        free = with_margins(free, residual.dtype)
        return CompiledVectors(inner, float(measure.weights), free, residual, base)
    return ArrayVectors(inner, measure, free, residual, base, upper, bound)


def scaled_vectors(
    inner: InnerOperator,
    measure: Measure,
    spec: Specification,
    free: Mask,
    iterate: Iterate,
    *,
    otherwise: float,
) -> tuple[Vectors, float]:
    """Return the vectors of a solve for a depth, in units of the first residual, and this unit (B1).

    Parameters
    ----------
    inner : InnerOperator
    measure : Measure
    spec : Specification
        Where no depth is prescribed it is the mean of u + f over F.
    free : bool array
        F at first, one cell at least, on the cells of the inner operator.
    iterate : Iterate
        Where the solve begins, there too.
    otherwise : float
        Unit where the residual is zero, if it is not zero itself [m].

    Returns
    -------
    vectors : Vectors
    unit : float
        Largest residual on F [m]: with it single precision holds all numbers. Pressures are in the unit too [Pa].
    """
    start, displacement, separation = iterate
    bound = spec.largest_hardness  # that of all cells: others are solved by projection
    if _has_machine_code(separation, measure, bound):
        area = float(measure.weights)
        return CompiledVectors.scaled(inner, area, free, iterate, depth=spec.depth, otherwise=otherwise)
    xp = measure.xp
    level = separation + displacement
    depth = measure.mean(level, free) if spec.depth is None else spec.depth
    unit = max_abs((depth - level)[free]) or otherwise or 1.0
    there = xp.isfinite(separation)
    residual = inner.scaled((depth - xp.where(there, level, 0.0)) / unit)
    residual = xp.where(there, residual, NEVER)
    upper = (start >= bound) & ~free
    base = inner.scaled(start / unit)
    return ArrayVectors(inner, measure, free, residual, base, upper, bound / unit), unit


def _has_machine_code(field: Array, measure: Measure, bound: float) -> bool:
    """Whether there is machine code for such vectors."""
    return not measure.varies and bound == math.inf and loader.takes(field)
