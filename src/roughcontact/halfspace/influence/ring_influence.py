"""Mean displacement of a ring under a uniform pressure on another, for rings of any widths."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np
import numpy.typing as npt

from roughcontact.validation import Array

__all__ = ["ring_matrix"]

Pairs = npt.NDArray[np.intp]

# Measured against 60-digit arithmetic (tests/halfspace/operators/test_ring.py).
WIDE = 1e-3  # product of two rings' widths over their radii: from here on differences of discs keep 12 digits
NEAR = 3.0  # gap over the wider width: below, the logarithm needs a separate rule
FAR = ((40.0, 3), (10.0, 4), (NEAR, 6))  # from which gap on, and how many points of Gauss's rule serve
REACH = 1e-17  # part of a piece next to the singularity that an integral of ln t can do without
POINTS, ACROSS = 40, 4  # of Gauss's rule over the logarithm of the distance, and over the place


def ring_matrix(edges: Array) -> Array:
    """Return the mean of the integral of 1/r over each ring, for a unit load on each ring [m].

    Parameters
    ----------
    edges : array, shape (n + 1,)
        Radii of the circles that bound the rings [m].

    Returns
    -------
    array, shape (n, n)
        Entry (j, i): a pressure p on ring i gives ring j a mean displacement of ``p/(pi E*)`` times it.

    Notes
    -----
    Means instead of values in the middle make the matrix symmetric under the areas of the rings.

    Wide rings are differences of discs. A disc of radius a under a unit pressure displaces the half-space by
    ``4 a E(r^2/a^2)/(pi E*)`` (thesis, before A.26; E of parameter m). Its integral over a disc of radius b <= a is
    closed too, ``(8 pi a^3/3) [(1 + m) E(m) - (1 - m) K(m)]`` with ``m = (b/a)^2`` over ``pi E*``; the same as one
    function, ``2 pi^2 a b^2 2F1(-1/2, 1/2; 2; m)``, keeps its digits for a small disc in a large one.

    The double difference costs narrow rings these digits. They are integrated instead: circles of radii r and
    r + t have ``8 pi r (r + t)/(2 r + t) K(1 - t^2/(2 r + t)^2)``, smooth except for the logarithm of t.
    """
    widths = np.diff(edges)
    energy = _discs(edges)
    i, j = np.triu_indices(len(widths))
    share = widths / edges[1:]
    narrow = share[i] * share[j] < WIDE
    i, j = i[narrow], j[narrow]
    gap = np.where(i == j, 0.0, edges[j] - edges[i + 1])
    ratio = gap / np.maximum(widths[i], widths[j])
    below = np.inf
    for start, points in FAR:
        chosen = (ratio >= start) & (ratio < below)
        energy[i[chosen], j[chosen]] = _apart(edges, i[chosen], j[chosen], points)
        below = start
    near = (ratio < NEAR) & (i < j)
    energy[i[near], j[near]] = _beside(edges, i[near], j[near])
    own = i[i == j]
    energy[own, own] = _within(edges, own)
    upper = np.triu(energy)
    areas = np.pi * widths * (edges[1:] + edges[:-1])
    return np.asarray((upper + np.triu(upper, 1).T) / areas[:, None])


def _discs(edges: Array) -> Array:
    """Differences of discs: all pairs of rings, those of narrow ones with few digits."""
    from scipy.special import hyp2f1

    inner, outer = np.minimum.outer(edges, edges), np.maximum.outer(edges, edges)
    m = np.divide(inner, outer, out=np.zeros_like(inner), where=outer > 0) ** 2
    discs = 2 * np.pi**2 * outer * inner**2 * hyp2f1(-0.5, 0.5, 2, m)
    return np.asarray(np.diff(np.diff(discs, axis=0), axis=1))


def _circles(r: Array, t: Array) -> Array:
    """Two circles of radii r and r + t, per width of each."""
    from scipy.special import ellipkm1

    return np.asarray(8 * np.pi * r * (r + t) / (2 * r + t) * ellipkm1((t / (2 * r + t)) ** 2))


def _apart(edges: Array, i: Pairs, j: Pairs, points: int) -> Array:
    """Rings i inside j, far apart for their widths: Gauss's rule across both."""
    own, other, gap = edges[i + 1] - edges[i], edges[j + 1] - edges[j], edges[j] - edges[i + 1]
    total = np.zeros(len(i))
    for x, a in _gauss(points):
        for y, b in _gauss(points):
            # The distance from the gap: as a difference of radii it would lose the digits of narrow rings.
            total += a * b * _circles(edges[i] + x * own, gap + (1 - x) * own + y * other)
    return total * own * other


def _beside(edges: Array, i: Pairs, j: Pairs) -> Array:
    """Rings i inside j, near each other, over their distance t and the place of the inner circle.

    Circles at a distance t have the overlap of ring i with ring j moved by -t: it grows, stays as wide as the narrower
    ring, and shrinks again. Lengths are those of the rings and of their gap, never differences of radii.
    """
    (a, b), c = (edges[i], edges[i + 1]), edges[j]
    own, other = b - a, edges[j + 1] - c
    gap, short, long = c - b, np.minimum(own, other), np.maximum(own, other)
    total = np.zeros(len(i))
    for s, weight in _logarithmic(gap, short):
        for x, share in _gauss(ACROSS):
            total += weight * share * s * _circles(b - x * s, gap + s)
    for s, weight in _logarithmic(gap + short, long - short):
        t = gap + short + s
        # The narrower ring is covered whole: from its own inner circle on.
        first = np.where(own <= other, a, c - t)
        for x, share in _gauss(ACROSS):
            total += weight * share * short * _circles(first + x * short, t)
    for s, weight in _logarithmic(gap + long, short):
        for x, share in _gauss(ACROSS):
            total += weight * share * (short - s) * _circles(a + x * (short - s), gap + long + s)
    return total


def _within(edges: Array, i: Pairs) -> Array:
    """Rings on themselves: as `_beside`, either circle inside the other."""
    a, width = edges[i], edges[i + 1] - edges[i]
    total = np.zeros(len(i))
    for t, weight in _logarithmic(np.zeros(len(i)), width):
        for x, share in _gauss(ACROSS):
            total += 2 * weight * share * (width - t) * _circles(a + x * (width - t), t)
    return total


def _logarithmic(start: Array, length: Array) -> Iterator[tuple[Array, Array]]:
    """Yield places s on 0 to `length`, and weights, for functions of t = start + s that are smooth except for ln t.

    Gauss's rule over that logarithm, in which they are analytic; where t comes from zero, from a little above it.
    """
    first = np.maximum(start, REACH * (start + length))
    span = np.log((start + length) / first)
    for x, share in _gauss(POINTS):
        t = first * np.exp(x * span)
        yield first * np.expm1(x * span) + (first - start), share * span * t


@cache
def _gauss(points: int) -> tuple[tuple[float, float], ...]:
    """Nodes and weights of Gauss and Legendre on 0 to 1."""
    x, weights = np.polynomial.legendre.leggauss(points)
    return tuple(zip(((x + 1) / 2).tolist(), (weights / 2).tolist(), strict=True))
