"""Persson's theory of an elastic and perfectly plastic body: the elastic, the plastic, and the open part of the area.

As shorter waves are included, the distribution of pressure widens like that of a particle that diffuses between two
absorbing ends: at zero the contact opens, at the hardness the material flows (Persson, Phys. Rev. Lett. 87, 116101
(2001); J. Chem. Phys. 115, 3840 (2001)). Area that has reached either end stays there. The variance of the free
distribution is (E* g/2)^2 as in `persson`, with the rms slope g. The three parts are closed sums of only ``p/H`` and
``E* g/(2 H)``: a sine series if the distribution is wide compared with the hardness, a sum over images if it is
narrow.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
from scipy.special import erf, erfc

from roughcontact.theory.law import LoadingLaw, over_area
from roughcontact.theory.persson_theory.persson import pressure_spread
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments
from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.validation import Array, numeric, positive, positive_scalar, require

__all__ = ["contact_fraction", "elastic_fraction", "law", "plastic_fraction"]

SOURCE = "Persson, Phys. Rev. Lett. 87, 116101 (2001)"
# Ratio of standard deviation to hardness up to which images are summed. Both sums are accurate to rounding there.
NARROW = 0.5
IMAGES = 4  # the next is erfc(8 / (sqrt2 NARROW)), below 1e-50
TERMS = 7  # the next is exp(-(8 pi NARROW)^2/2), below 1e-34


@numeric
def contact_fraction(
    pressure: float | Array, hardness: float, modulus: float, surface: ProfileMoments | Spectrum
) -> Array:
    """Return the real contact area over the nominal one, of elastic and plastic contact together [-].

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p, up to the hardness [Pa].
    hardness : float
        H of the softer body, the pressure at which it flows [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    surface : ProfileMoments or spectrum
        Its rms slope g enters.

    Returns
    -------
    float or array
        A/A0 [-].

    Raises
    ------
    ValueError
        If the pressure is negative or above the hardness, another number not positive, or the slope zero or infinite.

    Notes
    -----
    With ``x = p/H`` and ``v = (E* g/(2 H))^2`` it is ``x + (2/pi) sum_n sin(n pi x) exp(-n^2 pi^2 v/2)/n``.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson, persson_plastic
    >>> surface = rc.Moments(1e-12, 0.005, 1e9)  # rms slope 0.1
    >>> hard, soft = 1e12, 1e9  # E* g/2 is 5 GPa
    >>> elastic = persson.contact_fraction(1e7, 1e11, surface)
    >>> round(float(persson_plastic.contact_fraction(1e7, hard, 1e11, surface) / elastic), 6)
    1.0
    >>> round(float(persson_plastic.contact_fraction(1e7, soft, 1e11, surface)), 6)  # p/H
    0.01
    """
    x, spread = _reduced(pressure, hardness, modulus, surface)
    if spread > NARROW:
        return np.asarray(x + _sines(x, spread, 1.0))
    return np.asarray(erf(x / (math.sqrt(2) * spread)) + _images(2.0, x, spread))


@numeric
def plastic_fraction(
    pressure: float | Array, hardness: float, modulus: float, surface: ProfileMoments | Spectrum
) -> Array:
    """Return the part of the nominal area that flows, at the hardness [-].

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p, up to the hardness [Pa].
    hardness : float
        H of the softer body, the pressure at which it flows [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    surface : ProfileMoments or spectrum
        Its rms slope g enters.

    Returns
    -------
    float or array
        Part of the nominal area [-].

    Raises
    ------
    ValueError
        As of `contact_fraction`.

    Notes
    -----
    ``x - (2/pi) sum_n (-1)^(n+1) sin(n pi x) exp(-n^2 pi^2 v/2)/n``: it carries the whole load if roughness is strong.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_plastic
    >>> given = 1e7, 1e10, 1e11, rc.Moments(1e-12, 0.005, 1e9)  # a hardness of two spreads
    >>> plastic = persson_plastic.plastic_fraction(*given)
    >>> round(float(plastic / persson_plastic.contact_fraction(*given)), 3)  # bearing 43 % of the load
    0.27
    """
    x, spread = _reduced(pressure, hardness, modulus, surface)
    if spread > NARROW:
        return np.asarray(x - _sines(x, spread, -1.0))
    return _images(1.0, x, spread)


@numeric
def elastic_fraction(
    pressure: float | Array, hardness: float, modulus: float, surface: ProfileMoments | Spectrum
) -> Array:
    """Return the part of the nominal area in elastic contact, under pressures between zero and the hardness [-].

    Parameters
    ----------
    pressure : float or array
        Nominal pressure p, up to the hardness [Pa].
    hardness : float
        H of the softer body, the pressure at which it flows [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    surface : ProfileMoments or spectrum
        Its rms slope g enters.

    Returns
    -------
    float or array
        Part of the nominal area [-].

    Raises
    ------
    ValueError
        As of `contact_fraction`.

    Notes
    -----
    ``(4/pi) sum over odd n of sin(n pi x) exp(-n^2 pi^2 v/2)/n``: it decreases as shorter waves are included.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_plastic
    >>> given = 1e7, 1e10, 1e11, rc.Moments(1e-12, 0.005, 1e9)
    >>> parts = persson_plastic.elastic_fraction(*given) + persson_plastic.plastic_fraction(*given)
    >>> round(float(parts / persson_plastic.contact_fraction(*given)), 6)
    1.0
    """
    x, spread = _reduced(pressure, hardness, modulus, surface)
    if spread > NARROW:
        return np.asarray(_sines(x, spread, 1.0) + _sines(x, spread, -1.0))
    return np.asarray(erf(x / (math.sqrt(2) * spread)) + _images(2.0, x, spread) - _images(1.0, x, spread))


@numeric
def law(spectrum: Spectrum, hardness: float, modulus: float, area: float) -> LoadingLaw:
    """Return the contact area of a nominally flat surface, as a function of the force.

    Parameters
    ----------
    spectrum : Waves, measured or continuous spectrum
        Of the surface, without its shape.
    hardness : float
        H of the softer body [Pa].
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area A0 [m^2].

    Returns
    -------
    LoadingLaw
        "contact_area", up to the force that the hardness carries on the nominal area.

    Raises
    ------
    ValueError
        As of `contact_fraction`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_plastic
    >>> steel = rc.handbook("steel")
    >>> modulus = rc.reduced_modulus(steel.solid, steel.solid)
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> law = persson_plastic.law(spectrum, steel.hardness, modulus, 1e-6)
    >>> f"{law.predict('contact_area', 1.0) * steel.hardness:.3f}"  # of the load: nearly all flows
    '1.044'
    """
    waves, nominal = Waves.of(spectrum), float(positive(area, "the nominal area [m^2]"))
    given: dict[str, Any] = {"hardness": hardness, "modulus": modulus, "surface": waves}
    contact_fraction(0.0, **given)  # invalid numbers raise here
    return LoadingLaw(
        "Persson, plastic",
        SOURCE,
        {"contact_area": partial(over_area, partial(contact_fraction, **given), nominal)},
        domain=(0.0, nominal * hardness),
    )


def _reduced(
    pressure: float | Array, hardness: float, modulus: float, surface: ProfileMoments | Spectrum
) -> tuple[Array, float]:
    """Return p/H and E* g/(2 H)."""
    most = positive_scalar(hardness, "the hardness [Pa]")
    x = positive(pressure, "a pressure [Pa]", zero=True) / most
    # Tolerance for the rounding of a force over its area.
    require(
        x <= 1 + 1e-12,
        f"no pressure above the hardness of {most:.4g} Pa can be carried",
        value=pressure,
        place="pressure",
    )
    return np.minimum(x, 1.0), pressure_spread(modulus, surface) / most


def _sines(x: Array, spread: float, sign: float) -> Array:
    """Return ``(2/pi) sum_n sign^(n+1) sin(n pi x) exp(-n^2 pi^2 v/2)/n``."""
    n = np.arange(1, TERMS + 1)
    weights = 2 / math.pi * sign ** (n + 1) * np.exp(-((n * math.pi * spread) ** 2) / 2) / n
    # sin(n pi x) for x near 1 from the distance to 1: the sine of a rounded angle would lose its digits.
    rest = 1 - np.asarray(x)[..., None]
    near = np.where(n % 2 == 1, 1.0, -1.0) * np.sin(n * math.pi * rest)
    sines = np.where(rest < 0.5, near, np.sin(n * math.pi * np.asarray(x)[..., None]))
    return np.asarray(sines @ weights)


def _images(first: float, x: Array, spread: float) -> Array:
    """Return ``sum_k [erfc(d - x) - erfc(d + x)]`` over the distances d = first, first + 2, ... in sqrt2 spreads."""
    scale, distance = math.sqrt(2) * spread, first + 2 * np.arange(IMAGES)
    place = np.asarray(x)[..., None]
    return np.asarray((erfc((distance - place) / scale) - erfc((distance + place) / scale)).sum(axis=-1))
