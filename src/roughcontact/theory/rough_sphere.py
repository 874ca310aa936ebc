"""A sphere with self-affine roughness, as one axisymmetric indenter (thesis, section 5.2).

The roughness is replaced by z = Q r^H of the same stiffness, and added to the paraboloid r^2/(2R): a profile whose
contact is one disc and known in closed form.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from functools import partial

import numpy as np
import numpy.typing as npt

from roughcontact.theory import pohrt_popov
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.power_law_indenter import kappa
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["coefficient", "crossover_force", "force", "law", "stiffness"]

# Newton's steps from above, where the force is at most twice the wanted one: a few reach rounding.
STEPS = 12


@numeric
def coefficient(
    hurst: npt.ArrayLike, rms: npt.ArrayLike, length: npt.ArrayLike, *, prefactor: npt.ArrayLike | None = None
) -> Array:
    """Return Q of the indenter z = Q r^H that stands for the roughness [m^(1-H)] (thesis, eq. 5.6).

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

    Raises
    ------
    ValueError
        If H lies outside the range in which the stiffness of the roughness goes as F^(1/(H+1)).
    """
    h, zeta = _roughness(hurst, prefactor)
    height, size = positive(rms, "rms [m]"), positive(length, "length [m]")
    value: Array = (2 / (zeta * size)) ** (h + 1) * (h + 1) * size * height / (2 * h * kappa(h))
    return value


@numeric
def force(
    stiffness: npt.ArrayLike,
    *,
    radius: npt.ArrayLike,
    hurst: npt.ArrayLike,
    rms: npt.ArrayLike,
    length: npt.ArrayLike,
    modulus: npt.ArrayLike,
    prefactor: npt.ArrayLike | None = None,
) -> Array:
    """Return the force at which a rough sphere has a stiffness [N] (thesis, eq. 5.9 with E* for E).

    F = E* ((k/E*)^3/(6R) + L h (k/(zeta E* L))^(H+1)): Hertz' force for k and the roughness' force for k, added.

    Parameters
    ----------
    stiffness : float or array
        Contact stiffness k [N/m].
    radius : float or array
        Radius R of the sphere [m].
    hurst, rms, length, prefactor : float or array
        Of the roughness, see `coefficient`.
    modulus : float or array
        Reduced modulus E* [Pa].

    Raises
    ------
    ValueError
        If H lies outside its range, or a number is not positive.
    """
    e, sphere, rough, h = _terms(radius, hurst, rms, length, modulus, prefactor)
    x = positive(stiffness, "stiffness [N/m]", zero=True) / e
    value: Array = e * (sphere * x**3 + rough * x ** (h + 1))
    return value


@numeric
def stiffness(
    force: npt.ArrayLike,
    *,
    radius: npt.ArrayLike,
    hurst: npt.ArrayLike,
    rms: npt.ArrayLike,
    length: npt.ArrayLike,
    modulus: npt.ArrayLike,
    prefactor: npt.ArrayLike | None = None,
) -> Array:
    """Return the contact stiffness of a rough sphere [N/m], the inverse of `force` (thesis, eq. 5.9).

    It is below that of the smooth sphere and below that of the roughness alone, at any force.

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    radius, hurst, rms, length, modulus, prefactor : float or array
        See `force`.
    """
    e, sphere, rough, h = _terms(radius, hurst, rms, length, modulus, prefactor)
    f = positive(force, "force [N]", zero=True) / e
    # From the smaller of both asymptotes: the sum is convex, so that Newton's steps fall monotonely to the root.
    x = np.minimum(np.cbrt(f / sphere), (f / rough) ** (1 / (h + 1)))
    loaded = f > 0
    for _ in range(STEPS):
        slope = np.where(loaded, 3 * sphere * x**2 + (h + 1) * rough * x**h, 1.0)
        x = x - (sphere * x**3 + rough * x ** (h + 1) - f) / slope
    value: Array = e * x
    return value


@numeric
def crossover_force(
    radius: npt.ArrayLike,
    hurst: npt.ArrayLike,
    rms: npt.ArrayLike,
    length: npt.ArrayLike,
    modulus: npt.ArrayLike,
    *,
    prefactor: npt.ArrayLike | None = None,
) -> Array:
    """Return the force at which smooth sphere and roughness alone are equally stiff [N] (thesis, eq. 5.10).

    F = E* (zeta^(3H+3) h^-3 L^(3H) (6R)^-(H+1))^(1/(H-2)); below it the roughness decides.

    Parameters
    ----------
    radius, hurst, rms, length, modulus, prefactor : float or array
        See `force`; H must be below 2.

    Raises
    ------
    ValueError
        If H is 2: both laws then have the exponent 1/3 and never cross.
    """
    h, zeta = _roughness(hurst, prefactor)
    require(
        h < 2, "hurst must be below 2: at 2 roughness and sphere follow the same power law and never cross", h
    )
    r, e = positive(radius, "radius [m]"), positive(modulus, "modulus [Pa]")
    height, size = positive(rms, "rms [m]"), positive(length, "length [m]")
    inside = zeta ** (3 * h + 3) * height**-3 * size ** (3 * h) * (6 * r) ** -(h + 1)
    value: Array = e * inside ** (1 / (h - 2))
    return value


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
        Up to the force at which the disc of contact is as wide as the roughness' square, k = E* L.
    """
    body = {"radius": radius, "hurst": hurst, "rms": rms, "length": length, "modulus": modulus}
    highest = float(force(positive(modulus, "modulus [Pa]") * positive(length, "length [m]"), **body))
    # Powers p of r, and the depths by each term alone: d = sum D a^p, F = sum 2 E* p/(p + 1) D a^(p + 1).
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


def _roughness(hurst: npt.ArrayLike, prefactor: npt.ArrayLike | None) -> tuple[Array, Array]:
    """Return H and zeta."""
    natural = pohrt_popov.prefactor(hurst)
    require(
        np.asarray(hurst) <= pohrt_popov.SMOOTH,
        "hurst must not exceed 2: the roughness is then one smooth crest, and no indenter r^H",
        hurst,
    )
    zeta = natural if prefactor is None else positive(prefactor, "prefactor")
    return np.asarray(hurst, dtype=np.float64)[()], zeta


def _terms(
    radius: npt.ArrayLike,
    hurst: npt.ArrayLike,
    rms: npt.ArrayLike,
    length: npt.ArrayLike,
    modulus: npt.ArrayLike,
    prefactor: npt.ArrayLike | None,
) -> tuple[Array, Array, Array, Array]:
    """Return E*, the factors of x^3 and of x^(H+1) in F/E*, and H; x = k/E*."""
    h, zeta = _roughness(hurst, prefactor)
    size = positive(length, "length [m]")
    rough = size * positive(rms, "rms [m]") * (zeta * size) ** -(h + 1)
    return positive(modulus, "modulus [Pa]"), 1 / (6 * positive(radius, "radius [m]")), rough, h
