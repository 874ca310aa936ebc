"""Thermal contact conductance of conforming rough surfaces in vacuum: the engineers' correlations.

A nominally flat joint is taken for a number of equal cells with a round spot each. Its conductance per
nominal area is h [W/(m^2 K)]; A0 h is a conductance [W/K] as in `conductance`. The models have Gaussian heights cut
off at a plane (Cooper, Mikic and Yovanovich, Int. J. Heat Mass Transfer 12, 279 (1969)); the correlations follow
them to 5 % at fractions in contact from 1e-6 to 0.05. Whether the models are right is another matter:
`conductance` goes from a computed stiffness to the same number without them.

Moments are those of the sum of both surfaces, and k_s is the harmonic mean of both conductivities.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Literal

import numpy as np

from roughcontact.theory.conductance import Pair, harmonic_mean
from roughcontact.theory.law import LoadingLaw, over_area
from roughcontact.theory.profile_moments import ProfileMoments, moment
from roughcontact.validation import Array, numeric, positive, require

__all__ = [
    "cell_resistance",
    "constriction",
    "elastic_conductance",
    "elastic_law",
    "mean_absolute_slope",
    "plastic_conductance",
    "plastic_law",
]

FIT_LIMIT = 0.05  # of the fraction in contact
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
    """
    eps = positive(ratio, "the ratio of radii", zero=True)
    require(eps <= 1, f"a spot is no larger than its cell: the ratio of radii is at most 1, not {ratio}")
    if form == "power":
        return np.asarray((1 - eps) ** 1.5)
    if form != "tube":
        raise ValueError(f"form must be 'power' or 'tube', not {form!r}")
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
        Of both bodies [W/(m K)].
    form
        See `constriction`.
    """
    a = positive(radius, "the radius [m]", zero=True)
    psi = constriction(a / np.asarray(cell_radius, dtype=np.float64), form)
    with np.errstate(divide="ignore"):
        return np.asarray(psi / (2 * harmonic_mean(conductivities) * a))


def mean_absolute_slope(moments: ProfileMoments) -> float:
    """Return m, the mean of |dz/dx| of a profile of a Gaussian surface [-]: ``sqrt(2 m2/pi)``."""
    return math.sqrt(2 * moment(moments, "m2", ", the mean square slope") / math.pi)


@numeric
def plastic_conductance(
    pressure: float | Array, hardness: float, conductivities: Pair, moments: ProfileMoments
) -> Array:
    """Return h [W/(m^2 K)] of spots that flow, ``1.25 k_s (m/sigma) (P/H_c)^0.95`` (CMY; Yovanovich 1982).

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

    Raises
    ------
    ValueError
        If a number is out of range, or the pressure beyond 5 % of the hardness: the fit is one of small
        fractions.
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
    modulus : float
        Reduced modulus E* [Pa]. E* m/sqrt2 stands for the hardness: it is the mean pressure of asperity
        theory at small loads, `E* g/sqrt(2 pi)`.
    pressure, conductivities, moments
        See `plastic_conductance`.
    """
    soft = _asperity_pressure(modulus, moments)
    fraction = positive(pressure, "the pressure [Pa]", zero=True) / soft
    return 1.55 * _scale(conductivities, moments) * _small(fraction, "E* m/sqrt2") ** 0.94


@numeric
def plastic_law(moments: ProfileMoments, hardness: float, conductivities: Pair, area: float) -> LoadingLaw:
    """Return `plastic_conductance` over the nominal area [m^2] as a law of the force: a conductance [W/K]."""
    top = float(
        FIT_LIMIT * positive(hardness, "the hardness [Pa]") * positive(area, "the nominal area [m^2]")
    )
    conductance = partial(
        plastic_conductance, hardness=hardness, conductivities=conductivities, moments=moments
    )
    conductance(0.0)  # bad numbers show themselves here
    return LoadingLaw(
        "Cooper-Mikic-Yovanovich",
        "Cooper, Mikic and Yovanovich, Int. J. Heat Mass Transfer 12, 279 (1969); Yovanovich (1982)",
        {"thermal_conductance": partial(over_area, conductance, area)},
        (0.0, top),
    )


@numeric
def elastic_law(moments: ProfileMoments, modulus: float, conductivities: Pair, area: float) -> LoadingLaw:
    """Return `elastic_conductance` over the nominal area [m^2] as a law of the force: a conductance [W/K]."""
    top = float(FIT_LIMIT * _asperity_pressure(modulus, moments) * positive(area, "the nominal area [m^2]"))
    conductance = partial(
        elastic_conductance, modulus=modulus, conductivities=conductivities, moments=moments
    )
    conductance(0.0)
    return LoadingLaw(
        "Mikic",
        "Mikic, Int. J. Heat Mass Transfer 17, 205 (1974)",
        {"thermal_conductance": partial(over_area, conductance, area)},
        (0.0, top),
    )


def _asperity_pressure(modulus: float, moments: ProfileMoments) -> float:
    """Return E* m/sqrt2 [Pa]."""
    return float(positive(modulus, "the modulus [Pa]")) * mean_absolute_slope(moments) / math.sqrt(2)


def _scale(conductivities: Pair, moments: ProfileMoments) -> float:
    rms = math.sqrt(moment(moments, "m0", ", the mean square height [m^2]"))
    return harmonic_mean(conductivities) * mean_absolute_slope(moments) / rms


def _small(fraction: Array, limit: str) -> Array:
    if (fraction > FIT_LIMIT * (1 + 1e-9)).any():
        raise ValueError(
            f"the correlation holds for pressures up to {FIT_LIMIT} of {limit}, not {float(fraction.max()):.3g} of it: "
            "beyond, spots merge; use conductance.thermal on a computed stiffness"
        )
    return fraction
