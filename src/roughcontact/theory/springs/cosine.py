"""One cosine wave pressed on springs: the line z = h0 cos(q x) in the method of dimensionality reduction.

Section 4.4.2 of the thesis, with its equations 4.33 and 4.34 corrected. Springs of stiffness E* per length are
independent, so only the distribution of heights matters, not the wavenumber.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import spherical_jn

from roughcontact.theory.law import LoadingLaw, composed
from roughcontact.theory.tools.roots import bisect
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["depth", "force", "law", "small_force", "stiffness"]


@numeric
def force(depth: ArrayLike, amplitude: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the force on one cosine wave [N] (thesis, eq. 4.33, corrected).

    F = (2/pi) E* L h0 (sqrt(s(1-s)) - (1-2s) asin(sqrt s)) with s = d/(2 h0) up to 1, where all springs touch;
    F = E* L (d - h0) above.

    Parameters
    ----------
    depth : float or array
        Indentation depth d from first touch [m].
    amplitude : float or array
        h0 [m].
    length : float or array
        Length L of the line, with many waves or a whole number of waves [m].
    modulus : float or array
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        F [N].

    Examples
    --------
    >>> from roughcontact.theory import cosine
    >>> round(float(cosine.force(2e-6, 1e-6, 1e-3, 1e11)))  # all springs touch: E* L h0
    100
    """
    d, h0, scale = _given(depth, amplitude, length, modulus)
    t = _angle(d / (2 * h0))
    return scale * (h0 / np.pi * _bracket(t) + np.maximum(d - 2 * h0, 0.0))


@numeric
def stiffness(depth: ArrayLike, amplitude: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the stiffness of one cosine wave, E* times the length in contact, (2/pi) E* L asin(sqrt s) [N/m].

    Parameters
    ----------
    depth, amplitude, length, modulus : float or array
        See `force`.

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import cosine
    >>> round(float(cosine.stiffness(1e-6, 1e-6, 1e-3, 1e11)))  # half of E* L at the mean plane
    50000000
    """
    d, h0, scale = _given(depth, amplitude, length, modulus)
    return scale / np.pi * _angle(d / (2 * h0))


@numeric
def depth(force: ArrayLike, amplitude: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the depth at which one cosine wave carries a force [m], the inverse of `force`.

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    amplitude, length, modulus : float or array
        See `force`.

    Returns
    -------
    float or array
        d [m].

    Examples
    --------
    >>> from roughcontact.theory import cosine
    >>> round(float(cosine.depth(100.0, 1e-6, 1e-3, 1e11)) * 1e6, 6)  # [um]
    2.0
    """
    f = positive(force, "force [N]", zero=True)
    _, h0, scale = _given(0.0, amplitude, length, modulus)
    whole = f / (scale * h0)
    # (sin t - t cos t) = pi F/(E* L h0) is below t^3/3, and not below (t/pi)^3 pi up to t = pi.
    wanted = np.pi * np.minimum(whole, 1.0)
    t = bisect(lambda t: _bracket(t) > wanted, np.cbrt(3 * wanted), np.pi * np.cbrt(wanted / np.pi))
    value: Array = h0 * (2 * np.sin(t / 2) ** 2 + np.maximum(whole - 1, 0.0))
    return value


@numeric
def small_force(depth: ArrayLike, amplitude: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the force at small depth, (8/(3 pi)) E* L h0 (d/(2 h0))^(3/2) [N] (thesis, eq. 4.34, corrected).

    It is below the exact force: by 1 % at d = 0.2 h0, by 6 % at d = h0.

    Parameters
    ----------
    depth, amplitude, length, modulus : float or array
        See `force`; the depth at most 2 h0.

    Returns
    -------
    float or array
        F [N].

    Raises
    ------
    ValueError
        If the depth exceeds 2 h0: all springs touch.

    Examples
    --------
    >>> from roughcontact.theory import cosine
    >>> force = cosine.force(2e-7, 1e-6, 1e-3, 1e11)
    >>> round(float(cosine.small_force(2e-7, 1e-6, 1e-3, 1e11) / force), 3)
    0.99
    """
    d, h0, scale = _given(depth, amplitude, length, modulus)
    require(
        d <= 2 * h0,
        "depth must not exceed twice the amplitude: there the wave is flat, see force",
        value=d,
        place="depth",
    )
    return 8 / (3 * np.pi) * scale * h0 * (d / (2 * h0)) ** 1.5


@numeric
def law(amplitude: float, length: float, modulus: float) -> LoadingLaw:
    """Return stiffness and depth of one cosine wave as functions of force (thesis, eq. 4.33, corrected).

    Parameters
    ----------
    amplitude, length, modulus : float
        See `force`.

    Returns
    -------
    LoadingLaw
        "stiffness" and "depth".

    Examples
    --------
    >>> from roughcontact.theory import cosine
    >>> round(float(cosine.law(1e-6, 1e-3, 1e11).predict("stiffness", 100.0)))
    100000000
    """
    wave = {"amplitude": amplitude, "length": length, "modulus": modulus}
    # A wrong body is refused now, not at the first force.
    force(0.0, **wave)
    return LoadingLaw(
        "One cosine on springs",
        "thesis, eq. 4.33, corrected",
        {
            "stiffness": composed(partial(stiffness, **wave), partial(depth, **wave)),
            "depth": partial(depth, **wave),
        },
    )


def _given(
    depth: ArrayLike, amplitude: ArrayLike, length: ArrayLike, modulus: ArrayLike
) -> tuple[Array, Array, Array]:
    """Return d, h0 and E* L."""
    scale = positive(modulus, "modulus [Pa]") * positive(length, "length [m]")
    return positive(depth, "depth [m]", zero=True), positive(amplitude, "amplitude [m]"), scale


def _angle(s: Array) -> Array:
    """Return t = 2 asin(sqrt s): the phase of a wave that is in contact; pi for full contact."""
    return 2 * np.arcsin(np.sqrt(np.minimum(s, 1.0)))


def _bracket(t: Array) -> Array:
    """Return sin t - t cos t, twice the bracket of eq. 4.33, as t^2 j1(t): no cancellation at small t."""
    return t**2 * spherical_jn(1, t)
