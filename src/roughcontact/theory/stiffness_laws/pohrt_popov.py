"""The power law of Pohrt and Popov: the stiffness of a self-affine surface without cut-off (thesis, eq. 5.5).

k/(E* L) = zeta (F/(E* h L))^alpha with alpha = 1/(H+1) and zeta = 1.7/(H+1). The exponent is derived, the prefactor is
a fit to boundary-element results.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.spheres_and_punches.punch.polygon import SQUARE
from roughcontact.validation import Array, number, numeric, positive, require

__all__ = [
    "FORCE_LIMIT",
    "SMOOTH",
    "depth",
    "exponent",
    "force",
    "force_at_depth",
    "law",
    "prefactor",
    "scale_free_stiffness",
    "stiffness",
    "theta",
]

# F/(E* h L) up to which the thesis fits (section 4.5.1).
FORCE_LIMIT = 0.07
# Hurst exponent above which the surface is one smooth crest and touches like Hertz' paraboloid.
SMOOTH = 2.0


def exponent(hurst: ArrayLike) -> Array:
    """Return alpha = 1/(H+1) for 0 < H <= 2, 1/3 above (thesis, eqs 4.31, 4.52 and 6.2) [-].

    Parameters
    ----------
    hurst : float or array
        Hurst exponent H, above 0 and at most 3.

    Returns
    -------
    float or array
        alpha [-].

    Raises
    ------
    ValueError
        If H is not above 0: then the shortest waves dominate, and the exponent depends on the range of forces of the
        fit; see `height_distribution` and `gaussian_heights`. If H exceeds 3, where the law was not compared with
        computations.

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> pohrt_popov.exponent([1.0, 2.0, 3.0]).round(4).tolist()
    [0.5, 0.3333, 0.3333]
    """
    return 1 / (np.minimum(_hurst(hurst), SMOOTH) + 1)


def prefactor(hurst: ArrayLike) -> Array:
    """Return zeta = 1.7/(H+1) for 0 < H <= 2 (thesis, eq. 4.74), 1.7/3 above [-].

    Above 2 the printed formula goes to 0, but the stiffness does not. With the value at H = 2, zeta is 6 % above that
    of a single crest of two crossed waves, (6/(4 pi^2))^(1/3) = 0.5337, the exact limit for small forces and large H.

    Parameters
    ----------
    hurst : float or array
        Hurst exponent H, above 0 and at most 3.

    Returns
    -------
    float or array
        zeta [-].

    Notes
    -----
    A fit. At F/(E* h L) = 0.07 the law lies between 3 % below and 11 % above curves computed by boundary elements
    on 513 x 513 cells for H from 0.4 to 2, and a third below for H near 0. The exponent and the prefactor of
    one fit are strongly correlated: compare curves, not prefactors.

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> round(float(pohrt_popov.prefactor(1.0)), 6)
    0.85
    """
    return 1.7 * exponent(hurst)


@numeric
def stiffness(
    force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike
) -> Array:
    """Return the contact stiffness of a self-affine surface [N/m] (thesis, eqs 4.53 and 5.5).

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    hurst : float or array
        Hurst exponent H, above 0 and at most 3.
    rms : float or array
        Root mean square height h about the mean [m].
    length : float or array
        Side L of the square surface [m]; also the longest wavelength.
    modulus : float or array
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        k [N/m].

    Raises
    ------
    ValueError
        If H is out of range, or the force so large that the law exceeds the full-contact stiffness 1.1523 E* L.

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> k = pohrt_popov.stiffness([1.0, 2.0**1.8], 0.8, 1e-6, 1e-3, 1e11)
    >>> round(float(k[1] / k[0]), 6)  # as F^(1/(H+1))
    2.0
    """
    alpha, zeta, force_scale, stiffness_scale = _scales(hurst, rms, length, modulus)
    f = positive(force, "force [N]", zero=True) / force_scale
    return stiffness_scale * _below_full_contact(zeta * f**alpha)


@numeric
def force(
    stiffness: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike
) -> Array:
    """Return the force at which a self-affine surface has a stiffness [N], the inverse of `stiffness`.

    Parameters
    ----------
    stiffness : float or array
        Contact stiffness k, at most the full-contact stiffness 1.1523 E* L [N/m].
    hurst, rms, length, modulus : float or array
        See `stiffness`.

    Returns
    -------
    float or array
        F [N].

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> k = pohrt_popov.stiffness(1.0, 0.8, 1e-6, 1e-3, 1e11)
    >>> round(float(pohrt_popov.force(k, 0.8, 1e-6, 1e-3, 1e11)), 9)
    1.0
    """
    alpha, zeta, force_scale, stiffness_scale = _scales(hurst, rms, length, modulus)
    k = _below_full_contact(positive(stiffness, "stiffness [N/m]", zero=True) / stiffness_scale)
    return force_scale * (k / zeta) ** (1 / alpha)


@numeric
def depth(force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike) -> Array:
    """Return the indentation depth of a self-affine surface, int dF/k [m] (thesis, eq. 5.1 solved for d).

    Parameters
    ----------
    force, hurst, rms, length, modulus : float or array
        See `stiffness`.

    Returns
    -------
    float or array
        d [m].

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> d = pohrt_popov.depth(1.0, 0.8, 1e-6, 1e-3, 1e11)
    >>> k = pohrt_popov.stiffness(1.0, 0.8, 1e-6, 1e-3, 1e11)
    >>> round(float(k * d / 1.0), 6)  # k d/F = (H + 1)/H
    2.25
    """
    alpha, zeta, force_scale, stiffness_scale = _scales(hurst, rms, length, modulus)
    f = positive(force, "force [N]", zero=True) / force_scale
    _below_full_contact(zeta * f**alpha)
    return force_scale / stiffness_scale * f ** (1 - alpha) / ((1 - alpha) * zeta)


@numeric
def force_at_depth(
    depth: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike
) -> Array:
    """Return F = E* L h (zeta H d/((H+1) h))^((H+1)/H), the force at a depth [N] (thesis, eq. 5.1).

    The thesis gives the exponent; the prefactor follows from eq. 4.74. For H > 2 the exponent is 3/2.

    Parameters
    ----------
    depth : float or array
        Indentation depth d from first touch [m].
    hurst, rms, length, modulus : float or array
        See `stiffness`.

    Returns
    -------
    float or array
        F [N].

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> d = pohrt_popov.depth(1.0, 0.8, 1e-6, 1e-3, 1e11)
    >>> round(float(pohrt_popov.force_at_depth(d, 0.8, 1e-6, 1e-3, 1e11)), 9)
    1.0
    """
    alpha, zeta, force_scale, stiffness_scale = _scales(hurst, rms, length, modulus)
    d = positive(depth, "depth [m]", zero=True) * stiffness_scale / force_scale
    f: Array = (zeta * (1 - alpha) * d) ** (1 / (1 - alpha))
    _below_full_contact(zeta * f**alpha)
    return force_scale * f


@numeric
def theta(hurst: ArrayLike, rms: ArrayLike, length: ArrayLike) -> Array:
    """Return Theta = h L^-H, the same for each size to which a surface is cut [m^(1-H)] (thesis, eq. 7.1).

    Parameters
    ----------
    hurst, rms, length : float or array
        See `stiffness`.

    Returns
    -------
    float or array
        Theta [m^(1-H)].

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> whole, half = pohrt_popov.theta(0.8, [1e-6, 1e-6 * 0.5**0.8], [1e-3, 0.5e-3])
    >>> round(float(whole / half), 6)  # half of a self-affine surface is lower by 2^-H
    1.0
    """
    h, size = positive(rms, "rms [m]"), positive(length, "length [m]")
    return h * size ** -_hurst(hurst)


@numeric
def scale_free_stiffness(force: ArrayLike, hurst: ArrayLike, theta: ArrayLike, modulus: ArrayLike) -> Array:
    """Return k = E* zeta (F/(E* Theta))^(1/(H+1)), the law without the size of the surface [N/m] (thesis, eq. 7.2).

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    hurst : float or array
        Hurst exponent H, above 0 and at most 2.
    theta : float or array
        h L^-H [m^(1-H)], see `theta`.
    modulus : float or array
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        k [N/m].

    Raises
    ------
    ValueError
        If H exceeds 2: the exponent is then 1/3, and the size does not cancel.

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> theta = pohrt_popov.theta(0.8, 1e-6, 1e-3)
    >>> k = pohrt_popov.scale_free_stiffness(1.0, 0.8, theta, 1e11)
    >>> round(float(k / pohrt_popov.stiffness(1.0, 0.8, 1e-6, 1e-3, 1e11)), 6)
    1.0
    """
    scale, e = positive(theta, "theta [m^(1-H)]"), positive(modulus, "modulus [Pa]")
    alpha, zeta = exponent(hurst), prefactor(hurst)
    require(
        np.asarray(hurst) <= SMOOTH,
        "hurst must not exceed 2: one smooth crest carries the load, whose stiffness depends on the size",
        value=hurst,
        place="hurst",
    )
    return e * zeta * (positive(force, "force [N]", zero=True) / (e * scale)) ** alpha


@numeric
def law(hurst: float, rms: float, length: float, modulus: float) -> LoadingLaw:
    """Return stiffness, depth and elastic energy as functions of force (thesis, eqs 4.74 and 5.1).

    Parameters
    ----------
    hurst, rms, length, modulus : float
        See `stiffness`.

    Returns
    -------
    LoadingLaw
        Valid up to a force of 0.07 E* h L, the limit of the fits in the thesis.

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov
    >>> law = pohrt_popov.law(0.8, 1e-6, 1e-3, 1e11)
    >>> round(law.domain[1], 6)  # 0.07 E* h L [N]
    7.0
    """
    surface = {"hurst": hurst, "rms": rms, "length": length, "modulus": modulus}
    _, _, force_scale, _ = _scales(**surface)
    return LoadingLaw(
        "Pohrt and Popov",
        "thesis, eq. 4.74",
        {
            "stiffness": partial(stiffness, **surface),
            "depth": partial(depth, **surface),
            "elastic_energy": partial(_energy, surface),
        },
        (0.0, float(FORCE_LIMIT * force_scale)),
    )


def _energy(surface: Mapping[str, float], force: Array) -> Array:
    # U = int F dd with F ~ d^(1/(1 - alpha)).
    alpha, *_ = _scales(**surface)
    return (1 - alpha) / (2 - alpha) * force * depth(force, **surface)


def _hurst(hurst: ArrayLike) -> Array:
    h = number(hurst, "hurst")
    require(
        h > 0,
        "hurst must exceed 0: at 0 and below the shortest waves dominate, and no exponent is independent of the "
        "resolution",
        "see height_distribution and gaussian_heights",
        value=h,
        place="hurst",
    )
    require(
        h <= 3, "hurst must not exceed 3: no curve was compared with the law there", value=h, place="hurst"
    )
    return h


def _below_full_contact(dimensionless_stiffness: Array) -> Array:
    """Return k/(E* L), unless it exceeds that of the whole square."""
    require(
        dimensionless_stiffness <= SQUARE.value,
        f"the stiffness passes the full-contact stiffness {SQUARE.value:.4f} E* L, which no contact inside the "
        f"square exceeds; the law holds up to a force of {FORCE_LIMIT} E* h L",
    )
    return dimensionless_stiffness


def _scales(
    hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike
) -> tuple[Array, Array, Array, Array]:
    """Return alpha, zeta, E* h L [N] and E* L [N/m] (thesis, eqs 4.13 and 4.8)."""
    stiffness_scale = positive(modulus, "modulus [Pa]") * positive(length, "length [m]")
    return exponent(hurst), prefactor(hurst), stiffness_scale * positive(rms, "rms [m]"), stiffness_scale
