"""The fields of conjugate gradients between products: in machine code where there is some, else by their library."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy, largest, namespace
from roughcontact.contact.drivers import Driver
from roughcontact.contact.measure import Measure
from roughcontact.halfspace.local_inverse import LocalInverse
from roughcontact.machine import loader
from roughcontact.machine.region import Region, lower, with_margins

__all__ = ["Passes", "passes_for"]

Array = npt.NDArray[np.float64]
Single = npt.NDArray[Any]  # of single or double precision


class Passes(Protocol):
    """The fields of one run on a region, and what is done to them; sums are weighted.

    Inside the region r is the lack that is left, t the direction, v what it causes, and z the lack after the
    preconditioner. Outside only r means anything.

    Attributes
    ----------
    change, r, t, v : array
    """

    change: Array
    r: Array
    t: Array
    v: Array

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


def passes_for(
    driver: Driver, measure: Measure, inside: Array, r: Array, t: Array | None, v: Array | None
) -> Passes:
    """Return what works on fields like these; r is overwritten, and t counts inside only."""
    start = namespace(r).zeros_like(r) if t is None else t * inside
    if is_numpy(r) and not measure.varies and loader.takes(r):
        return _Compiled(driver, float(measure.weights), inside, r, start, r if v is None else v)
    return _Generic(driver, measure, inside, r, start, r if v is None else v)


class _Generic:
    def __init__(self, driver: Driver, measure: Measure, inside: Array, r: Array, t: Array, v: Array) -> None:
        self.change, self.r, self.t, self.v = namespace(r).zeros_like(r), r, t, v
        self._driver, self._measure, self._inside = driver, measure, inside
        self._error, self._z = r * inside, r
        self._shared: Any = None

    def size(self) -> float:
        return largest(self._error)

    def share(self) -> float:
        self._shared = self._driver.approximate_inverse(self._inside)
        self._shared *= self._inside
        return self._measure.total(self._shared)

    def precondition(self) -> tuple[float, float, float]:
        self._z = self._driver.approximate_inverse(self._error)
        self._z *= self._inside
        dot = self._measure.dot
        return dot(self._error, self._z), dot(self._z, self.v), self._measure.total(self._z)

    def turn(self, beta: float, shift: float) -> Array:
        self.t *= beta
        self.t += self._z
        if self._shared is not None:
            self.t -= shift * self._shared
        return self.t

    def measure(self, v: Array) -> tuple[float, float, float, float]:
        self.v, dot = v, self._measure.dot
        return dot(self.t, v), dot(self._inside, v), dot(self._error, self.t), self._measure.total(self.t)

    def advance(self, alpha: float, mean: float) -> float:
        self.change += alpha * self.t
        self.r -= alpha * (self.v - mean if mean else self.v)
        self._error = self.r * self._inside
        return largest(self._error)


class _Compiled:
    """The same in machine code, for NumPy's arrays and cells of one size: it follows the region, not the plane."""

    def __init__(
        self, driver: Driver, weight: float, inside: Single, r: Single, t: Single, v: Single
    ) -> None:
        self.r, self.t, self.v = (np.ascontiguousarray(field, dtype=r.dtype) for field in (r, t, v))
        self.change = np.zeros(r.shape, dtype=r.dtype)
        self._driver, self._weight = driver, weight
        self._region = Region(np.ascontiguousarray(inside, dtype=r.dtype))
        self._error, self._z = with_margins(self.change), self.change
        self._relief = float(getattr(driver, "relief", 0.0))
        self._constant: Single | None = None
        self._shares = False

    def size(self) -> float:
        return self._advanced(0.0)

    def share(self) -> float:
        self._shares, inside = True, self._region.inside
        return self._sums("weigh", 3, self._of_constant(), inside, inside, self.v, inside, 0.0)[2]

    def precondition(self) -> tuple[float, float, float]:
        self._z, inside = self._inverse(self._error), self._region.inside
        constant = self._of_constant() if self._relief else self._z
        a, b, c = self._sums("weigh", 3, self._z, inside, self._error, self.v, constant, self._relief)
        return a, b, c

    def turn(self, beta: float, shift: float) -> Array:
        shared, by = (self._of_constant(), shift) if self._shares else (self._z, 0.0)
        self._region.run("turn", 0, self.t, self._z, shared, beta, by)
        return self.t

    def measure(self, v: Array) -> tuple[float, float, float, float]:
        self.v = np.ascontiguousarray(v, dtype=self.r.dtype)
        a, b, c, d = self._sums("measure", 4, self.t, self.v, self._region.inside, self._error)
        return a, b, c, d

    def advance(self, alpha: float, mean: float) -> float:
        lower(self.r, self.v, alpha, mean)
        return self._advanced(alpha)

    def _advanced(self, alpha: float) -> float:
        fields = self.change, self.r, self._error, self.t, self._region.inside
        return float(self._region.run("advance", 1, *fields, alpha).max())

    def _of_constant(self) -> Single:
        """Return what the inverse answers to a constant on the region."""
        if self._constant is None:
            self._constant = self._inverse(with_margins(self._region.inside))
        return self._constant

    def _inverse(self, field: Single) -> Single:
        """Return about the pressure under a field that is zero outside the region."""
        local: LocalInverse | None = getattr(self._driver, "local_inverse", None)
        if local is None:
            return np.ascontiguousarray(self._driver.approximate_inverse(field), dtype=field.dtype)
        return local.on(self._region, field)

    def _sums(self, name: str, count: int, *fields: Single | float) -> list[float]:
        sums = self._region.run(name, count, *fields).sum(axis=0)
        return [float(self._weight * one) for one in sums]
