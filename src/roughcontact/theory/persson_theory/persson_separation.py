"""Persson's theory: mean gap, stiffness of the interface and elastic energy.

The energy of the flattened waves is that of full contact times W(P), with the contact fraction P at the magnification
of the wave: ``W = P (gamma + (1 - gamma) P^2)``. Waves in the contact regions are flatter than elsewhere, which makes
gamma < 1. It is 1 in Persson, Phys. Rev. Lett. 99, 125502 (2007), and 0.45 in Yang and Persson, J. Phys.: Condens.
Matter 20, 215214 (2008); the factor is fitted to computed contacts and does not follow from the theory. The other
results follow: the mean gap from du = -dU/(A0 p), the stiffness from K = -A0 dp/du (thesis, eqs 3.11 to 3.16; below
3.16 the minus sign is missing there).

`spectrum` is a continuous or measured spectrum or `Waves`. With g(q) the slope of all waves longer than q,
``q^2 C2D w dq = sqrt2 q/(2 pi g) d<h^2>`` for w = sqrt2/g, and every integral below is a sum over the waves.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.special import beta, erf, exp1

from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.validation import Array, numeric, positive, require

__all__ = [
    "GAMMA",
    "decay_length",
    "elastic_energy",
    "mean_gap",
    "reference_pressure",
    "self_affine_decay",
    "stiffness",
]

GAMMA = 0.45
ERF_SQUARED_TAIL = 0.40712493463432379  # int_0^inf erf(x)^2 exp(-x^2) dx/x


@numeric
def mean_gap(pressure: float | Array, modulus: float, spectrum: Spectrum, *, gamma: float = GAMMA) -> Array:
    """Return the mean gap u [m] over the nominal area; infinite without load, because a Gaussian surface has no top.

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    spectrum : Waves, measured or continuous spectrum
        See `Waves.of`.
    gamma : float
        Energy of the waves in contact at small load over that of full contact, above 0 and at most 1.

    Returns
    -------
    float or array
        u [m].

    Raises
    ------
    ValueError
        If a number is out of range, or the spectrum without limits.

    Notes
    -----
    ``u = sqrt(pi) int q^2 C2D w dq int_{wp/E*}^inf [gamma + 3 (1 - gamma) erf(t)^2] exp(-t^2) dt/t``.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_separation as separation
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> gap = separation.mean_gap([1.0, 1e9], 1e11, spectrum)
    >>> bool(gap[0] > 1e-6 > gap[1])  # above the rms height at low pressure, below it at high
    True
    """
    share = _checked(gamma)
    return _over_waves(pressure, modulus, spectrum, lambda x: _tail(x, share))


@numeric
def stiffness(pressure: float | Array, modulus: float, spectrum: Spectrum, *, gamma: float = GAMMA) -> Array:
    """Return the stiffness of the interface per nominal area, K/A0 = -dp/du = p/l(p) [Pa/m].

    ``l(p) = sqrt(pi) int q^2 C2D w [gamma + 3 (1 - gamma) P^2] exp(-(w p/E*)^2) dq`` is `decay_length` at no load.
    Near full contact it vanishes, and K diverges. Parameters as of `mean_gap`.

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    spectrum : Waves, measured or continuous spectrum
        Of the surface, see `Waves.of`.
    gamma : float
        See `mean_gap`.

    Returns
    -------
    float or array
        K/A0 [Pa/m].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_separation as separation
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> low = separation.stiffness([1.0, 2.0], 1e11, spectrum)
    >>> round(float(low[1] / low[0]), 4)  # in proportion to the pressure while it is low
    2.0
    """
    share = _checked(gamma)
    length = _over_waves(pressure, modulus, spectrum, lambda x: _fall(x, share))
    with np.errstate(divide="ignore"):
        return np.asarray(np.asarray(pressure) / length)


@numeric
def elastic_energy(
    pressure: float | Array, modulus: float, spectrum: Spectrum, *, gamma: float = GAMMA
) -> Array:
    """Return the elastic energy of the interface per nominal area, U/A0 = (E*/4) sum q W(P) <h^2> [J/m^2].

    The energy of uniform compression is not included. Parameters are those of `mean_gap`.

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    spectrum : Waves, measured or continuous spectrum
        Of the surface, see `Waves.of`.
    gamma : float
        See `mean_gap`.

    Returns
    -------
    float or array
        U/A0 [J/m^2].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_separation as separation
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> energy = float(separation.elastic_energy(1.0, 1e11, spectrum))
    >>> round(energy / separation.decay_length(spectrum), 4)  # U = A0 p u0 at low load
    1.0
    """
    waves, share = Waves.of(spectrum), _checked(gamma)
    # Only q of the common factor sqrt2 q/(2 sqrt(pi) g) belongs here.
    undo = modulus / 4 * math.sqrt(2 * math.pi) * waves.slope

    def squeezed(x: Array) -> Array:
        part = erf(x)
        return undo * part * (share + (1 - share) * part**2)

    return _over_waves(pressure, modulus, waves, squeezed)


@numeric
def decay_length(spectrum: Spectrum, *, gamma: float = GAMMA) -> float:
    """Return u0 [m], of p = p_c exp(-u/u0) and K = A0 p/u0 at small loads (thesis, eqs 3.15 and 3.16).

    ``u0 = gamma sqrt(pi) int q^2 C2D w dq``, proportional to the rms height, and independent of the short waves
    for a Hurst exponent well above 0.

    Parameters
    ----------
    spectrum : Waves, measured or continuous spectrum
        Of the surface, see `Waves.of`.
    gamma : float
        See `mean_gap`.

    Returns
    -------
    float
        u0 [m].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_separation as separation
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> u0 = separation.decay_length(spectrum)
    >>> stiffness = separation.stiffness(1.0, 1e11, spectrum)
    >>> round(float(stiffness) * u0, 4)  # K = A0 p/u0 at low load
    1.0
    """
    return _checked(gamma) * float(_over_waves(0.0, 1.0, spectrum, np.ones_like))


@numeric
def reference_pressure(modulus: float, spectrum: Spectrum, *, gamma: float = GAMMA) -> float:
    """Return p_c [Pa], of p = p_c exp(-u/u0) at small loads.

    ``ln(p_c/E*) u0 = sqrt(pi) int q^2 C2D w [gamma (-ln w - C/2) + 3 (1 - gamma) I] dq``, C = 0.5772... (Euler) and
    I = int_0^inf erf(x)^2 exp(-x^2) dx/x.

    Parameters
    ----------
    modulus : float
        Reduced modulus E* [Pa].
    spectrum : Waves, measured or continuous spectrum
        Of the surface, see `Waves.of`.
    gamma : float
        See `mean_gap`.

    Returns
    -------
    float
        p_c [Pa].

    Examples
    --------
    >>> import math
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_separation as separation
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> scale, u0 = separation.reference_pressure(1e11, spectrum), separation.decay_length(spectrum)
    >>> gap = float(separation.mean_gap(1.0, 1e11, spectrum))
    >>> round(scale * math.exp(-gap / u0), 3)  # the pressure of 1 Pa
    1.0
    """
    waves, share = Waves.of(spectrum), _checked(gamma)
    logs = np.log(waves.slope / math.sqrt(2)) - np.euler_gamma / 2
    level = share * logs + 3 * (1 - share) * ERF_SQUARED_TAIL
    weighted = float(_over_waves(0.0, modulus, waves, lambda _: level))
    exponent = float(weighted) / max(decay_length(waves, gamma=gamma), 1e-300)
    require(
        abs(exponent) < 700,
        f"gamma is too small for a reference pressure, ln(p_c/E*) = {exponent:g}",
        place="gamma",
    )
    return modulus * math.exp(exponent)


@numeric
def self_affine_decay(hurst: float) -> float:
    """Return u0/(gamma h) of a self-affine surface of rms height h with a longest and no shortest wave [-].

    H = 1/2: sqrt(pi/2); H = 1: 1; H = 2: sqrt(pi)/2. A shortest wave reduces it, only slightly if H is large.

    Parameters
    ----------
    hurst : float
        Hurst exponent H [-].

    Returns
    -------
    float
        u0/(gamma h) [-].

    Raises
    ------
    ValueError
        If H is not positive: then the height depends on the short waves, and there is no limit.

    Examples
    --------
    >>> from roughcontact.theory import persson_separation as separation
    >>> [round(separation.self_affine_decay(hurst), 4) for hurst in (0.5, 1.0, 2.0)]
    [1.2533, 1.0, 0.8862]
    """
    reason = f"without a shortest wave only a positive Hurst exponent has an rms height, not {hurst}"
    require(0 < hurst < np.inf, reason)
    # u0/gamma = sqrt(2/pi) int dg/q, and g^2 = h^2 q0^2 H/(1-H) [(q/q0)^(2-2H) - 1] makes it a Beta function.
    rest = abs(1 - hurst)
    if rest < 1e-9:
        return 1.0
    other = (hurst if hurst < 1 else 2 * hurst - 1) / (2 * rest)
    return math.sqrt(hurst / (2 * math.pi * rest)) * float(beta(other, 0.5))


def _over_waves(
    pressure: float | Array, modulus: float, spectrum: Spectrum, function: Callable[[Array], Array]
) -> Array:
    """Return ``sqrt(pi) int q^2 C2D w f(w p/E*) dq`` for each pressure."""
    p, waves = positive(pressure, "the pressure [Pa]", zero=True), Waves.of(spectrum)
    weights = waves.power * waves.wavenumber / (math.sqrt(2 * math.pi) * waves.slope)
    rate = math.sqrt(2) / (positive(modulus, "the modulus [Pa]") * waves.slope)
    # One pressure at a time, because there are many waves.
    return np.array([weights @ function(rate * one) for one in p.ravel()]).reshape(p.shape)


def _fall(x: Array, gamma: float) -> Array:
    """Return ``[gamma + 3 (1 - gamma) erf(x)^2] exp(-x^2)``."""
    return np.asarray((gamma + 3 * (1 - gamma) * erf(x) ** 2) * np.exp(-(x**2)))


def _tail(x: Array, gamma: float) -> Array:
    """Return the integral of ``[gamma + 3 (1 - gamma) erf(t)^2] exp(-t^2)/t`` from x on."""
    plain = exp1(x**2) / 2
    table = _erf_squared_tail()
    end = table.x[-1]
    squared = np.where(x < end, table(np.minimum(x, end)), plain)
    return np.asarray(gamma * plain + 3 * (1 - gamma) * squared)


@cache
def _erf_squared_tail() -> CubicHermiteSpline[np.float64]:
    """Return the integral of ``erf(t)^2 exp(-t^2)/t`` from x on, for x up to 6; beyond, erf is 1."""
    x = np.linspace(0, 6, 2001)
    y, weights = np.polynomial.legendre.leggauss(16)
    y = (y + 1) / 2
    # erf(t)^2 = 1 - (4/pi) int_0^1 exp(-t^2 (1 + y^2))/(1 + y^2) dy, and each exponential integrates to exp1.
    away = x[1:, None] ** 2
    lost = exp1(away * (2 + y**2)) / (1 + y**2) @ weights / math.pi
    values = np.append(ERF_SQUARED_TAIL, exp1(x[1:] ** 2) / 2 - lost)
    slopes = np.append(0.0, -(erf(x[1:]) ** 2) * np.exp(-(x[1:] ** 2)) / x[1:])
    return CubicHermiteSpline(x, values, slopes)


def _checked(gamma: float) -> float:
    require(0 < gamma <= 1, f"gamma must be above 0 and at most 1, not {gamma}", place="gamma")
    return gamma
