"""Love's integral over cells that repeat themselves along one axis: the sum over a row of images, in closed form."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import numpy.typing as npt
from scipy.special import factorial, k0, zeta

from roughcontact.halfspace.kernels import love

__all__ = ["repeated_love"]

Array = npt.NDArray[np.float64]

# In periods. A row of images is summed one by one up to IMAGES on either side, and beyond by powers of the distance
# over theirs; further than NEAR from the row by waves along it, of which WAVES are left. Cells larger than CELL are
# divided. Each is good to 1e-14 where it is used (tests/halfspace/test_half_periodic.py).
IMAGES = 4
NEAR = 0.5
CELL = 0.25
WAVES = 12
POWERS = 12  # even ones, from zero up
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(POWERS)


def repeated_love(
    across: npt.ArrayLike,
    along: npt.ArrayLike,
    cell: tuple[float, float],
    period: float,
    reference_length: float,
) -> Array:
    """Return the integral of the Green's function of a row of point loads over a cell [m].

    A pressure p on a cell and all its images lifts the surface at the offset by ``u = repeated_love(...) p/(pi E*)``.
    Far from the row it is that of a line load, ``(2/period) ln(reference_length/|across|)`` times the cell's area.

    Parameters
    ----------
    across, along : array
        Offsets from the centre of the cell, across the row and along it [m]; broadcast against each other.
    cell : tuple of float
        Sides of the cell across the row and along it [m].
    period : float
        Distance of the images [m], at least the cell's side along the row.
    reference_length : float
        Distance from the row at which its displacement vanishes on the mean [m].

    Notes
    -----
    The sum of 1/r over the row has no limit; the constant that is taken from it follows the load. With
    ``reference_length = 2 exp(-gamma) period``, about 1.12 periods, it is ``1/(|m| period)`` of the m-th image.
    """
    x, y = np.abs(np.asarray(across, float)), np.asarray(along, float)
    x, y = (x, y) if x.ndim and y.ndim else np.broadcast_arrays(np.atleast_1d(x), np.atleast_1d(y))
    parts = tuple(math.ceil(side / (CELL * period) - 1e-9) for side in cell)
    sides = (cell[0] / parts[0], cell[1] / parts[1])
    value = np.zeros(np.broadcast_shapes(x.shape, y.shape))
    for row in range(parts[0]):
        for place in range(parts[1]):
            shift = [side * (i - (n - 1) / 2) for side, i, n in zip(sides, (row, place), parts, strict=True)]
            value += _small(np.abs(x - shift[0]), y - shift[1], sides, period)
    # The page's constant is replaced by the one that is asked for.
    value += cell[0] * cell[1] * 2 / period * (np.euler_gamma + math.log(reference_length / (2 * period)))
    return value


def _small(x: Array, y: Array, cell: tuple[float, float], period: float) -> Array:
    """Return the integral over a cell that is small against the period, by the form that serves at its distance."""
    y = y - period * np.round(y / period)
    near = x <= NEAR * period
    value = np.empty(np.broadcast_shapes(x.shape, y.shape))
    for where, form in ((near, _images), (~near, _waves)):
        if not where.any():
            continue
        if x.shape == value.shape:  # a list of offsets
            value[where] = form(x[where], np.broadcast_to(y, value.shape)[where], cell, period)
        else:  # a table: x along its last axis
            value[..., where] = form(x[where], y, cell, period)
    return value


def _images(x: Array, y: Array, cell: tuple[float, float], period: float) -> Array:
    """Love's integral of the nearest images, and the rest of the row by powers of r over its distance.

    1/r(m) + 1/r(-m) - 2/(m period) = 2 sum_l r^l P_l(y/r)/(m period)^(l+1) over even l >= 2, and the sum over m is
    Hurwitz's zeta function.
    """
    value = np.asarray(love(x, y, *cell))
    for m in range(1, IMAGES):
        value = value + love(x, y + m * period, *cell) + love(x, y - m * period, *cell)
        value -= 2 * cell[0] * cell[1] / (m * period)
    # r^l P_l(y/r) is a polynomial in x^2 and y^2, the integral of whose terms over a cell is a product.
    inner = np.tensordot(_rest_of_row(), _mean_powers(y, cell[1], period), 1)
    area = cell[0] * cell[1] / period
    for x_power, y_polynomial in zip(_mean_powers(x, cell[0], period), inner, strict=True):
        value = value + area * x_power * y_polynomial
    return value


@cache
def _rest_of_row() -> Array:
    """Return the coefficients of ``x^(2a) y^(2b)`` in the rest of the row, lengths in periods.

    With l = 2(a + b), r^l P_l(y/r) = sum_a (-1/4)^a l!/((a!)^2 (l - 2a)!) x^(2a) y^(l - 2a).
    """
    a = np.arange(POWERS)
    b = a[:, None].T
    a = a[:, None]
    degree = 2 * (a + b)
    legendre = (-0.25) ** a * factorial(degree) / (factorial(a) ** 2 * factorial(2 * b))
    wanted = (degree > 0) & (a + b < POWERS)
    return np.where(wanted, 2 * legendre * zeta(np.maximum(degree, 1) + 1, IMAGES), 0.0)


def _mean_powers(x: Array, side: float, period: float) -> Array:
    """Return the means of even powers of x/period over a cell's side, exact by Gauss's rule."""
    places = (x[..., None] + _NODES * side / 2) / period
    square, power = places**2, np.ones(places.shape)
    means = np.empty((POWERS, *x.shape))
    for a in range(POWERS):
        means[a] = power @ (_WEIGHTS / 2)
        power *= square
    return means


def _waves(x: Array, y: Array, cell: tuple[float, float], period: float) -> Array:
    """Return -2 ln(x) on the mean along the row, and the waves along it, each of which decays as K0."""
    q = 2 * math.pi / period
    value = cell[1] / period * (_log_strip(x / period, cell[0] / period) * period)
    value = value - 2 * cell[0] * cell[1] / period * (np.euler_gamma - math.log(2.0))
    for n in range(1, WAVES + 1):
        decay = np.zeros(x.shape)
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):
            decay += weight / 2 * k0(n * q * (x + node * cell[0] / 2))
        width = cell[1] * np.sinc(n * cell[1] / period)
        value = value + 4 / period * cell[0] * width * decay * np.cos(n * q * y)
    return np.asarray(value)


def _log_strip(x: Array, side: float) -> Array:
    """Return the integral of ``-2 ln|x|`` over a side that does not reach zero, by Taylor's series in side/(2 x)."""
    ratio = (side / (2 * x)) ** 2
    series = sum(ratio**m / (2 * m * (2 * m + 1)) for m in range(1, 16))
    return np.asarray(-2 * side * (np.log(x) - series))
