"""The judge: every program's pressure is certified by one product that belongs to none of them.

The displacement comes from a whole-grid FFT of NumPy with a kernel of its own; nothing of roughcontact is used.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["Certificate", "Judge"]

Array = npt.NDArray[np.float64]


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


class Judge:
    """The displacement of one grid, made once and used for every program."""

    def __init__(
        self, shape: tuple[int, int], spacing: tuple[float, float], periodic: bool, modulus: float
    ) -> None:
        self._shape = shape
        self._cell_area = spacing[0] * spacing[1]
        self._padded = shape if periodic else (2 * shape[0], 2 * shape[1])
        make = _periodic_multiplier if periodic else _free_multiplier
        self._multiplier = make(shape, spacing) / modulus

    def displacement(self, pressure: Array) -> Array:
        """Return the displacement of the surface [m]."""
        spectrum = np.fft.rfft2(pressure, s=self._padded)
        ny, nx = self._shape
        return np.fft.irfft2(spectrum * self._multiplier, s=self._padded)[:ny, :nx]

    def certify(self, heights: Array, pressure: Array, force: float) -> Certificate:
        """Return the certificate of `pressure`, at the depth that makes its residual smallest."""
        contact = pressure > 0
        cells = int(contact.sum())
        if (
            pressure.shape != self._shape
            or not np.isfinite(pressure).all()
            or (pressure < 0).any()
            or not cells
        ):
            return Certificate(np.inf, np.inf, cells, np.nan)
        displacement = self.displacement(pressure)
        gap = displacement + (np.nanmax(heights) - heights)  # plus a depth that is not known
        highest = gap[contact].max()  # not a number under pressure where nothing was measured
        depth = (highest + np.nanmin(gap)) / 2
        residual = (highest - depth) / np.abs(displacement).max()
        carried = pressure.sum() * self._cell_area
        return Certificate(float(residual), float(abs(carried / force - 1)), cells, float(depth))


def _periodic_multiplier(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Return 2/q, the displacement of a pressure wave at E* = 1; zero for the mean."""
    qy = 2 * np.pi * np.fft.fftfreq(shape[0], spacing[0])
    qx = 2 * np.pi * np.fft.rfftfreq(shape[1], spacing[1])
    q = np.hypot(qy[:, None], qx)
    return np.divide(2, q, out=np.zeros_like(q), where=q > 0)


def _free_multiplier(shape: tuple[int, int], spacing: tuple[float, float]) -> npt.NDArray[np.complex128]:
    """Return the transform of Love's influence function, zero padded to twice the grid."""
    ny, nx = shape
    quadrant = _love(shape, spacing)
    table = np.zeros((2 * ny, 2 * nx))
    table[:ny, :nx] = quadrant
    table[ny + 1 :, :nx] = quadrant[:0:-1]
    table[:, nx + 1 :] = table[:, nx - 1 : 0 : -1]
    return np.fft.rfft2(table)


def _love(shape: tuple[int, int], spacing: tuple[float, float]) -> Array:
    """Return the displacement under a unit pressure on a cell at E* = 1 (Love 1929; Johnson, eq. 3.25).

    The four corner terms cancel to the square of the distance in cells; the longer floating-point type keeps
    what double precision would lose.
    """
    (ny, nx), (dy, dx) = shape, spacing
    y = ((np.arange(ny + 1, dtype=np.longdouble) - 0.5) * dy)[:, None]
    x = (np.arange(nx + 1, dtype=np.longdouble) - 0.5) * dx
    r = np.hypot(y, x)
    corner = y * np.log(x + r) + x * np.log(y + r)
    cell = corner[1:, 1:] - corner[:-1, 1:] - corner[1:, :-1] + corner[:-1, :-1]
    return np.asarray(cell / np.longdouble(np.pi), dtype=np.float64)
