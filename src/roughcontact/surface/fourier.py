"""Random surfaces and lines by the inverse Fourier transform."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.grid import Grid
from roughcontact.surface.spectrum import SelfAffineSpectrum, StretchedSpectrum
from roughcontact.surface.surface import Surface
from roughcontact.surface.wave_grid import Spectrum, Support, multiplicity, wave_powers, wavenumbers
from roughcontact.validation import number, numeric

__all__ = ["self_affine", "synthesise", "wavenumbers"]

Array = npt.NDArray[np.float64]


@numeric
def self_affine(
    grid: Grid,
    hurst: float,
    rms: float,
    rng: np.random.Generator,
    *,
    rolloff: float | None = None,
    long_cutoff: float | None = None,
    short_cutoff: float | None = None,
    anisotropy: tuple[float, float] | None = None,
    support: Support = "square",
    amplitudes: Literal["exact", "gaussian"] = "exact",
    nodal: bool = False,
) -> Surface:
    """Return a random self-affine surface or line (thesis, eqs 2.10 to 2.15 as corrected).

    The phases are random; the amplitudes follow the spectrum exactly, so that every sample has the same
    power spectrum and exactly the wanted rms height. The same generator state gives the
    same phases for every Hurst exponent, so that samples can be compared pair by pair.

    Parameters
    ----------
    grid : Grid
        Grid of the surface, ``(ny, nx)``, or of the line, ``(n,)``.
    hurst : float
        Hurst exponent, from -1 to 3: C2D ~ q^(-2(H+1)), on a line C1D ~ q^(-(2H+1)).
    rms : float
        Root mean square height [m]: of this sample; with Gaussian amplitudes that of
        the process, about which samples scatter.
    rng : numpy.random.Generator
        Source of the phases.
    rolloff, long_cutoff, short_cutoff : float, optional
        Limits of the power law [m], see `SelfAffineSpectrum`.
    anisotropy : tuple of float, optional
        ``(ratio, angle)``: correlation length along over that across, and the direction
        of the long one from x towards y [rad], see `StretchedSpectrum`. For surfaces only.
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
        If a parameter is out of range, or no wave is left.
    """
    if not (math.isfinite(rms) and rms > 0):
        raise ValueError(f"rms must be positive and finite [m], not {rms}")
    law = SelfAffineSpectrum(hurst, rolloff, long_cutoff, short_cutoff, grid.ndim)
    spectrum: Spectrum = law
    if anisotropy is not None:
        if np.shape(number(anisotropy, "anisotropy")) != (2,):
            raise ValueError(f"anisotropy must be two numbers (ratio, angle), not {anisotropy!r}")
        spectrum = StretchedSpectrum(law, *anisotropy)
    heights = _heights(grid, spectrum, rng, rms, support, amplitudes, nodal)
    return Surface(heights, grid, (f"self-affine, H = {hurst:g}, rms = {rms:g} m, inverse FFT",))


@numeric
def synthesise(
    grid: Grid,
    spectrum: Spectrum,
    rng: np.random.Generator,
    *,
    rms: float | None = None,
    support: Support = "square",
    amplitudes: Literal["exact", "gaussian"] = "exact",
    nodal: bool = False,
) -> Surface:
    """Return a random surface or line with a given power spectrum (thesis, eqs 2.11 to 2.15 as corrected).

    Parameters
    ----------
    grid : Grid
        Grid of the surface, ``(ny, nx)``, or of the line, ``(n,)``.
    spectrum : callable or object with a method ``at``
        ``spectrum(q)``: C2D [m^4] of a surface at the wavenumbers |q| [rad/m], or the two-sided C1D [m^3] of a
        line, ``<z^2> = int C2D d2q = int C1D dq``. For a spectrum that depends on the direction wrap a
        function of ``(qy, qx)`` in `DirectionalSpectrum`. It is never asked for q = 0.
    rng : numpy.random.Generator
        Source of the phases.
    rms : float, optional
        Root mean square height [m]; without it the spectrum is taken as it is, and not just as a shape.
    support, amplitudes, nodal
        See `self_affine`.

    Returns
    -------
    Surface
        With zero mean (a nodal one over its period). Its moments are `grid_moments` of the spectrum,
        with exact amplitudes to rounding.

    Raises
    ------
    ValueError
        If a parameter is out of range, the spectrum is negative, not finite or not even, or no wave is left.
    """
    if rms is not None and not (math.isfinite(rms) and rms > 0):
        raise ValueError(f"rms must be positive and finite [m], not {rms}")
    heights = _heights(grid, spectrum, rng, rms, support, amplitudes, nodal)
    size = "" if rms is None else f", rms = {rms:g} m"
    return Surface(heights, grid, (f"random surface of a given spectrum{size}, inverse FFT",))


def _heights(
    grid: Grid,
    spectrum: Spectrum,
    rng: np.random.Generator,
    rms: float | None,
    support: Support,
    amplitudes: str,
    nodal: bool,
) -> Array:
    """Return the heights of eqs 2.12 and 2.15; the border has looked at `rms`, the rest is looked at here."""
    if not isinstance(rng, np.random.Generator):
        raise ValueError(f"rng must be a numpy.random.Generator, for example default_rng(0), not {rng!r}")
    if amplitudes not in ("exact", "gaussian"):
        raise ValueError(f"amplitudes must be 'exact' or 'gaussian', not {amplitudes!r}")
    if nodal and any(grid.periodic):
        raise ValueError("nodal repeats the first row at the end: a periodic grid would hold it twice")
    if nodal and min(grid.shape) < 3:
        raise ValueError(f"a nodal grid needs at least 3 nodes an axis, not {grid.shape}")

    shape = tuple(n - 1 for n in grid.shape) if nodal else grid.shape
    amplitude = wave_powers(spectrum, shape, grid.spacing, support)
    scale = 1.0 if rms is None else rms / math.sqrt((amplitude * multiplicity(shape)).sum())
    np.sqrt(amplitude, out=amplitude)  # B, eqs 2.11 and 2.14

    # The transform of real white noise has the Hermitian phases of eq. 2.15 built in.
    noise = scipy.fft.rfftn(rng.standard_normal(shape))
    size = math.prod(shape)
    if amplitudes == "exact":
        modulus = np.abs(noise)
        np.divide(noise, modulus, out=noise, where=modulus > 0)
    else:
        scale /= math.sqrt(size)  # to unit variance a wave
    noise *= amplitude
    heights = np.asarray(scipy.fft.irfftn(noise, s=shape, overwrite_x=True))
    heights *= scale * size
    return np.pad(heights, [(0, 1)] * grid.ndim, mode="wrap") if nodal else heights
