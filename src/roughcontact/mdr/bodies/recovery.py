r"""From the springs to the surface: pressure inside and displacement outside a round contact.

The springs carry q(x) = E* (d - g(x)) up to the contact radius a (thesis, appendix A.2, and Popov & Hess, Method of
Dimensionality Reduction, 2015):

    p(r) = (E*/pi) [ \int_r^a g'(x) dx / sqrt(x^2 - r^2) + (d - g(a)) / sqrt(a^2 - r^2) ]
    u(r) = (2/pi) \int_0^a (d - g(x)) dx / sqrt(r^2 - x^2)          for r > a, and d - f(r) inside

The last term of the pressure is that of a flat punch: an edge or adhesion holds the contact where q(a) is not 0.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from roughcontact.mdr.bodies.axisymmetric_profile import Profile
from roughcontact.theory.tools.quadrature import double_exponential, gauss
from roughcontact.validation import Array

__all__ = ["pressure", "spring_energy", "surface_displacement"]

ORIGIN = 2.0**-30  # part of the contact in which the slope of the transform is treated as a power of x
SHARP = 1e-3  # largest exponent of that power for which the tip is sharp and its pressure infinite
NODES = 16  # Gauss nodes on each piece
HALVINGS = 12  # of the piece that begins at r, towards r: a break may lie just below r


def pressure(profile: Profile, modulus: float, radius: float, depth: float, r: Array) -> Array:
    """Return the pressure [Pa] at the radii `r` [m] under a contact of `radius` a [m] and `depth` d [m].

    Zero outside; infinite at a sharp tip and at an edge that carries load.
    """
    r = np.asarray(r, dtype=np.float64)
    out = np.zeros(r.shape)
    for index in np.argwhere((r <= radius) & (radius > 0)):
        place = tuple(index)
        out[place] = modulus / np.pi * _stress(profile, radius, depth, float(r[place]))
    return out


def _stress(profile: Profile, a: float, d: float, r: float) -> float:
    """Return the bracket of p(r)."""
    surplus = d - float(profile.transform(a))
    # The rounding error of a depth that was computed from the radius is not an edge.
    if abs(surplus) <= 1e-13 * abs(d):
        surplus = 0.0
    if r >= a:
        return float(np.sign(surplus) * np.inf) if surplus else 0.0
    total = surplus / np.sqrt((a - r) * (a + r))
    ends = [r, *(b for b in profile.breaks if r < b < a), a]
    if r == 0:
        ends[0] = ORIGIN * ends[1]
        total += _tip(profile, ends[0])
    for left, right in pairwise(ends):
        # x^2 = left^2 + y^2 removes the root singularity of the kernel, or of the slope beside a flat face, and y = s
        # sinh v
        # the near singularity of the kernel if the piece begins just above r.
        scale = np.sqrt((left - r) * (left + r)) if left > r else left
        top = float(np.arcsinh(np.sqrt((right - left) * (right + left)) / scale))
        v, weights = _pieces(top, HALVINGS if left == r else 0)
        y = scale * np.sinh(v)
        x = np.hypot(left, y)
        total += float(weights @ (profile.transform_slope(x) * (y / x if left > r else 1.0)))
    return float(total)


def _tip(profile: Profile, end: float) -> float:
    """Return the integral of g'(x)/x from 0 to `end`, where g' is a power of x."""
    outer, inner = profile.transform_slope(np.array([end, end / 2]))
    if outer == 0:
        return 0.0
    exponent = np.log2(outer / inner) if 0 < inner < np.inf else 0.0
    return float(outer / exponent) if exponent > SHARP else np.inf


def _pieces(top: float, halvings: int) -> tuple[Array, Array]:
    """Return nodes and weights on (0, top): pieces up to 1 long, the first of them halved towards 0."""
    whole = np.linspace(0.0, top, int(np.ceil(top)) + 1)
    edges = np.concatenate([[0.0], whole[1] * 2.0 ** np.arange(-halvings, 0), whole[1:]])
    nodes, weights = gauss(NODES)
    width = np.diff(edges)[:, None]
    return (edges[:-1, None] + width * nodes).ravel(), (width * weights).ravel()


def surface_displacement(profile: Profile, radius: float, depth: float, r: Array) -> Array:
    """Return the displacement [m] of the surface, into the body, at the radii `r` [m]."""
    r = np.asarray(r, dtype=np.float64)
    inside = r <= radius
    out = np.where(inside, depth - profile.height(np.minimum(r, radius)), 0.0)
    if radius == 0:
        return np.zeros(r.shape)
    far = r[~inside]
    nodes, weights = double_exponential()
    total = depth * np.arcsin(radius / far)
    ends = [0.0, *(b for b in profile.breaks if b < radius), radius]
    for left, right in pairwise(ends):
        first, last = _angle(left, far), _angle(right, far)
        t = first[:, None] + (last - first)[:, None] * nodes
        x = np.clip(far[:, None] * np.sin(t), left, right)
        total -= (last - first) * (profile.transform(x) @ weights)
    out[~inside] = 2 / np.pi * total
    return out


def spring_energy(profile: Profile, radius: float, depth: float) -> float:
    """Return the integral of (d - g)^2 from 0 to the contact `radius` [m^3]: the elastic energy over E*."""
    nodes, weights = double_exponential()
    ends = [0.0, *(b for b in profile.breaks if b < radius), radius]
    total = 0.0
    for left, right in pairwise(ends):
        x = left + (right - left) * nodes
        total += (right - left) * float(weights @ (depth - profile.transform(x)) ** 2)
    return total


def _angle(x: float, r: Array) -> Array:
    """Return t of x = r sin t, accurate also near x = r."""
    return np.asarray(np.arctan2(x, np.sqrt((r - x) * (r + x))))
