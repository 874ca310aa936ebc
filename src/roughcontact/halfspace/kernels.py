"""Closed forms of the half-space: the displacement under uniformly loaded rectangles and strips."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["love", "love_table", "periodic_multiplier", "strip"]

Array = npt.NDArray[np.float64]

# Measured against 60-digit arithmetic (tests/halfspace/test_kernels.py): beyond FAR longer sides the
# expansion of 1/r to fourth order, beyond NEAR shorter sides Gauss's rule across the cell, else the
# closed form. Each is good to some 1e-14 where it is used.
FAR = 60.0
NEAR = 5.0
BLOCK = 16384  # cells of a table that are computed in one go
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)


def love(x: npt.ArrayLike, y: npt.ArrayLike, dx: float, dy: float) -> Array:
    """Return the integral of 1/r over a cell [m] (thesis, eqs A.15, A.16; Love 1929).

    A pressure p on the cell lifts the surface at the offset by ``u = love(...) * p / (pi E*)``.

    Parameters
    ----------
    x, y : array
        Offsets from the centre of the cell [m], broadcast against each other.
    dx, dy : float
        Sides of the cell [m].

    Returns
    -------
    array
        Values [m], accurate to 1e-12 relative at any offset and any ratio of the sides.
    """
    a, b = np.broadcast_arrays(np.abs(np.asarray(x, float)), np.abs(np.asarray(y, float)))
    if dy > dx:  # the shorter side is called y, and the offset along it b, from here on
        a, b, dx, dy = b, a, dy, dx
    far = np.hypot(a, b) >= FAR * dx
    near = ~far & (np.maximum(b, a - dx / 2) < NEAR * dy)
    middle = ~far & ~near
    value = np.empty(a.shape)
    value[far] = _expansion(a[far], b[far], dx, dy)
    value[near] = _closed(a[near], b[near], dx, dy)
    value[middle] = _across(a[middle], b[middle], dx, dy)
    return value


def love_table(shape: tuple[int, ...], spacing: tuple[float, ...]) -> Array:
    """Return `love` for all offsets of whole cells from zero up, shape ``(ny, nx)`` [m]."""
    (ny, nx), (dy, dx) = shape, spacing
    x, y = np.arange(nx) * dx, np.arange(ny)[:, None] * dy
    table = np.empty((ny, nx))
    rows = max(1, BLOCK // nx)
    for start in range(0, ny, rows):  # in blocks whose temporaries stay in cache
        table[start : start + rows] = love(x, y[start : start + rows], dx, dy)
    return table


def periodic_multiplier(wavenumber: npt.ArrayLike) -> Array:
    """Return 2/q, zero at q = 0: the displacement of a unit pressure wave, times E* [m].

    The mean displacement of a periodic half-space is a matter of convention; here it is zero.
    """
    q = np.asarray(wavenumber, float)
    return np.asarray(np.divide(2.0, q, out=np.zeros_like(q), where=q > 0))


def strip(offset: npt.ArrayLike) -> Array:
    """Return the mean of ``-2 ln|x|`` over a strip, integrated over another, at offsets of whole strips (A.46).

    The strips have width one. ``B_0 = 3``, ``B_k = 3 - (k+1)^2 ln(k+1) + 2 k^2 ln k - (k-1)^2 ln(k-1)``. The
    thesis finds the same number for a hat-shaped pressure at its nodes, printed without the factor -2: a hat
    is a strip averaged over a strip.

    Parameters
    ----------
    offset : array of int
        Of either sign.
    """
    k = np.abs(np.asarray(offset, dtype=np.float64))
    value = np.empty(k.shape)
    near = (
        k < 8
    )  # beyond, the closed form would lose k^2 units in the last place; the series has none to lose
    x = k[near]
    value[near] = 3 - _square_log(x + 1) + 2 * _square_log(x) - _square_log(x - 1)
    far = k[~near]
    series = -2 * np.log(far)
    for m in range(1, 8):
        series += 2 / (m * (2 * m + 1) * (2 * m + 2)) * far ** (-2 * m)
    value[~near] = series
    return value


def _square_log(x: Array) -> Array:
    return np.asarray(x**2 * np.log(np.where(x == 0, 1.0, np.abs(x))))


def _closed(x: Array, y: Array, dx: float, dy: float) -> Array:
    """Eq. A.16 by F(x, y) = x asinh(y/x) + y asinh(x/y), which keeps the digits that the logarithms lose."""
    right, left, top, bottom = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
    return _corner(right, top) - _corner(left, top) - _corner(right, bottom) + _corner(left, bottom)


def _corner(x: Array, y: Array) -> Array:
    a, b = np.abs(x), np.abs(y)
    with np.errstate(divide="ignore", invalid="ignore"):
        value = np.where(a > 0, a * np.arcsinh(b / a), 0) + np.where(b > 0, b * np.arcsinh(a / b), 0)
    return np.asarray(np.sign(x) * np.sign(y) * value)


def _across(x: Array, y: Array, dx: float, dy: float) -> Array:
    """Gauss's rule across the shorter side of the integral along the longer one."""
    value = np.zeros(x.shape)
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        value += weight * _along(x - dx / 2, x + dx / 2, y + node * dy / 2)
    return value * (dy / 2)


def _along(start: Array, stop: Array, y: Array) -> Array:
    """Return the integral of 1/hypot(x, y) from `start` to `stop` without cancellation; y != 0 or start > 0."""
    # Seen from the nearer end the integral is log1p of a ratio of positive numbers; an interval that
    # holds zero is two such integrals.
    inner, r_inner, r_outer = np.abs(start), np.hypot(start, y), np.hypot(stop, y)
    same_side = start >= 0
    span = stop - start
    ratio = (span + span * (stop + start) / (r_outer + r_inner)) / (inner + r_inner)
    apart = np.arcsinh(inner / np.where(same_side, 1, np.abs(y))) + np.arcsinh(
        stop / np.where(same_side, 1, np.abs(y))
    )
    return np.where(same_side, np.log1p(ratio), apart)


def _expansion(x: Array, y: Array, dx: float, dy: float) -> Array:
    """Taylor's series of 1/r about the centre, integrated over the cell, to fourth order."""
    x2, y2 = x * x, y * y
    r2 = x2 + y2
    a, b = dx * dx / r2, dy * dy / r2
    c, s = x2 / r2, y2 / r2
    second = (a * (3 * c - 1) + b * (3 * s - 1)) / 24
    fourth = (
        a * a * (105 * c * c - 90 * c + 9) / 1920
        + a * b * (105 * c * s - 12) / 576
        + b * b * (105 * s * s - 90 * s + 9) / 1920
    )
    return dx * dy / np.sqrt(r2) * (1 + second + fourth)
