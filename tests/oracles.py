"""Slow, independent truths: whole-grid products written with NumPy alone."""

import functools

import numpy as np

from roughcontact.halfspace.influence.love import love


def displacement(grid, modulus, pressure):
    """Displacement under a pressure by a plain product over the whole padded grid."""
    (ny, nx), (dy, dx) = grid.shape, grid.spacing
    if all(grid.periodic):
        qy, qx = 2 * np.pi * np.fft.fftfreq(ny, dy), 2 * np.pi * np.fft.fftfreq(nx, dx)
        q = np.hypot(qy[:, None], qx)
        q[0, 0] = np.inf
        return np.fft.ifft2(np.fft.fft2(pressure) * 2 / (modulus * q)).real
    spectrum = np.fft.rfft2(pressure, (2 * ny, 2 * nx)) * _influence(grid) / (np.pi * modulus)
    return np.fft.irfft2(spectrum, (2 * ny, 2 * nx))[:ny, :nx]


@functools.lru_cache(2)
def _influence(grid):
    (ny, nx), (dy, dx) = grid.shape, grid.spacing
    y, x = np.arange(2 * ny), np.arange(2 * nx)
    y, x = np.minimum(y, 2 * ny - y), np.minimum(x, 2 * nx - x)
    quarter = love(np.arange(nx + 1) * dx, np.arange(ny + 1)[:, None] * dy, dx, dy)
    return np.fft.rfft2(quarter[y[:, None], x])


def certificate(surface, modulus, pressure, depth):
    """Largest violation of the conditions of contact relative to the largest displacement."""
    u = displacement(surface.grid, modulus, pressure)
    gap = u + np.nanmax(surface.heights) - surface.heights - depth
    if (pressure < 0).any() or (pressure[np.isnan(gap)] != 0).any():
        return np.inf
    violation = np.where(pressure > 0, np.abs(gap), -gap)
    return max(0.0, np.nanmax(violation)) / np.abs(u).max()


def paraboloid(n, radius, side=1.0, apex=(0.0, 0.0)):
    """Heights [m] of a paraboloid on n x n cells; for odd n the apex may sit on a cell centre."""
    x = (np.arange(n) - (n - 1) / 2) * side / n
    return -((x[:, None] - apex[0]) ** 2 + (x - apex[1]) ** 2) / (2 * radius)
