"""Random surfaces and lines by the inverse Fourier transform."""

from __future__ import annotations

import math

from roughcontact.errors import about
from roughcontact.grid import Grid
from roughcontact.slabs.slabs import Slabs
from roughcontact.surface.generation.random_heights import SizedSpectrum, random_heights
from roughcontact.surface.generation.random_phases import Amplitudes
from roughcontact.surface.generation.spectrum import SelfAffineSpectrum, StretchedSpectrum
from roughcontact.surface.generation.wave_grid import Spectrum, Support, wavenumbers
from roughcontact.surface.surface import Surface
from roughcontact.validation import RngLike, numeric

__all__ = ["self_affine", "synthesise", "wavenumbers"]


@numeric(rms="m", rms_band="m", rolloff="m", long_cutoff="m", short_cutoff="m")
def self_affine(
    grid: Grid,
    hurst: float,
    rms: float,
    rng: RngLike,
    *,
    rms_band: tuple[float, float] | None = None,
    rolloff: float | None = None,
    long_cutoff: float | None = None,
    short_cutoff: float | None = None,
    anisotropy: tuple[float, float] | None = None,
    support: Support = "square",
    amplitudes: Amplitudes = "exact",
    nodal: bool = False,
    slabs: Slabs | None = None,
) -> Surface:
    """Return a random self-affine surface or line (thesis, eqs 2.10 to 2.15 as corrected).

    The phases are random and the amplitudes follow the spectrum exactly: every sample has the same power spectrum and
    exactly the given rms height. The same seed or generator state gives the same phases for every Hurst exponent,
    which allows comparisons pair by pair. On every grid with the same outer sides it gives the same waves: a finer
    grid adds finer waves. See the notes.

    Parameters
    ----------
    grid : Grid
        Grid of the surface, ``(ny, nx)``, or of the line, ``(n,)``.
    hurst : float
        Hurst exponent, from -1 to 3: C2D ~ q^(-2(H+1)), on a line C1D ~ q^(-(2H+1)).
    rms : float
        Root mean square height [m] of this sample; with Gaussian amplitudes that of the process, about which samples
        scatter.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the phases: a generator yields a key of 128 bits and advances by that, whatever the grid; a seed
        means ``numpy.random.default_rng(seed)``; None draws different phases each time.
    rms_band : tuple of float, optional
        ``(longest, shortest)``: wavelengths [m] of the waves whose rms height is `rms`, both limits included. By
        default all waves of the grid. For one surface on several grids, choose a band that exists on all of them: from
        the side to slightly above two cells of the coarsest grid.
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
        Grids of n + 1 nodes as in the thesis: the surface is generated with period ``n * spacing`` and its first row
        and column are repeated at the end. For free grids only.
    slabs : Slabs, optional
        Processes that generate the surface together, each its rows, with the same seed or generators in the same
        state; on periodic grids. The waves are the same for any number of processes. With None the first process draws
        for all.

    Returns
    -------
    Surface
        With zero mean (a nodal one over its period).

    Raises
    ------
    ValueError
        If a parameter is out of range, or no wave is left.

    Notes
    -----
    Thesis, eqs 2.10 to 2.15, two of which are corrected: in 2.12 the exponent lacks the position, and 2.15 is a sum
    over wave vectors.

    The phase of a wave (and its modulus if Gaussian) is a function of only the key and the integer wave vector, the
    numbers of periods along each side: ``generation.random_phases`` defines it. Phases count from the outer corner of
    the first cell, for a nodal grid from its first node. Therefore the same generator state gives, on n, 2n, 3n or n +
    1 cells over the same sides, the same waves at the same places except those that are too fine; nodal grids share
    their nodes. With only `rms` each grid scales its waves to the same sum: at H = 0 the waves on 512^2 cells are 11 %
    higher than the same waves on 2048^2; with `rms_band` they are equal. Waves at the Nyquist wavenumber of an even
    number of cells are left out, because their phases are not free.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> f"{surface.rms:.3g} m"
    '1e-06 m'
    """
    if not (math.isfinite(rms) and rms > 0):
        raise about("rms", f"must be positive and finite [m], not {rms}")
    law = SelfAffineSpectrum(hurst, rolloff, long_cutoff, short_cutoff, grid.ndim)
    spectrum: Spectrum = law
    if anisotropy is not None:
        if not isinstance(anisotropy, list | tuple) or len(anisotropy) != 2:
            raise about("anisotropy", f"must be two numbers (ratio, angle), not {anisotropy!r}")
        spectrum = StretchedSpectrum(law, *anisotropy)
    sized = SizedSpectrum(spectrum, support, rms, rms_band)
    heights = random_heights(grid, sized, rng, amplitudes, nodal, slabs)
    return Surface(heights, grid, (f"self-affine, H = {hurst:g}{_size(rms, rms_band)}, inverse FFT",))


@numeric(rms="m", rms_band="m")
def synthesise(
    grid: Grid,
    spectrum: Spectrum,
    rng: RngLike,
    *,
    rms: float | None = None,
    rms_band: tuple[float, float] | None = None,
    support: Support = "square",
    amplitudes: Amplitudes = "exact",
    nodal: bool = False,
    slabs: Slabs | None = None,
) -> Surface:
    """Return a random surface or line with a given power spectrum (thesis, eqs 2.11 to 2.15 as corrected).

    Parameters
    ----------
    grid : Grid
        Grid of the surface, ``(ny, nx)``, or of the line, ``(n,)``.
    spectrum : callable or object with a method ``at``
        ``spectrum(q)``: C2D [m^4] of a surface at the wavenumbers ``|q|`` [rad/m], or the two-sided C1D [m^3] of a
        line, ``<z^2> = int C2D d2q = int C1D dq``. For a spectrum that depends on the direction, wrap a function of
        ``(qy, qx)`` in `DirectionalSpectrum`. It is never called for q = 0.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the phases, see `self_affine`.
    rms : float, optional
        Root mean square height [m]; with it the spectrum sets only the shape, without it also the height.
    rms_band : tuple of float, optional
        Wavelengths [m] of the waves whose rms height is `rms`, see `self_affine`. Not needed without `rms`: a spectrum
        that sets the height gives every wave the same amplitude on all grids.
    support : {"square", "disc"}
        All waves of the grid, or those with a wavenumber up to the smaller Nyquist wavenumber.
    amplitudes : {"exact", "gaussian"}
        The spectrum exactly, or on the average over a Gaussian process.
    nodal : bool
        Whether the last row and column repeat the first, see `self_affine`.
    slabs : Slabs, optional
        Processes that generate the surface together, see `self_affine`.

    Returns
    -------
    Surface
        With zero mean (a nodal one over its period). Its moments are `grid_moments` of the spectrum, to rounding with
        exact amplitudes.

    Raises
    ------
    ValueError
        If a parameter is out of range, the spectrum is negative, not finite or not even, or no wave is left.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> spectrum = rc.SelfAffineSpectrum(hurst=0.8, rolloff=16e-6).scaled(1e-6, grid)
    >>> surface = rc.synthesise(grid, spectrum, np.random.default_rng(1))
    >>> f"{surface.rms:.3g} m"
    '1e-06 m'
    """
    if rms is not None and not (math.isfinite(rms) and rms > 0):
        raise about("rms", f"must be positive and finite [m], not {rms}")
    sized = SizedSpectrum(spectrum, support, rms, rms_band)
    heights = random_heights(grid, sized, rng, amplitudes, nodal, slabs)
    size = _size(rms, rms_band)
    return Surface(heights, grid, (f"random surface of a given spectrum{size}, inverse FFT",))


def _size(rms: float | None, rms_band: tuple[float, float] | None) -> str:
    if rms is None:
        return ""
    of = "" if rms_band is None else f" of the waves from {rms_band[0]:g} m to {rms_band[1]:g} m"
    return f", rms = {rms:g} m{of}"
