"""Closed forms of heights and their transforms: formulae without checks of their arguments."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import special

from roughcontact.mdr.bodies.chebyshev import Panels
from roughcontact.theory.spheres_and_punches.power_law_indenter import kappa
from roughcontact.validation import Array

__all__ = ["PowerTerm", "SphereTerm", "TableTerm", "ripple_transform"]


def ripple_transform(amplitude: float, wavenumber: float, x: Array) -> Array:
    """Return the transform (pi/2) A k x H0(kx) of A (1 - cos kr) with Struve's function; slow."""
    z = wavenumber * x
    return np.asarray(np.pi / 2 * amplitude * z * special.struve(0, z))


@dataclass(frozen=True, slots=True)
class PowerTerm:
    """f = Q (r^n - b^n) beyond the radius b of a flat face, 0 on it.

    With ``u = (r/x)^2`` the transform is an incomplete beta integral; b = 0 is the power law itself.
    """

    exponent: float
    coefficient: float
    flat: float = 0.0

    @property
    def breaks(self) -> tuple[float, ...]:
        """The rim of the flat face [m]."""
        return (self.flat,) if self.flat > 0 else ()

    @property
    def rises(self) -> bool:
        """Whether g never falls."""
        return self.coefficient >= 0

    def height(self, r: Array) -> Array:
        """Return f(r) [m]."""
        beyond = np.maximum(r, self.flat)
        return np.asarray(self.coefficient * (beyond**self.exponent - self.flat**self.exponent))

    def transform(self, x: Array) -> Array:
        """Return g(x) [m]."""
        return self._full * x**self.exponent * special.betainc(0.5, self.exponent / 2, self._outside(x))

    def slope(self, x: Array) -> Array:
        """Return g'(x) [-]."""
        n, b = self.exponent, self.flat
        with np.errstate(divide="ignore"):
            slope = n * self._full * x ** (n - 1)
        if b == 0:
            return slope
        outside = x > b
        slope = np.where(outside, slope * special.betainc(0.5, n / 2, self._outside(x)), 0.0)
        root = np.sqrt(np.where(outside, (x - b) * (x + b), 1.0))
        return slope + np.where(outside, n * self.coefficient * b**n / root, 0.0)

    def primitive(self, x: Array) -> Array:
        """Return the integral of g from 0 to x [m^2]."""
        n = self.exponent
        return self._full / (n + 1) * x ** (n + 1) * special.betainc(1.5, n / 2, self._outside(x))

    @property
    def _full(self) -> float:
        return float(kappa(self.exponent)) * self.coefficient

    def _outside(self, x: Array) -> Array:
        """Return 1 - (b/x)^2, 0 on the flat face; 1 without a flat face."""
        if self.flat == 0:
            return np.ones_like(x)
        beyond = np.maximum(x, self.flat)
        return np.asarray((beyond - self.flat) * (beyond + self.flat) / beyond**2)


@dataclass(frozen=True, slots=True)
class SphereTerm:
    """f = R - sqrt(R^2 - r^2), g = x artanh(x/R)."""

    radius: float
    flat = 0.0
    breaks = ()
    rises = True

    def height(self, r: Array) -> Array:
        """Return f(r) [m]."""
        return r**2 / (self.radius + np.sqrt((self.radius - r) * (self.radius + r)))

    def transform(self, x: Array) -> Array:
        """Return g(x) [m]."""
        with np.errstate(divide="ignore"):
            return x * np.arctanh(x / self.radius)

    def slope(self, x: Array) -> Array:
        """Return g'(x) [-]."""
        t = x / self.radius
        with np.errstate(divide="ignore"):
            return np.arctanh(t) + t / ((1 - t) * (1 + t))

    def primitive(self, x: Array) -> Array:
        """Return the integral of g from 0 to x [m^2]."""
        t = x / self.radius
        # Far from the equator the closed form is a difference of almost equal numbers.
        series = sum(t ** (2 * k + 3) / ((2 * k + 1) * (2 * k + 3)) for k in range(14))
        inner = np.minimum(t, 1 - 2.0**-53)
        closed = (t - (1 - inner) * (1 + inner) * np.arctanh(inner)) / 2
        return self.radius**2 * np.where(t < 0.25, series, closed)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class TableTerm:
    """A height f(r) [m] and its transform g(x) [m] as tables, with the slope and the integral of the transform."""

    height: Panels
    transform: Panels
    slope: Panels
    primitive: Panels
    flat: float
    breaks: tuple[float, ...]
    rises: bool

    def __repr__(self) -> str:
        """Return the number of panels."""
        return f"TableTerm({len(self.transform.coefficients)} panels)"
