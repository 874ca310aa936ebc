"""A contact solver that shares no code with roughcontact: the other solver in the checks of the law.

The iteration is that of I. A. Polonsky and L. M. Keer, Wear 231, 206 (1999), in its plain form.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy import fft
from scipy.sparse.linalg import LinearOperator, cg

Array = npt.NDArray[np.float64]
Displacement = Callable[[Array], Array]

TOLERANCE = 1e-12  # of the pressure, over its mean
MOST = 20_000  # iterations


def half_space(shape: tuple[int, int], spacing: float, modulus: float) -> Displacement:
    """Return the function from pressure to displacement: Love's integral of 1/r over a square, summed by FFT."""
    y, x = (spacing * fft.fftfreq(2 * n, 1 / (2 * n)) for n in shape)
    kernel = np.zeros((len(y), len(x)))
    for sign, side in ((1, spacing / 2), (-1, -spacing / 2)):
        for other, end in ((1, spacing / 2), (-1, -spacing / 2)):
            down, along = (y + side)[:, np.newaxis], x + end
            corner = along * np.arcsinh(down / abs(along)) + down * np.arcsinh(along / abs(down))
            kernel += sign * other * corner / (np.pi * modulus)
    factors = fft.rfft2(kernel)
    rows, columns = shape

    def displacement(pressure: Array) -> Array:
        found: Array = fft.irfft2(fft.rfft2(pressure, kernel.shape) * factors, kernel.shape)
        return found[:rows, :columns]

    return displacement


def pressed(displacement: Displacement, heights: Array, force: float, cell: float) -> Array:
    """Return the pressure under a force; `cell` is the area of a cell."""
    separation = heights.max() - heights
    pressure = np.full(heights.shape, force / (heights.size * cell))
    direction, last, conjugate = np.zeros(heights.shape), 1.0, 0.0
    for _ in range(MOST):
        gap = displacement(pressure) + separation
        contact = pressure > 0
        gap -= gap[contact].mean()
        square = float((gap[contact] ** 2).sum())
        if square == 0 and not (gap < 0).any():
            return pressure
        direction = np.where(contact, gap + conjugate * square / last * direction, 0.0)
        last = square or 1.0
        image = displacement(direction)
        image -= image[contact].mean()
        slope = float((image[contact] * direction[contact]).sum())
        # A cell that is alone in contact has no direction.
        step = (
            float((gap[contact] * direction[contact]).sum()) / slope
            if slope
            else 1 / _own(displacement, gap.shape)
        )
        before = pressure
        pressure = np.maximum(pressure - step * direction, 0.0)
        overlap = (pressure == 0) & (gap < 0)
        pressure = np.where(overlap, -step * gap, pressure)
        conjugate = 0.0 if overlap.any() else 1.0
        pressure *= force / (pressure.sum() * cell)
        if np.abs(pressure - before).sum() < TOLERANCE * before.sum():
            return pressure
    raise SystemExit(f"not solved in {MOST} iterations")


def _own(displacement: Displacement, shape: tuple[int, ...]) -> float:
    """Return the displacement of a cell under a unit pressure on it."""
    unit = np.zeros(shape)
    unit[0, 0] = 1
    return float(displacement(unit)[0, 0])


def stiffness(displacement: Displacement, contact: npt.NDArray[np.bool_], cell: float) -> float:
    """Return dF/dd of a contact region: the force of the pressure that displaces all its cells by 1."""

    def product(values: Array) -> Array:
        field = np.zeros(contact.shape)
        field[contact] = values
        return displacement(field)[contact]

    cells = int(contact.sum())
    found, missed = cg(LinearOperator((cells, cells), product, dtype=float), np.ones(cells), rtol=TOLERANCE)
    if missed:
        raise SystemExit("the stiffness is not solved")
    return float(found.sum()) * cell
