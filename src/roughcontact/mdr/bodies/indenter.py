"""Bodies of revolution: closed forms, functions, samples, and roughness as a body (thesis, section 5.2).

The apex of each has height 0. Profiles can be added: ``paraboloid(0.5) + equivalent_roughness(0.7, rms=9e-3,
length=1.0)`` is the rough sphere of eq. 5.8 in the thesis, and any other smooth body can replace the sphere.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from roughcontact.errors import InputError
from roughcontact.mdr.bodies.axisymmetric_profile import Profile
from roughcontact.mdr.bodies.terms import PowerTerm, SphereTerm, ripple_transform
from roughcontact.mdr.bodies.transform_tables import from_function, from_samples, from_two_functions
from roughcontact.theory.spheres_and_punches import rough_sphere
from roughcontact.validation import Array, finite, numeric, positive, positive_scalar, scalar

__all__ = [
    "cone",
    "equivalent_roughness",
    "flat_punch",
    "from_transform",
    "of",
    "paraboloid",
    "power_law",
    "ripples",
    "rounded_cone",
    "sampled",
    "sampled_transform",
    "sphere",
]

MOST_WAVES = 2000  # of ripples: each needs at most two panels of a table


def power_law(exponent: float, coefficient: float, *, flat: float = 0.0) -> Profile:
    """Return ``f = Q r^n``, or with a flat face of radius b ``f = Q (r^n - b^n)`` beyond it (thesis, eq. 5.2).

    Parameters
    ----------
    exponent : float
        n > 0 [-].
    coefficient : float
        Q > 0 [m^(1-n)].
    flat : float
        Radius b of the flat face [m].

    Returns
    -------
    Profile

    Raises
    ------
    ValueError
        If exponent or coefficient are not positive, or `flat` is negative.

    Examples
    --------
    >>> from roughcontact.mdr import indenter
    >>> body = indenter.power_law(2.0, 50.0)  # r^2/(2R), R = 1 cm
    >>> round(float(body.transform(1e-3) / body.height(1e-3)), 6)
    2.0
    """
    positive_scalar(exponent, "exponent")
    positive_scalar(coefficient, "coefficient")
    positive(scalar(flat, "radius of a flat face"), "radius of a flat face", zero=True)
    return Profile(((1.0, PowerTerm(float(exponent), float(coefficient), float(flat))),))


def cone(slope: float, *, flat: float = 0.0) -> Profile:
    """Return ``f = slope * r``, or with a flat face of radius b ``f = slope * (r - b)`` beyond it.

    `slope` is the tangent of the angle between the flank and the ground [-], as in `shapes.cone`.

    Parameters
    ----------
    slope : float
        Tangent of the angle between flank and ground [-].
    flat : float
        Radius b of a flat face [m].

    Returns
    -------
    Profile

    Examples
    --------
    >>> import math
    >>> from roughcontact.mdr import indenter
    >>> body = indenter.cone(0.1)
    >>> round(float(body.transform(1e-3) / body.height(1e-3)) / (math.pi / 2), 6)
    1.0
    """
    positive_scalar(slope, "slope")
    return power_law(1.0, slope, flat=flat)


def paraboloid(radius: float, *, flat: float = 0.0) -> Profile:
    """Return ``f = r^2/(2R)``, or with a flat face of radius b ``f = (r^2 - b^2)/(2R)`` beyond it; R in m.

    Parameters
    ----------
    radius : float
        Radius of curvature R at the apex [m].
    flat : float
        Radius b of a flat face [m].

    Returns
    -------
    Profile

    Examples
    --------
    >>> from roughcontact.mdr import indenter
    >>> round(float(indenter.paraboloid(1e-2).height(1e-4)) * 1e6, 6)  # r^2/(2R) [um]
    0.5
    """
    positive_scalar(radius, "radius")
    return power_law(2.0, 1 / (2 * radius), flat=flat)


def sphere(radius: float) -> Profile:
    """Return ``f = R - sqrt(R^2 - r^2)``, up to the equator; R in m. Hertz' sphere is the `paraboloid`.

    Parameters
    ----------
    radius : float
        Radius R [m].

    Returns
    -------
    Profile

    Examples
    --------
    >>> from roughcontact.mdr import indenter
    >>> round(float(indenter.sphere(1e-2).height(1e-2)), 6)  # at the equator R
    0.01
    """
    positive_scalar(radius, "radius")
    return Profile(((1.0, SphereTerm(float(radius))),), float(radius))


def flat_punch(radius: float) -> Profile:
    """Return a cylinder with a flat face and a sharp edge; radius in m. Adding it to a body cuts the body.

    Parameters
    ----------
    radius : float
        Radius of the face [m].

    Returns
    -------
    Profile

    Examples
    --------
    >>> from roughcontact.mdr import indentation, indenter
    >>> punch = indentation.indent(indenter.flat_punch(1e-3), 1e11, depth=1e-6)
    >>> round(punch.force / (2 * 1e11 * 1e-3 * 1e-6), 6)  # F = 2 E* a d
    1.0
    """
    positive_scalar(radius, "radius")
    return Profile((), float(radius), edge=True)


def rounded_cone(slope: float, radius: float) -> Profile:
    """Return a cone with a round tip: a paraboloid of `radius` R [m] up to r = slope R, and `slope` from there on.

    Parameters
    ----------
    slope : float
        Tangent of the angle between flank and ground [-].
    radius : float
        Radius R of the round tip [m].

    Returns
    -------
    Profile

    Examples
    --------
    >>> from roughcontact.mdr import indenter
    >>> body = indenter.rounded_cone(0.1, 1e-3)  # the paraboloid ends at r = slope R
    >>> round(float(body.height(1e-4)) * 1e6, 6), round(float(body.height(2e-4)) * 1e6, 6)  # [um]
    (5.0, 15.0)
    """
    joint = positive_scalar(slope, "slope") * positive_scalar(radius, "radius")
    body = paraboloid(radius) - paraboloid(radius, flat=joint) + cone(slope, flat=joint)
    # A slope that never decreases gives a transform that never decreases.
    return replace(body, rises=True)


def ripples(amplitude: float, wavelength: float, radius: float) -> Profile:
    """Return rings of waves, ``f = A (1 - cos(2 pi r / wavelength))``, for addition to a body.

    Parameters
    ----------
    amplitude : float
        A [m]; negative for a trough in the middle.
    wavelength : float
        [m].
    radius : float
        Radius up to which the body is known [m]: at most 2000 wavelengths.

    Returns
    -------
    Profile
        Accurate to 1e-14 of its values near the axis, and to the rounding of k r far out.

    Raises
    ------
    ValueError
        If a number is out of range, or the waves are too many.

    Examples
    --------
    >>> from roughcontact.mdr import indenter
    >>> rings = indenter.ripples(1e-6, 1e-3, 2e-3)
    >>> round(float(rings.height(0.5e-3)) * 1e6, 6)  # 2A between two crests [um]
    2.0
    """
    positive_scalar(wavelength, "wavelength")
    positive_scalar(radius, "radius")
    if radius > MOST_WAVES * wavelength:
        many = (
            f"{radius / wavelength:.4g} waves within {radius:g} m are more than the {MOST_WAVES} of a table"
        )
        raise InputError(many, "use a smaller radius, or a longer wavelength")
    finite(scalar(amplitude, "amplitude"), "amplitude")
    k = 2 * math.pi / wavelength
    # The transform has an extremum between any two quarters of a wavelength.
    quarters = tuple(wavelength / 4 * n for n in range(1, math.ceil(4 * radius / wavelength)))
    return from_two_functions(
        lambda r: 2 * amplitude * np.sin(k * r / 2) ** 2,
        lambda x: ripple_transform(amplitude, k, x),
        float(radius),
        quarters,
        # The argument k r of the function has a rounding error.
        noise=k * radius * 2.0**-52,
    )


@numeric
def equivalent_roughness(
    hurst: float, *, rms: float, length: float, prefactor: float | None = None
) -> Profile:
    """Return the power law with the mean indentation curve of self-affine roughness (thesis, eqs 5.5-5.6).

    Added to any body of revolution it gives the rough contact of that body, like eqs 5.7-5.9 for the sphere.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, above 0 and at most 2, the exponent of the body.
    rms : float
        Root mean square height h over the length [m].
    length : float
        Side L of the square that has this rms height [m]; only h/L^H matters.
    prefactor : float, optional
        zeta of ``k/(E* L) = zeta (F/(E* h L))^(1/(H+1))``; by default 1.7/(H + 1) (thesis, eq. 4.74).

    Returns
    -------
    Profile

    Examples
    --------
    >>> from roughcontact.mdr import indentation, indenter
    >>> from roughcontact.theory import pohrt_popov
    >>> rough = indenter.equivalent_roughness(0.8, rms=1e-6, length=1e-3)
    >>> k = indentation.indent(rough, 1e11, force=1.0).stiffness
    >>> round(k / float(pohrt_popov.stiffness(1.0, 0.8, 1e-6, 1e-3, 1e11)), 6)
    1.0
    """
    Q = rough_sphere.coefficient(hurst, rms, length, prefactor=prefactor)
    return power_law(hurst, float(Q))


def of(height: Callable[[Array], Array], radius: float) -> Profile:
    """Return the body whose height is a function of the radius.

    Parameters
    ----------
    height : callable
        f(r) [m] of an array of radii [m] (``np.cosh``, not ``math.cosh``). Its value at 0 is subtracted. Kinks are
        found; derivatives are not needed.
    radius : float
        Radius up to which the body is known [m]. A load whose contact extends to it is refused; ``Profile.cut`` makes
        an edge.

    Returns
    -------
    Profile
        Its transform is accurate to about 1e-13 of its value, its slope to 1e-11, from 1e-10 of the `radius` on.

    Raises
    ------
    ValueError
        If the function is not finite or not piecewise smooth, or vanishes everywhere.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import indenter
    >>> cap = indenter.of(lambda r: 1e-2 - np.sqrt(1e-4 - r**2), 5e-3)
    >>> round(float(cap.transform(1e-3) / indenter.sphere(1e-2).transform(1e-3)), 9)
    1.0
    """
    return from_function(height, radius, transformed=False)


def from_transform(transform: Callable[[Array], Array], radius: float) -> Profile:
    """Return the body whose transform g(x) [m] is a function; the arguments are those of `of`.

    Parameters
    ----------
    transform : callable
        g(x) [m] of an array of positions [m].
    radius : float
        Radius up to which the body is known [m].

    Returns
    -------
    Profile

    Examples
    --------
    >>> from roughcontact.mdr import indenter
    >>> body = indenter.from_transform(lambda x: x**2 / 1e-2, 1e-3)  # that of a paraboloid
    >>> round(float(body.height(1e-4)) / (1e-8 / 2e-2), 9)
    1.0
    """
    return from_function(transform, radius, transformed=True)


def sampled(r: Array, height: Array, *, sharp: bool = False) -> Profile:
    """Return the body whose height is a cubic spline through samples.

    Parameters
    ----------
    r : array, shape (n,)
        Radii, increasing from 0 [m]; the body is known up to the last.
    height : array, shape (n,)
        f(r) [m]. The first is subtracted.
    sharp : bool
        Whether the body may have a tip. Otherwise its slope is zero on the axis.

    Returns
    -------
    Profile

    Notes
    -----
    The transform of the spline is exact at its nodes. For samples of a smooth body at steps D the error of the height
    falls as D^4, that of the transform as D^3.5, that of its slope as D^2.5. A spline rounds kinks: describe a body
    with a flat face or a sharp joint by a function (`of`).

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import indenter
    >>> r = np.linspace(0, 1e-3, 101)
    >>> body = indenter.sampled(r, r**2 / 2e-2)
    >>> round(float(body.transform(5e-4)) / (2.5e-7 / 1e-2), 6)
    1.0
    """
    return from_samples(r, height, sharp=sharp, transformed=False)


def sampled_transform(x: Array, transform: Array, *, sharp: bool = False) -> Profile:
    """Return the body whose transform g(x) [m] is a cubic spline through samples; see `sampled`.

    Parameters
    ----------
    x : array, shape (n,)
        Positions, increasing from 0 [m]; the body is known up to the last.
    transform : array, shape (n,)
        g(x) [m]. The first is subtracted.
    sharp : bool
        Whether the body may have a tip. Otherwise its slope is zero on the axis.

    Returns
    -------
    Profile

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.mdr import indenter
    >>> x = np.linspace(0, 1e-3, 101)
    >>> body = indenter.sampled_transform(x, x**2 / 1e-2)
    >>> round(float(body.height(5e-4)) / (2.5e-7 / 2e-2), 6)
    1.0
    """
    return from_samples(x, transform, sharp=sharp, transformed=True)
