"""Thermal contact conductance of conforming rough surfaces in vacuum: correlations used in engineering.

A nominally flat joint is modelled as a number of equal cells with a round spot each. Its conductance per
nominal area is h [W/(m^2 K)]; A0 h is a conductance [W/K] as in `conductance`. The models use Gaussian heights
truncated at a plane (Cooper, Mikic and Yovanovich, Int. J. Heat Mass Transfer 12, 279 (1969)); the correlations agree
with them to 5 % at contact fractions from 1e-6 to 0.05. The models are themselves approximate: `conductance` computes
the same number from a computed stiffness without them.

Moments are those of the sum of both surfaces, and k_s is the harmonic mean of both conductivities.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Literal

import numpy as np

from roughcontact.errors import InputError
from roughcontact.theory.joints.conductance import Pair, harmonic_mean
from roughcontact.theory.law import LoadingLaw, over_area
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments, moment
from roughcontact.validation import Array, numeric, positive, positive_scalar, require

__all__ = [
    "cell_resistance",
    "constriction",
    "elastic_conductance",
    "elastic_law",
    "mean_absolute_slope",
    "plastic_conductance",
    "plastic_law",
]

FIT_LIMIT = 0.05  # largest contact fraction
# psi of an isothermal disc in a coaxial tube, powers 0, 1, 3, 5, 7 of a/b (Negus and Yovanovich 1984).
TUBE = (1.0, -1.40978, 0.34406, 0.04350, 0.02271)


def constriction(ratio: float | Array, form: Literal["power", "tube"] = "power") -> Array:
    """Return psi(eps), the resistance of a spot in its cell over that between half-spaces [-].

    Parameters
    ----------
    ratio : float or array
        eps = a/b, spot over cell radius: the square root of the fraction in contact, from 0 to 1.
    form : {"power", "tube"}
        ``(1 - eps)^1.5`` of Cooper, Mikic and Yovanovich, or the series for a coaxial tube, which is within 1 % of
        spots in a square array up to eps = 0.3.

    Returns
    -------
    float or array
        psi [-].

    Examples
    --------
    >>> from roughcontact.theory import thermal
    >>> round(float(thermal.constriction(0.1)), 4), round(float(thermal.constriction(0.1, "tube")), 4)
    (0.8538, 0.8594)
    """
    eps = positive(ratio, "the ratio of radii", zero=True)
    require(
        eps <= 1,
        f"a spot is no larger than its cell: the ratio of radii is at most 1, not {ratio}",
        place="ratio",
    )
    if form == "power":
        return np.asarray((1 - eps) ** 1.5)
    require(form == "tube", f"form must be 'power' or 'tube', not {form!r}", place="form")
    one, first, third, fifth, seventh = TUBE
    square = eps**2
    return np.asarray(one + eps * (first + square * (third + square * (fifth + square * seventh))))


@numeric
def cell_resistance(
    radius: float | Array,
    cell_radius: float | Array,
    conductivities: Pair,
    form: Literal["power", "tube"] = "power",
) -> Array:
    """Return the thermal resistance of a spot in its cell [K/W], ``psi(a/b)/(2 k_s a)``.

    Parameters
    ----------
    radius, cell_radius : float or array
        a and b [m].
    conductivities : tuple of float
        Thermal conductivities of both bodies [W/(m K)].
    form : {"power", "tube"}
        See `constriction`.

    Returns
    -------
    float or array
        Resistance [K/W].

    Examples
    --------
    >>> from roughcontact.theory import thermal
    >>> round(float(thermal.cell_resistance(1e-6, 1.0, (400.0, 400.0))), 3)  # of a lone spot 1/(2 k_s a)
    1249.998
    """
    a = positive(radius, "the radius [m]", zero=True)
    psi = constriction(a / np.asarray(cell_radius, dtype=np.float64), form)
    with np.errstate(divide="ignore"):
        return np.asarray(psi / (2 * harmonic_mean(conductivities) * a))


def mean_absolute_slope(moments: ProfileMoments) -> float:
    """Return m, the mean of ``|dz/dx|`` of a profile of a Gaussian surface [-]: ``sqrt(2 m2/pi)``.

    Parameters
    ----------
    moments : ProfileMoments
        Profile moments of an isotropic Gaussian surface.

    Returns
    -------
    float
        m [-].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import thermal
    >>> round(thermal.mean_absolute_slope(rc.Moments(1e-12, 0.005, 1e9)), 6)
    0.056419
    """
    return math.sqrt(2 * moment(moments, "m2", ", the mean square slope") / math.pi)


@numeric
def plastic_conductance(
    pressure: float | Array, hardness: float, conductivities: Pair, moments: ProfileMoments
) -> Array:
    """Return h [W/(m^2 K)] of plastic spots, ``1.25 k_s (m/sigma) (P/H_c)^0.95`` (CMY; Yovanovich 1982).

    Parameters
    ----------
    pressure : float or array
        Nominal pressure P [Pa].
    hardness : float
        H_c of the softer body at the size of the spots [Pa]; P/H_c is the fraction in contact.
    conductivities : tuple of float
        Of both bodies [W/(m K)].
    moments : ProfileMoments
        sigma = sqrt(m0), m = sqrt(2 m2/pi), of the sum of both surfaces.

    Returns
    -------
    float or array
        h [W/(m^2 K)].

    Raises
    ------
    ValueError
        If a number is out of range, or the pressure above 5 % of the hardness: the fit is for small fractions.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import thermal
    >>> joint = rc.Moments(1e-12, 0.005, 1e9)
    >>> round(float(thermal.plastic_conductance(1e6, 1e9, (400.0, 400.0), joint)))
    39847
    """
    fraction = positive(pressure, "the pressure [Pa]", zero=True) / positive(hardness, "the hardness [Pa]")
    return 1.25 * _scale(conductivities, moments) * _small(fraction, "the hardness") ** 0.95


@numeric
def elastic_conductance(
    pressure: float | Array, modulus: float, conductivities: Pair, moments: ProfileMoments
) -> Array:
    """Return h [W/(m^2 K)] of elastic spots, ``1.55 k_s (m/sigma) (sqrt2 P/(E* m))^0.94`` (Mikic 1974).

    Parameters
    ----------
    pressure : float or array
        Nominal pressure P [Pa].
    modulus : float
        Reduced modulus E* [Pa]. E* m/sqrt2 takes the place of the hardness: it is the mean pressure of asperity theory
        at small loads, ``E* g/sqrt(2 pi)``.
    conductivities : tuple of float
        Of both bodies [W/(m K)].
    moments : ProfileMoments
        sigma = sqrt(m0), m = sqrt(2 m2/pi), of the sum of both surfaces.

    Returns
    -------
    float or array
        h [W/(m^2 K)].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import thermal
    >>> joint = rc.Moments(1e-12, 0.005, 1e9)
    >>> h = thermal.elastic_conductance([1e6, 2e6], 1e11, (400.0, 400.0), joint)
    >>> round(float(h[1] / h[0]), 4)  # 2^0.94
    1.9185
    """
    soft = _asperity_pressure(modulus, moments)
    fraction = positive(pressure, "the pressure [Pa]", zero=True) / soft
    return 1.55 * _scale(conductivities, moments) * _small(fraction, "E* m/sqrt2") ** 0.94


@numeric
def plastic_law(moments: ProfileMoments, hardness: float, conductivities: Pair, area: float) -> LoadingLaw:
    """Return `plastic_conductance` over the nominal area [m^2] as a law of the force: a conductance [W/K].

    Parameters
    ----------
    moments : ProfileMoments
        Of the sum of both surfaces.
    hardness : float
        H_c of the softer body at the size of the spots [Pa].
    conductivities : tuple of float
        Thermal conductivity lambda of both bodies [W/(m K)].
    area : float
        Nominal area A0 [m^2].

    Returns
    -------
    LoadingLaw
        "thermal_conductance", up to a pressure of 5 % of the hardness.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import thermal
    >>> law = thermal.plastic_law(rc.Moments(1e-12, 0.005, 1e9), 1e9, (400.0, 400.0), 1e-4)
    >>> round(law.domain[1], 6)
    5000.0
    """
    conductance = partial(
        plastic_conductance, hardness=hardness, conductivities=conductivities, moments=moments
    )
    source = "Cooper, Mikic and Yovanovich, Int. J. Heat Mass Transfer 12, 279 (1969); Yovanovich (1982)"
    return _law("Cooper-Mikic-Yovanovich", source, conductance, area, hardness)


@numeric
def elastic_law(moments: ProfileMoments, modulus: float, conductivities: Pair, area: float) -> LoadingLaw:
    """Return `elastic_conductance` over the nominal area [m^2] as a law of the force: a conductance [W/K].

    Parameters
    ----------
    moments : ProfileMoments
        Of the sum of both surfaces.
    modulus : float
        Reduced modulus E* [Pa].
    conductivities : tuple of float
        Thermal conductivity lambda of both bodies [W/(m K)].
    area : float
        Nominal area A0 [m^2].

    Returns
    -------
    LoadingLaw
        "thermal_conductance", up to a pressure of 5 % of E* m/sqrt2.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import thermal
    >>> law = thermal.elastic_law(rc.Moments(1e-12, 0.005, 1e9), 1e11, (400.0, 400.0), 1e-4)
    >>> k = law.predict("thermal_conductance", [100.0, 200.0])
    >>> round(float(k[1] / k[0]), 4)  # 2^0.94
    1.9185
    """
    conductance = partial(
        elastic_conductance, modulus=modulus, conductivities=conductivities, moments=moments
    )
    source = "Mikic, Int. J. Heat Mass Transfer 17, 205 (1974)"
    return _law("Mikic", source, conductance, area, _asperity_pressure(modulus, moments))


def _law(
    name: str, source: str, conductance: Callable[[Array], Array], area: float, hardness: float
) -> LoadingLaw:
    """Return the law of a conductance per area, up to the pressure at which its fit ends."""
    conductance(np.zeros(()))  # invalid numbers raise here
    top = FIT_LIMIT * hardness * positive_scalar(area, "the nominal area [m^2]")
    return LoadingLaw(
        name, source, {"thermal_conductance": partial(over_area, conductance, area)}, (0.0, top)
    )


def _asperity_pressure(modulus: float, moments: ProfileMoments) -> float:
    """Return E* m/sqrt2 [Pa]."""
    return float(positive(modulus, "the modulus [Pa]")) * mean_absolute_slope(moments) / math.sqrt(2)


def _scale(conductivities: Pair, moments: ProfileMoments) -> float:
    rms = math.sqrt(moment(moments, "m0", ", the mean square height [m^2]"))
    return harmonic_mean(conductivities) * mean_absolute_slope(moments) / rms


def _small(fraction: Array, limit: str) -> Array:
    if (fraction > FIT_LIMIT * (1 + 1e-9)).any():
        raise InputError(
            f"the correlation holds for pressures up to {FIT_LIMIT} of {limit}, not {float(fraction.max()):.3g} of it, "
            "where spots merge",
            "use conductance.thermal on a computed stiffness",
        )
    return fraction
