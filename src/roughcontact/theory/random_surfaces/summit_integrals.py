"""Integrals over the joint density of summit heights and curvatures, stable from narrow to wide spectra."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from scipy.special import expit

from roughcontact.theory.random_surfaces.nayak import free_variance
from roughcontact.theory.random_surfaces.partial_moments import log_gaussian
from roughcontact.validation import Array

__all__ = ["log_integrals"]

NODES = 64  # in each of two panels: rounding accuracy for all planes and all alpha
REACH = 9.0  # standard deviations of curvature beyond which the integrand is negligible in double precision
LEFT_OUT = 90.0  # exp(-45) of the density at the plane is below rounding, powers of heights included


def log_integrals(
    orders: Sequence[float], plane: Array, alpha: float, power: float, factor: Callable[[Array], Array] | None
) -> list[Array]:
    """Return ``ln int D(s, t, r) (s - s0)^n g^-power f(k2/k1) ds dt dr`` over all summits above s0, for each n.

    Parameters
    ----------
    orders : sequence of float
        The exponents n.
    plane : array
        s0, heights of the flat above the mean plane of the surface, in sqrt(m0).
    alpha : float
        Nayak's parameter, above 3/2.
    power : float
        Exponent of the geometric mean curvature g, in sqrt(m4); below 2.
    factor : callable or None
        f of the ratio of principal curvatures; None for 1.

    Raises
    ------
    ValueError
        If alpha is 3/2 or less, see `nayak.free_variance`.

    Notes
    -----
    D is `nayak.summit_density`. At given curvatures heights are normal, and their integral is a partial moment; with
    ``u = (r/t)^2`` the rest is ``t^(4 - power) exp(-3 t^2/4)`` times a Laplace transform over u from 0 to 1. At given
    height t is also normal, which locates the peak even of a narrow density.
    """
    s0 = np.asarray(plane, dtype=np.float64)
    above, root = np.maximum(s0, 0.0), math.sqrt(alpha)
    sigma = math.sqrt(free_variance(alpha))
    spread = math.sqrt(2 / 3) * sigma  # of t at given height
    peak, last = above / root, np.sqrt(above**2 + LEFT_OUT) / root
    ends = np.stack(
        [np.maximum(peak - REACH * spread, 0.0), peak + REACH * spread, last + REACH * spread], axis=-1
    )
    # In v = sqrt(t) half-integer powers at t = 0 are polynomials.
    v, weight = _panels(np.sqrt(ends))
    t = v**2
    kernel = 2 * v * weight * t ** (4 - power) * _over_deviators(t, power, factor) * math.sqrt(0.75 / math.pi)
    results = []
    for n in orders:
        moment = log_gaussian(n, (s0[..., None] - 1.5 * t / root) / sigma)
        # The factor exp(-s0^2/2), the height density at the plane, is taken out of the sum.
        sums = (kernel * np.exp(moment - 0.75 * t**2 + above[..., None] ** 2 / 2)).sum(axis=-1)
        results.append(np.log(sums) - above**2 / 2 + n * math.log(sigma))
    return results


def _over_deviators(t: Array, power: float, factor: Callable[[Array], Array] | None) -> Array:
    """Return ``(3/2) int_0^1 (1 - u)^(1 - power/2) f exp(-3 t^2 u/2) du`` with u = (r/t)^2, for each t."""
    # Double exponential: the integrand has a root and a logarithm at u = 1, and lies near u = 0 for large t.
    k, step = np.linspace(-3.2, 3.2, 81, retstep=True)
    u, rest = expit(math.pi * np.sinh(k)), expit(-math.pi * np.sinh(k))
    weight = 1.5 * step * math.pi * np.cosh(k) * u * rest ** (2 - power / 2)
    if factor is not None:
        weight *= factor(rest / (1 + np.sqrt(u)) ** 2)  # k2/k1 = (t - r)/(t + r)
    total = np.zeros_like(t)
    for node, share in zip(u, weight, strict=True):
        total += share * np.exp(-1.5 * node * t**2)
    return total


def _panels(ends: Array) -> tuple[Array, Array]:
    """Return Gauss-Legendre nodes and weights of the two panels between three ends (..., 3)."""
    x, w = np.polynomial.legendre.leggauss(NODES)
    middle, half = (ends[..., 1:] + ends[..., :-1]) / 2, np.diff(ends) / 2
    nodes, weights = middle[..., None] + half[..., None] * x, half[..., None] * w
    return nodes.reshape(*ends.shape[:-1], -1), weights.reshape(*ends.shape[:-1], -1)
