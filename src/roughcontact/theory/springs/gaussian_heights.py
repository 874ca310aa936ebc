"""White heights on springs: the stiffness of rough lines of low Hurst exponent in closed form.

For H below about -1/4 the heights of a rough line are almost independent and Gaussian. Pressed on the springs
of the method of dimensionality reduction down to t standard deviations above the mean, with the normal density phi and
Q = erfc(t/sqrt 2)/2,

    F/(E* h L) = phi(t) - t Q(t),    k/(E* L) = Q(t).

There is no highest peak and therefore no depth; the number of grid points, as in eq. 4.73 of the thesis, does not
matter.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtr

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, number, numeric, positive, require

__all__ = ["exponent", "force", "law", "stiffness"]

# Higher than the highest point of any grid.
HIGHEST = 38.0
BEYOND = 40.0  # here density and share of higher points underflow


@numeric
def force(level: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the force if the flat body is at a level above the mean height [N].

    Parameters
    ----------
    level : float or array
        t, in rms heights; negative below the mean.
    rms : float or array
        Root mean square height h [m].
    length : float or array
        Length L of the line [m].
    modulus : float or array
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        F [N].

    Examples
    --------
    >>> from roughcontact.theory import gaussian_heights
    >>> round(float(gaussian_heights.force(0.0, 1e-6, 1e-3, 1e11)), 4)  # E* L h/sqrt(2 pi) at the mean plane
    39.8942
    """
    t = number(level, "level")
    require(
        t > -np.inf,
        "level must be finite, or plus infinity, above all heights",
        value=t,
        place="level",
    )
    return _scale(length, modulus) * positive(rms, "rms [m]") * _force(t)


@numeric
def stiffness(force: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the contact stiffness at a force [N/m].

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    rms, length, modulus : float or array
        See `force`.

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import gaussian_heights
    >>> force = gaussian_heights.force(0.0, 1e-6, 1e-3, 1e11)
    >>> round(float(gaussian_heights.stiffness(force, 1e-6, 1e-3, 1e11)))  # half of E* L at the mean plane
    50000000
    """
    return _scale(length, modulus) * ndtr(-_level(force, rms, length, modulus))


@numeric
def exponent(force: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the local exponent d ln k/d ln F at a force [-]: it rises towards 1 as the force falls.

    Parameters
    ----------
    force, rms, length, modulus : float or array
        See `stiffness`; the force above 0.

    Returns
    -------
    float or array
        Exponent [-].

    Examples
    --------
    >>> from roughcontact.theory import gaussian_heights
    >>> round(float(gaussian_heights.exponent(1e-4, 1e-6, 1e-3, 1e11)), 3)
    0.96
    """
    positive(force, "force [N]")
    t = _level(force, rms, length, modulus)
    return _force(t) * _density(t) / ndtr(-t) ** 2


@numeric
def law(rms: float, length: float, modulus: float) -> LoadingLaw:
    """Return the stiffness as a function of force.

    Parameters
    ----------
    rms, length, modulus : float
        See `force`.

    Returns
    -------
    LoadingLaw
        "stiffness".

    Examples
    --------
    >>> from roughcontact.theory import gaussian_heights
    >>> law = gaussian_heights.law(1e-6, 1e-3, 1e11)
    >>> round(float(law.predict("stiffness", 1.0)))
    2628988
    """
    # A wrong body is refused now, not at the first force.
    force(0.0, rms, length, modulus)
    return LoadingLaw(
        "White heights on springs",
        "Gaussian heights in thesis, eq. 4.59",
        {"stiffness": partial(stiffness, rms=rms, length=length, modulus=modulus)},
    )


def _force(t: Array) -> Array:
    """Return F/(E* h L)."""
    t = np.minimum(t, BEYOND)
    return _density(t) - t * ndtr(-t)


def _density(t: Array) -> Array:
    value: Array = np.exp(-(t**2) / 2) / np.sqrt(2 * np.pi)
    return value


def _level(force: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the t at which the line carries a force."""
    scale = _scale(length, modulus) * positive(rms, "rms [m]")
    f = positive(force, "force [N]", zero=True) / scale
    # phi - t Q decreases with t and is at least -t.
    return -bisect(lambda minus_t: _force(-minus_t) > f, np.asarray(-HIGHEST), f)


def _scale(length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return E* L [N/m]."""
    return positive(modulus, "modulus [Pa]") * positive(length, "length [m]")
