"""Power spectra."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

from roughcontact.labels.engineering_units import Scale, scale
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import TICK, label_axes, outer_axis, readable_ticks
from roughcontact.surface.analysis.hurst import HurstFit
from roughcontact.surface.analysis.power import PowerSpectrum
from roughcontact.validation import Array

__all__ = ["SpectrumScales", "spectrum_axes", "spectrum_curve"]

_POINTS, _LAW, _LIMIT = (
    "#0072b2",
    "#d55e00",
    "0.3",
)  # blue and vermilion: distinct also for colour-blind readers
_DRAWN = 40.0  # bins per decade: more would overlap
_ROOM = 2.0  # factor of space below the lowest density on a logarithmic axis


@dataclass(frozen=True, slots=True)
class SpectrumScales:
    """The units of a picture of spectra, as factors of values in SI.

    Parameters
    ----------
    wavenumber : float
        From radians per metre to radians per unit of the wavelengths.
    density : Scale
        Of C2D [m^4] or C1D [m^3].
    length : Scale
        Of wavelengths [m].
    """

    wavenumber: float
    density: Scale
    length: Scale


def spectrum_curve(
    spectrum: PowerSpectrum, ax: Axes | None = None, *, law: HurstFit | None = None, label: str = "measured"
) -> Axes:
    """Draw a spectrum against the wavenumber, both logarithmic, with the wavelength on the upper axis.

    Reliable bins are drawn strongly, with the band of their standard errors, the others faintly. Many bins are averaged
    to forty per decade.

    Parameters
    ----------
    spectrum : PowerSpectrum
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    law : HurstFit, optional
        A law such as that of `roughcontact.fit_spectrum`, drawn over the band of the fit; vertical lines mark the ends
        of the band.
    label : str
        Label of the spectrum in the legend.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> spectrum = rc.power_spectrum(surface)
    >>> axes = rc.plot.spectrum_curve(spectrum, law=rc.fit_spectrum(spectrum))
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['measured', 'H = 0.806 ± 0.025']
    """
    axes = axes_for(ax)
    shown = spectrum.rebinned(_DRAWN)
    with_power = shown.density > 0  # zeros are left out: the axis is logarithmic
    wavelengths = shown.wavelength[with_power]
    scales = spectrum_axes(axes, shown.kind, wavelengths, shown.density[with_power])
    q, density = shown.wavenumber * scales.wavenumber, shown.density * scales.density.factor
    width = shown.standard_error * scales.density.factor
    inside = (shown.wavenumber >= shown.q_min * (1 - 1e-9)) & (shown.wavenumber <= shown.q_max * (1 + 1e-9))
    axes.plot(q[with_power], density[with_power], ".", color="0.7", markersize=3, zorder=2)
    reliable = inside & with_power
    # The standard error of a bin with few waves may exceed its value: the band ends at half of the value.
    low = np.maximum(density - width, density / 2)
    axes.fill_between(
        q[reliable], low[reliable], (density + width)[reliable], color=_POINTS, alpha=0.2, linewidth=0
    )
    style: Any = {"color": _POINTS, "markersize": 4, "linewidth": 0.8, "zorder": 3}
    axes.plot(q[reliable], density[reliable], ".-", label=label, **style)
    if law is not None:
        _draw_law(axes, law, scales)
    # Last, because a fixed limit stops the automatic scaling of the axis.
    axes.set_ylim(bottom=float(density[with_power].min()) / _ROOM)
    axes.legend(loc="lower left", fontsize=TICK, frameon=False)
    return axes


def spectrum_axes(axes: Axes, kind: str, wavelengths: Array, densities: Array) -> SpectrumScales:
    """Make axes logarithmic, label them, and put wavelengths on the upper one; return the scales to draw with.

    Parameters
    ----------
    axes : Axes
    kind : {"C2D", "C1D"}
    wavelengths, densities : array
        All values that will be drawn [m; m^4 or m^3]; the units follow from them.
    """
    length = scale(math.sqrt(float(wavelengths.min()) * float(wavelengths.max())), "m")
    density = scale(float(densities.max()), {"C2D": "m4", "C1D": "m3"}[kind])
    axes.set(xscale="log", yscale="log")
    power_name = rf"power spectrum $C_{{\mathrm{{{kind[1:]}}}}}$ [{density.unit}]"
    label_axes(axes, f"wavenumber q [rad/{length.unit}]", power_name, grid=True)
    low, high = (2 * math.pi / (w * length.factor) for w in (wavelengths.max(), wavelengths.min()))
    axes.set_xlim(low / 1.3, high * 1.3)
    top = outer_axis(axes, "top", f"wavelength [{length.unit}]", (_other, _other))
    for axis in (axes.xaxis, top.xaxis):
        readable_ticks(axis, high / low)
    return SpectrumScales(1 / length.factor, density, length)


def _draw_law(axes: Axes, law: HurstFit, scales: SpectrumScales) -> None:
    ends = (law.rolloff, law.long_cutoff, law.short_cutoff)
    # The corners are among the points, so that a plateau ends exactly there.
    corners = [2 * math.pi / w for w in ends if w is not None]
    q = np.unique(np.concatenate([np.geomspace(*law.band, 200), np.clip(corners, *law.band)]))
    values = law(q)
    drawn = values > 0
    label = f"H = {law.hurst:.3f} ± {law.standard_error:.3f}"
    x, y = q[drawn] * scales.wavenumber, values[drawn] * scales.density.factor
    axes.plot(x, y, color=_LAW, linewidth=1.8, zorder=4, label=label)
    for wavelength, name in zip(ends, ("roll-off", "long cut-off", "short cut-off"), strict=True):
        if wavelength is not None:
            text = f"{name} {wavelength * scales.length.factor:.3g} {scales.length.unit}"
            # The spectrum leaves room below it at long waves, and above it at short waves.
            height, side = (0.98, "top") if name == "short cut-off" else (0.2, "bottom")
            _mark(axes, (2 * math.pi / wavelength * scales.wavenumber, height), text, va=side)


def _mark(axes: Axes, place: tuple[float, float], words: str, **given: Any) -> None:
    """Draw a vertical line with words beside it, at a wavenumber and a part of the height of the axes."""
    axes.axvline(place[0], color=_LIMIT, linewidth=0.9, linestyle=(0, (6, 3)), zorder=1)
    style: Any = {"rotation": 90, "fontsize": TICK, "color": _LIMIT} | given
    axes.annotate(words, place, (3, 0), axes.get_xaxis_transform(), "offset points", **style)


def _other(value: npt.ArrayLike) -> Array:
    """Return the wavelength of a wavenumber, or the reverse; Matplotlib calls it with 0 before anything is drawn."""
    given = np.asarray(value, dtype=np.float64)
    return np.asarray(2 * np.pi / np.where(given == 0, np.finfo(float).tiny ** 0.5, given))
