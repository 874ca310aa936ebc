"""Figure 14: the spectrum of one surface, merged from what several instruments see of it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.optimize import brentq

import roughcontact as rc
from roughcontact.plot.spectrum_plot import SpectrumScales, spectrum_axes
from roughcontact_thesis import drawing

__all__ = ["MergedSpectra", "SimulatedInstrument", "case", "draw"]

TITLE = "spectra of one surface by several instruments, merged"
HURST = 0.68  # stated, as is the rms height
RMS = 0.5e-6
LENGTH = 200e-6
POINTS = 2048
SEED = 14
_CELLS = 8.0  # pixels to the shortest wave: an average over pixels leaves 95 % of its power
_TIP = 4.0  # curvature of the tip over the rms curvature of the waves that it follows
_FINE = 200.0


@dataclass(frozen=True, slots=True)
class SimulatedInstrument:
    """What an instrument sees: a field, through a tip, in pixels.

    Parameters
    ----------
    name : str
    field : float
        Side of the map over that of the surface.
    tip_radius : float or None
        [m]; without one heights are averaged over pixels.
    pixel : int
        Cells of the surface a pixel.
    """

    name: str
    field: float
    tip_radius: float | None
    pixel: int


INSTRUMENTS = (
    SimulatedInstrument("stylus, tip 2 µm", 1.0, 2e-6, 4),
    SimulatedInstrument("optical, pixel 0.4 µm", 1 / 4, None, 4),
    SimulatedInstrument("probe, tip 50 nm", 1 / 16, 50e-9, 1),
)
CHOSEN = (
    "synthetic: the measured plate is replaced by one generated surface, and its instruments by simulated ones",
    f"surface: {POINTS} x {POINTS} points over {LENGTH * 1e6:g} µm, periodic, Gaussian amplitudes",
    *(
        f"{each.name}: field {each.field * LENGTH * 1e6:g} µm, pixel {each.pixel * LENGTH / POINTS * 1e6:.2g} µm"
        for each in INSTRUMENTS
    ),
    "bands: from a third of the field (the whole field where it is the period) to eight pixels, or to where the rms "
    "curvature of the known law is a quarter of the tip's",
)
SIZE = (drawing.COLUMN, 3.9)

_STYLES = (("#0072b2", "o"), ("#009e73", "s"), ("#b0508a", "^"))


@dataclass(frozen=True, slots=True)
class MergedSpectra:
    """What the instruments found, what that makes together, and what it should be."""

    single: tuple[rc.PowerSpectrum, ...]
    merged: rc.PowerSpectrum
    fit: rc.HurstFit
    law: rc.SelfAffineSpectrum


def case(seed: int = SEED, points: int = POINTS) -> MergedSpectra:
    """Return the spectra C2D [m^4] that each instrument finds, and the one merged from their reliable bands."""
    grid = rc.Grid((points, points), LENGTH / points, periodic=True)
    surface = rc.self_affine(grid, HURST, RMS, np.random.default_rng(seed), amplitudes="gaussian")
    law = rc.SelfAffineSpectrum(HURST).scaled(RMS, grid)
    single = tuple(_measured(surface, each, law) for each in INSTRUMENTS)
    merged = rc.merge_spectra(single, per_decade=_FINE)
    return MergedSpectra(single, merged, rc.fit_spectrum(merged, limit="none"), law)


def draw(figure: Figure, data: MergedSpectra) -> None:
    """Draw the spectrum of each instrument, the merged one, and the law of the surface."""
    axes = figure.subplots()
    merged = data.merged.rebinned(20)
    wavelengths = np.concatenate([each.wavelength for each in data.single])
    scales = spectrum_axes(axes, "C2D", wavelengths, np.concatenate([each.density for each in data.single]))
    for instrument, spectrum, style in zip(INSTRUMENTS, data.single, _STYLES, strict=True):
        _spectrum(axes, spectrum.rebinned(12), scales, style, instrument.name)
    words = f"merged: H = {data.fit.hurst:.3f} ± {data.fit.standard_error:.3f}"
    q, density = merged.wavenumber * scales.wavenumber, merged.density * scales.density.factor
    axes.plot(q, density, color="black", zorder=4, label=words)
    q = 2 * math.pi / np.array([wavelengths.max(), wavelengths.min()])
    law, words = data.law(q) * scales.density.factor, f"the surface: H = {HURST:g}"
    axes.plot(q * scales.wavenumber, law, ":", color="#d55e00", linewidth=1.8, zorder=5, label=words)
    drawing.legend_below(axes)


def _measured(
    surface: rc.Surface, instrument: SimulatedInstrument, law: rc.SelfAffineSpectrum
) -> rc.PowerSpectrum:
    """Return the spectrum that an instrument finds, with the band in which it is to be relied upon."""
    seen = surface
    if instrument.field < 1:
        size = round(surface.grid.shape[0] * instrument.field)
        # Each looks at another place.
        start = round(size * (1 / instrument.field - 1) / 2)
        seen = seen.cropped(slice(start, start + size), slice(start, start + size))
    if instrument.tip_radius is None:
        seen = seen.averaged(instrument.pixel)
        shortest = _CELLS * seen.grid.spacing[0]
    else:
        seen = seen.scanned(instrument.tip_radius, "paraboloid")
        seen = seen.downsampled(instrument.pixel, anti_alias=False)
        shortest = max(_followed(law, instrument.tip_radius), _CELLS * seen.grid.spacing[0])
    found = rc.power_spectrum(seen, per_decade=_FINE)
    return replace(found, q_max=2 * math.pi / shortest)


def _followed(law: rc.SelfAffineSpectrum, radius: float) -> float:
    """Return the shortest wavelength [m] down to which the rms curvature of the law is a quarter of the tip's."""

    def excess(ln_wavelength: float) -> float:
        part = replace(law, long_cutoff=LENGTH, short_cutoff=math.exp(ln_wavelength))
        return part.moments().rms_curvature * _TIP * radius - 1

    low, high = math.log(LENGTH * 1e-8), math.log(LENGTH * 0.999)
    return math.exp(float(brentq(excess, low, high)))


def _spectrum(
    axes: Axes, spectrum: rc.PowerSpectrum, scales: SpectrumScales, style: tuple[str, str], name: str
) -> None:
    """Draw what is to be relied upon filled, the rest open."""
    colour, mark = style
    q, density = spectrum.wavenumber * scales.wavenumber, spectrum.density * scales.density.factor
    inside = (spectrum.wavenumber >= spectrum.q_min * (1 - 1e-9)) & (spectrum.wavenumber <= spectrum.q_max)
    axes.plot(q[inside], density[inside], mark, color=colour, markersize=5, zorder=3, label=name)
    beyond: Any = {"markerfacecolor": "none", "zorder": 2, "alpha": 0.6}
    axes.plot(q[~inside], density[~inside], mark, color=colour, markersize=5, **beyond)
