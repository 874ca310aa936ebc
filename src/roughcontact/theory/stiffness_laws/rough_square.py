"""The computed stiffness of rough squares: exponent and prefactor of ensembles of surfaces, with errors.

k/(E* L) = zeta (F/(E* h L))^alpha as in the thesis (`pohrt_popov`), but alpha and zeta are those of the mean
stiffness of 800 free squares of 512 x 512 cells for each of twelve Hurst exponents (docs/evidence/law.md), and monotone
interpolations between them. With kappa, k/(E* L) at F/(E* h L) = 0.02, zeta is kappa 0.02^-alpha.

They depend on where the square is cut out of its surface, because a crest at the border is cut in two:

``"interior"``
    The highest crest lies in the middle, and at most 5 % of the force within a contact radius of the border: the law of
    the surface itself.
``"period"``
    The square is one period of its surface, cut at random, as in the thesis: the other part of a crest at the border
    lies at the opposite border, and both are stiffer than one.
``"patch"``
    The square is cut out of a larger surface at random, as a measured map: the other part is missing.
"""

from __future__ import annotations

from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.stiffness_laws.square_laws import LEAST_STIFFNESS, laws_of_cut
from roughcontact.validation import Array, number, numeric, positive, require

__all__ = [
    "HURST_LIMITS",
    "LEAST_STIFFNESS",
    "Cut",
    "exponent",
    "exponent_error",
    "law",
    "prefactor",
    "prefactor_error",
    "relative_error",
    "single_range",
    "squares_needed",
    "stiffness",
]

Cut = Literal["interior", "period", "patch"]

_ROUND = 1e-9  # tolerance of a force at an end of the window
HURST_LIMITS = (0.1, 2.95)


def exponent(hurst: ArrayLike, *, cut: Cut) -> Array:
    """Return the exponent alpha of rough squares [-].

    Parameters
    ----------
    hurst : float or array
        Hurst exponent H, from 0.1 to 2.95.
    cut : {"interior", "period", "patch"}
        Where the square is cut out of its surface, see the description of the module.

    Returns
    -------
    float or array
        alpha [-].

    Raises
    ------
    ValueError
        If H is out of range of the computed surfaces, or there is no such cut.

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov, rough_square
    >>> for hurst in (0.25, 0.7, 1.6):
    ...     print(
    ...         f"{rough_square.exponent(hurst, cut='interior'):.2f}, {rough_square.exponent(hurst, cut='period'):.2f} "
    ...         f"beside {pohrt_popov.exponent(hurst):.2f}"
    ...     )
    0.71, 0.71 beside 0.80
    0.56, 0.58 beside 0.59
    0.40, 0.42 beside 0.38
    """
    return laws_of_cut(cut).exponent(_hurst(hurst))


def exponent_error(hurst: ArrayLike, *, cut: Cut) -> Array:
    """Return the standard error of the `exponent` [-].

    Parameters
    ----------
    hurst : float or array
        See `exponent`.
    cut : {"interior", "period", "patch"}
        See `exponent`.

    Returns
    -------
    float or array
        Standard error [-].

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> alpha, error = (each(0.7, cut="interior") for each in (rough_square.exponent, rough_square.exponent_error))
    >>> print(f"{alpha:.3f} +- {error:.3f}")
    0.565 +- 0.003
    """
    return laws_of_cut(cut).at(_hurst(hurst), "exponent_error")


def prefactor(hurst: ArrayLike, *, cut: Cut) -> Array:
    """Return the prefactor zeta of rough squares [-].

    Parameters
    ----------
    hurst : float or array
        See `exponent`.
    cut : {"interior", "period", "patch"}
        See `exponent`.

    Returns
    -------
    float or array
        zeta [-]: k/(E* L) at a force of E* h L, far outside the window. Compare stiffnesses, not prefactors.

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> zeta, error = (each(0.7, cut="interior") for each in (rough_square.prefactor, rough_square.prefactor_error))
    >>> print(f"{zeta:.2f} +- {error:.2f}")
    0.82 +- 0.01
    """
    zeta: Array = np.exp(laws_of_cut(cut).log_stiffness(1.0, _hurst(hurst)))
    return zeta


def prefactor_error(hurst: ArrayLike, *, cut: Cut) -> Array:
    """Return the standard error of the `prefactor` [-].

    Parameters
    ----------
    hurst : float or array
        See `exponent`.
    cut : {"interior", "period", "patch"}
        See `exponent`.

    Returns
    -------
    float or array
        Standard error [-].

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> bool(rough_square.prefactor_error(0.7, cut="period") > 0)
    True
    """
    return prefactor(hurst, cut=cut) * laws_of_cut(cut).standard_error(1.0, _hurst(hurst))


@numeric
def stiffness(
    force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike, *, cut: Cut
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
    cut : {"interior", "period", "patch"}
        Where the square is cut out of its surface, see the description of the module.

    Returns
    -------
    float or array
        k [N/m], the mean of many surfaces; for its error see `relative_error`, for single ones `single_range`.

    Raises
    ------
    ValueError
        If H is out of range, there is no such cut, or the force is outside the window of the ensembles: from the force
        at which k is 0.035 E* L, the stiffness of 20 of their cells, to 0.07 E* h L. An interior contact ends at lower
        forces if H is below 0.7: above them more than 5 % of the force lies at the border.

    Notes
    -----
    The amplitudes of the waves are those of the spectrum, their phases are random, and the shortest waves have two
    cells. The square is self-affine up to its side: the law does not hold for maps with a roll-off. The patch is not
    computed: its stiffness is that of the interior, with the effect of the border that is computed for the period,
    times the ratio of both effects for a smooth crest (docs/evidence/law.md).

    Examples
    --------
    >>> from roughcontact.theory import pohrt_popov, rough_square
    >>> surface = {"hurst": 0.25, "rms": 1e-6, "length": 1e-3, "modulus": 1e11}
    >>> k = rough_square.stiffness(2.0, **surface, cut="period")  # F/(E* h L) = 0.02
    >>> off = k / pohrt_popov.stiffness(2.0, **surface) - 1
    >>> print(f"{off:+.0%} +- {rough_square.relative_error(2.0, **surface, cut='period'):.0%}")
    +19% +- 1%
    """
    f, h, scale = _given(force, hurst, rms, length, modulus, cut)
    k: Array = scale * np.exp(laws_of_cut(cut).log_stiffness(f, h))
    return k


@numeric
def relative_error(
    force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike, *, cut: Cut
) -> Array:
    """Return the relative error of the mean `stiffness` [-].

    Parameters
    ----------
    force, hurst, rms, length, modulus : float or array
        See `stiffness`.
    cut : {"interior", "period", "patch"}
        See `stiffness`.

    Returns
    -------
    float or array
        Root of the sum of the squares of the standard error of the mean and the largest misfit of the power law in the
        window; for a patch also of half of the effect of its border [-]. It is not the scatter of single surfaces.

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> surface = {"hurst": 0.7, "rms": 1e-6, "length": 1e-3, "modulus": 1e11}
    >>> bool((rough_square.relative_error([1.0, 2.0, 7.0], **surface, cut="interior") < 0.03).all())
    True
    """
    f, h, _ = _given(force, hurst, rms, length, modulus, cut)
    laws = laws_of_cut(cut)
    return np.hypot(laws.standard_error(f, h), laws.at(h, "misfit"))


@numeric
def single_range(
    force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike, *, cut: Cut
) -> tuple[Array, Array]:
    """Return the range of the stiffness of a single rough square [N/m].

    Parameters
    ----------
    force, hurst, rms, length, modulus : float or array
        See `stiffness`.
    cut : {"interior", "period", "patch"}
        See `stiffness`.

    Returns
    -------
    tuple of two floats or arrays
        The 5 % and the 95 % quantiles of the stiffness of single surfaces [N/m].

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> surface = {"hurst": 0.7, "rms": 1e-6, "length": 1e-3, "modulus": 1e11}
    >>> low, high = rough_square.single_range(2.0, **surface, cut="interior")
    >>> mean = rough_square.stiffness(2.0, **surface, cut="interior")
    >>> f"{low / mean:.2f} to {high / mean:.2f} of the mean"
    '0.67 to 1.42 of the mean'
    """
    f, h, scale = _given(force, hurst, rms, length, modulus, cut)
    laws = laws_of_cut(cut)
    mean = scale * np.exp(laws.log_stiffness(f, h))
    low, high = laws.quantiles(f, h)
    return mean * low, mean * high


@numeric
def squares_needed(hurst: ArrayLike, error: ArrayLike, *, cut: Cut) -> Array:
    """Return how many squares must be measured to know their Hurst exponent from their stiffness.

    Exponents of k(F) are fitted to single squares over the window of the law. They scatter from square to square, and
    this scatter over dalpha/dH and the wanted error, squared, is the number. Errors of the measurement add to it.

    Parameters
    ----------
    hurst : float or array
        Expected Hurst exponent H, from 0.1 to 2.95.
    error : float or array
        Wanted standard error of H.
    cut : {"interior", "period", "patch"}
        Where the square is cut out of its surface.

    Returns
    -------
    float or array
        Number of squares, not rounded.

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> f"{rough_square.squares_needed(0.7, 0.1, cut='interior'):.0f} squares for H = 0.7 +- 0.1"
    '15 squares for H = 0.7 +- 0.1'
    """
    h, laws = _hurst(hurst), laws_of_cut(cut)
    found: Array = (laws.at(h, "scatter") / laws.slope(h) / positive(error, "error")) ** 2
    return found


@numeric
def law(hurst: float, rms: float, length: float, modulus: float, *, cut: Cut) -> LoadingLaw:
    """Return the mean stiffness of rough squares as a function of force.

    Parameters
    ----------
    hurst, rms, length, modulus : float
        See `stiffness`.
    cut : {"interior", "period", "patch"}
        See `stiffness`.

    Returns
    -------
    LoadingLaw
        Valid in the window of the ensembles. It has no depth, which would need the forces below.

    Examples
    --------
    >>> from roughcontact.theory import rough_square
    >>> law = rough_square.law(0.8, 1e-6, 1e-3, 1e11, cut="interior")
    >>> law, [f"{end:.2g} N" for end in law.domain]
    (LoadingLaw(Rough squares, computed (interior): stiffness), ['0.31 N', '7 N'])
    """
    surface = {"hurst": hurst, "rms": rms, "length": length, "modulus": modulus}
    h, laws = _hurst(hurst), laws_of_cut(cut)
    scale = float(_scale(length, modulus) * positive(rms, "rms [m]"))
    return LoadingLaw(
        f"Rough squares, computed ({cut})",
        "docs/evidence/law.md",
        {"stiffness": partial(stiffness, **surface, cut=cut)},
        (scale * float(laws.lowest(h)), scale * float(laws.highest(h))),
    )


def _given(
    force: ArrayLike, hurst: ArrayLike, rms: ArrayLike, length: ArrayLike, modulus: ArrayLike, cut: Cut
) -> tuple[Array, Array, Array]:
    """Return F/(E* h L), inside the window, H, and E* L [N/m]."""
    laws, h, scale = laws_of_cut(cut), _hurst(hurst), _scale(length, modulus)
    f = positive(force, "force [N]") / (scale * positive(rms, "rms [m]"))
    low, high = laws.lowest(h), laws.highest(h)
    require(
        (f >= low * (1 - _ROUND)) & (f <= high * (1 + _ROUND)),
        f"F/(E* h L) must lie between that at which k is {LEAST_STIFFNESS} E* L and the highest of the ensembles "
        f"(here {np.max(low):.2g} and {np.min(high):.2g})",
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
