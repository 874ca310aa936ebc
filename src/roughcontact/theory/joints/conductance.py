"""Electrical and thermal conductance of a contact from its stiffness, and back: an exact analogy.

Potential and temperature obey the same equation as the displacement under normal pressure. In the same contact
region ``k/E* = Lambda_e (rho1 + rho2)/2`` (thesis, eq. 4.2) and ``k/E* = Lambda_t (1/lambda1 + 1/lambda2)/2``: eqs 4.4
and 7.3 are printed with the arithmetic mean of conductivities instead of the harmonic one (Barber, Proc. R. Soc. A
459, 53 (2003)).

The stiffness against the approach gives the total conductance, including the constriction towards the whole contact;
the stiffness against the mean gap gives that of the interface, ``h A0 = lambda K/E*``. Current and heat cross only in
the contact region: no film, no gas, no radiation.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.theory.law import LoadingLaw
from roughcontact.validation import Array, number, numeric, positive, require, shown

__all__ = [
    "electrical",
    "harmonic_mean",
    "law",
    "resistance",
    "stiffness_from_electrical",
    "stiffness_from_thermal",
    "thermal",
]

Pair = tuple[float, float]


@numeric
def electrical(stiffness: float | Array, modulus: float, resistivities: Pair) -> Array:
    """Return the electrical conductance Lambda_e [S] (thesis, eq. 4.2).

    Parameters
    ----------
    stiffness : float or array
        k [N/m]; for k per nominal area [Pa/m] the conductance is also per area.
    modulus : float
        Reduced modulus E* [Pa] used to compute k, of any bodies.
    resistivities : tuple of float
        rho of both bodies [ohm m]; 0 for a superconductor.

    Returns
    -------
    float or array
        Lambda_e [S].

    Raises
    ------
    ValueError
        If a number is negative, or both bodies are superconductors: then the conductance is infinite.

    Examples
    --------
    >>> from roughcontact.theory import conductance
    >>> round(float(conductance.electrical(2e5, 1e11, (1.7e-8, 1.7e-8))), 3)  # Holm: 2a/rho of a disc, k = 2 E* a
    117.647
    """
    first, second = _both(resistivities, "a resistivity [ohm m]")
    require(first + second > 0, "between two bodies without resistivity the conductance has no limit")
    return np.asarray(_lengths(stiffness, modulus) * 2 / (first + second))


@numeric
def stiffness_from_electrical(conductance: float | Array, modulus: float, resistivities: Pair) -> Array:
    """Return the stiffness k [N/m] of the contact with an electrical conductance [S] (thesis, eq. 4.2).

    Parameters
    ----------
    conductance : float or array
        Lambda_e [S].
    modulus : float
        Reduced modulus E* [Pa].
    resistivities : tuple of float
        Resistivity rho of both bodies [ohm m].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import conductance
    >>> round(float(conductance.stiffness_from_electrical(117.647, 1e11, (1.7e-8, 1.7e-8))))
    200000
    """
    return _inverse(electrical, conductance, modulus, resistivities)


@numeric
def thermal(stiffness: float | Array, modulus: float, conductivities: Pair) -> Array:
    """Return the thermal conductance Lambda_t [W/K], ``k/E*`` times the harmonic mean (thesis, eq. 4.4 corrected).

    Parameters
    ----------
    stiffness : float or array
        k [N/m]; for k per nominal area [Pa/m] the conductance is also per area.
    modulus : float
        Reduced modulus E* [Pa] used to compute k.
    conductivities : tuple of float
        Thermal conductivity lambda of both bodies [W/(m K)]; 0 for an insulator, infinite for an isothermal body.

    Returns
    -------
    float or array
        Lambda_t [W/K].

    Examples
    --------
    >>> from roughcontact.theory import conductance
    >>> round(float(conductance.thermal(2e5, 1e11, (400.0, float("inf")))), 6)  # copper on an isothermal body
    0.0016
    """
    return np.asarray(_lengths(stiffness, modulus) * harmonic_mean(conductivities))


@numeric
def stiffness_from_thermal(conductance: float | Array, modulus: float, conductivities: Pair) -> Array:
    """Return the stiffness k [N/m] of the contact with a thermal conductance [W/K] (thesis, eq. 4.4 corrected).

    Parameters
    ----------
    conductance : float or array
        Lambda_t [W/K].
    modulus : float
        Reduced modulus E* [Pa].
    conductivities : tuple of float
        Thermal conductivity lambda of both bodies [W/(m K)].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import conductance
    >>> round(float(conductance.stiffness_from_thermal(1.6e-3, 1e11, (400.0, float("inf")))))
    200000
    """
    return _inverse(thermal, conductance, modulus, conductivities)


def harmonic_mean(conductivities: Pair) -> float:
    """Return the conductivity of two bodies in series, ``2/(1/lambda1 + 1/lambda2)`` [W/(m K)].

    Parameters
    ----------
    conductivities : tuple of float
        Thermal conductivity lambda of both bodies [W/(m K)].

    Returns
    -------
    float
        lambda [W/(m K)].

    Examples
    --------
    >>> from roughcontact.theory import conductance
    >>> round(conductance.harmonic_mean((400.0, 16.0)), 3)  # the poor conductor decides
    30.769
    """
    given = _both(conductivities, "a conductivity [W/(m K)]")
    require(
        np.isfinite(given).any(), "between two bodies of infinite conductivity the conductance has no limit"
    )
    with np.errstate(divide="ignore"):
        return float(2 / np.sum(1 / given))


def resistance(conductance: float | Array) -> Array:
    """Return 1/conductance: ohm for S, K/W for W/K, m^2 K/W for W/(m^2 K); infinite for 0.

    Parameters
    ----------
    conductance : float or array
        Not negative [S, W/K, W/(m^2 K)].

    Returns
    -------
    float or array
        Resistance [ohm, K/W, m^2 K/W].

    Examples
    --------
    >>> from roughcontact.theory import conductance
    >>> conductance.resistance([4.0, 0.0]).tolist()
    [0.25, inf]
    """
    with np.errstate(divide="ignore"):
        return np.asarray(1 / _not_negative(conductance, "a conductance"))


@numeric
def law(
    mechanical: LoadingLaw,
    modulus: float,
    *,
    resistivities: Pair | None = None,
    conductivities: Pair | None = None,
    quantity: str = "stiffness",
) -> LoadingLaw:
    """Return the conductances that belong to the stiffness of another law (thesis, eq. 7.3 with 4.4 corrected).

    Parameters
    ----------
    mechanical : LoadingLaw
        A law that predicts a stiffness.
    modulus : float
        Reduced modulus E* [Pa] of that law.
    resistivities, conductivities : tuple of float, optional
        Values of both bodies, for at least one of the two; see `electrical` and `thermal`.
    quantity : str
        ``"stiffness"`` for the total conductance, ``"interfacial_stiffness"`` for that of the interface.

    Returns
    -------
    LoadingLaw
        ``"electrical_conductance"`` [S], ``"thermal_conductance"`` [W/K] or both, according to the given pairs.

    Raises
    ------
    ValueError
        If neither pair is given, or the law does not predict such a stiffness.

    Examples
    --------
    >>> from roughcontact.theory import conductance, hertz
    >>> law = conductance.law(hertz.law(1e-2, 1e11), 1e11, resistivities=(1.7e-8, 1.7e-8))
    >>> ratio = law.predict("electrical_conductance", 8.0) / law.predict("electrical_conductance", 1.0)
    >>> round(float(ratio), 6)  # as F^(1/3)
    2.0
    """
    found: dict[str, Callable[[Array], Array]] = {}
    if resistivities is not None:
        found["electrical_conductance"] = partial(electrical, modulus=modulus, resistivities=resistivities)
    if conductivities is not None:
        found["thermal_conductance"] = partial(thermal, modulus=modulus, conductivities=conductivities)
    require(len(found), "give the resistivities [ohm m] or the conductivities [W/(m K)] of both bodies")
    for conductance in found.values():
        conductance(np.zeros(()))  # invalid numbers raise here
    return mechanical.derived(quantity, found)


def _lengths(stiffness: float | Array, modulus: float) -> Array:
    """Return k/E* [m], twice the radius of the equivalent spot: the only mechanical input of a conductance."""
    return _not_negative(stiffness, "a stiffness [N/m]") / positive(modulus, "the modulus [Pa]")


def _inverse(
    forward: Callable[[float, float, Pair], Array], conductance: float | Array, modulus: float, pair: Pair
) -> Array:
    unit = float(forward(1.0, modulus, pair))
    require(unit > 0, "with an insulator the conductance is zero, whatever the stiffness")
    return _not_negative(conductance, "a conductance") / unit


def _not_negative(values: ArrayLike, what: str) -> Array:
    """Return numbers from 0 to infinity: full contact is infinitely stiff, and there are insulators."""
    given = np.asarray(number(values, what))
    require(given >= 0, f"{what} must not be negative or missing", value=given)
    return given


def _both(values: Pair, what: str) -> Array:
    """Return the numbers of both bodies."""
    given = _not_negative(values, what)
    require(given.shape == (2,), f"{what} of each body is needed, not {shown(values)}")
    return given
