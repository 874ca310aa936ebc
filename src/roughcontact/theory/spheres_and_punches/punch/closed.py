"""Flat punches in closed form: disc, ellipse and strip."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import elliprf

from roughcontact.validation import Array, number, numeric, pair, positive, require

__all__ = [
    "disc",
    "disc_displacement",
    "disc_pressure",
    "ellipse",
    "ellipse_pressure",
    "strip",
    "strip_pressure",
]


@numeric
def disc(modulus: ArrayLike, radius: ArrayLike) -> Array:
    """Return the stiffness of a disc, k = 2 E* a [N/m] (thesis, eq. 4.6).

    It is that of any axisymmetric indenter whose contact is a disc, whatever its pressure.

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    radius : float or array
        Contact radius a [m].

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.disc(1e11, 1e-3)), 3)
    200000000.0
    """
    return 2 * positive(modulus, "modulus [Pa]") * positive(radius, "radius [m]")


@numeric
def disc_pressure(force: ArrayLike, radius: ArrayLike, distance: ArrayLike) -> Array:
    """Return the pressure under a disc, F/(2 pi a sqrt(a^2 - r^2)) [Pa] (Boussinesq).

    Infinite at the edge, 0 outside.

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    radius : float or array
        Radius a [m].
    distance : float or array
        Distance r from the centre [m].

    Returns
    -------
    float or array
        p [Pa].

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.disc_pressure(1.0, 1e-3, 0.0)), 2)  # half of the mean, F/(2 pi a^2)
    159154.94
    """
    r, a = positive(distance, "distance [m]", zero=True), positive(radius, "radius [m]")
    f = positive(force, "force [N]", zero=True)
    return _edged(f / (2 * np.pi * a**2), 1 - (r / a) ** 2)


@numeric
def disc_displacement(depth: ArrayLike, radius: ArrayLike, distance: ArrayLike) -> Array:
    """Return the displacement of the surface under and around a disc, (2/pi) d asin(a/r) outside [m].

    Parameters
    ----------
    depth : float or array
        Indentation depth d [m].
    radius : float or array
        Radius a [m].
    distance : float or array
        Distance r from the centre [m].

    Returns
    -------
    float or array
        u [m].

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.disc_displacement(1e-6, 1e-3, 2e-3)) * 1e6, 4)  # d/3 at twice the radius
    0.3333
    """
    r, a = positive(distance, "distance [m]", zero=True), positive(radius, "radius [m]")
    return 2 / np.pi * positive(depth, "depth [m]", zero=True) * np.arcsin(a / np.maximum(r, a))


def ellipse(modulus: ArrayLike, semi_axes: tuple[ArrayLike, ArrayLike]) -> Array:
    """Return the stiffness of an ellipse, k = pi E* a/K(e), e^2 = 1 - b^2/a^2 [N/m] (Galin).

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    semi_axes : tuple of (float or array)
        Semi-axes a and b in any order [m].

    Returns
    -------
    float or array
        k [N/m].

    Notes
    -----
    Written as pi E*/R_F(0, a^2, b^2) with Carlson's integral, which is accurate for any a and b.

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.ellipse(1e11, (1e-3, 1e-3)) / punch.disc(1e11, 1e-3)), 6)
    1.0
    """
    a, b = pair(semi_axes, "semi_axes [m]")
    return np.pi * positive(modulus, "modulus [Pa]") / elliprf(0.0, a**2, b**2)


@numeric
def ellipse_pressure(
    force: ArrayLike, semi_axes: tuple[ArrayLike, ArrayLike], x: ArrayLike, y: ArrayLike
) -> Array:
    """Return the pressure under an ellipse, F/(2 pi a b sqrt(1 - x^2/a^2 - y^2/b^2)) [Pa] (Galin).

    Infinite at the edge, 0 outside.

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    semi_axes : tuple of (float or array)
        Semi-axes a along x and b along y [m].
    x, y : float or array
        Position from the centre [m].

    Returns
    -------
    float or array
        p [Pa].

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.ellipse_pressure(1.0, (2e-3, 0.5e-3), 0.0, 0.0)), 2)
    159154.94
    """
    a, b = pair(semi_axes, "semi_axes [m]")
    f = positive(force, "force [N]", zero=True)
    inside = 1 - (number(x, "x [m]") / a) ** 2 - (number(y, "y [m]") / b) ** 2
    return _edged(f / (2 * np.pi * a * b), inside)


@numeric
def strip(modulus: ArrayLike, half_width: ArrayLike, reference_length: ArrayLike) -> Array:
    """Return the stiffness per length of an infinite strip, k' = pi E*/(2 ln(2L/a)) [N/m^2].

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    half_width : float or array
        Half the width, a [m].
    reference_length : float or array
        Distance L from a line load at which its displacement is zero [m]; at least the size of the body.

    Returns
    -------
    float or array
        k' [N/m^2].

    Raises
    ------
    ValueError
        If the reference length is at most a quarter of the width: the stiffness would not be positive.

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.strip(1e11, 1e-3, 1.0)) / 1e10, 4)  # the larger the body, the softer
    2.0666
    """
    a, length = positive(half_width, "half_width [m]"), positive(reference_length, "reference_length [m]")
    require(
        2 * length > a,
        "reference_length must exceed a quarter of the strip's width: below it, the displacement by a "
        "line load would be zero inside the strip, and the stiffness is not positive",
        place="reference_length",
    )
    value: Array = np.pi * positive(modulus, "modulus [Pa]") / (2 * np.log(2 * length / a))
    return value


@numeric
def strip_pressure(force: ArrayLike, half_width: ArrayLike, position: ArrayLike) -> Array:
    """Return the pressure under a strip, F'/(pi sqrt(a^2 - x^2)) [Pa]; infinite at the edge, 0 outside.

    Parameters
    ----------
    force : float or array
        Normal force per length F' [N/m].
    half_width : float or array
        Half the width, a [m].
    position : float or array
        Distance x from the middle, of either sign [m].

    Returns
    -------
    float or array
        p [Pa].

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> punch.strip_pressure(1.0, 1e-3, [0.0, 1e-3, 2e-3]).round(2).tolist()
    [318.31, inf, 0.0]
    """
    x, a = number(position, "position [m]"), positive(half_width, "half_width [m]")
    f = positive(force, "force [N/m]", zero=True)
    return _edged(f / (np.pi * a), 1 - (x / a) ** 2)


def _edged(scale: Array, inside: Array) -> Array:
    """Return scale/sqrt(inside); infinite where `inside` is 0, 0 where it is negative."""
    with np.errstate(divide="ignore"):
        root = 1 / np.sqrt(np.maximum(inside, 0.0))
    return np.where(inside < 0, 0.0, scale * np.where(scale > 0, root, 0.0))[()]
