"""The indenter z = Q r^n, exact for every n > 0: Galin's and Sneddon's solution (thesis, section 5.2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import gammaln, hyp2f1

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.tools.products import Product, checked, solve
from roughcontact.validation import Array, numeric, positive

__all__ = ["PowerLawContact", "contact", "kappa", "law"]

TINY = np.finfo(np.float64).tiny


def kappa(exponent: ArrayLike) -> Array:
    """Return kappa(n) = sqrt(pi) Gamma(n/2 + 1)/Gamma((n + 1)/2), the depth over the height at the edge [-].

    The indentation depth is ``kappa Q a^n``: 1 for n = 0 (a flat disc), pi/2 for a cone, 2 for a paraboloid.
    The thesis uses it in eqs 5.3 and 5.6 without stating it.

    Parameters
    ----------
    exponent : float or array
        n, not negative.

    Returns
    -------
    float or array
        kappa [-].

    Examples
    --------
    >>> from roughcontact.theory import power_law_indenter
    >>> power_law_indenter.kappa([0.0, 1.0, 2.0]).round(6).tolist()  # disc, cone, paraboloid
    [1.0, 1.570796, 2.0]
    """
    n = positive(exponent, "exponent", zero=True)
    value: Array = np.sqrt(np.pi) * np.exp(gammaln(n / 2 + 1) - gammaln((n + 1) / 2))
    return value


@dataclass(frozen=True, slots=True, eq=False)
class PowerLawContact:
    """The contact of z = Q r^n with an elastic half-space; numbers or arrays of one shape.

    Attributes
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    coefficient : float or array
        Q [m^(1-n)].
    exponent : float
        n.
    contact_radius : float or array
        Radius a of the contact [m].
    depth : float or array
        Indentation depth d [m].
    force : float or array
        Normal force F [N].
    stiffness : float or array
        dF/dd [N/m].

    Examples
    --------
    >>> from roughcontact.theory import power_law_indenter
    >>> cone = power_law_indenter.contact(1e11, exponent=1, coefficient=0.1, force=1.0)
    >>> f"{cone.contact_radius * 1e6:.1f} um", f"{float(cone.pressure(0.5 * cone.contact_radius)) / 1e9:.2f} GPa"
    ('8.0 um', '6.58 GPa')
    >>> round(float(cone.displacement(0.0) / cone.depth), 6)
    1.0
    """

    modulus: Array
    coefficient: Array
    exponent: float
    contact_radius: Array
    depth: Array
    force: Array
    stiffness: Array

    @property
    def contact_area(self) -> Array:
        """Area of the contact, pi a^2 [m^2]."""
        return np.pi * self.contact_radius**2

    @property
    def elastic_energy(self) -> Array:
        """Work done by the force, n/(2n + 1) F d [J]."""
        return self.exponent / (2 * self.exponent + 1) * self.force * self.depth

    def pressure(self, distance: ArrayLike) -> Array:
        """Return the pressure [Pa] at a `distance` from the centre [m]; infinite there for n <= 1, 0 outside.

        Parameters
        ----------
        distance : float or array
            Distance r from the axis [m].

        Returns
        -------
        float or array
            p [Pa].
        """
        r, n, a = positive(distance, "distance [m]", zero=True), self.exponent, self.contact_radius
        # (E*/pi) int_r^a g'(x)/sqrt(x^2 - r^2) dx with g = kappa Q x^n (thesis, eq. A.63).
        t = np.maximum(a**2 - r**2, 0.0) / np.maximum(a**2, TINY)
        slope = kappa(n) * n * self.coefficient * np.maximum(a, TINY) ** (n - 1)
        return self.modulus / np.pi * slope * np.sqrt(t) * hyp2f1(1, 1 - n / 2, 3 / 2, t)

    def displacement(self, distance: ArrayLike) -> Array:
        """Return the displacement of the surface [m] at a `distance` from the centre [m], inside and outside.

        Parameters
        ----------
        distance : float or array
            Distance r from the axis [m].

        Returns
        -------
        float or array
            u [m].
        """
        r, n, a = positive(distance, "distance [m]", zero=True), self.exponent, self.contact_radius
        # (2/pi) int_0^a (d - g(x))/sqrt(r^2 - x^2) dx (thesis, eq. A.64).
        e = a / np.maximum(np.maximum(r, a), TINY)
        profile = e / (n + 1) * hyp2f1(1 / 2, (n + 1) / 2, (n + 3) / 2, e**2)
        outside = 2 / np.pi * self.depth * (np.arcsin(e) - profile)
        return np.where(r <= a, self.depth - self.coefficient * r**n, outside)[()]


@numeric
def contact(
    modulus: ArrayLike | None = None,
    *,
    exponent: float,
    coefficient: ArrayLike | None = None,
    contact_radius: ArrayLike | None = None,
    depth: ArrayLike | None = None,
    force: ArrayLike | None = None,
    stiffness: ArrayLike | None = None,
) -> PowerLawContact:
    """Return the contact of z = Q r^n from any three independent quantities (thesis, eqs 5.2 and 5.3).

    d = kappa Q a^n, F = 2 E* n/(n + 1) kappa Q a^(n+1), k = 2 E* a.

    Parameters
    ----------
    modulus : float or array, optional
        Reduced modulus E* [Pa].
    exponent : float
        n, positive: the Hurst exponent of the thesis; 2 is a paraboloid of radius 1/(2Q).
    coefficient, contact_radius, depth, force, stiffness : float or array, optional
        Three of them, see `PowerLawContact`; arrays are broadcast. With `modulus` and `coefficient` the third
        may be 0.

    Returns
    -------
    PowerLawContact

    Raises
    ------
    ValueError
        If not three are given, if they depend on each other (as F = n/(n + 1) k d), if one is not positive, or
        if n is 0: the depth of a flat punch does not follow from its radius, see `punch.disc`.

    Examples
    --------
    >>> from roughcontact.theory import hertz, power_law_indenter
    >>> ball = power_law_indenter.contact(1e11, exponent=2, coefficient=1 / (2 * 1e-2), force=1.0)
    >>> round(float(ball.depth / hertz.point(1e11, radius=1e-2, force=1.0).depth), 6)  # n = 2 is Hertz' sphere
    1.0
    """
    n = float(positive(exponent, "exponent"))
    factor = float(kappa(n))
    # Powers of E*, Q and a.
    quantities = {
        "modulus": Product((1, 0, 0), unit="Pa"),
        "coefficient": Product((0, 1, 0), unit="m^(1-n)"),
        "contact_radius": Product((0, 0, 1), unit="m"),
        "depth": Product((0, 1, n), factor, unit="m"),
        "force": Product((1, 1, n + 1), 2 * n / (n + 1) * factor, unit="N"),
        "stiffness": Product((1, 0, 1), 2.0, unit="N/m"),
    }
    given = (modulus, coefficient, contact_radius, depth, force, stiffness)
    known = checked(quantities, given, body=("modulus", "coefficient"))
    return PowerLawContact(exponent=n, **solve(quantities, known))


@numeric
def law(exponent: float, coefficient: float, modulus: float) -> LoadingLaw:
    """Return stiffness, depth, contact area and elastic energy of z = Q r^n as functions of force (thesis, eq. 5.3).

    Parameters
    ----------
    exponent : float
        n, positive.
    coefficient : float
        Q [m^(1-n)].
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    LoadingLaw

    Examples
    --------
    >>> from roughcontact.theory import power_law_indenter
    >>> k = power_law_indenter.law(1.0, 0.1, 1e11).predict("stiffness", [1.0, 4.0])  # a cone
    >>> round(float(k[1] / k[0]), 6)  # as F^(n/(n+1))
    2.0
    """
    # A wrong body is refused now, not at the first force.
    contact(modulus, exponent=exponent, coefficient=coefficient, force=0.0)
    body = {"modulus": modulus, "exponent": exponent, "coefficient": coefficient}
    names = ("stiffness", "depth", "contact_area", "elastic_energy")
    quantities = {name: partial(_of, name, body) for name in names}
    return LoadingLaw(f"z ~ r^{exponent:g}", "thesis, eq. 5.3", quantities)


def _of(name: str, body: Mapping[str, float], force: Array) -> Array:
    value: Array = getattr(contact(**body, force=force), name)
    return value
