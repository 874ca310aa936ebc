"""Two equal discs that act in parallel, far enough apart."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import eval_jacobi, gammaln

from roughcontact.validation import Array, numeric, positive, require

__all__ = ["two_discs"]

DEGREE = 12  # of the polynomials: a higher degree changes the stiffness by less than 1e-13


@numeric
def two_discs(modulus: ArrayLike, radius: ArrayLike, spacing: ArrayLike) -> Array:
    """Return the stiffness of two equal discs under one rigid body that does not tilt [N/m] (thesis, fig. 12 b).

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    radius : float or array
        Radius a of each disc [m].
    spacing : float or array
        Distance s of their centres [m], at least 3 a.

    Returns
    -------
    float or array
        k [N/m].

    Raises
    ------
    ValueError
        If the discs are closer than three radii, where the degree of the polynomials is too low.

    Notes
    -----
    The pressure of each disc is 1/sqrt(1 - r^2/a^2) times a polynomial. Each polynomial of an orthogonal family causes
    a displacement proportional to itself on the same disc (W. D. Collins, Proc. Roy. Soc. A 274, 1963); on the other
    disc it causes a smooth displacement, which Gauss' quadrature projects. The relative error is below 1e-12. Far
    apart the depth under the force F is F/(4 E* a) (1 + (2/pi) a/s).

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.two_discs(1e11, 1e-3, 1.0) / punch.disc(1e11, 1e-3)), 3)  # nearly two, far apart
    1.999
    """
    a, s = positive(radius, "radius [m]"), positive(spacing, "spacing [m]")
    require(
        s >= 3 * a,
        "spacing must be at least three radii: the pressures of nearer discs need polynomials of higher degree",
        place="spacing",
    )
    value: Array = 2 * positive(modulus, "modulus [Pa]") * a * np.vectorize(_force, otypes=[float])(s / a)
    return value


def _force(spacing: float) -> float:
    """Return the force on both discs over that on a single disc of radius 1."""
    x, y, weights, basis, own = _polynomials()
    # The pressures are even in y: the influence of both halves of one disc on the upper half of the other, mirrored.
    across = spacing - x[:, None] - x
    green = sum(1 / np.hypot(across, y[:, None] - side * y) for side in (1, -1)) / (2 * np.pi)
    weighted = basis * weights
    flat = weighted.sum(axis=1)  # a unit displacement in the basis of polynomials
    coefficients = np.linalg.solve(np.diag(own) + weighted @ green @ weighted.T, flat)
    return float(flat @ coefficients)


@cache
def _polynomials() -> tuple[Array, Array, Array, Array, Array]:
    """Return nodes x, y and weights over a unit disc, the polynomials there, and the displacement that each causes.

    Polynomials are r^m cos(m t) P_n^(m, -1/2)(1 - 2 r^2) of degree m + 2n, shape (polynomials, nodes), normalised under
    the weight 1/sqrt(1 - r^2). Nodes are on the half of the disc where y > 0; weights count both halves.
    """
    # With z = sqrt(1 - r^2) the integral over r dr/sqrt(1 - r^2) is one over dz of an even polynomial.
    nodes, weights = np.polynomial.legendre.leggauss(2 * DEGREE)
    angles = np.pi * (np.arange(2 * DEGREE) + 0.5) / (2 * DEGREE)
    r = np.repeat(np.sqrt(1 - nodes[DEGREE:] ** 2), angles.size)
    t = np.tile(angles, DEGREE)
    weight = np.repeat(weights[DEGREE:], angles.size) * np.pi / DEGREE
    orders = [(m, n) for m in range(DEGREE + 1) for n in range((DEGREE - m) // 2 + 1)]
    basis = np.array([r**m * np.cos(m * t) * eval_jacobi(n, m, -0.5, 1 - 2 * r**2) for m, n in orders])
    basis /= np.sqrt(basis**2 @ weight)[:, None]
    m, n = np.array(orders).T
    own = np.exp(gammaln(n + 0.5) + gammaln(n + m + 0.5) - gammaln(n + 1) - gammaln(n + m + 1))
    return r * np.cos(t), r * np.sin(t), weight, basis, own
