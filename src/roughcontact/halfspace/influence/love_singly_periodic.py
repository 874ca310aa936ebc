"""Love's integral over cells that repeat themselves along one axis: the sum over a row of images, in closed form."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid
from roughcontact.halfspace.influence.love import love
from roughcontact.halfspace.influence.tables import Love
from roughcontact.validation import Array, Mask

__all__ = ["SinglyPeriodicLove", "repeated_love"]

Offsets = npt.NDArray[np.intp]
Form = Callable[[Array, Array, tuple[float, float], float], Array]

# In periods. What lies nearer than NEAR to the row is divided into pieces of CELL at most, whose images are summed one
# by one up to IMAGES on either side, and beyond by powers of the distance over theirs. What lies further away is done
# in one piece, however long, by waves along the row, of which WAVES are left. Each form is good to 1e-14 where it is
# used (tests/halfspace/operators/test_singly_periodic.py).
IMAGES = 4
NEAR = 0.5
CELL = 0.25
WAVES = 12
POWERS = 12  # even ones, from zero up
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(POWERS)
# The trapezoidal rule for integrals of exp(-z cosh t) over t, z >= 2 pi NEAR: its error is exp(-pi^2/STEP), and what it
# leaves out exp(-pi cosh 3.4), some 1e-21 both.
STEP = 0.2
_COSH = np.cosh(STEP * np.arange(18))
_SHARES = STEP * np.where(np.arange(18) == 0, 0.5, 1.0)


@dataclass(frozen=True, slots=True)
class SinglyPeriodicLove:
    """A uniformly loaded cell and its images along one axis, on a half-space of reduced modulus `modulus` [Pa]."""

    grid: Grid
    modulus: float
    reference: float

    @property
    def axis(self) -> int:
        """The axis along which the load repeats itself."""
        return self.grid.periodic.index(True)

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]; along the periodic axis it is even about half the period."""
        along = self.axis
        period = self.grid.shape[along]
        half = min(shape[along], period // 2 + 1)
        values = self._values(np.arange(shape[1 - along]), np.arange(half)[:, None])  # rows along the period
        steps = np.arange(shape[along])
        values = values[np.minimum(steps, period - steps)]
        return np.ascontiguousarray(values if along == 0 else values.T)

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]."""
        offsets = np.broadcast_arrays(rows, columns)
        across, along = offsets[1 - self.axis], offsets[self.axis]
        return self._values(across.ravel(), along.ravel()).reshape(across.shape)

    def _values(self, across: Offsets, along: Offsets) -> Array:
        step_along, step_across = self.grid.spacing[self.axis], self.grid.spacing[1 - self.axis]
        value = repeated_love(
            across * step_across,
            along * step_along,
            (step_across, step_along),
            self.grid.lengths[self.axis],
            self.reference,
        )
        value /= math.pi * self.modulus
        return value

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return E* q/2 [Pa/m]: that of the half-space as if it repeated itself along both axes."""
        return Love(self.grid.spacing, self.modulus).inverse(shape)

    def coarsened(self, grid: Grid) -> SinglyPeriodicLove | None:
        """Return the same body on the cells of `grid`; None in a window, whose cells need not divide the period."""
        return SinglyPeriodicLove(grid, self.modulus, self.reference) if any(grid.periodic) else None


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
        Distance from the row at which its mean displacement along the row vanishes [m].

    Notes
    -----
    The sum of 1/r over the row has no limit; the constant that is taken from it follows the load. With
    ``reference_length = 2 exp(-gamma) period``, about 1.12 periods, it is ``1/(|m| period)`` of the m-th image.
    """
    x, y = np.abs(np.asarray(across, float)), np.asarray(along, float)
    x, y = (x, y) if x.ndim and y.ndim else np.broadcast_arrays(np.atleast_1d(x), np.atleast_1d(y))
    value = np.empty(np.broadcast_shapes(x.shape, y.shape))
    for where, form in _forms(x, cell[0], period):
        if x.shape == value.shape:  # a list of offsets
            value[where] = form(x[where], np.broadcast_to(y, value.shape)[where], cell, period)
        else:  # a table: x along its last axis
            value[..., where] = form(x[where], y, cell, period)
    # The page's constant is replaced by the one that is asked for.
    value += cell[0] * cell[1] * 2 / period * (np.euler_gamma + math.log(reference_length / (2 * period)))
    return value


def _forms(x: Array, side: float, period: float) -> Iterator[tuple[Mask, Form]]:
    """Yield offsets across the row, and the form that serves a cell of a side there."""
    near = x - side / 2 < NEAR * period * (1 - 1e-9)
    if not near.all():
        yield ~near, _waves
    if side <= CELL * period:
        if near.any():
            yield near, _pieces
        return
    for offset in np.unique(x[near]):  # of offsets of whole cells, three at most
        yield x == offset, _long_cell


def _long_cell(x: Array, y: Array, cell: tuple[float, float], period: float) -> Array:
    """Return the integral over a cell at one offset x, of which part is near the row: waves for what is not."""
    start, stop, reach = x[0] - cell[0] / 2, x[0] + cell[0] / 2, NEAR * period
    value = np.zeros(np.broadcast_shapes(x.shape, y.shape))
    for inner, outer in ((max(reach, start), stop), (max(reach, -stop), -start)):  # on either side of the row
        if outer > inner:
            value += _waves(np.full_like(x, (inner + outer) / 2), y, (outer - inner, cell[1]), period)
    start, stop = max(start, -reach), min(stop, reach)
    for shift, side in _equal_parts(stop - start, period):
        piece = np.full_like(x, abs((start + stop) / 2 + shift))
        value += _pieces(piece, y, (side, cell[1]), period)
    return value


def _pieces(x: Array, y: Array, cell: tuple[float, float], period: float) -> Array:
    """Return the integral over a cell that is short across the row, by pieces along it."""
    value = np.zeros(np.broadcast_shapes(x.shape, y.shape))
    for shift, side in _equal_parts(cell[1], period):
        offset = y - shift
        value += _images(x, offset - period * np.round(offset / period), (cell[0], side), period)
    return value


def _equal_parts(side: float, period: float) -> list[tuple[float, float]]:
    """Return the centres of short parts of a side, counted from its own, and their lengths."""
    count = max(1, math.ceil(side / (CELL * period) - 1e-9))
    return [(side / count * (part - (count - 1) / 2), side / count) for part in range(count)]


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
    from scipy.special import factorial, zeta

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
    """Return -2 ln(x), the mean along the row, and the waves along it, each of which decays as K0.

    K0(z) is the integral of exp(-z cosh t) over t > 0, and so its integral over any side is one of exponentials.
    """
    q = 2 * math.pi / period
    value = cell[0] * cell[1] / period * _mean_log(x / period, cell[0] / period)
    value = value - 2 * cell[0] * cell[1] / period * (np.euler_gamma - math.log(2.0))
    for n in range(1, WAVES + 1):
        decay = np.zeros(x.shape)
        for cosh, share in zip(_COSH, _SHARES, strict=True):
            rate = n * q * cosh
            side = -math.expm1(-rate * cell[0]) / rate
            decay += share * side * np.exp(-rate * (x - cell[0] / 2))
        width = cell[1] * np.sinc(n * cell[1] / period)
        value = value + 4 / period * width * decay * np.cos(n * q * y)
    return np.asarray(value)


def _mean_log(x: Array, side: float) -> Array:
    """Return the mean of ``-2 ln(x)`` over a side that does not reach beyond zero."""
    from scipy.special import xlog1py

    part = side / (2 * x)
    return np.asarray(2 - 2 * np.log(x) - (xlog1py(1 + part, part) - xlog1py(1 - part, -part)) / part)
