"""Influence functions: the displacement of every cell under a unit pressure on one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.grid import Grid
from roughcontact.halfspace.kernels import love_table, periodic_multiplier

__all__ = ["Influence", "Love", "Periodic"]

Array = npt.NDArray[np.float64]


class Influence(Protocol):
    """An even, translation-invariant influence function on cells of one size."""

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the displacement per pressure [m/Pa] at offsets of whole cells from zero up to `shape`."""
        ...

    def coarsened(self, grid: Grid) -> Influence:
        """Return the influence function of the same body on the cells of `grid`."""
        ...


@dataclass(frozen=True, slots=True)
class Love:
    """A uniformly loaded cell on a free half-space of reduced modulus `modulus` [Pa] (thesis, eq. A.15)."""

    spacing: tuple[float, ...]
    modulus: float

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        return love_table(shape, self.spacing) / (math.pi * self.modulus)

    def coarsened(self, grid: Grid) -> Love:
        """Return the same body on the cells of `grid`."""
        return Love(grid.spacing, self.modulus)


@dataclass(frozen=True, slots=True)
class Periodic:
    """Every wave of pressure on a periodic half-space answers with 2/(E* q) (Westergaard 1939).

    The mean displacement is zero, so a constant pressure moves nothing.
    """

    grid: Grid
    modulus: float

    def multiplier(self) -> Array:
        """Return the displacement per pressure wave [m/Pa], shape ``(ny//2 + 1, nx//2 + 1)``, rows from 0 up."""
        (ny, nx), (dy, dx) = self.grid.shape, self.grid.spacing
        qy = 2 * np.pi * scipy.fft.rfftfreq(ny, dy)
        qx = 2 * np.pi * scipy.fft.rfftfreq(nx, dx)
        return periodic_multiplier(np.hypot(qy[:, None], qx)) / self.modulus

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        ny, nx = self.grid.shape
        half = self.multiplier()
        full = np.concatenate([half, half[ny - half.shape[0] : 0 : -1]])
        table = scipy.fft.irfft2(full, s=(ny, nx))
        return np.ascontiguousarray(table[: shape[0], : shape[1]])

    def coarsened(self, grid: Grid) -> Periodic:
        """Return the same body on the cells of `grid`, of which a window of the period is made.

        The period stays: cells of `grid` that do not divide it are stretched until they do.
        """
        shape = tuple(
            max(1, round(length / step)) for length, step in zip(self.grid.lengths, grid.spacing, strict=True)
        )
        spacing = tuple(length / n for length, n in zip(self.grid.lengths, shape, strict=True))
        return Periodic(Grid(shape, spacing, periodic=True), self.modulus)
