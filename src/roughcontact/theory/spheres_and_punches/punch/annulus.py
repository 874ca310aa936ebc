"""The flat annular punch, by a quadrature that is spectrally accurate for every width."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ellipkm1

from roughcontact.validation import Array, numeric, positive, require

__all__ = ["annulus"]

NODES = 48
# Below this inner over outer radius the series is exact to rounding, above it the nodes are.
THIN_HOLE = 0.02


@numeric
def annulus(modulus: ArrayLike, outer_radius: ArrayLike, inner_radius: ArrayLike) -> Array:
    """Return the stiffness of an annulus [N/m].

    Parameters
    ----------
    modulus : float or array
        Reduced modulus E* [Pa].
    outer_radius, inner_radius : float or array
        Radii a and b of its edges [m]; b = 0 is the disc.

    Returns
    -------
    float or array
        k [N/m].

    Raises
    ------
    ValueError
        If the inner radius is not below the outer one.

    Examples
    --------
    >>> from roughcontact.theory import punch
    >>> round(float(punch.annulus(1e11, 1e-3, 0.5e-3) / punch.disc(1e11, 1e-3)), 4)  # hardly softer than the disc
    0.981
    """
    a = positive(outer_radius, "outer_radius [m]")
    b = positive(inner_radius, "inner_radius [m]", zero=True)
    require(
        b < a,
        "inner_radius must be below outer_radius: no contact is left between them",
        place="inner_radius",
    )
    ratio = np.vectorize(_over_disc, otypes=[np.float64])(b / a, (a - b) / a)
    value: Array = (2 * positive(modulus, "modulus [Pa]") * a * ratio)[()]
    return value


def _over_disc(hole: float, width: float) -> float:
    """Return k/(2 E* a) of an annulus with a = 1, b = `hole` and a - b = `width`."""
    return _series(hole) if hole < THIN_HOLE else _quadrature(hole, width)


def _series(e: float) -> float:
    """Return the first terms in b/a (Gubenko and Mossakovskii; Collins)."""
    square = np.pi**2
    terms = 4 / (3 * square) * e**3 + 8 / (15 * square) * e**5 + 16 / (27 * square**2) * e**6
    return float(1 - terms - 92 / (315 * square) * e**7)


def _quadrature(hole: float, width: float) -> float:
    """Solve pi E* = int S(r, s) p(s) s ds for a unit depth by Nystroem's method.

    S = 4/(r + s) K(k), k'^2 = ((r - s)/(r + s))^2, is the displacement by a ring (thesis, eq. A.20). With
    s = (1 + b)/2 - (1 - b)/2 cos t, the inverse square roots of p at both edges cancel in ds, so p s ds is a smooth
    even function of t times dt; and K = -(1/pi) K(k') ln(k'^2/16) + a smooth rest, where ln k'^2 is a smooth function
    plus twice ln|cos t - cos t'|, whose integral over cosines is known (Kress, Linear Integral Equations).
    """
    n = NODES
    t = (np.arange(n) + 0.5) * np.pi / n
    s = (1 + hole) / 2 - width / 2 * np.cos(t)
    total = s[:, None] + s
    # cos t - cos t' as a product, which loses no digits for a narrow ring.
    m1 = (width * np.sin((t[:, None] + t) / 2) * np.sin((t[:, None] - t) / 2) / total) ** 2
    # ln|cos t - cos t'| = -ln 2 - 2 sum_j cos(j t) cos(j t')/j, as weights of an integral over t' from 0 to pi.
    j = np.arange(1, n)
    waves = np.cos(np.outer(t, j))
    logarithm = -np.pi / n * (np.log(2) + 2 * (waves / j) @ waves.T)
    smooth = np.pi / n * np.log(width / (8 * total))
    complement = ellipkm1(1 - m1)
    kernel = 4 / total * (np.pi / n * _rest(m1) - 2 / np.pi * complement * (smooth + logarithm))
    load = np.linalg.solve(kernel, np.full(n, np.pi))
    # The force 2 pi int p s ds over 2 E* a d.
    return float(np.pi * load.sum() * np.pi / n)


def _rest(m1: Array) -> Array:
    """Return K(k) + (1/pi) K(k') ln(k'^2/16) at `m1` = k'^2; 0 in the limit of 0."""
    apart = np.where(m1 > 0, m1, 1.0)
    value: Array = ellipkm1(apart) + ellipkm1(1 - apart) / np.pi * np.log(apart / 16)
    return np.where(m1 > 0, value, 0.0)
