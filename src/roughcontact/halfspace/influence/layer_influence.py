"""Influence functions of a layer: that of a half-space of its material, and the correction for the base."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid
from roughcontact.halfspace.influence.layer_bases import Base
from roughcontact.halfspace.influence.layer_kernel import LayerKernel, layer_kernel
from roughcontact.halfspace.influence.love import love, love_table, wave_compliance
from roughcontact.halfspace.influence.tables import Love, table_of_waves, wavenumbers
from roughcontact.validation import Array

__all__ = ["LayerCells", "LayerWaves", "Stack", "kernel_for"]

Offsets = npt.NDArray[np.intp]

# Nodes of Gauss's rule along an edge that is no longer than twice its distance from what is singular, and along one
# that is FAR_AWAY lengths from it: both good to 1e-15.
POINTS = 20
FEW_POINTS = 6
FAR_AWAY = 8


@dataclass(frozen=True, slots=True)
class Stack:
    """A layer, its base, and a half-space that is pressed against it.

    Parameters
    ----------
    modulus : float
        Reduced modulus E* of the layer [Pa].
    thickness : float
        Of the layer [m].
    base : Base
        What it lies on.
    partner_compliance : float
        1/E* of the other body [1/Pa]; 0 if it is rigid.
    """

    modulus: float
    thickness: float
    base: Base
    partner_compliance: float

    @property
    def mean(self) -> float:
        """Displacement under a constant pressure [m/Pa]; zero where an endless body would have none."""
        return 2 * self.base.slope * self.thickness / self.modulus

    def answer(self, wavenumber: Array) -> Array:
        """Return displacement per pressure wave times q/2 [1/Pa]: 1/E* of a half-space, and what takes its place."""
        return np.asarray(
            self.base.ratio(wavenumber * self.thickness) / self.modulus + self.partner_compliance
        )

    def inverse(self, shape: tuple[int, int], spacing: tuple[float, ...]) -> Array:
        """Return the pressure per displacement wave [Pa/m] on a box of `shape` cells, rows and columns from 0."""
        half_wavenumber = Love(spacing, 1.0).inverse(shape)  # at the mean, that of half the longest wave
        return np.asarray(half_wavenumber / self.answer(2 * half_wavenumber))


@dataclass(frozen=True, slots=True, eq=False)
class LayerCells:
    """A uniformly loaded cell on an endless layer: Love's integral, and what the base takes from it or adds."""

    spacing: tuple[float, ...]
    stack: Stack
    kernel: LayerKernel
    modulus: ClassVar[None] = None

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        dy, dx = self.spacing
        down = self._edges(shape, (dy, dx))  # right edges of the cells, along y
        across = self._edges(shape[::-1], (dx, dy)).T  # their upper edges
        change = np.diff(down, axis=1, prepend=-down[:, :1]) + np.diff(across, axis=0, prepend=-across[:1])
        return self._scaled(love_table(shape, self.spacing), change)

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]."""
        dy, dx = self.spacing
        y, x = np.broadcast_arrays(np.abs(rows) * dy, np.abs(columns) * dx)
        change = self._edge(x + dx / 2, y, dy, POINTS) - self._edge(x - dx / 2, y, dy, POINTS)
        change += self._edge(y + dy / 2, x, dx, POINTS) - self._edge(y - dy / 2, x, dx, POINTS)
        return self._scaled(love(x, y, dx, dy), change)

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return the pressure per displacement wave [Pa/m]: that of the layer as if it repeated itself."""
        return self.stack.inverse(shape, self.spacing)

    def coarsened(self, grid: Grid) -> LayerCells:
        """Return the same body on the cells of `grid`."""
        return LayerCells(grid.spacing, self.stack, kernel_for(grid, self.stack, self.kernel))

    def _scaled(self, half_space: Array, change: Array) -> Array:
        half_space *= (1 / self.stack.modulus + self.stack.partner_compliance) / math.pi
        half_space += change / (math.pi * self.stack.modulus)
        return half_space

    def _edges(self, shape: tuple[int, ...], sides: tuple[float, float]) -> Array:
        """Return the flux through the edges at half steps of the second side, each along one step of the first."""
        along = sides[0] * np.arange(shape[0], dtype=np.float64)[:, None]
        distance = sides[1] * (np.arange(shape[1], dtype=np.float64) + 0.5)
        flux = np.empty(shape)
        near = FAR_AWAY * max(sides)
        rows, columns = (1 + int(near / side) for side in sides)
        step = max(1, 2**16 // shape[1])
        for start in range(0, shape[0], step):
            part = slice(start, start + step)
            flux[part] = self._edge(distance, along[part], sides[0], FEW_POINTS)
        flux[:rows, :columns] = self._edge(distance[:columns], along[:rows], sides[0], POINTS)
        return flux

    def _edge(self, distance: Array, along: Array, length: float, points: int) -> Array:
        """Return the flux of W through edges of a `length` at a `distance`, their middles `along` from its foot [m]."""
        thickness = self.stack.thickness
        # No edge comes closer to the load than half a cell, nor what is singular closer than two thicknesses.
        shortest = math.hypot(min(self.spacing), 4 * thickness)
        parts = math.ceil(length / shortest - 1e-9)
        value = np.zeros(np.broadcast_shapes(distance.shape, along.shape))
        for part in range(parts):
            middle = along + length / parts * (part - (parts - 1) / 2)
            for node, weight in zip(*np.polynomial.legendre.leggauss(points), strict=True):
                y = middle + node * length / parts / 2
                value += weight * self.kernel(np.hypot(distance, y) / thickness)
        return value * (distance * length / (2 * parts * thickness))


@dataclass(frozen=True, slots=True, eq=False)
class LayerWaves:
    """Every wave of pressure on a periodic layer answers by itself, the constant one too."""

    grid: Grid
    stack: Stack
    modulus: ClassVar[None] = None

    def transfer_function(self) -> Array:
        """Return the displacement per pressure wave [m/Pa], shape ``(ny//2 + 1, nx//2 + 1)``, rows from 0 up."""
        q = wavenumbers(self.grid.shape, self.grid.spacing)
        q[0, 0] = 1.0
        transfer = wave_compliance(q) * self.stack.answer(q)
        transfer[0, 0] = self.stack.mean
        return np.asarray(transfer)

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        return table_of_waves(self.transfer_function(), self.grid.shape, shape)

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]."""
        a, b = np.abs(rows), np.abs(columns)
        return np.asarray(self.table((int(a.max(initial=0)) + 1, int(b.max(initial=0)) + 1))[a, b])

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return the pressure per displacement wave [Pa/m]."""
        return self.stack.inverse(shape, self.grid.spacing)

    def coarsened(self, grid: Grid) -> LayerWaves | None:
        """Return the same body on the cells of `grid`; None in a window, whose cells need not divide the period."""
        return LayerWaves(grid, self.stack) if all(grid.periodic) else None


def kernel_for(grid: Grid, stack: Stack, known: LayerKernel | None = None) -> LayerKernel:
    """Return a kernel that reaches across the grid; the `known` one if it does."""
    reach = math.hypot(*grid.lengths) / stack.thickness
    if known is not None and known.edges[-1] >= reach:
        return known
    return layer_kernel(stack.base.deviation, 2 * reach)  # coarser grids may be longer
