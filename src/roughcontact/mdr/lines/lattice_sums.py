"""Sums over the waves of a square and of a line, for equal roughness of both on a grid."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import hyp2f1, zeta

from roughcontact.errors import about
from roughcontact.validation import Array, numeric, scalar, whole

__all__ = ["lambda_rms", "line_sum", "square_sum"]

# B_2j / 2j, the coefficients of Euler and Maclaurin's correction in terms of Taylor coefficients.
_BERNOULLI = (1 / 12, -1 / 120, 1 / 252, -1 / 240, 1 / 132)
# Up to this ring the sum is direct. Beyond, the first term left out is below 1e-16 of the ring for exponents
# up to 4: the integrand's poles are sqrt(2) rings away from the corner.
_DIRECT = 32


def lambda_rms(hurst: float, modes: int | None = None) -> float:
    """Return lambda of C1D = lambda q C2D for equal rms heights of line and surface (thesis, A.76 corrected).

    Parameters
    ----------
    hurst : float
        Hurst exponent H, at least -1.
    modes : int, optional
        Largest number N of waves to a side: ``(n - 1)//2`` on a grid of n cells, because waves at the Nyquist
        wavenumber are left out. By default the limit of many waves.

    Returns
    -------
    float
        ``sum' (n^2 + m^2)^(-H-1) / sum' |n|^(-2H-1)``, both sums from -N to N without the origin. The limit is
        ``2 zeta(H+1) beta(H+1) / zeta(2H+1)`` for H > 0 (beta: Dirichlet's) and ``4 int_0^1 (1+x^2)^(-H-1) dx``
        for H <= 0; it is 4 at H = -1, pi at H = 0, 2.507 at H = 1 and 2 for a single wave, H to infinity.

    Raises
    ------
    ValueError
        If H is below -1 or not finite, or `modes` is not a whole number >= 1.

    Notes
    -----
    The thesis prints half of this and a limit of pi at H = 1. The sums belong to all waves of a square grid.
    On a disc of waves the ratio is ``grid_moments(..., surface).m0 / grid_moments(..., line).m0``.

    Examples
    --------
    >>> import math
    >>> from roughcontact.mdr import lattice_sums
    >>> round(lattice_sums.lambda_rms(0.0) / math.pi, 6), round(lattice_sums.lambda_rms(1.0), 3)
    (1.0, 2.507)
    """
    _check(hurst, modes)
    if modes is not None:
        return square_sum(hurst + 1, modes) / line_sum(2 * hurst + 1, modes)
    exponent = hurst + 1
    above = exponent - 1  # H as rounded in the exponent: both poles of zeta need the same H
    if above <= 0:  # both sums diverge, in the ratio of their integrals
        return 4 * _side_integral(exponent)
    return 2 * float(zeta(1 + above) / zeta(1 + 2 * above)) * _dirichlet_beta(exponent)


@numeric
def line_sum(exponent: float, modes: int) -> float:
    """Return the sum of ``|n|^-exponent`` over n from -`modes` to `modes` without 0.

    Parameters
    ----------
    exponent : float
        Any real number [-].
    modes : int
        Largest number N of waves to a side.

    Returns
    -------
    float
        Sum [-].

    Examples
    --------
    >>> from roughcontact.mdr import lattice_sums
    >>> lattice_sums.line_sum(2.0, 2)  # 2 (1 + 1/4)
    2.5
    """
    return 2 * float(np.sum(_rings(1, modes) ** -exponent))


@numeric
def square_sum(exponent: float, modes: int) -> float:
    """Return the sum of ``(n^2 + m^2)^-exponent`` over n and m from -`modes` to `modes` without the origin.

    Computed by square rings: the cost grows with `modes` and not with its square. The ring of half
    side k is eight times the trapezoidal rule for ``(k^2 + m^2)^-exponent`` over m from 0 to k: summed directly
    in the middle, from its integral and Euler and Maclaurin's correction at the corner further out.

    Parameters
    ----------
    exponent : float
        Any real number [-].
    modes : int
        Largest number N of waves to a side.

    Returns
    -------
    float
        Sum [-].

    Examples
    --------
    >>> from roughcontact.mdr import lattice_sums
    >>> lattice_sums.square_sum(1.0, 1)  # four sides and four corners
    6.0
    """
    inner = _rings(1, min(modes, _DIRECT))
    total = 4 * float(np.sum(inner ** (-2 * exponent) * (1 + 2.0**-exponent)))
    side, place = inner[:, None], inner[None, :]
    total += 8 * float(np.sum((side**2 + place**2) ** -exponent, where=place < side))
    outer = _rings(_DIRECT + 1, modes)
    taylor = _taylor_at_corner(exponent, 2 * len(_BERNOULLI))
    ring = outer * _side_integral(exponent)
    for j, coefficient in enumerate(_BERNOULLI, start=1):
        ring += coefficient * taylor[2 * j - 1] * outer ** (1 - 2 * j)
    return total + 8 * float(np.sum(outer ** (-2 * exponent) * ring))


def _dirichlet_beta(exponent: float) -> float:
    """Return the sum of ``(-1)^k (2k + 1)^-exponent``, to rounding for exponents above 0.

    By the acceleration of alternating series of Cohen, Rodriguez Villegas and Zagier (Exp. Math. 9, 3, 2000),
    algorithm 1; a difference of two Hurwitz zeta functions loses all digits towards exponent 1.
    """
    terms = 24  # the error is below (3 + sqrt 8)^-terms
    power = (3 + math.sqrt(8)) ** terms
    d = (power + 1 / power) / 2
    b, c, total = -1.0, -d, 0.0
    for k in range(terms):
        c = b - c
        total += c * (2 * k + 1.0) ** -exponent
        b *= (k + terms) * (k - terms) / ((k + 0.5) * (k + 1))
    return total / d


def _side_integral(exponent: float) -> float:
    """Return the integral of ``(1 + x^2)^-exponent`` from 0 to 1."""
    return float(hyp2f1(0.5, exponent, 1.5, -1.0))


def _taylor_at_corner(exponent: float, count: int) -> list[float]:
    """Return the Taylor coefficients of ``(1 + x^2)^-exponent`` about x = 1.

    From ``(2 + 2t + t^2) g' = -2 exponent (1 + t) g`` with t = x - 1.
    """
    before, here = 0.0, 2.0**-exponent
    coefficients = [here]
    for n in range(count - 1):
        after = -((2 * n + 2 * exponent) * here + (n - 1 + 2 * exponent) * before) / (2 * (n + 1))
        before, here = here, after
        coefficients.append(here)
    return coefficients


def _rings(first: int, last: int) -> Array:
    return np.arange(first, last + 1, dtype=np.float64)


def _check(hurst: float, modes: int | None) -> None:
    scalar(hurst, "Hurst exponent")
    if not (math.isfinite(hurst) and hurst >= -1):
        raise about("hurst", f"must be finite and at least -1 (white heights), not {hurst}")
    if modes is not None:
        whole(modes, "modes, the waves to a side,")
