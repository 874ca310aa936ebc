"""The law of an interface under normal load: closure and stiffness against nominal pressure, between computed loads."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from scipy.interpolate import PchipInterpolator

from roughcontact.cached import cached_property
from roughcontact.contact.curve import REMEDY, Curve
from roughcontact.contact.loop import Loop
from roughcontact.errors import InputError
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.statistics.power_law import fit_power_law
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["NormalLaw", "Pressed", "normal_law"]

Pressed: TypeAlias = "Curve | Loop"

_ROUNDING = 1e-12  # of a pressure that leaves the range by rounding of a difference
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(12)
_BISECTIONS = 60
_SMOOTH_POINTS = 400


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class NormalLaw:
    """Mean gap and interfacial stiffness per area against nominal pressure, of surfaces that do not flow any more.

    Between the loads, the mean gap is a monotone cubic in the logarithm of the pressure. Below the lowest load, the
    pressure is a power of the closure since first touch that continues the slope, if the gap at first touch is known.

    Attributes
    ----------
    pressure, gap : array, shape (n,)
        Nominal pressures [Pa], increasing, and mean gaps [m], decreasing.
    touch : float
        Mean gap at first touch [m]; NaN if it is not known, as for a free map.
    cells : array, shape (n,)
        Number of cells in contact; infinite for a fitted law.
    map_area : float
        Nominal area of the map [m^2].
    modulus : float
        Reduced modulus E* [Pa].
    hardness : float
        Pressure at which cells flowed before [Pa]; infinite for an elastic curve.
    columns : dict of array
        Other numbers of the loads: contact fraction, and the measures of the curve.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, long_cutoff=3e-5)
    >>> law = rc.normal_law(rc.loading_curve(surface, 1e9, pressures=[1e6, 2e6, 4e6, 8e6]))
    >>> law
    NormalLaw(4 loads, 1e+06 to 8e+06 Pa)
    >>> f"{law.gap_at(3e6) * 1e9:.0f} nm, {law.stiffness_at(3e6) / 1e12:.0f} N/um/mm^2"
    '91 nm, 51 N/um/mm^2'
    """

    pressure: Array
    gap: Array
    touch: float
    cells: Array
    map_area: float
    modulus: float
    hardness: float
    columns: dict[str, Array]

    @property
    def lowest(self) -> float:
        """Lowest pressure at which the law holds [Pa]: 0 if the gap at first touch is known."""
        return float(self.pressure[0]) if math.isnan(self.touch) else 0.0

    @property
    def highest(self) -> float:
        """Highest pressure at which the law holds [Pa]."""
        return float(self.pressure[-1])

    @numeric(pressure="Pa")
    def gap_at(self, pressure: float | Array) -> Array:
        """Return the mean gap [m] at nominal pressures [Pa].

        Parameters
        ----------
        pressure : float or array
            Nominal pressures, from `lowest` to `highest` [Pa].

        Returns
        -------
        float or array
            Mean gaps [m].

        Raises
        ------
        ValueError
            If a pressure lies outside the law: it is never extrapolated.
        """
        p = self._within(pressure)
        above = np.maximum(p, self.pressure[0])
        found = self._cubic(np.log(above))
        start = self.pressure[0]
        if self.lowest == 0:
            below = self.touch - (self.touch - self.gap[0]) * (p / start) ** self._power
            found = np.where(p < start, below, found)
        return np.asarray(found)

    @numeric(pressure="Pa")
    def stiffness_at(self, pressure: float | Array) -> Array:
        """Return the interfacial stiffness per area [Pa/m], the slope -dp/dgap of this law.

        Parameters
        ----------
        pressure : float or array
            Nominal pressures, from `lowest` to `highest` [Pa].

        Returns
        -------
        float or array
            K/A0 [Pa/m]; 0 at first touch, unless the law begins with a finite slope.
        """
        p = self._within(pressure)
        found = -np.maximum(p, self.pressure[0]) / self._cubic(np.log(np.maximum(p, self.pressure[0])), 1)
        if self.lowest == 0:
            found = np.where(p < self.pressure[0], found * (p / self.pressure[0]) ** (1 - self._power), found)
        return np.asarray(found)

    @numeric(gap="m")
    def pressure_at(self, gap: float | Array) -> Array:
        """Return the nominal pressure [Pa] at mean gaps [m], the inverse of `gap_at`; 0 above the gap at first touch.

        Parameters
        ----------
        gap : float or array
            Mean gaps [m].

        Returns
        -------
        float or array
            Nominal pressures [Pa]; NaN above the largest gap of a law whose first touch is not known.

        Raises
        ------
        ValueError
            If a gap is smaller than that of the highest load.
        """
        g, low = np.asarray(gap, dtype=np.float64), float(self.gap[-1])
        require(
            g >= low - _ROUNDING * abs(self.gap[0]),
            f"the smallest mean gap of the curve is {low:g} m",
            "use a curve with higher loads",
            value=g,
            place="gap",
        )
        k = np.clip(np.searchsorted(-self.gap, -g) - 1, 0, len(self.gap) - 2)
        x = np.log(self.pressure)
        below, above = x[k], x[k + 1]
        for _ in range(_BISECTIONS):
            middle = (below + above) / 2
            closed = self._cubic(middle) <= g
            below, above = np.where(closed, below, middle), np.where(closed, middle, above)
        found = np.exp((below + above) / 2)
        if self.lowest > 0:
            return np.where(g > self.gap[0], np.nan, found)
        closure = np.maximum(self.touch - g, 0.0) / (self.touch - self.gap[0])
        return np.where(g > self.gap[0], self.pressure[0] * closure ** (1 / self._power), found)

    def bow(self, low: float, high: float) -> float:
        """Return by how much the chord of the gap lies above it, integrated from one pressure to another [Pa m].

        It is the trapezoidal rule less the integral, ``int (p_m - p)/K dp`` with the middle p_m, a form without the
        cancellation of the two.

        Parameters
        ----------
        low, high : float
            Pressures [Pa].

        Returns
        -------
        float
            Integral [Pa m].
        """
        self._within(np.array([low, high]))
        middle, start, m = (low + high) / 2, float(self.pressure[0]), self._power
        total = 0.0
        if low < start:
            upper = min(high, start)
            # The stiffness is that of the lowest load times (p/start)^(1 - m).
            first, last = (
                middle * x**m / m - start * x ** (m + 1) / (m + 1) for x in (low / start, upper / start)
            )
            total += (last - first) * start / float(self.stiffness_at(start))
        inside = self.pressure[(self.pressure > low) & (self.pressure < high)]
        ends = np.log(np.concatenate([[max(low, start)], inside[inside > start], [max(high, start)]]))
        half = np.diff(ends)[:, None] / 2
        x = ends[:-1, None] + half * (1 + _NODES)
        # 1/K dp = -(dg/dx) dx
        return total - float((half * _WEIGHTS * (middle - np.exp(x)) * self._cubic(x, 1)).sum())

    @cached_property
    def fitted(self) -> NormalLaw:
        """The law with the stiffness ``K/A0 = c p^a`` that fits the loads, without the steps of single cells.

        It is fitted to the slopes between neighbouring loads by least squares of the logarithms.
        """
        pressure, gap = self.pressure, self.gap
        middle = np.sqrt(pressure[1:] * pressure[:-1])
        fit = fit_power_law(middle, np.diff(pressure) / -np.diff(gap), 1.0, 1.0, "all loads")
        a, c = fit.exponent, fit.prefactor
        p = np.geomspace(pressure[0], pressure[-1], _SMOOTH_POINTS)
        exponential = abs(1 - a) < 1e-9
        closure = np.log(p / p[0]) / c if exponential else (p ** (1 - a) - p[0] ** (1 - a)) / (c * (1 - a))
        there = float(np.interp(math.log(middle[len(middle) // 2]), np.log(pressure), gap))
        level = there + float(np.interp(math.log(middle[len(middle) // 2]), np.log(p), closure))
        touch = level + p[0] ** (1 - a) / (c * (1 - a)) if a < 1 and not exponential else math.nan
        return NormalLaw(
            p,
            level - closure,
            touch,
            np.full(len(p), math.inf),
            self.map_area,
            self.modulus,
            self.hardness,
            {name: np.interp(np.log(p), np.log(pressure), each) for name, each in self.columns.items()},
        )

    def __repr__(self) -> str:
        """Return the range of the law."""
        return f"NormalLaw({len(self.pressure)} loads, {self.pressure[0]:.4g} to {self.highest:.4g} Pa)"

    @cached_property
    def _cubic(self) -> PchipInterpolator:
        return PchipInterpolator(np.log(self.pressure), self.gap)

    @cached_property
    def _power(self) -> float:
        """Exponent m of the closure ~ p^m below the lowest load, whose slope is that of the cubic."""
        if math.isnan(self.touch):
            return 1.0
        return float(-self._cubic(math.log(self.pressure[0]), 1) / (self.touch - self.gap[0]))

    def _within(self, pressure: float | Array) -> Array:
        p = positive(pressure, "the nominal pressure [Pa]", zero=True)
        require(
            (p >= self.lowest * (1 - _ROUNDING)) & (p <= self.highest * (1 + _ROUNDING)),
            f"the law holds from {self.lowest:g} to {self.highest:g} Pa",
            "use a curve whose loads include this pressure",
            value=p,
            place="pressure",
        )
        return np.clip(p, self.lowest, self.highest)


def normal_law(pressed: Pressed) -> NormalLaw:
    """Return the law of an interface between its loads.

    Parameters
    ----------
    pressed : Curve or Loop
        The curve of a map without hardness, or a loop of loads: its reloading branch, up to the largest load, is the
        law of surfaces that have flowed.

    Returns
    -------
    NormalLaw
        Of all loads that met their tolerance.

    Raises
    ------
    ValueError
        If the curve is not that of a map, is the first loading of a surface that flows, or has fewer than two loads.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ground = rc.examples.surface("ground")
    >>> loop = rc.loading_loop(ground, 1e11, hardness=4e9, pressures=[1e7, 3e7, 1e8])
    >>> rc.normal_law(loop)
    NormalLaw(3 loads, 1e+07 to 1e+08 Pa)
    """
    curve = pressed.reloading if isinstance(pressed, Loop) else pressed
    if curve.geometry is not Geometry.SURFACE:
        raise InputError(
            f"the law of an interface per area needs the curve of a map, not of a {curve.geometry.value}",
            "press a map of heights",
        )
    if math.isfinite(curve.hardness):
        raise InputError(
            "this is the first loading of a surface that flows: it does not return on the same curve when a part of "
            "the load is removed",
            "pass the loop of rc.loading_loop, whose reloading branch is elastic",
            "curve",
        )
    solved = np.array([status.converged for status in curve.status]) & (curve.force > 0)
    solved &= np.isfinite(curve.interfacial_stiffness)
    kept = np.flatnonzero(solved)[np.argsort(curve.force[solved], kind="stable")]
    pressure, gap = curve.nominal_pressure[kept], curve.mean_gap[kept]
    if len(kept) < 2 or not ((np.diff(gap) < 0).all() and (np.diff(pressure) > 0).all()):
        raise InputError(
            f"a law needs two loads between which the mean gap falls, and the curve has {len(kept)} loads",
            REMEDY,
        )
    touch = math.nan
    if isinstance(pressed, Loop):
        touch = pressed.residual_gap
    elif all(curve.periodic):  # depth and mean gap add up to the mean separation
        touch = float(curve.mean_gap[0] + curve.depth[0])
    return NormalLaw(
        pressure,
        gap,
        touch,
        curve.contact_area[kept] / math.prod(curve.spacing),
        curve.nominal_area,
        curve.modulus,
        pressed.loading.hardness if isinstance(pressed, Loop) else math.inf,
        {"contact_fraction": curve.contact_fraction[kept]}
        | {name: values[kept] for name, values in curve.measured.items()},
    )
