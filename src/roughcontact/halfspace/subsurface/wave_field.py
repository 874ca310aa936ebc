"""The field below a periodic half-space under waves of pressure (Westergaard 1939): Love's potentials, transformed.

Conventions are those of `roughcontact.halfspace.subsurface.love_field`.
"""

from __future__ import annotations

import numpy as np
import scipy.fft

from roughcontact.grid import Grid
from roughcontact.validation import Array

__all__ = ["displacement_waves", "stress_waves"]


def stress_waves(grid: Grid, depth: float, poisson_ratio: float) -> Array:
    """Return the stresses xx, yy, zz, xy, xz and yz per pressure wave, shape ``(6, ny//2 + 1, nx//2 + 1)``.

    Real, without the factor -i for each axis along which a component is odd. A constant pressure, which has no
    direction, cannot widen the body: its lateral stress is ``-nu/(1 - nu)`` of it.
    """
    q, qy, qx, odd_y, odd_x = _waves(grid)
    nu, z, decay = poisson_ratio, depth, np.exp(-q * depth)
    lateral = z - (1 - 2 * nu) / q
    stress = [
        decay * (qx * qx / q * lateral - 2 * nu),
        decay * (qy * qy / q * lateral - 2 * nu),
        -decay * (1 + q * z),
        -decay * odd_y * odd_x / q * lateral,
        -decay * odd_x * z,
        -decay * odd_y * z,
    ]
    constant = (-nu / (1 - nu), -nu / (1 - nu), -1.0, 0.0, 0.0, 0.0)
    for component, value in zip(stress, constant, strict=True):
        component[0, 0] = value
    return np.stack(stress)


def displacement_waves(grid: Grid, depth: float, poisson_ratio: float) -> Array:
    """Return the displacements x, y and z times the shear modulus per pressure wave [m], as `stress_waves`.

    Those of a constant pressure count from the surface, whose mean displacement is zero.
    """
    q, _, _, odd_y, odd_x = _waves(grid)
    nu, z, decay = poisson_ratio, depth, np.exp(-q * depth)
    lateral = decay / q * (z - (1 - 2 * nu) / q) / 2
    normal = decay * ((1 - nu) / q + z / 2)
    normal[0, 0] = -z * (1 - 2 * nu) / (2 * (1 - nu))
    return np.stack([odd_x * lateral, odd_y * lateral, normal])


def _waves(grid: Grid) -> tuple[Array, Array, Array, Array, Array]:
    """Return q, qy and qx [rad/m], and qy and qx again as odd factors: zero where both signs share a place."""
    qy, qx = (
        2 * np.pi * scipy.fft.rfftfreq(n, step) for n, step in zip(grid.shape, grid.spacing, strict=True)
    )
    odd_y, odd_x = qy.copy(), qx.copy()
    for odd, n in ((odd_y, grid.shape[0]), (odd_x, grid.shape[1])):
        if n % 2 == 0:
            odd[-1] = 0.0
    q = np.hypot(qy[:, None], qx)
    q[0, 0] = 1.0  # of the constant, whose values are set apart
    return q, qy[:, None], qx, odd_y[:, None], odd_x
