"""The spectrum of a map and that of its noise, before they are averaged over bins."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import reduce
from typing import Literal

import numpy as np
from scipy.special import polygamma

from roughcontact.evaluation.noise import Noise
from roughcontact.measurement.instrument import Instrument
from roughcontact.measurement.tip_image import tip_limit
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.surface.analysis.spectra import power_spectrum
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["RESOLUTION_ERROR", "Signal", "assumed_noise", "signal_of"]

# Relative standard deviation of a stated resolution, for which one that is 20 % wrong is covered, and that of C at the
# limit of a tip, in proportion to q: benchmarks/virtual_instruments.py.
RESOLUTION_ERROR = 0.15
_TIP_ERROR = 0.1
_FLAT = -0.5  # exponent of a spectrum from which on noise is taken for white
_STEEPEST = {"C2D": -2.0, "C1D": -1.0}  # of rough surfaces the flattest, H = 0 (thesis, eq. 2.13)


@dataclass(frozen=True, slots=True, eq=False)
class Signal:
    """The power of a map and of its noise at each wavenumber.

    Parameters
    ----------
    spectrum : PowerSpectrum
        Of the map with its noise; of the mean of all repeats if there are repeats.
    noise : array, shape (n,)
        Density of the noise of that spectrum.
    response : array, shape (n,)
        Squared response of the instrument.
    repeats : int
        Number of maps of one place.
    log_blur : array, shape (n,)
        Standard deviation of ln C by the error of the stated resolution and by a tip.
    """

    spectrum: PowerSpectrum
    noise: Array
    response: Array
    repeats: int
    log_blur: Array

    @property
    def density(self) -> Array:
        """Density without noise and blur; it may be negative where noise dominates."""
        return (self.spectrum.density - self.noise) / self.response

    def freedom(self, ratio: Array, waves: Array) -> Array:
        """Return the effective number of waves in means of the density over some waves.

        Of n repeats a pair has the variance ``C^2 + 2 C N/n + N^2/(n (n - 1))``, N the noise of one map.

        Parameters
        ----------
        ratio : array
            Noise over signal, N/C, of one map.
        waves : array
            Number of independent waves.
        """
        n = self.repeats
        return waves / ((1 + ratio) ** 2 if n == 1 else 1 + 2 * ratio / n + ratio**2 / (n * (n - 1)))


def signal_of(
    surfaces: Sequence[Surface],
    noise: Noise | None,
    instrument: Instrument,
    direction: Literal["auto", "ring", "x", "y"] = "auto",
) -> Signal:
    """Return signal and noise of maps of one place: by their differences, or by the noise of a single map."""
    count = len(surfaces)
    spectrum = power_spectrum(reduce(Surface.__add__, surfaces) * (1 / count), direction)
    q = spectrum.wavenumber
    if count > 1:
        each = np.mean([power_spectrum(surface, direction).density for surface in surfaces], axis=0)
        floor = (each - spectrum.density) / (count - 1)
    else:
        floor = np.zeros(q.size) if noise is None else _density(noise, surfaces[0], spectrum)
    blur = (
        np.zeros(q.size) if instrument.resolution is None else (instrument.resolution * q / 2 / math.pi) ** 2
    )
    tip = _TIP_ERROR * tip_limit(surfaces[0], instrument.tip_radius) * q / 2 / math.pi
    error = np.hypot(2 * math.log(4) * blur * RESOLUTION_ERROR, tip)
    return Signal(spectrum, floor, 4.0**-blur, count, error)


def _density(noise: Noise, surface: Surface, spectrum: PowerSpectrum) -> Array:
    """Return the spectrum of noise: white over the cells, or that of its Gaussian covariance."""
    length, q = noise.correlation_length, spectrum.wavenumber
    white = spectrum.kind == "C2D", length <= min(surface.grid.spacing)
    scale = {
        (True, True): surface.grid.cell_area / (2 * math.pi) ** 2,
        (False, True): surface.grid.spacing[-1] / (2 * math.pi),
        (True, False): length**2 / (4 * math.pi),
        (False, False): length / (2 * math.sqrt(math.pi)),
    }[white]
    decay = 0.0 if white[1] else length**2 / 4
    return np.asarray(noise.rms**2 * scale * np.exp(-decay * q**2))


def assumed_noise(surface: Surface) -> Noise | None:
    """Return white noise of the level at which the spectrum of a map ends flat; None if it does not end flat.

    The exponent over the last octave must be above -1/2, and two standard errors above that of any rough surface.
    """
    spectrum = power_spectrum(surface)
    end = float(spectrum.wavenumber[-1])
    last = spectrum.wavenumber > end / 2
    last &= spectrum.density > 0
    if last.sum() < 3:
        return None
    x = np.log(spectrum.wavenumber[last])
    y = np.log(spectrum.density[last])
    weight = 1 / polygamma(1, spectrum.freedom[last])
    x = x - np.average(x, weights=weight)
    slope = float((weight * x * y).sum() / (weight * x**2).sum())
    if slope < max(_FLAT, _STEEPEST[spectrum.kind] + 2 / math.sqrt(float((weight * x**2).sum()))):
        return None
    flat = spectrum.wavenumber > end / math.sqrt(2)
    level = float(np.average(spectrum.density[flat], weights=spectrum.freedom[flat]))
    return Noise(math.sqrt(level / float(_density(Noise(1.0), surface, spectrum)[0])))
