"""Random rough lines in numbers: the waves of many lines in one transform."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.grid import Grid
from roughcontact.surface.wave_grid import Spectrum, multiplicity, wave_powers
from roughcontact.validation import numeric, shown, whole

__all__ = ["line_heights", "random_waves", "rough_lines"]

Array = npt.NDArray[np.float64]
Waves = npt.NDArray[np.complex128]

# Heights of a batch: 8 MB, enough that NumPy asks for large pages.
BATCH = 2**20


def rough_lines(
    grid: Grid,
    spectrum: Spectrum,
    rng: np.random.Generator,
    count: int,
    *,
    rms: float | None = None,
    amplitudes: Literal["exact", "gaussian"] = "exact",
) -> Iterator[Array]:
    """Yield `count` random rough lines in batches of a few megabytes (thesis, eqs 2.10 to 2.12 as corrected).

    Parameters
    ----------
    grid : Grid
        Of one axis.
    spectrum : callable
        Two-sided C1D [m^3] of the wavenumber [rad/m]; that of a line which is equivalent to a surface comes from
        `line_spectrum`.
    rng : numpy.random.Generator
        Source of the phases. The same state gives the same phases for every spectrum.
    count : int
        Number of lines.
    rms, amplitudes
        As for `roughcontact.synthesise`, which draws the same lines one by one.

    Yields
    ------
    array, shape (batch, n)
        Heights [m], a line a row, with zero mean.

    Raises
    ------
    ValueError
        If an argument is out of range, or no wave of the grid lies inside the limits of the spectrum.
    """
    whole(count, "count, the number of lines,")
    _check(rng, amplitudes)
    amplitude = _amplitude(grid, spectrum, rms)
    rows = max(1, BATCH // grid.size)
    sizes = [min(rows, count - start) for start in range(0, count, rows)]
    return (_lines(grid, amplitude, random_waves(grid, rng, size, amplitudes=amplitudes)) for size in sizes)


@numeric
def random_waves(
    grid: Grid,
    rng: np.random.Generator,
    count: int,
    *,
    amplitudes: Literal["exact", "gaussian"] = "exact",
) -> Waves:
    """Return the waves of `count` lines with unit spectrum, shape (count, n//2 + 1).

    Their modulus is one ("exact": only the phases are random) or one in the mean square ("gaussian").
    Kept, they give `line_heights` of many spectra that differ in nothing else.
    """
    _check(rng, amplitudes)
    waves = scipy.fft.rfft(rng.standard_normal((count, grid.size)))
    if amplitudes == "exact":
        modulus = np.abs(waves)
        return np.asarray(np.divide(waves, modulus, out=waves, where=modulus > 0))
    return np.asarray(waves / math.sqrt(grid.size))


@numeric
def line_heights(grid: Grid, spectrum: Spectrum, waves: Waves, *, rms: float | None = None) -> Array:
    """Return the heights [m] of lines with a `spectrum` from their unit `waves`, a line a row.

    See `rough_lines`; with `rms` [m] the spectrum is a shape only.
    """
    amplitude = _amplitude(grid, spectrum, rms)
    if waves.shape[1:] != amplitude.shape:
        raise ValueError(
            f"waves of shape {waves.shape} do not fit the {amplitude.size} wavenumbers of the grid"
        )
    return _lines(grid, amplitude, waves)


def _amplitude(grid: Grid, spectrum: Spectrum, rms: float | None) -> Array:
    """Return B [m] at every wavenumber (thesis, eq. 2.11)."""
    if not isinstance(grid, Grid) or grid.ndim != 1:
        raise ValueError("a line has a grid of one axis: Grid(n, spacing)")
    if rms is not None and not (math.isfinite(rms) and rms > 0):
        raise ValueError(f"rms must be positive and finite [m], not {rms}")
    if not callable(spectrum):
        raise ValueError(f"a spectrum C1D(q) is wanted, such as line_spectrum returns, not {shown(spectrum)}")
    powers = wave_powers(spectrum, grid.shape, grid.spacing)
    if rms is not None:
        powers *= rms**2 / float(powers @ multiplicity(grid.shape))
    return np.sqrt(powers)


def _lines(grid: Grid, amplitude: Array, waves: Waves) -> Array:
    """Return the sum of the waves at every point (thesis, eq. 2.12 as corrected)."""
    return np.asarray(scipy.fft.irfft(waves * (grid.size * amplitude), n=grid.size, overwrite_x=True))


def _check(rng: np.random.Generator, amplitudes: str) -> None:
    if not isinstance(rng, np.random.Generator):
        raise ValueError(f"rng must be a numpy.random.Generator, for example default_rng(0), not {rng!r}")
    if amplitudes not in ("exact", "gaussian"):
        raise ValueError(f"amplitudes must be 'exact' or 'gaussian', not {amplitudes!r}")
