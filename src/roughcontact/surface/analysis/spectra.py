"""Power spectra as functions of the wavenumber: averaged over rings, or over profiles."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
import numpy.typing as npt
import scipy.fft

from roughcontact.errors import InputError, about
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.analysis.power_map import PowerMap, power_map
from roughcontact.surface.analysis.preprocess import Level, SpectralWindow, prepared, tapers
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, require

__all__ = ["power_spectrum"]

# A windowed spectrum of a free surface is reliable from this number of waves per length on: longer waves are affected
# by levelling and by the width of the window's kernel.
LONGEST = 3.0
FINEST = 1e5  # bins to a factor of ten: no surface has enough waves for more


@numeric
@analysed_on_host
def power_spectrum(
    surface: Surface,
    direction: Literal["auto", "ring", "x", "y"] = "auto",
    *,
    window: SpectralWindow = "auto",
    level: Level = "auto",
    per_decade: float | None = None,
) -> PowerSpectrum:
    """Return the power spectrum of a surface or of its profiles.

    Parameters
    ----------
    surface : Surface
        Without missing points.
    direction : {"auto", "ring", "x", "y"}
        "ring": C2D averaged over all directions, up to the smaller of the Nyquist wavenumbers; "x", "y":
        C1D of the profiles along that axis, averaged over them. "auto": rings of a surface, C1D of a line.
    window : {"auto", "none", "hann", "hamming", "blackman", "welch", "tukey"}
        "auto" is "none" along periodic and "hann" along free axes. The power that a window removes is restored on
        average.
    level : {"auto", "none", "mean", "plane"}
        The trend to remove first; "auto" is the mean and, along free axes, the slope. The mean of each profile of a
        surface is also removed.
    per_decade : float, optional
        Bins to a factor of ten in wavenumber. By default the width of a bin is one wave of the longer side.

    Returns
    -------
    PowerSpectrum
        Without the waves at the Nyquist wavenumber, each of which represents two waves.

    Raises
    ------
    ValueError
        If points are missing, an option is unknown, or rings are requested for a line.

    Notes
    -----
    Rings: thesis, eqs 2.13 and 2.14; profiles: eqs 2.10 and 2.11.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> spectrum = rc.power_spectrum(surface)
    >>> spectrum.kind, spectrum.wavenumber.size
    ('C2D', 32)
    >>> f"{rc.fit_spectrum(spectrum).hurst:.1f}"
    '0.8'
    """
    ndim = surface.grid.ndim
    if direction == "auto":
        direction = "ring" if ndim == 2 else "x"
    require(
        direction in ("ring", "x", "y"),
        f"direction must be 'ring', 'x' or 'y', not {direction!r}",
        place="direction",
    )
    if ndim == 1 and direction != "x":
        raise InputError(f"a line has profiles along 'x' only, not {direction!r}", place="direction")
    if per_decade is not None and not 0 < per_decade <= FINEST:
        raise about("per_decade", f"must be positive and at most {FINEST:g}, not {per_decade}")
    if direction == "ring":
        return _rings(surface, window, level, per_decade)
    return _profiles(surface, 0 if direction == "y" else ndim - 1, window, level, per_decade)


def _rings(surface: Surface, window: SpectralWindow, level: Level, per_decade: float | None) -> PowerSpectrum:
    """Return C2D averaged over rings."""
    grid, windows = surface.grid, tapers(surface, window)
    first = [2 * math.pi / length for length in grid.lengths]
    waves = power_map(surface, window=window, level=level)
    limit = math.pi / max(grid.spacing)
    q, density, count = _ring_means(waves, min(first), limit * (1 - 1e-12), per_decade)
    return PowerSpectrum(
        wavenumber=q,
        density=density,
        kind="C2D",
        count=count,
        freedom=count / 2 / math.prod(along.overlap for along in windows),
        q_min=max(
            (1.0 if periodic else LONGEST) * step for periodic, step in zip(grid.periodic, first, strict=True)
        ),
        q_max=limit,
        smear=sum(along.smear * step**2 for along, step in zip(windows, first, strict=True)) / 2,
    )


def _ring_means(
    waves: PowerMap, least: float, limit: float, per_decade: float | None
) -> tuple[Array, Array, Array]:
    """Return the wavenumber, the density and the number of waves of each ring, `least` wide or many to a decade."""
    size = (
        int(limit / least + 0.5) + 1
        if per_decade is None
        else int(per_decade * math.log10(limit / least)) + 1
    )
    total, logs, number = (np.zeros(size) for _ in range(3))
    # Every column except the first (and the Nyquist one, which is left out) stands for two waves.
    weights = np.where(np.arange(waves.qx.size) == 0, 1.0, 2.0)
    for qy, row in zip(waves.qy, waves.density, strict=True):
        q = np.hypot(qy, waves.qx)
        keep = (q <= limit) & (q > 0)
        q, weight = q[keep], weights[keep]
        ln_q = np.log(q)
        if per_decade is None:
            index = (q / least + 0.5).astype(np.int64)
        else:
            # The tiny shift keeps the longest waves, which lie on the first edge, inside the first bin.
            index = (per_decade / math.log(10) * (ln_q - math.log(least)) + 1e-9).astype(np.int64)
        total += np.bincount(index, weight * row[keep], minlength=size)
        logs += np.bincount(index, weight * ln_q, minlength=size)
        number += np.bincount(index, weight, minlength=size)
    full = number > 0
    return np.exp(logs[full] / number[full]), total[full] / number[full], number[full]


def _profiles(
    surface: Surface, axis: int, window: SpectralWindow, level: Level, per_decade: float | None
) -> PowerSpectrum:
    """Return C1D of the profiles along `axis`."""
    grid = surface.grid
    n, spacing, length = grid.shape[axis], grid.spacing[axis], grid.lengths[axis]
    if n < 3:
        raise InputError(f"a spectrum of profiles needs at least 3 points along them, not {n}")
    along = tapers(surface, window)[axis]
    none = tapers(surface, "none")
    work = prepared(surface, none, level, "a power spectrum")
    work = np.ascontiguousarray(np.atleast_2d(np.moveaxis(work, axis, -1)))
    if level != "none":
        # The remaining mean of a profile after the window would leak into its longest waves.
        work -= (work @ along.values / along.values.sum())[:, None]
    work *= along.values
    waves = scipy.fft.rfft(work, axis=1, overwrite_x=True)[:, 1 : (n + 1) // 2]
    power = waves.real**2 + waves.imag**2
    density = power.mean(axis=0) * length / (2 * math.pi * n**2) / along.power
    freedom = _independent(waves) / along.overlap
    q = 2 * math.pi / length * np.arange(1, density.size + 1)
    periodic = grid.periodic[axis]
    spectrum = PowerSpectrum(
        wavenumber=q,
        density=density,
        kind="C1D",
        count=np.full(q.shape, 2.0 * work.shape[0]),
        freedom=freedom,
        q_min=(1.0 if periodic else LONGEST) * 2 * math.pi / length,
        q_max=math.pi / spacing,
        smear=along.smear * (2 * math.pi / length) ** 2,
    )
    return spectrum if per_decade is None else spectrum.rebinned(per_decade)


def _independent(waves: npt.NDArray[np.complex128]) -> Array:
    """Return the effective number of independent profiles in each column of amplitudes.

    Neighbouring profiles are correlated, but the waves across them are not: with their powers P the number is (sum
    m)^2/sum m^2 of the means m, and the powers of a Gaussian surface have <P^2> = 2 m^2.
    """
    if waves.shape[0] == 1:
        return np.ones(waves.shape[1])
    across = scipy.fft.fft(waves, axis=0)
    power = across.real**2 + across.imag**2
    square = (power**2).sum(axis=0)
    ratio = np.divide(power.sum(axis=0) ** 2, square, out=np.ones(square.shape), where=square > 0)
    return np.asarray(np.clip(2 * ratio - 1, 1, waves.shape[0]))
