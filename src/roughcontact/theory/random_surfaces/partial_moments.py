"""Partial moments of a height distribution: integrals of powers of the excess above a plane."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal

import numpy as np
from scipy import special

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, number, numeric, require

__all__ = ["DISTRIBUTIONS", "Distribution", "log_exponential", "log_gaussian"]

Distribution = Literal["gaussian", "exponential"]

HIGHEST_ORDER = 20.0  # the area of a tip of height r^H needs 2/H; at higher orders digits are lost at LOW
LOW = 1.5  # below it, two Kummer functions barely cancel; above it, 96 Laguerre nodes are exact to rounding
NODES = 96


@numeric
def log_gaussian(order: float, plane: float | Array) -> Array:
    """Return ln F_n(t) of heights with zero mean and unit standard deviation.

    Parameters
    ----------
    order : float
        n, above -1 and at most 20.
    plane : float or array
        Height t of the plane, any real numbers.

    Returns
    -------
    array
        The logarithm, because F_n falls like exp(-t^2/2) and underflows at t = 39.

    Raises
    ------
    ValueError
        If the order lies outside.

    Notes
    -----
    ``F_n(t) = int_t^inf (x - t)^n phi(x) dx`` with ``dF_n/dt = -n F_{n-1}`` (Greenwood and Williamson 1966); F_0
    is the upper tail of the normal distribution. It is ``Gamma(n + 1)/sqrt(2 pi) exp(-t^2/4) D_{-n-1}(t)`` with the
    parabolic cylinder function, but SciPy's function underflows at t = 37 and has nine digits at t = 6.

    Examples
    --------
    >>> import math
    >>> from roughcontact.theory import partial_moments
    >>> round(math.exp(partial_moments.log_gaussian(0.0, 0.0)), 6)  # half of all heights lie above the mean
    0.5
    """
    n = _checked(order)
    t = np.asarray(number(plane, "plane"))
    require(
        t > -np.inf, "plane must not be minus infinity: the moment would be infinite", value=t, place="plane"
    )
    value = np.empty(t.shape)
    low = t < LOW
    value[low] = _by_kummer(n, t[low])
    value[~low] = _by_laguerre(n, t[~low])
    return value


@numeric
def log_exponential(order: float, plane: float | Array) -> Array:
    """Return ln F_n(t) of the heights ``phi(x) = exp(-x)``, x > 0: ``ln Gamma(n + 1) - t``.

    Parameters
    ----------
    order : float
        n, above -1 and at most 20.
    plane : float or array
        Height t of the plane, not negative: see Raises.

    Returns
    -------
    float or array
        The logarithm of F_n(t).

    Raises
    ------
    ValueError
        If the order is out of range, or a plane is below 0, where every height counts and the formula differs.

    Examples
    --------
    >>> import math
    >>> from roughcontact.theory import partial_moments
    >>> round(float(partial_moments.log_exponential(1.0, 3.0)), 6)  # ln Gamma(2) - 3
    -3.0
    """
    n = _checked(order)
    t = np.asarray(plane, dtype=np.float64)
    if (t < 0).any():
        raise InputError(
            f"a plane {-t.min():.3g} standard deviations below the lowest of all exponential heights touches "
            "every asperity: the exponential law holds only above it",
            place="plane",
        )
    return np.asarray(special.gammaln(n + 1) - t)


DISTRIBUTIONS: dict[Distribution, Callable[[float, float | Array], Array]] = {
    "gaussian": log_gaussian,
    "exponential": log_exponential,
}


def _checked(order: float) -> float:
    if not -1 < order <= HIGHEST_ORDER:
        raise about(
            "the order",
            f"of a partial moment must lie above -1, where the integral exists, and at most at "
            f"{HIGHEST_ORDER:g}, not {order}",
        )
    return float(order)


def _by_kummer(n: float, t: Array) -> Array:
    """Return ln F_n as its even and its odd part (DLMF 12.4, 12.7.12); at negative t both are positive."""
    x = t**2 / 2
    even = special.gamma((n + 1) / 2) * special.hyp1f1(-n / 2, 0.5, -x)
    odd = special.gamma(n / 2 + 1) * special.hyp1f1((1 - n) / 2, 1.5, -x)
    scale = (n / 2 - 1) * math.log(2) - math.log(math.pi) / 2
    return np.asarray(scale + np.log(even - math.sqrt(2) * t * odd))


def _by_laguerre(n: float, t: Array) -> Array:
    """Return ln F_n from ``F_n = phi(t) t^(-n-1) int_0^inf v^n exp(-v) exp(-v^2/(2 t^2)) dv``."""
    nodes, weights = special.roots_genlaguerre(NODES, n)
    integral = np.exp(-((nodes / t[..., None]) ** 2) / 2) @ weights
    return np.asarray(np.log(integral) - (n + 1) * np.log(t) - t**2 / 2 - math.log(2 * math.pi) / 2)
