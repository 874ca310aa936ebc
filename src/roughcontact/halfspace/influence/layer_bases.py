"""What a layer lies on, and its response to waves of pressure beside that of a half-space of its material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np
import numpy.typing as npt

from roughcontact.material import Solid

__all__ = ["Base", "Bonded", "Frictionless", "OnHalfSpace"]

Array = npt.NDArray[Any]  # real wavenumbers, or complex ones where a kernel is expanded


class Base(Protocol):
    """The answer to waves of wavenumber q, with ``t = q thickness``: ``2/(E* q) * ratio(t)``, E* of the layer."""

    @property
    def slope(self) -> float:
        """Limit of ``ratio(t)/t`` at t = 0: a constant pressure p presses in by ``2 slope thickness p/E*``.

        Zero for one that moves nothing, and for one that would move an endless body without bound.
        """

    def ratio(self, t: Array) -> Array:
        """Return the ratio of the answer to that of a half-space, at t > 0."""

    def deviation(self, t: Array) -> Array:
        """Return the same less one, which decays as exp(-2 t)."""


@dataclass(frozen=True, slots=True)
class Frictionless:
    """A rigid base on which the layer slides: ``(cosh 2t - 1)/(sinh 2t + 2t)``, whatever its Poisson's ratio."""

    @property
    def slope(self) -> float:
        """A half: u = p thickness/E*."""
        return 0.5

    def ratio(self, t: Array) -> Array:
        """Return M."""
        e, rest = np.exp(-2 * t), -np.expm1(-2 * t)
        return np.asarray(rest**2 / (rest * (1 + e) + 4 * t * e))

    def deviation(self, t: Array) -> Array:
        """Return M - 1."""
        e, rest = np.exp(-2 * t), -np.expm1(-2 * t)
        return np.asarray(-2 * e * (rest + 2 * t) / (rest * (1 + e) + 4 * t * e))


@dataclass(frozen=True, slots=True)
class Bonded:
    """A rigid base to which the layer is bonded.

    ``(2 k sinh 2t - 4 t)/(2 k cosh 2t + 4 t^2 + 1 + k^2)`` with k = 3 - 4 nu of the layer.
    """

    poisson_ratio: float

    @property
    def _k(self) -> float:
        return 3 - 4 * self.poisson_ratio

    @property
    def slope(self) -> float:
        """That of a layer which cannot widen: u = p thickness (1 + nu)(1 - 2 nu)/((1 - nu) E)."""
        nu = self.poisson_ratio
        return (1 - 2 * nu) / (2 * (1 - nu) ** 2)

    def ratio(self, t: Array) -> Array:
        """Return M."""
        k, e, rest = self._k, np.exp(-2 * t), -np.expm1(-2 * t)
        # sinh 2t - 2t apart: near t = 0 it is all that an incompressible layer has.
        return np.asarray(((k - 1) * rest * (1 + e) + 2 * _scaled(2 * t)) / self._denominator(t, e))

    def deviation(self, t: Array) -> Array:
        """Return M - 1."""
        k, e = self._k, np.exp(-2 * t)
        return np.asarray(-e * (2 * k * e + 4 * t + 4 * t**2 + 1 + k**2) / self._denominator(t, e))

    def _denominator(self, t: Array, e: Array) -> Array:
        k = self._k
        return np.asarray(k * (1 + e**2) + (4 * t**2 + 1 + k**2) * e)


@dataclass(frozen=True, slots=True)
class OnHalfSpace:
    """A half-space of another solid to which the layer is bonded.

    ``[1 + 4 t r e - l r e^2]/[1 - (l + r + 4 r t^2) e + l r e^2]`` with ``e = exp(-2 t)``, ``m = G1/G2``,
    ``l = 1 - 4 (1 - nu1)/(1 + m (3 - 4 nu2))`` and ``r = (m - 1)/(m + 3 - 4 nu1)``; 1 is the layer, 2 its base.
    """

    layer: Solid
    base: Solid

    @property
    def slope(self) -> float:
        """Zero: the mean displacement of an endless body is set to zero."""
        return 0.0

    def ratio(self, t: Array) -> Array:
        """Return M."""
        c, e = self._constants, np.exp(-2 * t)
        # (1 - e^2) - 4 t e = 2 e (sinh 2t - 2t), and what is left of the two where layer or base is stiff
        numerator = c.product_rest + 2 * c.l * c.r * _scaled(2 * t) + 4 * t * e * c.r * (1 + c.l)
        return np.asarray(numerator / self._denominator(t, e))

    def deviation(self, t: Array) -> Array:
        """Return M - 1."""
        c, e, rest = self._constants, np.exp(-2 * t), -np.expm1(-2 * t)
        change = c.l * c.r_rest + c.r * c.l_rest + 2 * c.l * c.r * rest + 4 * c.r * t * (1 + t)
        return np.asarray(e * change / self._denominator(t, e))

    def _denominator(self, t: Array, e: Array) -> Array:
        c, rest = self._constants, -np.expm1(-2 * t)
        # (1 - e)^2 - 4 t^2 e = 4 e (sinh^2 t - t^2): a stiff layer bends
        less = _scaled(t)
        bending = 4 * less * (less + 2 * t * np.exp(-t))
        return np.asarray(c.l_rest * c.r_rest + rest * (c.l_rest * c.r * e + c.r_rest * c.l) + c.r * bending)

    @property
    def _constants(self) -> _Constants:
        m = self.layer.shear_modulus / self.base.shear_modulus
        k1, k2 = (3 - 4 * solid.poisson_ratio for solid in (self.layer, self.base))
        below, above = 1 + m * k2, m + k1
        return _Constants(
            l=(m * k2 - k1) / below,
            r=(m - 1) / above,
            l_rest=(1 + k1) / below,
            r_rest=(1 + k1) / above,
            product_rest=m * (1 + k1) * (1 + k2) / (below * above),
        )


class _Constants(NamedTuple):
    """l, r, 1 - l, 1 - r and 1 - l r, each without a difference of nearly equal numbers."""

    l: float  # noqa: E741
    r: float
    l_rest: float
    r_rest: float
    product_rest: float


def _scaled(t: Array) -> Array:
    """Return ``exp(-t) (sinh t - t)``."""
    small = np.where(np.abs(t) < 1, t, 0)
    term = small**3 / 6
    series = term.copy()
    for n in range(2, 10):
        term = term * small**2 / (2 * n * (2 * n + 1))
        series += term
    near_zero = np.exp(-small) * series
    return np.asarray(np.where(np.abs(t) < 1, near_zero, -np.expm1(-2 * t) / 2 - t * np.exp(-t)))
