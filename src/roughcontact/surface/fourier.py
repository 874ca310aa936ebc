"""Self-affine surfaces by the inverse Fourier transform."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.grid import Grid
from roughcontact.surface.spectrum import SelfAffineSpectrum
from roughcontact.surface.surface import Surface

__all__ = ["self_affine", "wavenumbers"]

Array = npt.NDArray[np.float64]


def self_affine(
    grid: Grid,
    hurst: float,
    rms: float,
    rng: np.random.Generator,
    *,
    rolloff_wavelength: float | None = None,
    cutoff_wavelength: float | None = None,
    short_wavelength: float | None = None,
    support: Literal["square", "disc"] = "square",
    amplitudes: Literal["exact", "gaussian"] = "exact",
    nodal: bool = False,
) -> Surface:
    """Return a random self-affine surface (thesis, eqs 2.13 to 2.15 as corrected).

    The phases are random; the amplitudes follow the spectrum exactly, so that every sample has the same
    power spectrum and exactly the wanted rms height. The same generator state gives the
    same phases for every Hurst exponent, so that samples can be compared pair by pair.

    Parameters
    ----------
    grid : Grid
        Two-dimensional grid of the surface.
    hurst : float
        Hurst exponent, from -1 to 3.
    rms : float
        Root mean square height [m]: of this sample, set after synthesis; with Gaussian amplitudes that of
        the process, about which samples scatter.
    rng : numpy.random.Generator
        Source of the phases.
    rolloff_wavelength, cutoff_wavelength, short_wavelength : float, optional
        Limits of the power law [m], see `SelfAffineSpectrum`.
    support : {"square", "disc"}
        All waves of the grid, or those with a wavenumber up to the smaller Nyquist wavenumber.
    amplitudes : {"exact", "gaussian"}
        The spectrum exactly, or on the average over a Gaussian process.
    nodal : bool
        The thesis' grids of n + 1 nodes: the surface is made with period ``n * spacing`` and its first row
        and column are repeated at the end. For free grids only.

    Returns
    -------
    Surface
        With zero mean (a nodal one over its period).

    Raises
    ------
    ValueError
        If the grid has one axis, a parameter is out of range, or no wave is left.
    """
    if grid.ndim != 2:
        raise ValueError(f"self_affine makes surfaces: the grid needs two axes, not {grid.ndim}")
    if not (math.isfinite(rms) and rms > 0):
        raise ValueError(f"rms must be positive and finite [m], not {rms}")
    if not isinstance(rng, np.random.Generator):
        raise ValueError(f"rng must be a numpy.random.Generator, for example default_rng(0), not {rng!r}")
    if nodal and any(grid.periodic):
        raise ValueError("nodal repeats the first row at the end: a periodic grid would hold it twice")
    if nodal and min(grid.shape) < 3:
        raise ValueError(f"a nodal grid needs at least 3 x 3 nodes, not {grid.shape}")
    spectrum = SelfAffineSpectrum(hurst, rolloff_wavelength, cutoff_wavelength, short_wavelength)

    shape = tuple(n - 1 for n in grid.shape) if nodal else grid.shape
    amplitude = np.sqrt(spectrum(wavenumbers(shape, grid.spacing)))  # B2D, eq. 2.14, up to its scale
    _drop_nyquist(amplitude, shape)
    if support == "disc":
        limit = math.pi / max(grid.spacing)
        amplitude[wavenumbers(shape, grid.spacing) > limit] = 0
    elif support != "square":
        raise ValueError(f"support must be 'square' or 'disc', not {support!r}")
    if not amplitude.any():
        raise ValueError(
            "no wave of this grid lies inside the limits of the spectrum: widen them or the grid"
        )

    # The transform of real white noise has the Hermitian phases of eq. 2.15 built in.
    noise = scipy.fft.rfft2(rng.standard_normal(shape))
    if amplitudes == "exact":
        modulus = np.abs(noise)
        noise = np.divide(noise, modulus, out=np.zeros_like(noise), where=modulus > 0)
    elif amplitudes != "gaussian":
        raise ValueError(f"amplitudes must be 'exact' or 'gaussian', not {amplitudes!r}")
    heights = scipy.fft.irfft2(noise * amplitude, s=shape, overwrite_x=True)
    heights *= rms / (np.std(heights) if amplitudes == "exact" else _process_rms(amplitude, heights.size))
    if nodal:
        heights = np.pad(heights, ((0, 1), (0, 1)), mode="wrap")
    return Surface(heights, grid, (f"self-affine, H = {hurst:g}, rms = {rms:g} m, inverse FFT",))


def wavenumbers(shape: tuple[int, ...], spacing: tuple[float, ...]) -> Array:
    """Return |q| [rad/m] of the waves of a real transform over a grid of two axes, shape ``(ny, nx//2 + 1)``."""
    (ny, nx), (dy, dx) = shape, spacing
    qy = 2 * np.pi * scipy.fft.fftfreq(ny, dy)
    qx = 2 * np.pi * scipy.fft.rfftfreq(nx, dx)
    return np.asarray(np.hypot(qy[:, None], qx))


def _process_rms(amplitude: Array, size: int) -> float:
    """Return the rms of the Gaussian process whose white noise of unit variance is coloured by `amplitude`."""
    # Columns beyond the first stand for two waves each; the Nyquist column is empty.
    return math.sqrt((2 * (amplitude**2).sum() - (amplitude[:, 0] ** 2).sum()) / size)


def _drop_nyquist(amplitude: Array, shape: tuple[int, ...]) -> None:
    """Set the self-conjugate row and column of an even grid to zero: their phases could not be free."""
    ny, nx = shape
    if ny % 2 == 0:
        amplitude[ny // 2, :] = 0
    if nx % 2 == 0:
        amplitude[:, nx // 2] = 0
