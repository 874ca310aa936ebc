"""Closed forms of the half-space: the displacement under uniformly loaded rectangles and strips."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np
import numpy.typing as npt
from numpy.polynomial import Polynomial

from roughcontact.validation import Array

__all__ = ["love", "love_table", "over_cell", "strip", "table_of_cells", "wave_compliance"]


# Measured against 60-digit arithmetic (tests/halfspace/influence/test_love.py): beyond FAR longer sides the
# expansion of 1/r by multipoles, beyond NEAR shorter sides Gauss's rule across the cell, otherwise the
# closed form. Each is good to some 1e-14 where it is used.
FAR = 18.0
ORDER = 4  # pairs of multipoles: the first that is left out is 2e-3 FAR^-10 of the whole
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
    unit = max(dx, dy)
    a, b = np.abs(np.asarray(x, float)) / unit, np.abs(np.asarray(y, float)) / unit
    dx, dy = dx / unit, dy / unit
    if dy > dx:  # the shorter side is called y, and the offset along it b, from here on
        a, b, dx, dy = b, a, dy, dx
    value, close = _expansion(a, b, dx, dy)
    if close.any():
        a, b = (c[close] for c in np.broadcast_arrays(a, b))
        near = np.maximum(b, a - dx / 2) < NEAR * dy
        inner = np.empty(a.shape)
        inner[near] = over_cell(_corner, a[near], b[near], dx, dy)
        inner[~near] = _across(a[~near], b[~near], dx, dy)
        value[close] = inner
    value *= unit
    return value


def love_table(shape: tuple[int, ...], spacing: tuple[float, ...]) -> Array:
    """Return `love` for all offsets of whole cells from zero up, shape ``(ny, nx)`` [m]."""
    (ny, nx), (dy, dx) = shape, spacing
    if ny * nx <= BLOCK:
        return _small_table(ny, nx, dy, dx).copy()
    return table_of_cells(love, np.empty((ny, nx)), spacing)


def table_of_cells(influence: Callable[..., Array], table: Array, spacing: tuple[float, ...]) -> Array:
    """Fill a table, shape ``(..., ny, nx)``, with an influence at offsets of whole cells from zero up."""
    (ny, nx), (dy, dx) = table.shape[-2:], spacing
    x, y = np.arange(nx) * dx, np.arange(ny)[:, None] * dy
    rows = max(1, BLOCK // nx)
    for start in range(0, ny, rows):  # in blocks whose temporaries stay in cache
        table[..., start : start + rows, :] = influence(x, y[start : start + rows], dx, dy)
    return table


# Who presses many small surfaces has one table, and windows of large ones begin with the same; 128 kB each at most.
@lru_cache(maxsize=32)
def _small_table(ny: int, nx: int, dy: float, dx: float) -> Array:
    return love(np.arange(nx) * dx, np.arange(ny)[:, None] * dy, dx, dy)


def wave_compliance(wavenumber: npt.ArrayLike) -> Array:
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


def over_cell(corner: Callable[[Array, Array], Array], x: Array, y: Array, dx: float, dy: float) -> Array:
    """Return the integral over a cell at an offset of what has the mixed antiderivative `corner`."""
    right, left, top, bottom = x + dx / 2, x - dx / 2, y + dy / 2, y - dy / 2
    return corner(right, top) - corner(left, top) - corner(right, bottom) + corner(left, bottom)


def _corner(x: Array, y: Array) -> Array:
    """Return F(x, y) = x asinh(y/x) + y asinh(x/y) of eq. A.16, which keeps the digits that the logarithms lose."""
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


def _expansion(x: Array, y: Array, dx: float, dy: float) -> tuple[Array, npt.NDArray[np.bool_]]:
    """Return the expansion of 1/r about the centre, integrated over the cell, and where it is not good enough."""
    x2, y2 = x * x, y * y
    r2 = np.asarray(x2 + y2)
    close = r2 < (FAR * dx) ** 2
    np.maximum(r2, dx * dx, out=r2)
    c = x2 / r2
    value: Array | None = None
    for polynomial in reversed(_multipoles(dx, dy)):
        term = np.full(r2.shape, polynomial[-1])
        for coefficient in polynomial[-2::-1]:
            term *= c
            term += coefficient
        if value is not None:
            value /= r2
            term += value
        value = term
    assert value is not None
    value *= dx * dy
    value /= np.sqrt(r2)
    return value, close


@lru_cache(maxsize=64)
def _multipoles(dx: float, dy: float) -> tuple[tuple[float, ...], ...]:
    """Return the polynomials ``P_m(c)`` of ``mean(1/|r - r'|) = sum P_m(c) / r^(2m + 1)`` over a cell, c = x^2/r^2.

    With n = r/r the summands are means of ``r'^2m Legendre_2m(n . r'/r')``, polynomials in n_x^2 = c and n_y^2 = 1 - c.
    """

    def moment(i: int, j: int) -> float:
        """Return the mean of ``x^2i y^2j`` over the cell."""
        return (dx / 2) ** (2 * i) / (2 * i + 1) * (dy / 2) ** (2 * j) / (2 * j + 1)

    found = []
    along, across = Polynomial([0.0, 1.0]), Polynomial([1.0, -1.0])
    for m in range(ORDER + 1):
        legendre = np.polynomial.legendre.leg2poly([0.0] * (2 * m) + [1.0])
        total = Polynomial([0.0] * (m + 1))
        for k in range(m + 1):  # of the term (n . r')^2k r'^2(m - k)
            for i in range(k + 1):
                mean = sum(math.comb(m - k, j) * moment(i + j, m - i - j) for j in range(m - k + 1))
                share = math.comb(2 * k, 2 * i) * mean * legendre[2 * k]
                total = total + share * along**i * across ** (k - i)
        found.append(tuple(float(t) for t in total.coef[: m + 1]))
    return tuple(found)
