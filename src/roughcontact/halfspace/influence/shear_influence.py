"""Influence functions of tangential traction: how a cell's traction moves every cell sideways."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid
from roughcontact.halfspace.influence.cerruti import cerruti, cerruti_table
from roughcontact.halfspace.influence.tables import Tables, spans, wavenumbers
from roughcontact.validation import Array

__all__ = ["Cerruti", "Influences", "ShearCompliance", "ShearWaves", "TensorTables"]

Offsets = npt.NDArray[np.intp]
Component = Callable[[Offsets, Offsets], Array]


@dataclass(frozen=True, slots=True)
class ShearCompliance:
    """What two bodies yield to waves of tangential traction: ``2/q`` times these, per wave of wavenumber q.

    Parameters
    ----------
    along : float
        Under traction along the wave vector, ``1/E* = sum (1 - nu)/(2G)`` [1/Pa].
    across : float
        Under traction across it, ``sum 1/(2G)`` [1/Pa].
    """

    along: float
    across: float


@dataclass(frozen=True, slots=True)
class Cerruti:
    """Uniformly sheared cells on free half-spaces (Johnson, Contact Mechanics, 1985, section 3.6)."""

    spacing: tuple[float, ...]
    compliance: ShearCompliance

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        return self._tensor(cerruti_table(shape, self.spacing))

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]."""
        dy, dx = self.spacing
        return self._tensor(cerruti(columns * dx, rows * dy, dx, dy))

    def _tensor(self, integrals: Array) -> Array:
        x, y, z = integrals
        along, across = self.compliance.along / math.pi, self.compliance.across / math.pi
        return np.stack([across * x + along * y, (across - along) * z, along * x + across * y])

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return what the half-space takes as if it repeated itself [Pa/m]."""
        return _inverse(shape, self.spacing, self.compliance)


@dataclass(frozen=True, slots=True)
class ShearWaves:
    """Periodic half-spaces: each wave of traction answers by itself, and a constant one moves nothing."""

    grid: Grid
    compliance: ShearCompliance

    def transfer_function(self) -> Array:
        """Return xx, xy and yy of displacement per traction wave [m/Pa], shape ``(3, ny//2 + 1, nx//2 + 1)``.

        Rows from 0 up; of the rows beyond, which repeat in reverse, xy has the other sign.
        """
        q, cos, sin, cross = _waves(self.grid.shape, self.grid.spacing)
        factor = np.divide(2.0, q, out=np.zeros_like(q), where=q > 0)
        along, across = self.compliance.along * factor, self.compliance.across * factor
        return np.stack([along * cos + across * sin, (along - across) * cross, along * sin + across * cos])

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        import scipy.fft

        ny, nx = self.grid.shape
        half = self.transfer_function()
        beyond = half[:, ny - half.shape[1] : 0 : -1] * np.array([1.0, -1.0, 1.0])[:, None, None]
        table = scipy.fft.irfft2(np.concatenate([half, beyond], axis=1), s=(ny, nx))
        return np.ascontiguousarray(table[:, : shape[0], : shape[1]])

    def at(self, rows: Offsets, columns: Offsets) -> Array:
        """Return single values [m/Pa]."""
        return self.table((int(rows.max(initial=0)) + 1, int(columns.max(initial=0)) + 1))[:, rows, columns]

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return what each wave takes [Pa/m]."""
        return _inverse(shape, self.grid.spacing, self.compliance)


@dataclass(frozen=True, slots=True)
class TensorTables:
    """An influence tensor that depends only on the offset: xx and yy are even along both axes, xy is odd."""

    influence: Cerruti | ShearWaves
    modulus: ClassVar[None] = None

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        return self.influence.table(shape)

    def transfer_function(self) -> Array:
        """Return the displacement per wave of traction over a period [m/Pa]; only for what is periodic."""
        assert isinstance(self.influence, ShearWaves)
        return self.influence.transfer_function()

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return the traction per displacement wave [Pa/m]."""
        return self.influence.inverse(shape)

    def components(self) -> tuple[Component, Component, Component]:
        """Return xx, xy and yy."""

        def component(index: int) -> Component:
            return lambda rows, columns: self.influence.at(rows, columns)[index]

        return component(0), component(1), component(2)

    def matrix(self, rows: Offsets, columns: Offsets) -> Array:
        """Return the matrix [m/Pa] between cells: entries of the table at their offsets."""
        down, right = rows[:, None] - rows, columns[:, None] - columns
        xx, xy, yy = self.table(spans(rows, columns))[:, np.abs(down), np.abs(right)]
        xy *= np.sign(down) * np.sign(right)
        return np.block([[xx, xy], [xy, yy]])

    def coarsened(self, grid: Grid) -> None:
        """Return None: it is not stated on larger cells."""


Influences = Tables | TensorTables
"""An influence function, or a tensor of them, with what operators ask of it."""


def _inverse(shape: tuple[int, ...], spacing: tuple[float, ...], compliance: ShearCompliance) -> Array:
    """Return the inverse of the response to waves; the mean has that of half the longest wave, to be definite."""
    q, cos, sin, cross = _waves(shape, spacing)
    q[0, 0] = 0.5 * q[q > 0].min(initial=2.0)
    along, across = q / (2 * compliance.along), q / (2 * compliance.across)
    return np.stack([along * cos + across * sin, (along - across) * cross, along * sin + across * cos])


def _waves(shape: tuple[int, ...], spacing: tuple[float, ...]) -> tuple[Array, Array, Array, Array]:
    """Return q [rad/m] and qx^2, qy^2 and qx qy over q^2, shape ``(ny//2 + 1, nx//2 + 1)`` each.

    At Nyquist's wavenumber, the same for both signs, the mean of qx qy over both is zero. The constant has no
    direction: both its squares are 1/2.
    """
    qy, qx = (2 * np.pi * np.fft.rfftfreq(n, step) for n, step in zip(shape, spacing, strict=True))
    q = wavenumbers(shape, spacing)
    square = np.where(q > 0, q * q, 1.0)
    cos, sin, cross = qx**2 / square, qy[:, None] ** 2 / square, qy[:, None] * qx / square
    cos[0, 0] = sin[0, 0] = 0.5
    for axis, n in enumerate(shape):
        if n % 2 == 0:
            cross[(slice(None),) * axis + (-1,)] = 0.0
    return q, cos, sin, cross
