"""Hertz' contact of a body with two radii of curvature."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import elliprd, elliprf

from roughcontact.theory.tools.products import Product, checked, solve
from roughcontact.validation import Array, finite, number, numeric, pair

__all__ = ["EllipticContact", "elliptic"]

# ln(Rx/Ry) over ln(a/b) rises from 3/2 (a circle) to 2 (a line), so a step with the mean slope removes six sevenths of
# the error.
SLOPE, STEPS = 7 / 4, 22
TINY = np.finfo(np.float64).tiny


@dataclass(frozen=True, slots=True, eq=False)
class EllipticContact:
    """An elliptic paraboloid on an elastic half-space; numbers or arrays of one shape.

    Attributes
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    radii : tuple of (float or array)
        Radii of curvature (Rx, Ry) at the apex [m].
    semi_axes : tuple of (float or array)
        Semi-axes of the contact along x and y [m]; the longer one lies along the larger radius.
    depth : float or array
        Indentation depth d [m].
    force : float or array
        Normal force F [N].
    max_pressure : float or array
        Pressure p0 in the centre [Pa]; the mean is 2/3 of it.
    stiffness : float or array
        dF/dd [N/m]: that of a flat punch of the same ellipse.

    Examples
    --------
    >>> from roughcontact.theory import hertz
    >>> contact = hertz.elliptic(1e11, radii=(1e-2, 2e-2), force=1.0)
    >>> a, b = contact.semi_axes
    >>> f"{a * 1e6:.1f} and {b * 1e6:.1f} um", f"{contact.pressure(0.6 * a, 0.0) / contact.max_pressure:.6f}"
    ('37.3 and 59.2 um', '0.800000')
    >>> f"{contact.displacement(0.0, 0.0) / contact.depth:.6f}"
    '1.000000'
    """

    modulus: Array
    radii: tuple[Array, Array]
    semi_axes: tuple[Array, Array]
    depth: Array
    force: Array
    max_pressure: Array
    stiffness: Array

    @property
    def contact_area(self) -> Array:
        """Area of the contact [m^2]."""
        return np.pi * self.semi_axes[0] * self.semi_axes[1]

    @property
    def elastic_energy(self) -> Array:
        """Work done by the force, 2/5 F d [J]."""
        return 2 / 5 * self.force * self.depth

    @numeric
    def pressure(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return the pressure [Pa] at a point [m]; 0 outside the contact.

        Parameters
        ----------
        x : float or array
            Place along the first principal direction, from the centre [m].
        y : float or array
            Place along the second [m].

        Returns
        -------
        float or array
            p [Pa].
        """
        a, b = self.semi_axes
        u, v = number(x, "x [m]") / a, number(y, "y [m]") / b
        return self.max_pressure * np.sqrt(np.maximum(1 - u**2 - v**2, 0.0))

    @numeric
    def displacement(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return the displacement of the surface [m] at a point [m], inside and outside.

        Parameters
        ----------
        x : float or array
            Place along the first principal direction, from the centre [m].
        y : float or array
            Place along the second [m].

        Returns
        -------
        float or array
            u [m].
        """
        xx, yy = finite(x, "x [m]") ** 2, finite(y, "y [m]") ** 2
        aa, bb = self.semi_axes[0] ** 2, self.semi_axes[1] ** 2
        # The ellipse through the point that has the foci of the contact: x^2/(a^2+s) + y^2/(b^2+s) = 1.
        half, rest = (xx + yy - aa - bb) / 2, xx * bb + yy * aa - aa * bb
        root = np.sqrt(np.maximum(half**2 + rest, 0.0))
        # The larger root without cancellation.
        far = root + np.abs(half)
        s = np.maximum(np.where(half > 0, far, rest / np.maximum(far, TINY)), 0.0)
        curved = xx * elliprd(s, bb + s, aa + s) + yy * elliprd(s, aa + s, bb + s)
        form = elliprf(s, aa + s, bb + s) - curved / 3
        value: Array = self.max_pressure / self.modulus * self.semi_axes[0] * self.semi_axes[1] * form
        return value


def elliptic(
    modulus: ArrayLike | None = None,
    *,
    radii: tuple[ArrayLike, ArrayLike],
    force: ArrayLike | None = None,
    depth: ArrayLike | None = None,
    max_pressure: ArrayLike | None = None,
    stiffness: ArrayLike | None = None,
) -> EllipticContact:
    """Return the contact of a body with two radii of curvature from two further quantities (Johnson 1985, ch. 4).

    Parameters
    ----------
    modulus : float or array, optional
        Reduced modulus E* [Pa].
    radii : tuple of (float or array)
        Radii of curvature (Rx, Ry) at the apex [m], those of the gap between two bodies whose axes agree. They
        may be equal.
    force, depth, max_pressure, stiffness : float or array, optional
        Two of them, see `EllipticContact`; arrays are broadcast.

    Returns
    -------
    EllipticContact

    Raises
    ------
    ValueError
        If not two quantities are given, if they depend on each other, or if one is not positive.

    Notes
    -----
    With Carlson's integrals R_F and R_D, for any a and b,

        E*/(2 Rx) = p0 a b R_D(0, b^2, a^2)/3,    E*/(2 Ry) = p0 a b R_D(0, a^2, b^2)/3,
        d = p0 a b R_F(0, a^2, b^2)/E*,    F = (2/3) pi a b p0,    k = pi E*/R_F(0, a^2, b^2).

    No difference of complete elliptic integrals is taken, so nothing is lost near a circle or near a line.

    Examples
    --------
    >>> from roughcontact.theory import hertz
    >>> crossed = hertz.elliptic(1e11, radii=(1e-2, 1e-2), force=1.0)
    >>> sphere = hertz.point(1e11, radius=1e-2, force=1.0)
    >>> round(float(crossed.depth / sphere.depth), 6)  # crossed cylinders of one radius touch like a sphere
    1.0
    """
    rx, ry = pair(radii, "radii [m]")
    # The squares of the semi-axes over their product, which is the square of the third base quantity.
    aa = _aspect(rx / ry)
    bb = 1 / aa
    flat: Array = np.asarray(elliprf(0.0, aa, bb), dtype=np.float64)
    curved: Array = np.asarray(2 / 3 * np.sqrt(elliprd(0.0, bb, aa) * elliprd(0.0, aa, bb)), dtype=np.float64)
    # Powers of E*, sqrt(Rx Ry) and sqrt(a b).
    quantities = {
        "modulus": Product((1, 0, 0), unit="Pa"),
        "radii": Product((0, 1, 0), unit="m"),
        "force": Product((1, -1, 3), 2 / 3 * np.pi / curved, unit="N"),
        "depth": Product((0, -1, 2), flat / curved, unit="m"),
        "max_pressure": Product((1, -1, 1), 1 / curved, unit="Pa"),
        "stiffness": Product((1, 0, 1), np.pi / flat, unit="N/m"),
    }
    radius = np.sqrt(rx * ry)
    others = checked(quantities, (modulus, None, force, depth, max_pressure, stiffness))
    found = solve(quantities, {"radii": radius, **others})
    size = np.sqrt(found["depth"] * radius * curved / flat)
    return EllipticContact(
        radii=(rx, ry),
        semi_axes=(size * np.sqrt(aa), size * np.sqrt(bb)),
        **{name: value for name, value in found.items() if name != "radii"},
    )


def _aspect(ratio: Array) -> Array:
    """Return the ratio a/b of the semi-axes at a ratio Rx/Ry of the radii."""
    wanted = np.log(ratio)
    t = wanted / SLOPE
    for _ in range(STEPS):
        aa, bb = np.exp(t), np.exp(-t)
        t = t + (wanted - np.log(elliprd(0.0, aa, bb) / elliprd(0.0, bb, aa))) / SLOPE
    return np.exp(t)
