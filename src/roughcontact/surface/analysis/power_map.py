"""The two-dimensional power spectrum, wave by wave."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.fft

from roughcontact.errors import InputError
from roughcontact.surface.analysis.preprocess import Level, SpectralWindow, power_left, prepared, tapers
from roughcontact.surface.generation.wave_grid import wave_vectors
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric

__all__ = ["PowerMap", "power_map"]


@dataclass(frozen=True, slots=True, eq=False)
class PowerMap:
    """C2D of every wave of a real surface: half a plane, because opposite waves have the same power.

    Attributes
    ----------
    density : array, shape (ny, nx//2 + 1)
        C2D [m^4].
    qy : array, shape (ny,)
        Wavenumbers along y [rad/m], in the order of the transform: zero, positive, negative.
    qx : array, shape (nx//2 + 1,)
        Wavenumbers along x [rad/m], from zero up.
    columns : int
        The nx of the surface, even or odd.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> waves = rc.power_map(rc.shapes.wave(grid, 1e-6, wavelength=16e-6))
    >>> qy, qx, density = waves.centred()
    >>> qx[density.max(axis=0) > 0.1 * density.max()].round(-2)  # +-2 pi/16 um
    array([-392700.,  392700.])
    """

    density: Array
    qy: Array
    qx: Array
    columns: int

    @property
    def variance(self) -> float:
        """The sum of C2D over all waves but the mean, ``<h^2>`` [m^2] (Parseval)."""
        cell = (self.qy[1] - self.qy[0]) * (self.qx[1] - self.qx[0])
        both = slice(1, (self.columns + 1) // 2)
        once = self.density.sum() + self.density[:, both].sum() - self.density[0, 0]
        return float(once * cell)

    def centred(self) -> tuple[Array, Array, Array]:
        """Return the whole plane of waves, zero in the middle.

        Returns
        -------
        qy : array, shape (ny,)
            Wavenumbers along y [rad/m], increasing.
        qx : array, shape (nx,)
            Wavenumbers along x [rad/m], increasing.
        density : array, shape (ny, nx)
            C2D [m^4].
        """
        # The wave -q has the power of q.
        ny, rest = self.density.shape[0], range(self.qx.size, self.columns)
        mirrored = self.density[np.ix_((-np.arange(ny)) % ny, [self.columns - i for i in rest])]
        whole = np.fft.fftshift(np.concatenate([self.density, mirrored], axis=1))
        step = float(self.qx[1] - self.qx[0])
        qx = np.fft.fftshift(np.fft.fftfreq(self.columns, 1 / self.columns)) * step
        return np.fft.fftshift(self.qy), qx, whole


@numeric
@analysed_on_host
def power_map(surface: Surface, *, window: SpectralWindow = "auto", level: Level = "auto") -> PowerMap:
    """Return the two-dimensional power spectrum C2D of a surface (thesis, eqs 2.13 and 2.14).

    Parameters
    ----------
    surface : Surface
        On a grid of two axes, without missing points.
    window : {"auto", "none", "hann", "hamming", "blackman", "welch", "tukey"}
        Along both axes; "auto" is "none" along periodic and "hann" along free axes.
        The power that a window removes is restored on average.
    level : {"auto", "none", "mean", "plane"}
        The trend to remove first; "auto" is the mean and, along free axes, the slope.

    Returns
    -------
    PowerMap
        C2D of every wave.

    Raises
    ------
    ValueError
        If the surface is a line or too small, has missing points, or an option is unknown.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> waves = rc.power_map(surface)
    >>> waves.density.shape, f"rms {waves.variance**0.5:.3g} m"
    ((64, 33), 'rms 1e-06 m')
    """
    grid = surface.grid
    if grid.ndim != 2 or min(grid.shape) < 2:
        raise InputError(f"a spectrum map needs a surface of at least 2 x 2 points, not shape {grid.shape}")
    windows = tapers(surface, window)
    density = _power(prepared(surface, windows, level, "a power spectrum"))
    density *= grid.area / (2 * math.pi * grid.size) ** 2 / power_left(windows)
    qy, qx = (component.ravel() for component in wave_vectors(grid.shape, grid.spacing))
    return PowerMap(density, qy, qx, grid.shape[1])


def _power(work: Array) -> Array:
    """Return |rfft2|^2 of `work`, which is overwritten."""
    waves = scipy.fft.rfft2(work, overwrite_x=True)
    power = np.empty(waves.shape)
    for row, wave in zip(power, waves, strict=True):  # row by row: no second array of complex numbers
        np.add(wave.real**2, wave.imag**2, out=row)
    return power
