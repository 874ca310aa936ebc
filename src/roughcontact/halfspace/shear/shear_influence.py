"""Influence functions of tangential traction: how a cell's traction moves every cell sideways."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.grid import Grid
from roughcontact.halfspace.influence.cerruti import cerruti, cerruti_table
from roughcontact.halfspace.influence.tables import wavenumbers

__all__ = ["Cerruti", "ShearCompliance", "ShearInfluence", "ShearWaves"]

Array = npt.NDArray[np.float64]
Offsets = npt.NDArray[np.intp]
Part = Callable[[Offsets, Offsets], Array]


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


class ShearInfluence(Protocol):
    """A translation-invariant influence tensor: xx and yy are even in both offsets, xy is odd in both."""

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return xx, yy and xy [m/Pa] at offsets of whole cells from zero up to `shape`, shape ``(3, *shape)``."""
        ...

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return xx, yy and xy of traction per displacement wave [Pa/m] on a box, rows and columns from 0 up."""
        ...


@dataclass(frozen=True, slots=True)
class Cerruti:
    """Uniformly sheared cells on free half-spaces (Johnson, Contact Mechanics, 1985, section 3.6)."""

    spacing: tuple[float, ...]
    compliance: ShearCompliance

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        return self._tensor(cerruti_table(shape, self.spacing))

    def parts(self) -> tuple[Part, Part, Part]:
        """Return xx, yy and xy [m/Pa] as functions of offsets of whole cells, rows and columns from zero up."""
        dy, dx = self.spacing

        def part(index: int) -> Part:
            return lambda rows, columns: self._tensor(cerruti(columns * dx, rows * dy, dx, dy))[index]

        return part(0), part(1), part(2)

    def _tensor(self, integrals: Array) -> Array:
        x, y, z = integrals
        along, across = self.compliance.along / math.pi, self.compliance.across / math.pi
        return np.stack([across * x + along * y, along * x + across * y, (across - along) * z])

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return what the half-space takes as if it repeated itself [Pa/m]."""
        return _inverse(shape, self.spacing, self.compliance)


@dataclass(frozen=True, slots=True)
class ShearWaves:
    """Periodic half-spaces: each wave of traction answers by itself, and a constant one moves nothing."""

    grid: Grid
    compliance: ShearCompliance

    def multiplier(self) -> Array:
        """Return xx, yy and xy of displacement per traction wave [m/Pa], shape ``(3, ny//2 + 1, nx//2 + 1)``.

        Rows from 0 up; of the rows beyond, which repeat in reverse, xy has the other sign.
        """
        q, cos, sin, cross = _waves(self.grid.shape, self.grid.spacing)
        factor = np.divide(2.0, q, out=np.zeros_like(q), where=q > 0)
        along, across = self.compliance.along * factor, self.compliance.across * factor
        return np.stack([along * cos + across * sin, along * sin + across * cos, (along - across) * cross])

    def table(self, shape: tuple[int, ...]) -> Array:
        """Return the table [m/Pa]."""
        ny, nx = self.grid.shape
        half = self.multiplier()
        beyond = half[:, ny - half.shape[1] : 0 : -1] * np.array([1.0, 1.0, -1.0])[:, None, None]
        table = scipy.fft.irfft2(np.concatenate([half, beyond], axis=1), s=(ny, nx))
        return np.ascontiguousarray(table[:, : shape[0], : shape[1]])

    def inverse(self, shape: tuple[int, int]) -> Array:
        """Return what each wave takes [Pa/m]."""
        return _inverse(shape, self.grid.spacing, self.compliance)


def _inverse(shape: tuple[int, ...], spacing: tuple[float, ...], compliance: ShearCompliance) -> Array:
    """Return the inverse of the response to waves; the mean has that of half the longest wave, to be definite."""
    q, cos, sin, cross = _waves(shape, spacing)
    q[0, 0] = 0.5 * q[q > 0].min(initial=2.0)
    along, across = q / (2 * compliance.along), q / (2 * compliance.across)
    return np.stack([along * cos + across * sin, along * sin + across * cos, (along - across) * cross])


def _waves(shape: tuple[int, ...], spacing: tuple[float, ...]) -> tuple[Array, Array, Array, Array]:
    """Return q [rad/m] and qx^2, qy^2 and qx qy over q^2, shape ``(ny//2 + 1, nx//2 + 1)`` each.

    At Nyquist's wavenumber, the same for both signs, the mean of qx qy over both is zero. Of the constant, which has no
    direction, both squares are 1/2.
    """
    qy, qx = (2 * np.pi * scipy.fft.rfftfreq(n, step) for n, step in zip(shape, spacing, strict=True))
    q = wavenumbers(shape, spacing)
    square = np.where(q > 0, q * q, 1.0)
    cos, sin, cross = qx**2 / square, qy[:, None] ** 2 / square, qy[:, None] * qx / square
    cos[0, 0] = sin[0, 0] = 0.5
    for axis, n in enumerate(shape):
        if n % 2 == 0:
            cross[(slice(None),) * axis + (-1,)] = 0.0
    return q, cos, sin, cross
