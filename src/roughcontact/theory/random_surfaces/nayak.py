"""Summits of an isotropic Gaussian surface: density, heights, curvatures (Nayak 1971; McCool 1986).

Densities are dimensionless: heights in ``sqrt(m0)`` above the mean plane, curvatures in ``sqrt(m4)``, summits per area
in ``m4/(2 pi m2)``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import log_ndtr

from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments, moment
from roughcontact.validation import Array, finite, numeric, require

__all__ = ["SummitStatistics", "bandwidth", "free_variance", "geometric_density", "summit_density", "summits"]

NARROWEST = 1.5  # Nayak's parameter of waves of one length, the minimum of isotropic surfaces
SPREAD = 1 + 16 / math.pi - 3 * math.sqrt(3)  # 0.8968: factor of 1/alpha in the variance of summit heights


@dataclass(frozen=True, slots=True)
class SummitStatistics:
    """The mean asperity of a surface, for theories of equal spheres.

    Attributes
    ----------
    density : float
        Summits per area [1/m^2].
    radius : float
        Radius of the sphere with the mean curvature of all summits [m].
    std : float
        Standard deviation of summit heights [m].
    mean_height : float
        Mean of summit heights above the mean plane of the surface [m].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import nayak
    >>> mean = nayak.summits(rc.Moments(1e-12, 0.005, 1e9))
    >>> f"{mean.density * 1e-6:.0f} summits/mm^2 of radius {mean.radius * 1e6:.0f} um"
    '6126 summits/mm^2 of radius 21 um'
    """

    density: float
    radius: float
    std: float
    mean_height: float


def bandwidth(moments: ProfileMoments) -> float:
    """Return Nayak's parameter ``alpha = m0 m4/m2^2`` [-].

    Parameters
    ----------
    moments : ProfileMoments
        m0 [m^2], m2 [-], m4 [1/m^2].

    Returns
    -------
    float
        alpha [-].

    Raises
    ------
    ValueError
        If a moment is zero or infinite, or alpha below 3/2: then the moments are not those of an isotropic
        Gaussian surface (those of a line, or of a surface with a lay, may be lower).

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import nayak
    >>> round(nayak.bandwidth(rc.Moments(1e-12, 0.005, 1e9)), 6)
    40.0
    """
    m0, m2, m4 = moment(moments, "m0"), moment(moments, "m2"), moment(moments, "m4")
    alpha = m0 * m4 / m2**2
    # A relative error of 10^-9 is allowed for the rounding of summed moments.
    require(
        alpha >= NARROWEST * (1 - 1e-9),
        f"Nayak's parameter of an isotropic surface is at least 3/2, not {alpha:.6g}: are these the moments of "
        "a line, or of a surface with a lay?",
    )
    return alpha


def summits(moments: ProfileMoments) -> SummitStatistics:
    """Return density, mean radius and heights of the summits of a surface with these profile moments.

    Parameters
    ----------
    moments : ProfileMoments
        m0 [m^2], m2 [-], m4 [1/m^2] of an isotropic Gaussian surface.

    Returns
    -------
    SummitStatistics

    Raises
    ------
    ValueError
        If no surface has these moments, see `bandwidth`.

    Notes
    -----
    ``m4/(6 sqrt(3) pi m2)``, ``(3/8) sqrt(pi/m4)``, ``(1 - 0.8968/alpha) m0`` (squared) and ``4 sqrt(m0/(pi alpha))``
    (McCool, Wear 107, 37 (1986)); 0.8968 is ``1 + 16/pi - 3 sqrt(3)``. Density and radius depend strongly on the
    shortest waves: a fractal without a shortest wave has no finite density of summits.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import nayak
    >>> mean = nayak.summits(rc.Moments(1e-12, 0.005, 1e9))
    >>> round(mean.radius * 1e6, 3), round(mean.std / 1e-6, 4)  # [um], and in rms heights
    (21.019, 0.9887)
    """
    alpha = bandwidth(moments)
    return SummitStatistics(
        density=moments.m4 / (6 * math.sqrt(3) * math.pi * moments.m2),
        radius=3 / 8 * math.sqrt(math.pi / moments.m4),
        std=math.sqrt((1 - SPREAD / alpha) * moments.m0),
        mean_height=4 * math.sqrt(moments.m0 / (math.pi * alpha)),
    )


@numeric
def summit_density(
    height: float | Array, mean: float | Array, deviator: float | Array, alpha: float
) -> Array:
    """Return the density D(s, t, r) of summits over height and curvatures; its integral is ``1/(3 sqrt(3))``.

    Parameters
    ----------
    height : float or array
        s, above the mean plane.
    mean, deviator : float or array
        t and r: the principal curvatures are ``t + r`` and ``t - r``, and a summit has ``t > r >= 0``.
    alpha : float
        Nayak's parameter, above 3/2, see `free_variance`.

    Returns
    -------
    float or array
        D [-].

    Notes
    -----
    ``(t^2 - r^2) N(t; 0, 2/3) N(s; 3t/(2 sqrt(alpha)), 1 - 3/(2 alpha)) 3 r exp(-3 r^2/2)`` with the normal density
    N(x; mean, variance): the determinant of the curvatures counts the points where both slopes vanish.

    Examples
    --------
    >>> from roughcontact.theory import nayak
    >>> float(nayak.summit_density(1.0, 0.5, 0.6, 10.0))  # a saddle, since its curvatures differ in sign
    0.0
    """
    s, t, r = finite(height, "height"), finite(mean, "mean"), finite(deviator, "deviator")
    variance = free_variance(alpha)
    exponent = 0.75 * t**2 + (s - 1.5 * t / math.sqrt(alpha)) ** 2 / (2 * variance) + 1.5 * r**2
    scale = 3 / (2 * math.pi * math.sqrt(2 / 3 * variance))
    return np.where((t > r) & (r >= 0), scale * (t**2 - r**2) * r * np.exp(-exponent), 0.0)


@numeric
def geometric_density(height: float | Array, curvature: float | Array, alpha: float) -> Array:
    """Return the density D(s, g) of summits over height and the geometric mean ``g = sqrt(k1 k2)`` of curvatures.

    Parameters
    ----------
    height : float or array
        s, above the mean plane.
    curvature : float or array
        g, not negative.
    alpha : float
        Nayak's parameter, above 3/2, see `free_variance`.

    Returns
    -------
    float or array
        D [-].

    Notes
    -----
    `summit_density` integrated at fixed g (Greenwood, Wear 261, 191 (2006)). Computed in logarithms, because its two
    exponentials and the error function leave the range of floats where their product does not.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import nayak
    >>> s, g = np.meshgrid(np.linspace(-6, 8, 281), np.linspace(0, 6, 241))
    >>> total = nayak.geometric_density(s, g, 10.0).sum() * 0.05 * 0.025
    >>> round(float(total) * 3 * 3**0.5, 4)  # the integral over all summits is 1/(3 sqrt(3))
    1.0
    """
    s, g = finite(height, "height"), finite(curvature, "curvature")
    rest = 2 * alpha * free_variance(alpha)  # 2 alpha - 3
    w = 3 * math.sqrt((alpha - 1) / (2 * rest)) * (g - s * math.sqrt(alpha) / (3 * (alpha - 1)))
    # erfc(w) = 2 Phi(-sqrt(2) w)
    exponent = 1.5 * g**2 - alpha * s**2 / (2 * (alpha - 1)) + log_ndtr(-math.sqrt(2) * w)
    scale = 6 * math.sqrt(alpha / (24 * math.pi * (alpha - 1)))
    return np.where(g > 0, scale * g**3 * np.exp(exponent), 0.0)


@numeric
def free_variance(alpha: float) -> float:
    """Return the variance of a summit's height at given curvatures, ``1 - 3/(2 alpha)``, in m0.

    Parameters
    ----------
    alpha : float
        Nayak's parameter [-].

    Returns
    -------
    float
        Variance [-].

    Raises
    ------
    ValueError
        If it is not positive: waves of one length have summits whose curvature is a multiple of their height.

    Examples
    --------
    >>> from roughcontact.theory import nayak
    >>> round(nayak.free_variance(10.0), 6)
    0.85
    """
    require(
        alpha > NARROWEST,
        "a joint density of summit heights and curvatures needs a Nayak parameter above 3/2, that of waves of one "
        f"length, not {alpha:.6g}",
        place="alpha",
    )
    return 1 - NARROWEST / alpha
