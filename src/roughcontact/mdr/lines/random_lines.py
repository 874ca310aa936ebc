"""Many random rough lines: their waves in one transform."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.generation.random_phases import (
    Amplitudes,
    draw_keys,
    require_amplitudes,
    unit_waves,
)
from roughcontact.surface.generation.wave_grid import Spectrum, cell_centres, wave_amplitudes
from roughcontact.validation import Array, RngLike, as_generator, numeric, positive_scalar, shown, whole

__all__ = ["line_heights", "random_waves", "rough_lines"]

Waves = npt.NDArray[np.complex128]

# Heights of a batch: 8 MB, enough for NumPy to request large pages.
BATCH = 2**20


def rough_lines(
    grid: Grid,
    spectrum: Spectrum,
    rng: RngLike,
    count: int,
    *,
    rms: float | None = None,
    rms_band: tuple[float, float] | None = None,
    amplitudes: Amplitudes = "exact",
) -> Iterator[Array]:
    """Yield `count` random rough lines in batches of a few megabytes (thesis, eqs 2.10 to 2.12 as corrected).

    Parameters
    ----------
    grid : Grid
        Of one axis.
    spectrum : callable
        Two-sided C1D [m^3] of the wavenumber [rad/m]; that of a line which is equivalent to a surface comes from
        `line_spectrum`.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the phases: a generator yields a key for each line. The same seed or state gives the same phases for
        every spectrum and every number of points, see `roughcontact.self_affine`.
    count : int
        Number of lines.
    rms : float, optional
        As for `roughcontact.synthesise`, which draws the same lines one by one.
    rms_band : tuple of float, optional
        As for `roughcontact.synthesise`, which draws the same lines one by one.
    amplitudes : {"exact", "gaussian"}
        As for `roughcontact.synthesise`, which draws the same lines one by one.

    Yields
    ------
    array, shape (batch, n)
        Heights [m], a line a row, with zero mean.

    Raises
    ------
    ValueError
        If an argument is out of range, or no wave of the grid lies inside the limits of the spectrum.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import equivalent_line, random_lines
    >>> surface = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> grid = rc.Grid(512, 1e-3 / 512, periodic=True)
    >>> line = equivalent_line.line_spectrum(surface)
    >>> (heights,) = random_lines.rough_lines(grid, line, np.random.default_rng(0), 3, rms=1e-6)
    >>> heights.std(axis=1).round(12).tolist()
    [1e-06, 1e-06, 1e-06]
    """
    whole(count, "count, the number of lines,")
    generator = as_generator(rng)  # once: batches are drawn on demand
    require_amplitudes(amplitudes)
    amplitude = _amplitude(grid, spectrum, rms, rms_band)
    rows = max(1, BATCH // grid.size)
    sizes = [min(rows, count - start) for start in range(0, count, rows)]
    return (
        _lines(grid, amplitude, random_waves(grid, generator, size, amplitudes=amplitudes)) for size in sizes
    )


@numeric
def random_waves(
    grid: Grid,
    rng: RngLike,
    count: int,
    *,
    amplitudes: Amplitudes = "exact",
) -> Waves:
    """Return the waves of `count` lines with unit spectrum, shape (count, n//2 + 1).

    Their modulus is one ("exact": only the phases are random) or one in the mean square ("gaussian").
    Pass them to `line_heights` with several spectra to compare lines with the same phases. The waves of a line of
    fewer points are the first columns.

    Parameters
    ----------
    grid : Grid
        Of one axis.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of the phases.
    count : int
        Number of lines.
    amplitudes : {"exact", "gaussian"}
        "exact": only the phases are random; "gaussian": also the moduli of the waves.

    Returns
    -------
    complex array
        Shape (count, n//2 + 1).

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import random_lines
    >>> waves = random_lines.random_waves(rc.Grid(64, 1e-6, periodic=True), np.random.default_rng(0), 2)
    >>> waves.shape, round(float(abs(waves[0, 5])), 9)
    ((2, 33), 1.0)
    """
    return unit_waves(
        draw_keys(rng, whole(count, "count, the number of lines,")), 0, (0, grid.size // 2 + 1), amplitudes
    )


@numeric
def line_heights(
    grid: Grid,
    spectrum: Spectrum,
    waves: Waves,
    *,
    rms: float | None = None,
    rms_band: tuple[float, float] | None = None,
) -> Array:
    """Return the heights [m] of lines with a `spectrum` from their unit `waves`, a line a row.

    See `rough_lines`; with `rms` [m] only the shape of the spectrum matters.

    Parameters
    ----------
    grid : Grid
        Of one axis.
    spectrum : Waves, measured or continuous spectrum
        Two-sided C1D [m^3] of the wavenumber [rad/m], see `line_spectrum`.
    waves : complex array, shape (lines, n//2 + 1)
        Unit waves, from `random_waves`.
    rms : float, optional
        Root mean square height of each line [m]: then only the shape of the spectrum matters. By default that of the
        spectrum.
    rms_band : tuple of float, optional
        Wavelengths [m] of the waves whose rms height is `rms`, see `roughcontact.self_affine`. By default all.

    Returns
    -------
    array
        Heights [m], shape (lines, n).

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.mdr import random_lines
    >>> grid = rc.Grid(64, 1e-6, periodic=True)
    >>> waves = random_lines.random_waves(grid, np.random.default_rng(0), 2)
    >>> heights = random_lines.line_heights(grid, lambda q: q**-3.0, waves, rms=1e-6)
    >>> heights.std(axis=1).round(12).tolist()  # of all lines alike
    [1e-06, 1e-06]
    """
    amplitude = _amplitude(grid, spectrum, rms, rms_band)
    if waves.shape[1:] != amplitude.shape:
        raise about(
            "waves", f"of shape {waves.shape} do not fit the {amplitude.size} wavenumbers of the grid"
        )
    return _lines(grid, amplitude, waves)


def _amplitude(
    grid: Grid, spectrum: Spectrum, rms: float | None, rms_band: tuple[float, float] | None
) -> Array:
    """Return B [m] at every wavenumber (thesis, eq. 2.11)."""
    if not isinstance(grid, Grid) or grid.ndim != 1:
        raise InputError("a line has a grid of one axis", "use Grid(n, spacing)")
    if rms is not None:
        positive_scalar(rms, "rms")
    if not callable(spectrum):
        raise InputError(
            f"a spectrum C1D(q) is needed, for example from line_spectrum, not {shown(spectrum)}",
            place="spectrum",
        )
    return wave_amplitudes(spectrum, grid.shape, grid.spacing, rms=rms, rms_band=rms_band)


def _lines(grid: Grid, amplitude: Array, waves: Waves) -> Array:
    """Return the sum of the waves at every point (thesis, eq. 2.12 as corrected)."""
    (to_centres,) = cell_centres(grid.shape)
    waves = waves * (grid.size * amplitude)
    waves *= to_centres
    return np.asarray(scipy.fft.irfft(waves, n=grid.size, overwrite_x=True))
