"""Periodic bodies with a factor for each wave of pressure, and a material that passes by."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.halfspace.operators.operator import Capabilities, Operator
from roughcontact.validation import Array
from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["WaveOperator", "Waves", "passing", "wave_vectors"]

Waves: TypeAlias = npt.NDArray[np.complex128]
"""A factor for each wave of a real field, shape ``(ny, nx//2 + 1)``."""


@dataclass(frozen=True, eq=False)
class WaveOperator:
    """The map from pressure to displacement on a periodic grid by a factor for each wave; the mean moves nothing.

    It is symmetric where all factors are real.

    Parameters
    ----------
    grid : Grid
        Periodic along both axes.
    symbol : function
        Takes a grid and returns the displacement per pressure wave on it [m/Pa], zero for the mean.
    """

    grid: Grid
    symbol: Callable[[Grid], Waves]

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            semidefinite=True,
            coarsened=lambda grid: replace(self, grid=grid) if all(grid.periodic) else None,
            approximate_inverse=self.approximate_inverse,
        )

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @cached_property
    def factors(self) -> Waves:
        """Displacement per pressure wave [m/Pa]."""
        return self.symbol(self.grid)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        return self.filtered(pressure, self.factors)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return the pressure [Pa] of a `displacement` [m]; its mean has the factor of the softest wave."""
        return self.filtered(displacement, self._inverse)

    def filtered(self, field: Array, factors: Waves) -> Array:
        """Return a field whose waves are multiplied by factors."""
        # The mean apart: what moves nothing moves nothing by rounding either.
        waves: Any = scipy.fft.rfft2(field - field.mean())
        waves[0, 0] = field.mean() * field.size
        return np.asarray(scipy.fft.irfft2(factors * waves, s=self.grid.shape))

    def as_matrix(self, cells: npt.NDArray[np.intp] | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        some = np.arange(self.grid.size) if cells is None else cells
        (ny, nx), (rows, columns) = self.grid.shape, np.divmod(some, self.grid.shape[1])
        return np.asarray(self._table[(rows[:, None] - rows) % ny, (columns[:, None] - columns) % nx])

    def restrict(self, window: tuple[slice, ...]) -> Operator:
        """Return the map between the cells of `window`, with no pressure outside."""
        part = self.grid.window(window)
        if part.shape == self.grid.shape:
            return self
        cells = np.arange(self.grid.size).reshape(self.grid.shape)[window].ravel()
        return DenseOperator(part, self.as_matrix(cells), positive=False)

    @cached_property
    def _table(self) -> Array:
        """The displacement of all cells per unit pressure on the first [m/Pa]."""
        return np.asarray(scipy.fft.irfft2(self.factors, s=self.grid.shape))

    @cached_property
    def _inverse(self) -> Waves:
        inverse = self.factors.copy()
        inverse[0, 0] = np.abs(inverse).max() or 1.0
        return np.asarray(1 / inverse)


def wave_vectors(grid: Grid) -> tuple[Array, Array]:
    """Return qy and qx [rad/m] of the waves of a real field, shapes ``(ny, 1)`` and ``(1, nx//2 + 1)``."""
    (ny, nx), (dy, dx) = grid.shape, grid.spacing
    qy, qx = 2 * np.pi * np.fft.fftfreq(ny, dy), 2 * np.pi * np.fft.rfftfreq(nx, dx)
    return np.asarray(qy[:, None]), np.asarray(qx[None])


def passing(material: Viscoelastic, velocity: tuple[float, float]) -> Callable[[Grid], Waves]:
    """Return the symbol 2/(abs(q) E(q.v)) of a material that passes at a velocity ``(vx, vy)`` [m/s].

    A Nyquist wave stands for both signs of its wavenumber: its factor is the mean of both.
    """
    vx, vy = velocity
    unlimited = replace(material, band=None)

    def compliance(frequency: Array) -> Waves:
        modulus = unlimited.complex_modulus(np.abs(frequency))
        return np.asarray(1 / np.where(frequency < 0, np.conj(modulus), modulus))

    def symbol(grid: Grid) -> Waves:
        (qy, qx), (ny, nx) = wave_vectors(grid), grid.shape
        q = np.sqrt(qy**2 + qx**2)
        q[0, 0] = np.inf
        answer = compliance(qx * vx + qy * vy)
        turned = compliance(qx * vx - qy * vy)  # of -qy, and conjugate of -qx
        if ny % 2 == 0:
            answer[ny // 2] = (answer + turned)[ny // 2] / 2
        if nx % 2 == 0:
            answer[:, -1] = (answer + turned.conj())[:, -1] / 2
        if ny % 2 == nx % 2 == 0:
            answer[ny // 2, -1] = answer[ny // 2, -1].real
        return np.asarray(answer * (2 / q))

    return symbol
