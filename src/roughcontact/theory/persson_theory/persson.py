"""Persson's theory: real contact area and the distribution of pressure, at any magnification.

As shorter waves of the surface are included, the distribution of pressure widens, like that of a particle that
diffuses and is absorbed at zero pressure (Persson, J. Chem. Phys. 115, 3840 (2001); Surf. Sci. Rep. 61, 201 (2006); on
the absorbing boundary Manners and Greenwood, Wear 261, 600 (2006)). In full contact a wave of amplitude B and
wavenumber q causes the pressure E* q B/2: the variance of pressure is (E* g/2)^2 with the rms slope g.

Only the rms slope of a surface matters: `surface` is anything with profile moments, such as
`roughcontact.Moments`, or a spectrum. A lower magnification is the surface without its short waves:
``Waves.of_spectrum(spectrum, q_max=...)``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np
from scipy.special import erf, erfc, erfinv

from roughcontact.theory.law import LoadingLaw, over_area
from roughcontact.theory.persson_theory import persson_separation as separation
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments
from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.validation import Array, moderate, numeric, positive, require

__all__ = [
    "AREA_SLOPE",
    "contact_fraction",
    "fraction_above",
    "law",
    "magnified_fraction",
    "pressure_density",
    "pressure_for",
    "pressure_spread",
]

AREA_SLOPE = math.sqrt(8 / math.pi)  # A/A0 = AREA_SLOPE p/(E* g) at small pressure


@numeric
def contact_fraction(pressure: float | Array, modulus: float, surface: ProfileMoments | Spectrum) -> Array:
    """Return the real contact area over the nominal one, A/A0 = erf(sqrt2 p/(E* g)) [-].

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p, force over nominal area [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    surface : ProfileMoments or spectrum
        Provides the rms slope g.

    Returns
    -------
    float or array
        A/A0 [-].

    Raises
    ------
    ValueError
        If the pressure is negative, the modulus not positive, or the slope zero or infinite.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson
    >>> surface = rc.Moments(1e-12, 0.005, 1e9)  # rms slope 0.1
    >>> round(float(persson.contact_fraction(1e7, 1e11, surface)) / 1e-3, 4)  # sqrt(8/pi) p/(E* g) at low load
    1.5958
    """
    return np.asarray(erf(_pressure(pressure) / (math.sqrt(2) * pressure_spread(modulus, surface))))


@numeric
def magnified_fraction(pressure: float, modulus: float, spectrum: Spectrum) -> tuple[Array, Array]:
    """Return wavenumbers q [rad/m] and the contact fraction with only the waves up to q [-].

    At the last wavenumber it differs slightly from that of the whole surface: use `contact_fraction` for that.

    Parameters
    ----------
    pressure : float
        Nominal pressure p [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    spectrum : Waves, measured or continuous spectrum
        Of the surface, see `Waves.of`.

    Returns
    -------
    array, array
        Wavenumbers [rad/m] and contact fractions [-], each of shape (n,).

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> q, fraction = persson.magnified_fraction(1e6, 1e11, spectrum)
    >>> bool(fraction[0] > fraction[-1])  # less of it the closer one looks
    True
    """
    waves = Waves.of(spectrum)
    spread = positive(modulus, "the modulus [Pa]") * waves.slope / 2
    return waves.wavenumber, np.asarray(erf(_pressure(pressure) / (math.sqrt(2) * spread)))


@numeric
def pressure_for(fraction: float | Array, modulus: float, surface: ProfileMoments | Spectrum) -> Array:
    """Return the nominal pressure [Pa] at which a fraction of the nominal area is in contact, from 0 to below 1.

    Parameters
    ----------
    fraction : float or array
        A/A0, from 0 to below 1 [-].
    modulus : float
        Reduced modulus E* [Pa].
    surface : ProfileMoments or spectrum
        Its rms slope g enters.

    Returns
    -------
    float or array
        p [Pa].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson
    >>> surface = rc.Moments(1e-12, 0.005, 1e9)
    >>> pressure = persson.pressure_for(0.1, 1e11, surface)
    >>> round(float(persson.contact_fraction(pressure, 1e11, surface)), 6)
    0.1
    """
    part = np.asarray(fraction, dtype=np.float64)
    within = (part >= 0) & (part < 1)
    require(
        within,
        f"a contact fraction must lie from 0 to below 1, not {fraction}",
        place="fraction",
    )
    return np.asarray(math.sqrt(2) * pressure_spread(modulus, surface) * erfinv(part))


@numeric
def pressure_spread(modulus: float, surface: ProfileMoments | Spectrum) -> float:
    """Return the standard deviation of the pressure in full contact, E* g/2 [Pa].

    Parameters
    ----------
    modulus : float
        Reduced modulus E* [Pa].
    surface : ProfileMoments or spectrum
        Its rms slope g enters.

    Returns
    -------
    float
        Standard deviation [Pa].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson
    >>> round(persson.pressure_spread(1e11, rc.Moments(1e-12, 0.005, 1e9)) / 1e9, 6)  # E* g/2 [GPa]
    5.0
    """
    slope = math.sqrt(2 * (surface.m2 if hasattr(surface, "m2") else Waves.of(surface).m2))
    require(slope > 0, "a surface without slope has no waves: contact is full at any load", place="surface")
    finite = slope < math.inf
    require(finite, "with an infinite rms slope the contact area is zero", "give the surface a shortest wave")
    return moderate(float(positive(modulus, "the modulus [Pa]")), "the modulus [Pa]") * slope / 2


@numeric
def pressure_density(
    stress: float | Array, pressure: float | Array, modulus: float, surface: ProfileMoments | Spectrum
) -> Array:
    """Return the probability density P(s) of a local pressure s > 0 [1/Pa].

    Its integral is the contact fraction; the rest of the area, 1 - A/A0, carries no pressure. Its first moment is
    the nominal pressure.

    Parameters
    ----------
    stress : float or array
        Local pressure s, not negative [Pa].
    pressure : float or array
        Nominal pressure p [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    surface : ProfileMoments or spectrum
        Its rms slope g enters.

    Returns
    -------
    float or array
        P(s) [1/Pa].

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson
    >>> surface, s = rc.Moments(1e-12, 0.005, 1e9), np.linspace(0, 5e10, 5001)
    >>> density = persson.pressure_density(s, 1e8, 1e11, surface)
    >>> round(float((s * density).sum() * 1e7) / 1e8, 4)  # its first moment is the nominal pressure
    1.0
    """
    s, p, spread = _pressure(stress), _pressure(pressure), pressure_spread(modulus, surface)
    # exp(-(s-p)^2/2V) - exp(-(s+p)^2/2V), without cancellation
    towards = np.exp(-((s - p) ** 2) / (2 * spread**2))
    return np.asarray(-towards * np.expm1(-2 * s * p / spread**2) / (math.sqrt(2 * math.pi) * spread))


@numeric
def fraction_above(
    stress: float | Array, pressure: float | Array, modulus: float, surface: ProfileMoments | Spectrum
) -> Array:
    """Return the part of the nominal area that carries a pressure above `stress` [-]; at 0 the contact fraction.

    Parameters
    ----------
    stress : float or array
        Local pressure s, not negative [Pa].
    pressure : float or array
        Nominal pressure p [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    surface : ProfileMoments or spectrum
        Its rms slope g enters.

    Returns
    -------
    float or array
        Part of the nominal area [-].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson
    >>> surface = rc.Moments(1e-12, 0.005, 1e9)
    >>> above = persson.fraction_above(0.0, 1e8, 1e11, surface)
    >>> round(float(above / persson.contact_fraction(1e8, 1e11, surface)), 6)
    1.0
    """
    s, p = _pressure(stress), _pressure(pressure)
    scale = math.sqrt(2) * pressure_spread(modulus, surface)
    return np.asarray((erfc((s - p) / scale) - erfc((s + p) / scale)) / 2)


@numeric
def law(spectrum: Spectrum, modulus: float, area: float, *, gamma: float = separation.GAMMA) -> LoadingLaw:
    """Return Persson's theory of a nominally flat surface, as functions of the force.

    Parameters
    ----------
    spectrum : Waves, measured or continuous spectrum
        Of the surface, without its shape.
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].
    gamma : float
        See `persson_separation`.

    Returns
    -------
    LoadingLaw
        "contact_area", "mean_gap", "interfacial_stiffness" and "elastic_energy".

    Notes
    -----
    The stiffness is that against the mean gap. It holds where many contacts share the load; for the
    lowest loads of a finite surface see `finite_size`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> area = persson.law(spectrum, 1e11, 1e-6).predict("contact_area", [1.0, 2.0])
    >>> round(float(area[1] / area[0]), 2)  # in proportion to the force while it is small
    2.0
    """
    waves, area = Waves.of(spectrum), float(positive(area, "the nominal area [m^2]"))
    given: dict[str, Any] = {"modulus": modulus, "spectrum": waves, "gamma": gamma}
    separation.stiffness(0.0, **given)  # invalid numbers raise here
    return LoadingLaw(
        "Persson",
        "Persson, J. Chem. Phys. 115, 3840 (2001); Yang and Persson, J. Phys.: Condens. Matter 20, 215214 (2008)",
        {
            "contact_area": partial(
                over_area, partial(contact_fraction, modulus=modulus, surface=waves), area
            ),
            "mean_gap": partial(_mean_gap, given, area),
            "interfacial_stiffness": partial(over_area, partial(separation.stiffness, **given), area),
            "elastic_energy": partial(over_area, partial(separation.elastic_energy, **given), area),
        },
    )


def _mean_gap(given: Mapping[str, Any], area: float, force: Array) -> Array:
    return separation.mean_gap(force / area, **given)


def _pressure(pressure: float | Array) -> Array:
    return positive(pressure, "a pressure [Pa]", zero=True)
