r"""The two integrals between a body of revolution f(r) and its one-dimensional profile g(x) (thesis, appendix A.2).

    g(x) = x \int_0^x f'(r) dr / sqrt(x^2 - r^2)          f(r) = (2/pi) \int_0^r g(x) dx / sqrt(r^2 - x^2)

Both are Abel's integral of a function. One routine computes it for a piecewise polynomial to rounding accuracy: near
the singular end by the substitution r = x sin t, elsewhere with nodes that are the same for every x.
"""

from __future__ import annotations

import numpy as np

from roughcontact.mdr.bodies.chebyshev import Function, Panels, fit, interpolate
from roughcontact.theory.tools.quadrature import gauss
from roughcontact.validation import Array

__all__ = ["abel", "height_of", "transform_of"]

FUNCTION = 1e-14  # tolerance of the fit to a function, relative on each panel
TRANSFORMED = 1e-13  # of the fit to its transform, which has the rounding error of the integral
FAR = 12  # Gauss nodes of a panel that lies at least its length below x: exact to rounding
NEAR = 24  # Gauss nodes of a panel closer to x
CHUNK = 2_000_000  # kernel values held at once


def transform_of(height: Panels) -> Panels:
    """Return g(x) of a profile f(r), both as panels up to the same radius."""
    slope = height.derivative()
    return _matched(lambda x: x * abel(slope, x), height)


def height_of(transform: Panels) -> Panels:
    """Return f(r) of a transform g(x), both as panels up to the same radius."""
    return _matched(lambda r: 2 / np.pi * abel(transform, r), transform)


def _matched(function: Function, source: Panels) -> Panels:
    """Return the function on new panels; if the given panels are coarse, as for samples, on the given panels."""
    nodes = source.coefficients.shape[1]
    if nodes < NEAR // 2:
        # Cubic splines contain no more information than their knots: finer panels would only resolve their jumps.
        return interpolate(function, source.edges, nodes + 3)
    return fit(function, float(source.edges[-1]), tolerance=TRANSFORMED)


def abel(function: Panels, x: Array) -> Array:
    r"""Return the integral of a piecewise polynomial p(r) over r from 0 to x with the weight 1/sqrt(x^2 - r^2).

    Parameters
    ----------
    function : Panels
        Its first edge is 0.
    x : array, shape (n,)
        Positions in [0, last edge] [m]; at 0 the limit, p(0) pi/2.

    Returns
    -------
    array, shape (n,)
    """
    x = np.asarray(x, dtype=np.float64)
    out = np.empty_like(x)
    rows = max(1, CHUNK // (FAR * len(function.coefficients)))
    nodes, weights = _fixed(function)
    for start in range(0, len(x), rows):
        part = slice(start, start + rows)
        out[part] = _abel(function, x[part], nodes, weights)
    return out


def _fixed(function: Panels) -> tuple[Array, Array]:
    """Return Gauss nodes of every panel and the weights times the function there, both of shape (m, FAR)."""
    local, weights = gauss(FAR)
    left, width = function.edges[:-1, None], np.diff(function.edges)[:, None]
    places = left + width * local
    return places, width * weights * function.at(places, np.arange(len(width)))


def _abel(function: Panels, x: Array, nodes: Array, weights: Array) -> Array:
    left, right = function.edges[:-1], function.edges[1:]
    far = x[:, None] - right >= right - left
    near = ~far & (x[:, None] > left)
    # Kernel of the far panels; other panels get weight zero and a harmless position.
    spread = (x[:, None, None] - nodes) * (x[:, None, None] + nodes)
    kernel = np.where(far[..., None], 1 / np.sqrt(np.where(far[..., None], spread, 1.0)), 0.0)
    total = np.einsum("ijk,jk->i", kernel, weights)
    row, panel = np.nonzero(near)
    reached = x[row]
    first, last = _angle(left[panel], reached), _angle(np.minimum(right[panel], reached), reached)
    local, shares = gauss(NEAR)
    t = first[:, None] + (last - first)[:, None] * local
    values = function.at(reached[:, None] * np.sin(t), panel)
    np.add.at(total, row, (last - first) * (values @ shares))
    total[x == 0] = np.pi / 2 * function.at(np.zeros(1), np.zeros(1, dtype=np.intp))[0]
    return np.asarray(total)


def _angle(r: Array, x: Array) -> Array:
    """Return t of r = x sin t; the arc sine loses half of the digits near r = x."""
    return np.asarray(np.arctan2(r, np.sqrt((x - r) * (x + r))))
