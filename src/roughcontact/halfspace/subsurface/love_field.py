"""Closed forms of the field below a uniformly loaded rectangle on a half-space (Love 1929).

Coordinates are offsets of the field point from the middle of the rectangle [m], z > 0 into the body. Displacements are
positive along the axes, stresses positive in tension; the rectangle carries a unit pressure. The thesis' point load
(eqs A.10 to A.12) is the integrand; here are its integrals, as sums over the corners of the rectangle.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from roughcontact.halfspace.influence.love import over_cell
from roughcontact.validation import Array

__all__ = [
    "DISPLACEMENT_PARITY",
    "STRESS_PARITY",
    "displacement_table",
    "love_displacement",
    "love_stress",
    "stress_table",
]

Primitive = Callable[[Array, Array, float, float], Array]

# Whether a component is odd in (y, x): of the stresses xx, yy, zz, xy, xz, yz and the displacements x, y, z.
EVEN, ODD_X, ODD_Y, ODD = (False, False), (False, True), (True, False), (True, True)
STRESS_PARITY = (EVEN, EVEN, EVEN, ODD, ODD_X, ODD_Y)
DISPLACEMENT_PARITY = (ODD_X, ODD_Y, EVEN)


def love_stress(
    x: npt.ArrayLike, y: npt.ArrayLike, depth: float, cell: tuple[float, float], poisson_ratio: float
) -> Array:
    """Return the stresses xx, yy, zz, xy, xz and yz under a unit pressure, shape ``(6, *shape of the offsets)``.

    Parameters
    ----------
    x, y : array
        Offsets from the middle of the cell [m], broadcast against each other.
    depth : float
        Depth below the surface [m]; at 0 the shear stress xy is infinite in the corners of the cell.
    cell : tuple of float
        Sides of the cell along y and x [m].
    poisson_ratio : float
        Of the body.
    """
    return _corners(_stress, x, y, depth, cell, poisson_ratio)


def love_displacement(
    x: npt.ArrayLike, y: npt.ArrayLike, depth: float, cell: tuple[float, float], poisson_ratio: float
) -> Array:
    """Return the displacements x, y and z times the shear modulus under a unit pressure [m], as `love_stress`."""
    return _corners(_displacement, x, y, depth, cell, poisson_ratio)


def stress_table(
    shape: tuple[int, ...], spacing: tuple[float, ...], depth: float, poisson_ratio: float
) -> Array:
    """Return `love_stress` at offsets of whole cells from zero up, shape ``(6, ny, nx)``."""
    return _table(_stress, shape, spacing, depth, poisson_ratio)


def displacement_table(
    shape: tuple[int, ...], spacing: tuple[float, ...], depth: float, poisson_ratio: float
) -> Array:
    """Return `love_displacement` at offsets of whole cells from zero up, shape ``(3, ny, nx)``."""
    return _table(_displacement, shape, spacing, depth, poisson_ratio)


def _corners(
    primitive: Primitive,
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    depth: float,
    cell: tuple[float, float],
    poisson_ratio: float,
) -> Array:
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    return over_cell(lambda a, b: primitive(a, b, depth, poisson_ratio), x, y, cell[1], cell[0])


def _table(
    primitive: Primitive,
    shape: tuple[int, ...],
    spacing: tuple[float, ...],
    depth: float,
    poisson_ratio: float,
) -> Array:
    """Return the sums over corners, each of which is shared by four cells."""
    (ny, nx), (dy, dx) = shape, spacing
    x, y = (np.arange(nx + 1) - 0.5) * dx, (np.arange(ny + 1) - 0.5) * dy
    # In blocks of rows whose temporaries stay in cache.
    rows = max(1, 2**14 // (nx + 1))
    parts = []
    for start in range(0, ny, rows):
        across, down = np.broadcast_arrays(x, y[start : start + rows + 1, None])
        corners = primitive(across, down, depth, poisson_ratio)
        parts.append(np.diff(np.diff(corners, axis=1), axis=2))
    return np.concatenate(parts, axis=1)


def _stress(x: Array, y: Array, z: float, nu: float) -> Array:
    """Return what the stresses are mixed derivatives of, by the potentials psi and chi; psi_z = chi_zz."""
    rho, below_x, below_y = _inverses(x, y, z)
    z_psi_xx, z_psi_yy = z * x * below_y / rho, z * y * below_x / rho
    psi_z = -np.arctan2(x * y, z * rho)
    chi_xx, chi_yy = _angles(x, y, z, rho)
    one = 1 - 2 * nu
    stress = [
        2 * nu * psi_z - z_psi_xx - one * chi_xx,
        2 * nu * psi_z - z_psi_yy - one * chi_yy,
        psi_z + z_psi_xx + z_psi_yy,
        -one * np.log(rho + z) - z / rho,
        -z * z * below_y / rho,
        -z * z * below_x / rho,
    ]
    return np.stack(stress) / (2 * math.pi)


def _displacement(x: Array, y: Array, z: float, nu: float) -> Array:
    """Return what the displacements times the shear modulus are mixed derivatives of."""
    rho, below_x, below_y = _inverses(x, y, z)
    # Where rho + y is nothing, the logarithm is multiplied by nothing.
    log_x, log_y = (
        -np.log(inverse, out=np.zeros_like(rho), where=inverse > 0) for inverse in (below_x, below_y)
    )
    log_z = np.log(rho + z)
    chi_xx, chi_yy = _angles(x, y, z, rho)
    one = 1 - 2 * nu
    psi_z = -np.arctan2(x * y, z * rho)
    psi = x * log_y + y * log_x + z * psi_z
    displacement = [
        -one * (y * log_z + z * log_y + x * chi_xx) - z * log_y,
        -one * (x * log_z + z * log_x + y * chi_yy) - z * log_x,
        2 * (1 - nu) * psi - z * psi_z,
    ]
    return np.stack(displacement) / (4 * math.pi)


def _inverses(x: Array, y: Array, z: float) -> tuple[Array, Array, Array]:
    """Return rho, 1/(rho + x) and 1/(rho + y), without their cancellation; 0 where they would be infinite."""
    rho = np.sqrt(x * x + y * y + z * z)
    return rho, _below(rho, x, y * y + z * z), _below(rho, y, x * x + z * z)


def _below(rho: Array, a: Array, rest: Array) -> Array:
    """Return 1/(rho + a), rho^2 - a^2 being `rest`."""
    negative = a < 0
    top, bottom = np.where(negative, rho - a, 1.0), np.where(negative, rest, rho + a)
    return np.divide(top, bottom, out=np.zeros_like(rho), where=bottom > 0)


def _angles(x: Array, y: Array, z: float, rho: Array) -> tuple[Array, Array]:
    """Return chi_xx and chi_yy."""
    top = x * y * (x * x + y * y) / (rho + z)  # x y (rho - z)
    return np.arctan2(top, x * x * rho + y * y * z), np.arctan2(top, y * y * rho + x * x * z)
