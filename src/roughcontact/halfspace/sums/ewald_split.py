"""Ewald's split of an influence function into a short-range part, and a long-range part that is smooth.

``1/r = erfc(a r)/r + erf(a r)/r`` with the screening parameter a (Ewald 1921): the first part is gone at a few lengths
1/a, the second has no waves much shorter than 1/a, so that nodes every few cells hold it.

Each split has ``short_range(cells)``, that part at offsets from zero up to `cells` along each axis, and
``long_range(step, lengths)``, the transfer function of the other on nodes `step` cells apart, for waves over `lengths`
nodes: shape ``(lengths[0] // 2 + 1, lengths[1] // 2 + 1)``, rows and columns from 0 up.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.influence.tables import Love, Periodic, table_of_waves, wavenumbers
from roughcontact.transforms import even_multiplier
from roughcontact.validation import Array

__all__ = ["SCREENING", "FreeSplit", "PeriodicSplit"]

Offsets = npt.NDArray[np.intp]
Pair = tuple[int, int]

SCREENING = 3.5  # Ewald screening parameter, times the reach of the short-range part: erfc(3.5) is 7e-7
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(3)


@dataclass(frozen=True, slots=True)
class FreeSplit:
    """The influence of the free half-space [m/Pa], whose short-range part ends at `reach` [m]."""

    kernel: Love
    reach: float

    def short_range(self, cells: Pair) -> Array:
        """Return the short-range part [m/Pa]."""
        rows, columns = _offsets(cells)
        short = self.kernel.at(rows, columns) - self._long_range(rows, columns)
        dy, dx = self.kernel.spacing
        return np.where(np.hypot(rows * dy, columns * dx) <= self.reach, short, 0.0)

    def long_range(self, step: Pair, lengths: Pair) -> Array:
        """Return the transfer function of the long-range part [m/Pa], which is cut off half a length away."""
        rows, columns = _offsets((lengths[0] // 2, lengths[1] // 2))
        rows, columns = rows * step[0], columns * step[1]
        table = self.kernel.at(rows, columns)
        # Within the reach the two differ.
        a, b = (int(self.reach / (n * d)) + 1 for n, d in zip(step, self.kernel.spacing, strict=True))
        table[:a, :b] = self._long_range(rows[:a], columns[:, :b])
        return even_multiplier(table, lengths)

    def _long_range(self, rows: Offsets, columns: Offsets) -> Array:
        """Return the mean of the long-range part over a cell, by Gauss's rule."""
        from scipy.special import erf

        (dy, dx), width = self.kernel.spacing, self.reach / SCREENING
        mean = np.zeros(np.broadcast_shapes(rows.shape, columns.shape))
        for a, first in zip(_NODES / 2, _WEIGHTS / 2, strict=True):
            for b, second in zip(_NODES / 2, _WEIGHTS / 2, strict=True):
                r = np.hypot((rows + a) * dy, (columns + b) * dx)
                far = np.divide(
                    erf(r / width), r, out=np.full(r.shape, 2 / (math.sqrt(math.pi) * width)), where=r > 0
                )
                mean += first * second * far
        return np.asarray(mean * (dy * dx / (math.pi * self.kernel.modulus)))


@dataclass(frozen=True, slots=True)
class PeriodicSplit:
    """The influence of the periodic half-space [m/Pa], whose short-range part all but ends at `reach` [m]."""

    kernel: Periodic
    reach: float

    def short_range(self, cells: Pair) -> Array:
        """Return the short-range part [m/Pa]."""
        from scipy.special import erf

        near = self.kernel.transfer_function() * erf(self._phase)
        near[0, 0] = self._mean
        return table_of_waves(near, self.kernel.grid.shape, (cells[0] + 1, cells[1] + 1))

    def long_range(self, step: Pair, lengths: Pair) -> Array:
        """Return the transfer function of the long-range part [m/Pa]; the nodes share the period."""
        from scipy.special import erfc

        far = self.kernel.transfer_function() * erfc(self._phase)
        far[0, 0] = -self._mean
        ny, nx = (n // 2 + 1 for n in lengths)
        return far[:ny, :nx] / (step[0] * step[1])

    @property
    def _phase(self) -> Array:
        grid = self.kernel.grid
        return wavenumbers(grid.shape, grid.spacing) * (self.reach / SCREENING / 2)

    @property
    def _mean(self) -> float:
        """Displacement under a constant pressure by the short-range part; the long-range part takes it back."""
        return 2 * self.reach / SCREENING / (math.sqrt(math.pi) * self.kernel.modulus)


def _offsets(cells: Pair) -> tuple[Offsets, Offsets]:
    return np.arange(cells[0] + 1)[:, None], np.arange(cells[1] + 1)[None]
