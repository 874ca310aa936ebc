"""The law of an interface under normal load: closure and stiffness against nominal pressure, between computed loads.

The stiffness of an elastic contact rises with the pressure p, so that the mean gap g is a convex function of p. Between
two loads, of distance h, g is the hyperbola that has their gaps and stiffnesses and is convex,

    g = chord - h A B t (1 - t)/[A t + B (1 - t)],    0 <= t <= 1,

where the slope of the chord exceeds that of g by A at t = 0, and is exceeded by B at t = 1 (Delbourgo and Gregory, SIAM
J. Sci. Stat. Comput. 6, 967 (1985)). Its stiffness rises with the pressure, and the loss in shear is never negative.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from roughcontact.cached import cached_property
from roughcontact.contact.curve import Curve
from roughcontact.contact.loop import Loop
from roughcontact.errors import InputError, about
from roughcontact.guesses import hinted
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.statistics.power_law import fit_power_law
from roughcontact.validation import Array, numeric, positive, require, shown

__all__ = ["NormalLaw", "normal_law"]

_ROUNDING = 1e-12  # of a pressure that leaves the range by rounding of a difference
_NODES, _WEIGHTS = (np.polynomial.legendre.leggauss(20) + np.array([[1.0], [0.0]])) / 2  # from 0 to 1
_STRAIGHT = 1e-15  # of the slope of a chord: the least turn
_BISECTIONS = 60
_MORE = "press the map by more loads, from small ones on, none of them in full contact"
_PASSES = 6  # of the exponent of a fitted law: it is then exact to 1e-6 for loads a decade apart
_SMOOTH_POINTS = 400
_TINY = 1e-150  # of the lowest load: the stiffness without pressure is that at this one
_SAME = 1e-9  # relative change below which two lengths, or two exponents, are equal


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class NormalLaw:
    """Mean gap and interfacial stiffness per area against nominal pressure, of surfaces that do not flow any more.

    Between the loads, the mean gap is a convex function with the computed mean gaps and stiffnesses. Below the lowest
    load, the closure since first touch is the power of the pressure that continues the law. If the gap at first touch
    is not known, the law ends at the lowest load.

    Attributes
    ----------
    pressure, gap, stiffness : array, shape (n,)
        Nominal pressures [Pa], increasing; mean gaps [m], decreasing; interfacial stiffness per area K/A0 [Pa/m].
    touch : float
        Mean gap at first touch [m]; NaN if it is not known: for a free map, or a map with missing cells.
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
    free : bool
        Whether edges of the map are free.

    Raises
    ------
    ValueError
        If there are fewer than two loads, the pressures do not rise, or the mean gaps do not fall.

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
    >>> f"{law.pressure_at(91e-9) / 1e6:.1f} MPa, {law.bow(1e6, 3e6) * 1e3:.1f} mJ/m^2"
    '3.0 MPa, 10.4 mJ/m^2'
    """

    pressure: Array
    gap: Array
    stiffness: Array
    touch: float
    cells: Array
    map_area: float
    modulus: float
    hardness: float
    columns: dict[str, Array]
    free: bool = False

    def __post_init__(self) -> None:
        gaps = self.gap if math.isnan(self.touch) else np.append(self.touch, self.gap)
        rising = (np.diff(self.pressure) > 0).all() and self.pressure[:1] > 0
        require(
            len(self.pressure) > 1 and rising and (np.diff(gaps) < 0).all(),
            "a law needs two or more loads, along which the pressure rises and the mean gap falls "
            f"(loads: {len(self.pressure)})",
            _MORE,
        )

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
        return self._gap(self._within(pressure))

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
        return np.asarray(-1 / self._slope(np.maximum(self._within(pressure), _TINY * self.pressure[0])))

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
        below, above = self.pressure[k], self.pressure[k + 1]
        for _ in range(_BISECTIONS):
            middle = (below + above) / 2
            closed = self._gap(middle) <= g
            below, above = np.where(closed, below, middle), np.where(closed, middle, above)
        if math.isnan(self.touch):
            return np.where(g > self.gap[0], np.nan, above)
        closure = np.maximum(self.touch - g, 0.0) / (self.touch - self.gap[0])
        return np.where(g > self.gap[0], self.pressure[0] * closure ** (1 / self._power), above)

    def bow(self, low: float, high: float) -> float:
        """Return by how much the chord of the gap lies above it, integrated from one pressure to another [Pa m].

        It is the trapezoidal rule less the integral, without the cancellation of the two, and never negative.

        Parameters
        ----------
        low, high : float
            Pressures, in pascals.

        Returns
        -------
        float
            Integral [Pa m].
        """
        low, high = self._within(np.array([low, high]))
        inside = self.pressure[(self.pressure > low) & (self.pressure < high)]
        ends = np.concatenate([[low], inside, [high]])
        lower, upper, middles = ends[:-1], ends[1:], (ends[1:] + ends[:-1]) / 2
        # Between the chord and the polygon through the loads, then in each part between the polygon and the law
        total = float((middles - (low + high) / 2) @ np.diff(self._gap(ends)))
        if low < self.pressure[0]:
            p, m = ends[:2], self._power
            closure = (self.touch - self.gap[0]) * (p / self.pressure[0]) ** m
            total += float(np.diff((middles[0] - p * m / (m + 1)) * closure)[0])
            lower, upper, middles = lower[1:], upper[1:], middles[1:]
        k = np.searchsorted(self.pressure, middles) - 1
        a, b, h, _ = self._pieces[:, k]
        t = (np.array([lower, upper]) - self.pressure[k]) / h
        first, last = b + (a - b) * t
        inner = _WEIGHTS * _NODES * (1 - _NODES) / (first[:, None] + np.outer(last - first, _NODES))
        parts = (upper - lower) ** 2 * (t[1] - t[0]) * (a * b) ** 2 / (first * last)
        return total + float(parts @ inner.sum(axis=1))

    @cached_property
    def fitted(self) -> NormalLaw:
        """The law with the stiffness ``K/A0 = c p^a`` that fits the loads, without the steps of single cells.

        It is fitted to the slopes between neighbouring loads by least squares of the logarithms, and needs three loads.
        On the average of the loads, it has the mean gap of the curve.
        """
        pressure = self.pressure
        require(
            len(pressure) > 2, "a power law of the stiffness needs three loads, and this law has two", _MORE
        )
        middle, slope = np.sqrt(pressure[1:] * pressure[:-1]), np.diff(pressure) / -np.diff(self.gap)
        m = 0.0
        for _ in range(_PASSES):
            # From the slope between two loads to the stiffness in their middle, of a power law of this exponent
            share = middle ** (1 - m) * np.diff(_rise(pressure, m)) / np.diff(pressure)
            fit = fit_power_law(middle, slope * share, 1.0, 1.0, "all loads")
            m = 1 - fit.exponent
        p = np.geomspace(pressure[0], pressure[-1], _SMOOTH_POINTS)
        closure = _rise(p, m) / fit.prefactor  # from first touch on, if m > 0
        level = float(np.mean(self.gap + _rise(pressure, m) / fit.prefactor))
        return replace(
            self,
            pressure=p,
            gap=level - closure,
            stiffness=fit.prefactor * p**fit.exponent,
            touch=level if m > _SAME else math.nan,
            cells=np.full(len(p), math.inf),
            columns={name: np.interp(p, pressure, values) for name, values in self.columns.items()},
        )

    def __repr__(self) -> str:
        """Return the range of the law."""
        return f"NormalLaw({len(self.pressure)} loads, {self.pressure[0]:.4g} to {self.highest:.4g} Pa)"

    def _gap(self, p: Array) -> Array:
        """Return mean gaps [m] at pressures [Pa]."""
        k, a, b, h, chord, t = self._between(p)
        gap = self.gap[k] + chord * h * t - h * a * b * t * (1 - t) / (b + (a - b) * t)
        if math.isnan(self.touch):
            return np.asarray(gap)
        return np.where(p < self.pressure[0], self.touch - self._closure(p), gap)

    def _slope(self, p: Array) -> Array:
        """Return the slopes of the gap at positive pressures [m/Pa]."""
        _, a, b, _, chord, t = self._between(p)
        slope = chord - a * b * (b * (1 - t) ** 2 - a * t**2) / (b + (a - b) * t) ** 2
        if math.isnan(self.touch):
            return np.asarray(slope)
        return np.where(p < self.pressure[0], -self._power * self._closure(p) / p, slope)

    def _between(self, p: Array) -> tuple[Any, ...]:
        """Return the loads below the pressures, the numbers of these pieces, and the places in them, from 0 to 1."""
        k = np.clip(np.searchsorted(self.pressure, p, "right") - 1, 0, len(self.pressure) - 2)
        a, b, h, chord = self._pieces[:, k]
        return k, a, b, h, chord, np.maximum(p - self.pressure[k], 0.0) / h

    def _closure(self, p: Array) -> Array:
        """Return by how much a pressure below the lowest load closes the gap [m]."""
        return np.asarray((self.touch - self.gap[0]) * (p / self.pressure[0]) ** self._power)

    @cached_property
    def _pieces(self) -> Array:
        """A, B, h and the slope of the chord between two loads, a column for each two."""
        h = np.diff(self.pressure)
        chords = np.diff(self.gap) / h
        steepest = -math.inf if math.isnan(self.touch) else (self.gap[0] - self.touch) / self.pressure[0]
        slopes = np.clip(-1 / self.stiffness, [steepest, *chords], [*chords, 0.0])
        turns = np.maximum([chords - slopes[:-1], slopes[1:] - chords], _STRAIGHT * -chords)
        return np.array([*turns, h, chords])

    @cached_property
    def _power(self) -> float:
        """Exponent m of the closure ~ p^m below the lowest load, at most 1."""
        a, _, _, chord = self._pieces[:, 0]
        return float((a - chord) * self.pressure[0] / (self.touch - self.gap[0]))

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


def _rise(pressure: Array, m: float) -> Array:
    """Return the integral of ``p^(m - 1)`` over the pressure; from zero, if m > 0."""
    return np.log(pressure) if abs(m) <= _SAME else pressure**m / m


def normal_law(pressed: Curve | Loop) -> NormalLaw:
    """Return the law of an interface between its loads.

    Parameters
    ----------
    pressed : Curve or Loop
        The curve of a map without hardness, or after plastic flow the loop of `loading_loop`: its reloading branch, up
        to the largest load, is elastic.

    Returns
    -------
    NormalLaw
        Of all loads that met their tolerance.

    Raises
    ------
    ValueError
        If the curve is not that of a map, is a branch of a surface that flows, or has fewer than two loads.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ground = rc.examples.surface("ground")
    >>> loop = rc.loading_loop(ground, 1e11, hardness=4e9, pressures=[1e7, 3e7, 1e8])
    >>> rc.normal_law(loop)
    NormalLaw(3 loads, 1e+07 to 1e+08 Pa)
    """
    if not isinstance(pressed, Curve | Loop):
        raise about(
            "pressed", f"must be a Curve, as rc.loading_curve returns it, or a Loop, not {shown(pressed)}"
        )
    curve = pressed.reloading if isinstance(pressed, Loop) else pressed
    if curve.geometry is not Geometry.SURFACE:
        raise InputError(
            f"the law of an interface per area needs the curve of a map, not of a {curve.geometry.value}",
            "press a map of heights",
        )
    if curve.flow is not None and not isinstance(pressed, Loop):
        raise InputError(
            "this curve is one branch of a surface that flows: first loading is not elastic, and the mean gap at first "
            "touch after flow is not in the curve",
            "pass the loop of rc.loading_loop, whose reloading branch is elastic",
            "pressed",
        )
    solved = np.array([status.converged for status in curve.status]) & (curve.force > 0)
    kept = np.flatnonzero(solved & np.isfinite(curve.interfacial_stiffness))
    kept = kept[np.argsort(curve.force[kept])]
    touch, level = math.nan, curve.mean_gap + curve.depth
    if isinstance(pressed, Loop):
        touch = pressed.residual_gap
    elif all(curve.periodic) and np.ptp(level) < _SAME * level[0]:  # without missing cells
        touch = float(level[0])
    return NormalLaw(
        curve.nominal_pressure[kept],
        curve.mean_gap[kept],
        curve.interfacial_stiffness_per_area[kept],
        touch,
        curve.contact_area[kept] / math.prod(curve.spacing),
        curve.nominal_area,
        curve.modulus,
        pressed.loading.hardness if isinstance(pressed, Loop) else math.inf,
        {"contact_fraction": curve.contact_fraction[kept]}
        | {name: values[kept] for name, values in curve.measured.items()},
        not all(curve.periodic),
    )
