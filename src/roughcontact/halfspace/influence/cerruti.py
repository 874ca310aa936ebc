"""Closed forms of Cerruti's problem: how a tangential traction on a rectangle moves the surface sideways."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.influence.love import over_cell, table_of_cells
from roughcontact.validation import Array

__all__ = ["cerruti", "cerruti_table"]


# Below NEAR shorter sides the closed form, beyond Gauss's rule across the cell of the integral along it, with fewer
# points beyond FAR: each is good to some 1e-14 of Love's integral where it is used, at any ratio of the sides
# (tests/halfspace/influence/test_cerruti.py).
NEAR = 5.0
FAR = 60.0


def cerruti(x: npt.ArrayLike, y: npt.ArrayLike, dx: float, dy: float) -> Array:
    """Return the integrals X, Y, Z of ``x^2/r^3``, ``y^2/r^3`` and ``x y/r^3`` over a cell [m].

    A traction (qx, qy) on the cell moves the surface of one body at the offset by ``u_x = [(1 - nu)(X + Y) + nu X]
    qx/(2 pi G) + nu Z qy/(2 pi G)`` (Johnson, Contact Mechanics, 1985, section 3.6); ``X + Y`` is Love's integral of
    1/r, and u_y follows by exchange of x and y.

    Parameters
    ----------
    x, y : array
        Offsets from the centre of the cell [m], broadcast against each other.
    dx, dy : float
        Sides of the cell [m].

    Returns
    -------
    array, shape ``(3, *shape of the offsets)``
        X and Y are even in both offsets, Z is odd in both.
    """
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    if dy > dx:
        across, along, cross = cerruti(y, x, dy, dx)
        return np.stack([along, across, cross])
    a, b = np.abs(x), np.abs(y)  # along the longer side and across it
    distance = np.maximum(b, a - dx / 2)
    near, far = distance < NEAR * dy, distance >= FAR * dy
    middle = ~near & ~far
    value = np.empty((3, *a.shape))
    value[:, near] = over_cell(_corner, a[near], b[near], dx, dy)
    value[:, middle] = _across(a[middle], b[middle], dx, dy, points=8)
    value[:, far] = _across(a[far], b[far], dx, dy, points=3)
    value[2] *= np.sign(x) * np.sign(y)
    return value


def cerruti_table(shape: tuple[int, ...], spacing: tuple[float, ...]) -> Array:
    """Return `cerruti` for all offsets of whole cells from zero up, shape ``(3, ny, nx)`` [m]."""
    return table_of_cells(cerruti, np.empty((3, *shape)), spacing)


def _corner(x: Array, y: Array) -> Array:
    """Return ``y asinh(x/|y|)``, ``x asinh(y/|x|)`` and ``-r``, of which the integrands are mixed derivatives."""
    a, b = np.abs(x), np.abs(y)
    with np.errstate(divide="ignore", invalid="ignore"):
        first = np.where(b > 0, y * np.arcsinh(x / b), 0.0)
        second = np.where(a > 0, x * np.arcsinh(y / a), 0.0)
    return np.stack([first, second, -np.hypot(x, y)])


def _across(x: Array, y: Array, dx: float, dy: float, *, points: int) -> Array:
    """Gauss's rule across the shorter side of the integrals along the longer one."""
    value = np.zeros((3, *x.shape))
    for node, weight in zip(*np.polynomial.legendre.leggauss(points), strict=True):
        value += weight * _along(x, y + node * dy / 2, dx)
    return value * (dy / 2)


def _along(x: Array, y: Array, dx: float) -> Array:
    """Return the integrals along a line from ``x - dx/2`` to ``x + dx/2`` at distance y, without cancellation.

    They are the differences of ``asinh(x/y) - x/r``, ``x/r`` and ``-y/r`` between the ends; x >= 0, and y != 0 where
    the line reaches back beyond zero.
    """
    start, stop = x - dx / 2, x + dx / 2
    r_start, r_stop = np.hypot(start, y), np.hypot(stop, y)
    y2, squares, product = y * y, 2 * x * dx, r_start * r_stop  # squares = stop^2 - start^2
    same_side = start >= 0
    sinh = np.where(same_side, squares, stop * r_start - start * r_stop)
    sinh /= np.where(same_side, stop * r_start + start * r_stop, y2)
    second = y2 * sinh / product
    return np.stack([np.arcsinh(sinh) - second, second, y * squares / (product * (r_start + r_stop))])
