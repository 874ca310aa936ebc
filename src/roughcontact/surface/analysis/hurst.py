"""The Hurst exponent from a power spectrum, by likelihood."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt
from scipy.special import chdtri

from roughcontact.errors import InputError, about
from roughcontact.surface.analysis.limits import Limit, clear_bins, find_limits, sharpened, step_at
from roughcontact.surface.analysis.power import PowerSpectrum, require_measured
from roughcontact.surface.analysis.preprocess import SpectralWindow
from roughcontact.surface.analysis.spectra import power_spectrum
from roughcontact.surface.analysis.whittle import likeliest, slope_error, smearing
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric

__all__ = ["HurstFit", "fit_spectrum", "hurst_exponent"]

# Bins narrow enough that a law as steep as q^-8 is straight in each to 1e-3.
FINE = 200.0
# Probability of a larger misfit by chance below which the law counts as violated.
RARE = 1e-3


@dataclass(frozen=True, slots=True)
class HurstFit:
    """A self-affine law fitted to a surface.

    Attributes
    ----------
    hurst : float
        Hurst exponent H.
    standard_error : float
        Standard error of H, for a Gaussian surface that follows the law. On a long free strip it does not include the
        bias of the window, which does not fall with the length: one to two standard errors at 16 x 4096 cells.
    density : float
        Density of the law at `wavenumber`: C2D [m^4] or C1D [m^3].
    wavenumber : float
        Where the law has this density [rad/m].
    kind : {"C2D", "C1D"}
        Which density: of the surface or of its profiles.
    rolloff : float or None
        Waves longer than this [m] have its amplitude (thesis, fig. 34).
    long_cutoff : float or None
        Waves longer than this [m] are outside the law.
    short_cutoff : float or None
        Waves shorter than this [m] are outside the law.
    misfit : float
        Mean square of the deviations in units of their expected scatter: near 1 where the law holds, for
        a windowed spectrum about 0.6, since neighbouring bins share waves.
        The standard error is only valid if the law holds, except that of `fit_structure`.
    band : tuple of float
        Wavenumbers [rad/m] of the fit; for a structure function 2 pi over its lags.
    freedom : int
        Number of independent deviations over which the misfit is averaged.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1), rolloff=2e-5)
    >>> fit = rc.hurst_exponent(surface)
    >>> f"H = {fit.hurst:.2f} +- {fit.standard_error:.2f}, roll-off at {fit.rolloff * 1e6:.0f} um"
    'H = 0.80 +- 0.03, roll-off at 20 um'
    """

    hurst: float
    standard_error: float
    density: float
    wavenumber: float
    kind: Literal["C2D", "C1D"]
    rolloff: float | None
    long_cutoff: float | None
    short_cutoff: float | None
    misfit: float
    band: tuple[float, float]
    freedom: int = 1

    @property
    def chance(self) -> float:
        """Misfit that chance exceeds for one in a thousand surfaces that follow the law (chi-squared)."""
        return float(chdtri(self.freedom, RARE)) / self.freedom

    @property
    def longest_wave(self) -> float:
        """Length of the longest waves [m]: the roll-off or the long cut-off, or the longest wave of the fit."""
        return self.rolloff or self.long_cutoff or 2 * math.pi / self.band[0]

    @property
    def exponent(self) -> float:
        """Exponent of the decay of the density: 2(H + 1) for C2D, 2H + 1 for C1D (thesis, eqs 2.8 and 2.10)."""
        return 2 * self.hurst + (2 if self.kind == "C2D" else 1)

    @numeric
    def __call__(self, wavenumber: npt.ArrayLike) -> Array:
        """Return the density of the law, zero outside its limits.

        Parameters
        ----------
        wavenumber : array
            Wavenumbers [rad/m].

        Returns
        -------
        array, the same shape
            C2D [m^4] or C1D [m^3].
        """
        q = np.asarray(wavenumber, dtype=np.float64)
        bent = q if self.rolloff is None else np.maximum(q, 2 * np.pi / self.rolloff)
        law = self.density * (bent / self.wavenumber) ** -self.exponent
        if self.long_cutoff is not None:
            law = np.where(q < 2 * np.pi / self.long_cutoff, 0.0, law)
        if self.short_cutoff is not None:
            law = np.where(q > 2 * np.pi / self.short_cutoff, 0.0, law)
        return np.asarray(law)


@numeric(q_min="rad/m", q_max="rad/m")
def hurst_exponent(
    surface: Surface,
    *,
    limit: Limit = "auto",
    q_min: float | None = None,
    q_max: float | None = None,
    window: SpectralWindow = "auto",
) -> HurstFit:
    """Return the Hurst exponent of a surface or line from its power spectrum, with its standard error.

    Parameters
    ----------
    surface : Surface
        Without missing points. A surface of two axes is assumed to be isotropic.
    limit : {"auto", "none", "rolloff", "long_cutoff"}
        How the law may end, see `fit_spectrum`.
    q_min, q_max : float, optional
        The band to fit [rad/m]; by default the reliable band. Cut the spectrum of a measured surface where the
        instrument no longer resolves the waves, see `PowerSpectrum`.
    window : {"auto", "none", "hann", "hamming", "blackman", "welch", "tukey"}
        See `power_spectrum`.

    Returns
    -------
    HurstFit
        The exponent, its standard error and the law.

    Raises
    ------
    ValueError
        If points are missing or the band holds too few waves.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> fit = rc.hurst_exponent(surface)
    >>> f"H = {fit.hurst:.1f}, {fit.kind}"
    'H = 0.8, C2D'
    """
    spectrum = power_spectrum(surface, "auto", window=window, per_decade=FINE)
    return fit_spectrum(spectrum, limit=limit, q_min=q_min, q_max=q_max)


@numeric(q_min="rad/m", q_max="rad/m")
def fit_spectrum(
    spectrum: PowerSpectrum,
    *,
    limit: Limit = "auto",
    q_min: float | None = None,
    q_max: float | None = None,
) -> HurstFit:
    """Return the self-affine law of maximum likelihood for a `spectrum`.

    The powers of the waves of a Gaussian surface are independent and exponentially distributed about the
    spectrum (Whittle's likelihood), and their means over bins follow a Gamma distribution. No logarithm of a noisy
    density is taken, which avoids its bias.

    Parameters
    ----------
    spectrum : PowerSpectrum
        Its bins must be narrow compared with the changes of the law: ``power_spectrum(..., per_decade=200)``. The
        first few rings of one wave's width are too wide.
    limit : {"auto", "none", "rolloff", "long_cutoff"}
        How the law ends toward long waves: not in the band, in a plateau, or in a drop to another level. Except with
        "none", it may also end in another level toward short waves. With "auto" an end is used only if it raises the
        likelihood by more than chance.
    q_min, q_max : float, optional
        The band to fit [rad/m]; by default the reliable band.

    Returns
    -------
    HurstFit
        The exponent, its standard error and the law.

    Raises
    ------
    ValueError
        If the band holds fewer than four bins, or no power.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> spectrum = rc.power_spectrum(surface, per_decade=200)
    >>> f"H = {rc.fit_spectrum(spectrum, limit='none').hurst:.1f}"
    'H = 0.8'
    """
    if limit not in ("auto", "none", "rolloff", "long_cutoff"):
        raise about("limit", f"must be 'auto', 'none', 'rolloff' or 'long_cutoff', not {limit!r}")
    require_measured(spectrum)
    band = spectrum.within(q_min, q_max)
    if band.wavenumber.size < 4 or not band.density.any():
        raise InputError(
            f"a fit needs four bins with power: there are {np.count_nonzero(band.density)} between "
            f"{band.q_min:g} and {band.q_max:g} rad/m"
        )
    limits = find_limits(band, limit)
    bend = math.log(band.wavenumber[limits.bend]) if limits.bend else -math.inf
    centre = float(np.average(np.log(band.wavenumber), weights=band.freedom))
    edges = (step_at(band, limits.first), step_at(band, limits.last))
    for _ in range(3):  # under a window the law and the positions of its limits depend on each other
        inside = clear_bins(band, limits, edges)
        q = band.wavenumber[inside]
        slope = likeliest(np.maximum(np.log(q), bend) - centre, band, inside)
        if band.smear == 0:
            break
        edges = (
            sharpened(band, slope, centre, edges[0], True),
            sharpened(band, slope, centre, edges[1], False),
        )

    hurst = (slope.exponent - (2 if band.kind == "C2D" else 1)) / 2
    law = np.exp(slope.level - slope.exponent * (np.maximum(np.log(q), bend) - centre))
    law *= 1 + smearing(slope.exponent, band, inside)
    squares = _squared_deviations(q, band.density[inside] / law, band.freedom[inside])
    return HurstFit(
        hurst=hurst,
        standard_error=slope_error(np.log(q), bend, slope.exponent, band.freedom[inside]) / 2,
        density=math.exp(slope.level),
        wavenumber=math.exp(centre),
        kind=band.kind,
        rolloff=2 * math.pi / math.exp(bend) if limits.bend else None,
        long_cutoff=_wavelength(edges[0]),
        short_cutoff=_wavelength(edges[1]),
        misfit=float(np.mean(squares)),
        band=(float(band.wavenumber[0]), float(band.wavenumber[-1])),
        freedom=squares.size,
    )


def _wavelength(wavenumber: float) -> float | None:
    return None if math.isnan(wavenumber) else 2 * math.pi / wavenumber


def _squared_deviations(q: Array, ratio: Array, freedom: Array) -> Array:
    """Return the squared deviations of the `ratio` from 1 over its variance, in bins of a twentieth decade."""
    # In narrower bins, waves under one window are correlated over several bins, and `freedom` would be too low.
    group = np.unique(np.floor(20 * np.log10(q)), return_inverse=True)[1]
    total = np.bincount(group, freedom)
    mean = np.bincount(group, freedom * ratio) / total
    return np.asarray(total * (mean - 1) ** 2)
