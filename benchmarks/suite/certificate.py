"""The judge: every program's answer is certified by products that belong to none of them.

Displacements come from a whole-grid FFT of NumPy with a kernel of its own, stiffnesses from a full matrix; nothing of
roughcontact is used.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

__all__ = ["Certificate", "Judge", "Punch"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

EPS = float(np.finfo(np.float64).eps)
IMAGES = 32  # of a cell on either side that are summed one by one
ROWS = 256  # of a kernel at once, in the longer type
KERNEL = 1e-11  # of the largest: errors of a kernel; what is left of the tail of a row of images is 4e-12


@dataclass(frozen=True, slots=True)
class Certificate:
    """What the judge found about a pressure."""

    residual: (
        float  # largest of |gap| under pressure and of penetration elsewhere, over the largest |displacement|
    )
    force_error: float  # relative
    cells: int  # in contact
    depth: float  # [m], since first touch

    @property
    def error(self) -> float:
        """The number that has to stay below the tolerance."""
        return max(self.residual, self.force_error)


class Punch(NamedTuple):
    """A flat punch of a region's shape: its stiffness [N/m], and how far another one may be from it."""

    stiffness: float
    error: float


class Judge:
    """The displacement of one grid, made once and used for every program.

    `periodic` says it for both axes, or for each. With one of them the displacement of a row of loads vanishes on the
    mean at the longest distance on the grid.
    """

    def __init__(
        self,
        shape: tuple[int, int],
        spacing: tuple[float, float],
        periodic: bool | tuple[bool, bool],
        modulus: float,
    ) -> None:
        both = (periodic, periodic) if isinstance(periodic, bool) else periodic
        self._shape, self._constant_moves = shape, not all(both)
        self._cell_area = spacing[0] * spacing[1]
        self._padded = tuple(n if wraps else 2 * n for n, wraps in zip(shape, both, strict=True))
        if all(both):
            self._multiplier = _periodic_multiplier(shape, spacing) / modulus
            self._table = np.fft.irfft2(self._multiplier, s=shape)
        else:
            quadrant = _row(shape, spacing, both) if any(both) else _love(shape, spacing)
            self._table = _evenly(quadrant, self._padded) / modulus
            self._multiplier = np.fft.rfft2(self._table)

    def displacement(self, pressure: Array) -> Array:
        """Return the displacement of the surface [m]."""
        if not self._constant_moves:
            pressure = pressure - pressure.mean()  # nor shall its rounding
        spectrum = np.fft.rfft2(pressure, s=self._padded)
        ny, nx = self._shape
        return np.fft.irfft2(spectrum * self._multiplier, s=self._padded)[:ny, :nx]

    def pressure(self, displacement: Array) -> Array:
        """Return the pressure without its mean [Pa] that causes a displacement; periodic maps only."""
        stiffness = np.divide(
            1, self._multiplier, out=np.zeros_like(self._multiplier), where=self._multiplier > 0
        )
        return np.fft.irfft2(np.fft.rfft2(displacement) * stiffness, s=self._shape)

    def rounding(self, pressure: Array) -> float:
        """Return how far a displacement [m] may be rounded.

        Sixteen units in the last place of what the largest pressure does in its own cell, which a program may allow
        itself, and as much for the judge.
        """
        return float(32 * EPS * self._table[0, 0] * pressure.max())

    def certify(
        self,
        heights: Array,
        pressure: Array,
        force: float,
        *,
        depth: float | None = None,
        hardness: float = math.inf,
    ) -> Certificate:
        """Return the certificate of `pressure`, at a `depth` or at the one that makes its residual smallest."""
        contact = pressure > 0
        cells = int(contact.sum())
        if (
            pressure.shape != self._shape
            or not np.isfinite(pressure).all()
            or (pressure < 0).any()
            or (pressure > hardness).any()
            or not cells
        ):
            return Certificate(np.inf, np.inf, cells, np.nan)
        displacement = self.displacement(pressure)
        separation = np.nanmax(heights) - heights
        # Counted from a cell in contact: where much flows, displacements are far smaller than separations.
        origin = separation.flat[np.argmax(np.where(contact, displacement + separation, -np.inf))]
        level = displacement + (separation - origin)  # the gap, plus a depth that is not known
        highest = level[contact].max()  # not a number under pressure where nothing was measured
        lowest = np.nanmin(np.where(pressure < hardness, level, np.inf))
        level_of_depth = (highest + min(lowest, highest)) / 2 if depth is None else depth - origin
        violation = max(highest - level_of_depth, level_of_depth - lowest)
        residual = 0.0 if violation <= 0 else violation / np.abs(displacement).max()
        carried = pressure.sum() * self._cell_area
        found = level_of_depth + origin
        return Certificate(float(residual), float(abs(carried / force - 1)), cells, float(found))

    def punch(self, region: Mask, tolerance: float) -> Punch:
        """Return the stiffness of a region from its full matrix.

        The error is a bound on the difference to a stiffness whose displacement is one to a `tolerance`.
        """
        if not region.any() or (region.all() and not self._constant_moves):
            return Punch(math.inf if region.any() else 0.0, 0.0)
        y, x = np.nonzero(region)
        matrix = self._table[y[:, None] - y, x[:, None] - x]  # a negative offset counts from the end
        pressure = np.linalg.solve(matrix, np.ones(len(y)))
        residual = float(np.abs(1 - matrix @ pressure).max())
        size = float(np.abs(pressure).sum())
        # k = 1.t with A t = 1: an error e of the displacement makes e.t of it, one E of the matrix t.E t.
        error = (tolerance + residual) * size + KERNEL * float(np.abs(matrix).max()) * size**2
        return Punch(float(pressure.sum()) * self._cell_area, error * self._cell_area)

    def own(self) -> float:
        """Return the displacement of a cell per unit pressure on itself [m/Pa]."""
        return float(self._table[0, 0])


def _periodic_multiplier(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Return 2/q, the displacement of a pressure wave at E* = 1; zero for the mean."""
    qy = 2 * np.pi * np.fft.fftfreq(shape[0], spacing[0])
    qx = 2 * np.pi * np.fft.rfftfreq(shape[1], spacing[1])
    q = np.hypot(qy[:, None], qx)
    return np.divide(2, q, out=np.zeros_like(q), where=q > 0)


def _evenly(quadrant: Array, shape: tuple[int, ...]) -> Array:
    """Return the table of all offsets, even along each axis, with those that do not occur left out."""
    steps = [np.minimum(np.arange(n), n - np.arange(n)) for n in shape]
    table = np.zeros(shape)
    there = [s < n for s, n in zip(steps, quadrant.shape, strict=True)]
    inside = np.ix_(*there)
    table[inside] = quadrant[np.ix_(*(s[t] for s, t in zip(steps, there, strict=True)))]
    return table


def _love(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Return the displacement under a unit pressure on a cell at E* = 1 (Love 1929; Johnson, eq. 3.25).

    The four corner terms cancel to the square of the distance in cells; the longer floating-point type keeps
    what double precision would lose.
    """
    (ny, nx), (dy, dx) = shape, spacing
    x = (np.arange(nx + 1, dtype=np.longdouble) - 0.5) * dx
    cells = np.empty(shape)
    for first in range(0, ny, ROWS):
        rows = np.arange(first, min(first + ROWS, ny) + 1, dtype=np.longdouble)
        y = ((rows - 0.5) * dy)[:, None]
        r = np.hypot(y, x)
        corner = y * np.log(x + r) + x * np.log(y + r)
        cell = corner[1:, 1:] - corner[:-1, 1:] - corner[1:, :-1] + corner[:-1, :-1]
        cells[first : first + ROWS] = cell / np.longdouble(np.pi)
    return cells


def _row(shape: tuple[int, int], spacing: tuple[float, float], periodic: tuple[bool, bool]) -> Array:
    """Return the displacement under a unit pressure on a cell and all its images along one axis, at E* = 1."""
    if periodic[1]:
        return _row(shape[::-1], spacing[::-1], (True, False)).T
    (n, across), (dy, dx) = shape, spacing
    period, offsets = n * dy, np.arange(n // 2 + 1)
    lone = _love((IMAGES * n + len(offsets), across), spacing)
    images = lone[offsets] + sum(lone[m * n + offsets] + lone[m * n - offsets] for m in range(1, IMAGES + 1))
    # The others are points, taken at Gauss's nodes of the cell.
    nodes, weights = np.polynomial.legendre.leggauss(4)
    tail = np.zeros(images.shape)
    for a, wa in zip(nodes, weights, strict=True):
        for b, wb in zip(nodes, weights, strict=True):
            y, x = (offsets[:, None] + a / 2) * dy, (np.arange(across) + b / 2) * dx
            tail += wa * wb / 4 * (_beyond(x, y, period) + _beyond(x, -y, period))
    reference = math.hypot(period / 2, across * dx)
    return images + dy * dx / math.pi * (tail + 2 / period * math.log(reference))


def _beyond(x: Array, y: Array, period: float) -> Array:
    """Return the sum of 1/r of the images beyond the last, but for a constant that has no limit.

    Euler and Maclaurin's sum from half a period before the next one.
    """
    y = y + (IMAGES + 0.5) * period
    r = np.hypot(x, y)
    integral = -np.log(y + r) / period
    first, third = -y / r**3, y * (9 * x**2 - 6 * y**2) / r**7
    return np.asarray(integral + period / 24 * first - 7 * period**3 / 5760 * third)
