"""The computed stiffness of rough squares: exponent and prefactor of ensembles of surfaces, with errors.

k/(E* L) = zeta (F/(E* h L))^alpha as in the thesis (`pohrt_popov`), but alpha and zeta are those of the mean
stiffness of 800 free squares of 512 x 512 cells for each of twelve Hurst exponents (docs/evidence/law.md), and monotone
interpolations between them. With kappa, k/(E* L) at F/(E* h L) = 0.02, zeta is kappa 0.02^-alpha.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import PchipInterpolator

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.stiffness_laws.pohrt_popov import FORCE_LIMIT
from roughcontact.validation import Array, number, numeric, positive, require

__all__ = [
    "HURST_LIMITS",
    "LEAST_STIFFNESS",
    "exponent",
    "exponent_error",
    "law",
    "prefactor",
    "prefactor_error",
    "relative_error",
    "stiffness",
]

# k/(E* L) of 20 of 512 x 512 cells, below which single cells dominate.
LEAST_STIFFNESS = 0.035
_REFERENCE = 0.02  # F/(E* h L) at which the errors of exponent and level are almost uncorrelated
_ROUND = 1e-9  # tolerance of a force at an end of the window
# H; alpha and its standard error; kappa and its standard error over it; the correlation of both errors.
# `python reproduction/benchmarks/law_formula.py` prints it.
_TABLE = (
    (0.1, 0.75738, 0.00315, 0.068037, 0.00563, -0.62),
    (0.25, 0.71424, 0.00328, 0.071091, 0.00632, -0.45),
    (0.4, 0.67005, 0.00320, 0.077042, 0.00666, -0.25),
    (0.55, 0.62318, 0.00343, 0.085063, 0.00715, -0.25),
    (0.7, 0.58351, 0.00337, 0.093883, 0.00723, -0.08),
    (0.85, 0.54904, 0.00332, 0.102928, 0.00733, 0.07),
    (1, 0.51735, 0.00339, 0.111727, 0.00753, 0.06),
    (1.3, 0.46580, 0.00316, 0.127646, 0.00768, 0.25),
    (1.6, 0.42508, 0.00267, 0.140216, 0.00782, 0.37),
    (1.9, 0.39827, 0.00214, 0.149075, 0.00785, 0.42),
    (2.35, 0.37205, 0.00154, 0.156720, 0.00718, 0.33),
    (2.95, 0.35929, 0.00112, 0.160740, 0.00618, 0.52),
)
_HURST, _ALPHAS, _ALPHA_ERRORS, _KAPPAS, _KAPPA_ERRORS, _CORRELATIONS = np.array(_TABLE).T
_ERRORS = _ALPHA_ERRORS, _KAPPA_ERRORS, _CORRELATIONS
_ALPHA, _KAPPA = PchipInterpolator(_HURST, _ALPHAS), PchipInterpolator(_HURST, _KAPPAS)
HURST_LIMITS = (float(_HURST[0]), float(_HURST[-1]))


def exponent(hurst: ArrayLike) -> Array:
    """Return the exponent alpha of rough squares [-].

    Parameters
    ----------
    hurst : float or array
        Hurst exponent H, from 0.1 to 2.95.

    Returns
    -------
    float or array
        alpha [-].

    Raises
    ------
    ValueError
        If H is out of range of the computed surfaces.

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov, rough_square
    >>> for hurst in (0.25, 0.7, 1.6):
    ...     print(f"{rough_square.exponent(hurst):.2f} beside {pohrt_popov.exponent(hurst):.2f}")
    0.71 beside 0.80
    0.58 beside 0.59
    0.43 beside 0.38
    """
    return _exponent(_hurst(hurst))


def exponent_error(hurst: ArrayLike) -> Array:
    """Return the standard error of the `exponent` [-].

    Parameters
    ----------
    hurst : float or array
        See `exponent`.

    Returns
    -------
    float or array
        Standard error [-].

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> print(f"{rough_square.exponent(0.7):.3f} +- {rough_square.exponent_error(0.7):.3f}")
    0.584 +- 0.003
    """
    error: Array = np.interp(_hurst(hurst), _HURST, _ERRORS[0])
    return error


def prefactor(hurst: ArrayLike) -> Array:
    """Return the prefactor zeta of rough squares [-].

    Parameters
    ----------
    hurst : float or array
        See `exponent`.

    Returns
    -------
    float or array
        zeta [-]: k/(E* L) at a force of E* h L, far outside the window. Compare stiffnesses, not prefactors.

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> print(f"{rough_square.prefactor(0.7):.2f} +- {rough_square.prefactor_error(0.7):.2f}")
    0.92 +- 0.01
    """
    zeta: Array = np.exp(_log_stiffness(1.0, _hurst(hurst)))
    return zeta


def prefactor_error(hurst: ArrayLike) -> Array:
    """Return the standard error of the `prefactor` [-].

    Parameters
    ----------
    hurst : float or array
        See `exponent`.

    Returns
    -------
    float or array
        Standard error [-].

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> bool(rough_square.prefactor_error(0.7) > 0)
    True
    """
    return prefactor(hurst) * _log_error(1.0, _hurst(hurst))


@numeric
def stiffness(
    force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike
) -> Array:
    """Return the mean contact stiffness of rough squares [N/m].

    Parameters
    ----------
    force : float or array
        Normal force F [N].
    hurst : float or array
        Hurst exponent H, from 0.1 to 2.95.
    rms : float or array
        Root mean square height h about the mean [m].
    length : float or array
        Side L of the square surface [m]; also the longest wavelength.
    modulus : float or array
        Reduced modulus E* [Pa].

    Returns
    -------
    float or array
        k [N/m], of many surfaces; for its error see `relative_error`.

    Raises
    ------
    ValueError
        If H is out of range, or the force outside the window of the ensembles: from the force at which k is 0.035 E*
        L, the stiffness of 20 of their cells, to 0.07 E* h L.

    Notes
    -----
    The amplitudes of the waves are those of the spectrum, their phases are random, and the shortest waves have two
    cells. Single surfaces scatter about the mean by up to a quarter. Curves of the mean stiffness are slightly bent:
    docs/evidence/law.md lists their deviations from a power law. If any Hurst exponent is left out, interpolation
    reproduces its values within one standard error.

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov, rough_square
    >>> surface = {"hurst": 0.25, "rms": 1e-6, "length": 1e-3, "modulus": 1e11}
    >>> k = rough_square.stiffness(2.0, **surface)  # F/(E* h L) = 0.02
    >>> off = k / pohrt_popov.stiffness(2.0, **surface) - 1
    >>> print(f"{off:+.0%} +- {rough_square.relative_error(2.0, **surface):.0%}")
    +20% +- 1%
    """
    f, h, scale = _given(force, hurst, rms, length, modulus)
    k: Array = scale * np.exp(_log_stiffness(f, h))
    return k


@numeric
def relative_error(
    force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike
) -> Array:
    """Return the relative standard error of the mean `stiffness` [-].

    Parameters
    ----------
    force, hurst, rms, length, modulus : float or array
        See `stiffness`.

    Returns
    -------
    float or array
        Relative standard error [-] of the mean, not the scatter of single surfaces.

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> surface = {"hurst": 0.7, "rms": 1e-6, "length": 1e-3, "modulus": 1e11}
    >>> bool((rough_square.relative_error([1.0, 2.0, 7.0], **surface) < 0.03).all())
    True
    """
    f, h, _ = _given(force, hurst, rms, length, modulus)
    return _log_error(f, h)


@numeric
def law(hurst: float, rms: float, length: float, modulus: float) -> LoadingLaw:
    """Return the mean stiffness of rough squares as a function of force.

    Parameters
    ----------
    hurst, rms, length, modulus : float
        See `stiffness`.

    Returns
    -------
    LoadingLaw
        Valid in the window of the ensembles. It has no depth, which would need the forces below.

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> law = rough_square.law(0.8, 1e-6, 1e-3, 1e11)
    >>> law, [f"{end:.2g} N" for end in law.domain]
    (LoadingLaw(Rough squares, computed: stiffness), ['0.31 N', '7 N'])
    """
    surface = {"hurst": hurst, "rms": rms, "length": length, "modulus": modulus}
    h = _hurst(hurst)
    scale = float(_scale(length, modulus) * positive(rms, "rms [m]"))
    return LoadingLaw(
        "Rough squares, computed",
        "docs/evidence/law.md",
        {"stiffness": partial(stiffness, **surface)},
        (scale * float(_lowest(h)), scale * FORCE_LIMIT),
    )


def _given(
    force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike
) -> tuple[Array, Array, Array]:
    """Return F/(E* h L), inside the window, H, and E* L [N/m]."""
    h, scale = _hurst(hurst), _scale(length, modulus)
    f = positive(force, "force [N]") / (scale * positive(rms, "rms [m]"))
    require(
        (f >= _lowest(h) * (1 - _ROUND)) & (f <= FORCE_LIMIT * (1 + _ROUND)),
        f"F/(E* h L) must lie between that at which k is {LEAST_STIFFNESS} E* L, 0.0074 at H = 0.25 and 0.0003 at "
        f"H = 2.95, and {FORCE_LIMIT}: no surfaces were computed outside",
        "compute the surface, or use pohrt_popov",
        value=f,
    )
    return f, h, scale


def _scale(length: ArrayLike, modulus: ArrayLike) -> Array:
    return positive(modulus, "modulus [Pa]") * positive(length, "length [m]")


def _hurst(hurst: ArrayLike) -> Array:
    h = number(hurst, "hurst")
    low, high = HURST_LIMITS
    require(
        (h >= low) & (h <= high),
        f"hurst must lie from {low} to {high}: no surfaces were computed outside",
        value=h,
        place="hurst",
    )
    return h


def _lowest(hurst: Array) -> Array:
    """Return the force F/(E* h L) at which k is the smallest resolved stiffness."""
    found: Array = _REFERENCE * (LEAST_STIFFNESS / _level(hurst)) ** (1 / _exponent(hurst))
    return found


def _exponent(hurst: Array) -> Array:
    alpha: Array = _ALPHA(hurst)[()]
    return alpha


def _level(hurst: Array) -> Array:
    """Return kappa, k/(E* L) at the reference force."""
    kappa: Array = _KAPPA(hurst)[()]
    return kappa


def _log_error(force: ArrayLike, hurst: Array) -> Array:
    """Return the standard error of ln k at F/(E* h L)."""
    of_alpha, of_level, correlation = (np.interp(hurst, _HURST, each) for each in _ERRORS)
    by_alpha = np.log(np.asarray(force) / _REFERENCE) * of_alpha
    error: Array = np.sqrt(of_level**2 + 2 * correlation * of_level * by_alpha + by_alpha**2)
    return error


def _log_stiffness(force: ArrayLike, hurst: Array) -> Array:
    """Return ln k/(E* L) at F/(E* h L)."""
    k: Array = np.log(_level(hurst)) + _exponent(hurst) * np.log(np.asarray(force) / _REFERENCE)
    return k
