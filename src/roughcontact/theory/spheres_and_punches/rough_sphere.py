"""A sphere with self-affine roughness, as one axisymmetric indenter (thesis, section 5.2).

The roughness is replaced by z = Q r^H of the same stiffness, and added to the paraboloid r^2/(2R): a profile whose
contact is one disc and known in closed form.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.spheres_and_punches.power_law_indenter import kappa
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["coefficient", "crossover_force", "force", "law", "stiffness"]

# Newton's steps from above, where the force is at most twice the target: a few steps reach rounding.
STEPS = 12


@numeric
def coefficient(
    hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, *, prefactor: ArrayLike | None = None
) -> Array:
    """Return Q of the indenter z = Q r^H that replaces the roughness [m^(1-H)] (thesis, eq. 5.6).

    Q = (2/(zeta L))^(H+1) (H+1) L h/(2 H kappa(H)).

    Parameters
    ----------
    hurst : float or array
        Hurst exponent H, above 0 and at most 2.
    rms : float or array
        Root mean square height h of the roughness [m].
    length : float or array
        Side L of the square over which it was measured; also its longest wavelength [m].
    prefactor : float or array, optional
        zeta of the power law; by default 1.7/(H+1).

    Returns
    -------
    float or array
        Q [m^(1-H)].

    Raises
    ------
    ValueError
        If H lies outside the range in which the stiffness of the roughness scales as F^(1/(H+1)).

    Examples
    --------
    >>> from roughcontact.theory import power_law_indenter, pohrt_popov, rough_sphere
    >>> Q = rough_sphere.coefficient(0.8, 1e-6, 1e-3)
    >>> k = power_law_indenter.contact(1e11, exponent=0.8, coefficient=Q, force=1.0).stiffness
    >>> round(float(k / pohrt_popov.stiffness(1.0, 0.8, 1e-6, 1e-3, 1e11)), 6)
    1.0
    """
    h, zeta = _roughness(hurst, prefactor)
    height, size = positive(rms, "rms [m]"), positive(length, "length [m]")
    return (2 / (zeta * size)) ** (h + 1) * (h + 1) * size * height / (2 * h * kappa(h))


@numeric
def force(
    stiffness: ArrayLike,
    *,
    radius: ArrayLike,
    hurst: ArrayLike,
    rms: ArrayLike,
    length: ArrayLike,
    modulus: ArrayLike,
    prefactor: ArrayLike | None = None,
) -> Array:
    """Return the force at which a rough sphere has a stiffness [N] (thesis, eq. 5.9 with E* for E).

    F = E* ((k/E*)^3/(6R) + L h (k/(zeta E* L))^(H+1)): Hertz' force for k and the roughness' force for k, added.

    Parameters
    ----------
    stiffness : float or array
        Contact stiffness k [N/m].
    radius : float or array
        Radius R of the sphere [m].
    hurst : float or array
        Hurst exponent H of the roughness, above 0 and at most 2.
    rms : float or array
        Root mean square height h of the roughness [m].
    length : float or array
        Side L of the square over which it was measured; also its longest wavelength [m].
    modulus : float or array
        Reduced modulus E* [Pa].
    prefactor : float or array
        zeta of the power law; by default 1.7/(H+1).

    Returns
    -------
    float or array
        F [N].

    Raises
    ------
    ValueError
        If H lies outside its range, or a number is not positive.

    Examples
    --------
    >>> from roughcontact.theory import rough_sphere
    >>> body = {"radius": 1e-2, "hurst": 0.8, "rms": 1e-8, "length": 1e-3, "modulus": 1e11}
    >>> round(float(rough_sphere.force(rough_sphere.stiffness(1.0, **body), **body)), 9)
    1.0
    """
    e, sphere, rough, h = _terms(radius, hurst, rms, length, modulus, prefactor)
    x = positive(stiffness, "stiffness [N/m]", zero=True) / e
    return e * (sphere * x**3 + rough * x ** (h + 1))


@numeric
def stiffness(
    force: ArrayLike,
    *,
    radius: ArrayLike,
    hurst: ArrayLike,
    rms: ArrayLike,
    length: ArrayLike,
    modulus: ArrayLike,
    prefactor: ArrayLike | None = None,
) -> Array:
    """Return the contact stiffness of a rough sphere [N/m], the inverse of `force` (thesis, eq. 5.9).

    At any force it is below that of the smooth sphere and below that of only the roughness.

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    radius, hurst, rms, length, modulus, prefactor : float or array
        See `force`.

    Returns
    -------
    float or array
        k [N/m].

    Examples
    --------
    >>> from roughcontact.theory import hertz, rough_sphere
    >>> smooth = hertz.point(1e11, radius=1e-2, force=100.0).stiffness
    >>> rough = rough_sphere.stiffness(100.0, radius=1e-2, hurst=0.8, rms=1e-8, length=1e-3, modulus=1e11)
    >>> round(float(rough / smooth), 3)  # at high load that of the smooth sphere
    0.999
    """
    e, sphere, rough, h = _terms(radius, hurst, rms, length, modulus, prefactor)
    f = positive(force, "force [N]", zero=True) / e
    # From the smaller of both asymptotes: the sum is convex, and Newton's steps decrease monotonically to the root.
    x = np.minimum(np.cbrt(f / sphere), (f / rough) ** (1 / (h + 1)))
    loaded = f > 0
    for _ in range(STEPS):
        slope = np.where(loaded, 3 * sphere * x**2 + (h + 1) * rough * x**h, 1.0)
        x = x - (sphere * x**3 + rough * x ** (h + 1) - f) / slope
    return e * x


@numeric
def crossover_force(
    radius: ArrayLike,
    hurst: ArrayLike,
    rms: ArrayLike,
    length: ArrayLike,
    modulus: ArrayLike,
    *,
    prefactor: ArrayLike | None = None,
) -> Array:
    """Return the force at which the smooth sphere and only the roughness are equally stiff [N] (thesis, eq. 5.10).

    F = E* (zeta^(3H+3) h^-3 L^(3H) (6R)^-(H+1))^(1/(H-2)); below it the roughness dominates.

    Parameters
    ----------
    radius, hurst, rms, length, modulus, prefactor : float or array
        See `force`; H must be below 2.

    Returns
    -------
    float or array
        F [N].

    Raises
    ------
    ValueError
        If H is 2: both laws then have the exponent 1/3 and never cross.

    Examples
    --------
    >>> from roughcontact.theory import hertz, pohrt_popov, rough_sphere
    >>> force = rough_sphere.crossover_force(1e-2, 0.8, 1e-8, 1e-3, 1e11)
    >>> smooth = hertz.point(1e11, radius=1e-2, force=force).stiffness
    >>> round(float(smooth / pohrt_popov.stiffness(force, 0.8, 1e-8, 1e-3, 1e11)), 6)
    1.0
    """
    h, zeta = _roughness(hurst, prefactor)
    require(
        h < 2,
        "hurst must be below 2: at 2 roughness and sphere follow the same power law and never cross",
        value=h,
        place="hurst",
    )
    r, e = positive(radius, "radius [m]"), positive(modulus, "modulus [Pa]")
    height, size = positive(rms, "rms [m]"), positive(length, "length [m]")
    inside = zeta ** (3 * h + 3) * height**-3 * size ** (3 * h) * (6 * r) ** -(h + 1)
    return e * inside ** (1 / (h - 2))


Terms = tuple[tuple[float, float], ...]  # powers of a radius, and their coefficients


@numeric
def law(radius: float, hurst: float, rms: float, length: float, modulus: float) -> LoadingLaw:
    """Return stiffness, depth and elastic energy of a rough sphere as functions of force (thesis, eqs 5.7 to 5.9).

    Parameters
    ----------
    radius, hurst, rms, length, modulus : float
        See `force`.

    Returns
    -------
    LoadingLaw
        Valid up to the force at which the contact is as wide as the square of the roughness, k = E* L.

    Examples
    --------
    >>> from roughcontact.theory import rough_sphere
    >>> law = rough_sphere.law(1e-2, 0.8, 1e-8, 1e-3, 1e11)
    >>> round(float(law.predict("stiffness", law.domain[1])) / 1e8, 6)  # its domain ends at k = E* L
    1.0
    """
    body = {"radius": radius, "hurst": hurst, "rms": rms, "length": length, "modulus": modulus}
    highest = float(force(positive(modulus, "modulus [Pa]") * positive(length, "length [m]"), **body))
    # Powers p of r, and the depths by each single term: d = sum D a^p, F = sum 2 E* p/(p + 1) D a^(p + 1).
    terms = ((2.0, 1 / radius), (hurst, float(coefficient(hurst, rms, length) * kappa(hurst))))

    return LoadingLaw(
        "Rough sphere",
        "thesis, eq. 5.9",
        {
            "stiffness": partial(stiffness, **body),
            "depth": partial(_depth, body, terms),
            "elastic_energy": partial(_energy, body, terms),
        },
        (0.0, highest),
    )


def _contact_radius(body: Mapping[str, float], force: Array) -> Array:
    return stiffness(force, **body) / (2 * body["modulus"])


def _depth(body: Mapping[str, float], terms: Terms, force: Array) -> Array:
    a = _contact_radius(body, force)
    return np.asarray(sum(scale * a**p for p, scale in terms))


def _energy(body: Mapping[str, float], terms: Terms, force: Array) -> Array:
    # U = int F dd, term by term.
    a = _contact_radius(body, force)
    parts = [
        2 * body["modulus"] * p / (p + 1) * scale * other * q / (p + q + 1) * a ** (p + q + 1)
        for (p, scale), (q, other) in itertools.product(terms, repeat=2)
    ]
    return np.asarray(sum(parts))


def _roughness(hurst: ArrayLike, prefactor: ArrayLike | None) -> tuple[Array, Array]:
    """Return H and zeta."""
    natural = pohrt_popov.prefactor(hurst)
    require(
        np.asarray(hurst) <= pohrt_popov.SMOOTH,
        "hurst must not exceed 2: the roughness is then one smooth crest, and no indenter r^H",
        value=hurst,
        place="hurst",
    )
    zeta = natural if prefactor is None else positive(prefactor, "prefactor")
    return np.asarray(hurst, dtype=np.float64)[()], zeta


def _terms(
    radius: ArrayLike,
    hurst: ArrayLike,
    rms: ArrayLike,
    length: ArrayLike,
    modulus: ArrayLike,
    prefactor: ArrayLike | None,
) -> tuple[Array, Array, Array, Array]:
    """Return E*, the factors of x^3 and of x^(H+1) in F/E*, and H; x = k/E*."""
    h, zeta = _roughness(hurst, prefactor)
    size = positive(length, "length [m]")
    rough = size * positive(rms, "rms [m]") * (zeta * size) ** -(h + 1)
    return positive(modulus, "modulus [Pa]"), 1 / (6 * positive(radius, "radius [m]")), rough, h
