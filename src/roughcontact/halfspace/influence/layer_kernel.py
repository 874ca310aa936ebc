"""What a layer adds to the half-space beside a point load and over a cell: Hankel transforms, tabulated."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.special import hankel1, j1

from roughcontact.validation import Array

__all__ = ["LayerKernel", "layer_kernel"]

Deviation = Callable[[npt.NDArray[Any]], npt.NDArray[Any]]

# Lengths in thicknesses from here on. The transforms are smooth over a thickness near the load, and over the distance
# further away: polynomials of COUNT coefficients on intervals that grow by GROWTH hold them to 1e-13 of the
# half-space's (tests/halfspace/operators/test_layer.py).
FIRST = 0.5
GROWTH = 1.5
COUNT = 16
LAST = 24.0  # beyond, a deviation that decays as exp(-2 t) is nothing
LEAST = 2.0**-60  # of the first oscillation: before, an integral with a logarithm is nothing
# Angle of the ray in the complex plane along which the oscillation decays: all poles lie beyond.
ANGLE = math.pi / 6
DECAYED = 38.0  # exp(-38) is nothing
SPAN = 4.0  # of an oscillation's argument that a rule resolves
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_X = np.cos(np.pi * (np.arange(COUNT) + 0.5) / COUNT)
_chebyshev = np.polynomial.chebyshev


@dataclass(frozen=True, slots=True, eq=False)
class LayerKernel:
    """The function W of the distance r in thicknesses with which a point load pushes cells of a layer.

    A point load lifts the layer by ``1/r + D(r)`` where it lifts a half-space by 1/r, with
    ``D = int (M(t) - 1) J0(t r) dt``. D is the divergence of the vector ``W(r) (x, y)``, with
    ``W = int (M(t) - 1) J1(t r)/(t r) dt``: its integral over a cell is one of W along its edges.

    Attributes
    ----------
    edges : array, shape (n + 1,)
        Ends of the intervals.
    coefficients : array, shape (COUNT, n)
        Of Chebyshev polynomials on each.
    least : float
        Smallest value of ``1 + r D`` up to the last edge; below zero, a load lifts some place.
    """

    edges: Array
    coefficients: Array
    least: float

    def __call__(self, r: Array) -> Array:
        """Return W at distances up to the last edge."""
        place = np.zeros(r.shape, np.intp)
        beyond = r > FIRST
        place[beyond] = (np.log(r[beyond] / FIRST) / math.log(GROWTH)).astype(np.intp) + 1
        np.minimum(place, len(self.edges) - 2, out=place)
        start, stop = self.edges[place], self.edges[place + 1]
        x = (2 * r - start - stop) / (stop - start)
        last, value = np.zeros(r.shape), np.zeros(r.shape)  # Clenshaw's recurrence
        for row in self.coefficients[:0:-1]:
            value, last = row[place] + 2 * x * value - last, value
        return np.asarray(self.coefficients[0][place] + x * value - last)


def layer_kernel(deviation: Deviation, reach: float) -> LayerKernel:
    """Return the kernel of a layer up to a distance of `reach` thicknesses.

    Parameters
    ----------
    deviation : callable
        M(t) - 1 at real or complex t, ``2/(E* q) M(q thickness)`` being the answer to a wave of pressure.
    reach : float
        Largest distance over the thickness.
    """
    count = max(1, math.ceil(math.log(max(reach, FIRST) / FIRST) / math.log(GROWTH) + 1e-9))
    edges = np.r_[0.0, FIRST * GROWTH ** np.arange(count + 1)]
    r = FIRST * (1 + _X) / 2
    values = _near(deviation, r)
    columns = [_coefficients(values)]
    flux = FIRST**2 * float(_chebyshev.chebval(1.0, columns[0]))
    slope = _chebyshev.chebval(_X, _chebyshev.chebder(columns[0])) / (FIRST / 2)
    least = float((1 + r * (2 * values + r * slope)).min())
    for start, stop in pairwise(edges[1:]):
        half = (stop - start) / 2
        r = start + half * (1 + _X)
        added = r * _far(deviation, r)
        least = min(least, float((1 + added).min()))
        # D r = (W r^2)'
        integral = _chebyshev.chebint(_coefficients(added), lbnd=-1) * half
        columns.append(_coefficients((flux + _chebyshev.chebval(_X, integral)) / r**2))
        flux += float(_chebyshev.chebval(1.0, integral))
    return LayerKernel(edges, np.stack(columns, axis=1), least)


def _coefficients(values: Array) -> Array:
    """Return the coefficients of the polynomial through values at the Chebyshev nodes."""
    coefficients = 2 / COUNT * _chebyshev.chebvander(_X, COUNT - 1).T @ values
    coefficients[0] /= 2
    return np.asarray(coefficients)


def _near(deviation: Deviation, r: Array) -> Array:
    """Return W within a thickness, by its integral."""
    t, weights = _rule(np.r_[0.0, 2.0 ** np.arange(-40, 0), np.arange(1.0, LAST + 1)])
    weighted = weights * deviation(t)
    return np.array([float(weighted @ (j1(t * one) / (t * one))) for one in r])


def _far(deviation: Deviation, r: Array) -> Array:
    """Return D, by its integral along a ray on which Hankel's function decays where Bessel's goes on and on."""
    closest, furthest = float(r.min()), float(r.max())
    end = min(LAST / math.cos(ANGLE), DECAYED / (closest * math.sin(ANGLE)))
    # Doubling from a point where a logarithm is left, with steps that resolve the deviation and the oscillation.
    step = min(1.0, SPAN / furthest)
    first = step * 2.0 ** np.arange(round(math.log2(LEAST)), 0)
    s, weights = _rule(np.r_[first, np.arange(1, math.ceil(end / step) + 1) * step])
    turn = cmath.exp(1j * ANGLE)
    weighted = turn * weights * deviation(turn * s)
    return np.array([float((weighted @ hankel1(0, turn * s * one)).real) for one in r])


def _rule(ends: Array) -> tuple[Array, Array]:
    """Return nodes and weights of Gauss's rule on intervals."""
    half = np.diff(ends) / 2
    middle = (ends[1:] + ends[:-1]) / 2
    return (middle[:, None] + half[:, None] * _NODES).ravel(), (half[:, None] * _WEIGHTS).ravel()
