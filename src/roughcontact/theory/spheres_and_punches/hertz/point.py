"""Hertz' point contact, from any three of its quantities."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import spherical_jn

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.tools.products import Product, checked, solve
from roughcontact.validation import Array, numeric, positive

__all__ = ["PointContact", "law", "point"]

# Powers of E*, R and a (thesis, eqs A.60, A.61 and 4.6).
QUANTITIES = {
    "modulus": Product((1, 0, 0), unit="Pa"),
    "radius": Product((0, 1, 0), unit="m"),
    "contact_radius": Product((0, 0, 1), unit="m"),
    "depth": Product((0, -1, 2), unit="m"),
    "force": Product((1, -1, 3), 4 / 3, unit="N"),
    "max_pressure": Product((1, -1, 1), 2 / np.pi, unit="Pa"),
    "stiffness": Product((1, 0, 1), 2.0, unit="N/m"),
}
TINY = np.finfo(np.float64).tiny


@dataclass(frozen=True, slots=True, eq=False)
class PointContact:
    """A paraboloid on an elastic half-space; numbers or arrays of one shape.

    Attributes
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    radius : float or array
        Radius of curvature R at the apex [m].
    contact_radius : float or array
        Radius a of the contact [m].
    depth : float or array
        Indentation depth d [m].
    force : float or array
        Normal force F [N].
    max_pressure : float or array
        Pressure p0 in the centre [Pa]; the mean is 2/3 of it.
    stiffness : float or array
        dF/dd [N/m].

    Examples
    --------
    >>> from roughcontact.theory import hertz
    >>> contact = hertz.point(1e11, radius=1e-2, force=1.0)
    >>> f"{contact.contact_radius * 1e6:.1f} um", f"{contact.max_pressure / 1e6:.0f} MPa"
    ('42.2 um', '268 MPa')
    >>> f"{contact.pressure(0.6 * contact.contact_radius) / contact.max_pressure:.6f}"  # (1 - 0.6^2)^(1/2)
    '0.800000'
    >>> f"{contact.displacement(0.0) / contact.depth:.6f}"
    '1.000000'
    """

    modulus: Array
    radius: Array
    contact_radius: Array
    depth: Array
    force: Array
    max_pressure: Array
    stiffness: Array

    @property
    def contact_area(self) -> Array:
        """Area of the contact, pi a^2 [m^2]."""
        return np.pi * self.contact_radius**2

    @property
    def elastic_energy(self) -> Array:
        """Work done by the force, 2/5 F d [J]."""
        return 2 / 5 * self.force * self.depth

    def pressure(self, distance: ArrayLike) -> Array:
        """Return the pressure [Pa] at a `distance` from the centre [m]; 0 outside the contact.

        Parameters
        ----------
        distance : float or array
            Distance r from the axis [m].

        Returns
        -------
        float or array
            p [Pa].
        """
        r = positive(distance, "distance [m]", zero=True)
        half_chord = np.sqrt(np.maximum(self.contact_radius**2 - r**2, 0.0))
        return 2 * self.modulus / (np.pi * self.radius) * half_chord

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
        r = positive(distance, "distance [m]", zero=True)
        a = self.contact_radius
        # The usual form, (a^2/pi R) ((2 - r^2/a^2) asin(a/r) + sqrt(r^2/a^2 - 1)), cancels far away. With
        # t = 2 asin(a/r) and the spherical Bessel function j1 it is (a^2/pi R) (t^2/2) j1(t) / sin^2(t/2).
        t = 2 * np.arcsin(a / np.maximum(np.maximum(r, a), TINY))
        outside = 2 * self.depth / np.pi * spherical_jn(1, t) / np.sinc(t / (2 * np.pi)) ** 2
        return np.where(r <= a, self.depth - r**2 / (2 * self.radius), outside)[()]


def point(
    modulus: ArrayLike | None = None,
    *,
    radius: ArrayLike | None = None,
    contact_radius: ArrayLike | None = None,
    depth: ArrayLike | None = None,
    force: ArrayLike | None = None,
    max_pressure: ArrayLike | None = None,
    stiffness: ArrayLike | None = None,
) -> PointContact:
    """Return the contact of a paraboloid from any three independent quantities (thesis, eqs 5.4, A.60 and A.61).

    d = a^2/R, F = (4/3) E* a^3/R, p0 = 2 E* a/(pi R), k = 2 E* a.

    Parameters
    ----------
    modulus, radius, contact_radius, depth, force, max_pressure, stiffness : float or array, optional
        Three of them, see `PointContact`; arrays are broadcast. With `modulus` and `radius`, the third may be 0.

    Returns
    -------
    PointContact

    Raises
    ------
    ValueError
        If not three are given, if they depend on each other (as F = (2/3) k d), or if one is not positive.

    Notes
    -----
    Exact for a paraboloid on a half-space under small strains, which is not checked: a sphere requires
    ``contact_radius`` much smaller than ``radius``, and a contact radius above R has no meaning.

    Examples
    --------
    >>> from roughcontact.theory import hertz
    >>> ball = hertz.point(1e11, radius=1e-2, force=1.0)
    >>> round(float(ball.contact_radius) * 1e6, 2), round(float(ball.depth) * 1e9, 1)  # [um], [nm]
    (42.17, 177.8)
    """
    given = (modulus, radius, contact_radius, depth, force, max_pressure, stiffness)
    known = checked(QUANTITIES, given, body=("modulus", "radius"))
    return PointContact(**solve(QUANTITIES, known))


@numeric
def law(radius: float, modulus: float) -> LoadingLaw:
    """Return Hertz' stiffness, depth, contact area and elastic energy as functions of force (thesis, eq. 5.4).

    Parameters
    ----------
    radius : float
        Radius of curvature R at the apex [m].
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    LoadingLaw
        "stiffness", "depth", "contact_area" and "elastic_energy".

    Examples
    --------
    >>> from roughcontact.theory import hertz
    >>> law = hertz.law(radius=1e-2, modulus=1e11)
    >>> round(float(law.predict("stiffness", 8.0) / law.predict("stiffness", 1.0)), 6)  # as F^(1/3)
    2.0
    """
    # A wrong body is refused now, not at the first force.
    point(modulus, radius=radius, force=0.0)
    names = ("stiffness", "depth", "contact_area", "elastic_energy")
    return LoadingLaw(
        "Hertz", "thesis, eq. 5.4", {name: partial(_of, name, radius, modulus) for name in names}
    )


def _of(name: str, radius: float, modulus: float, force: Array) -> Array:
    value: Array = getattr(point(modulus, radius=radius, force=force), name)
    return value
