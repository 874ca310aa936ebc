"""The combined spectrum of many measurements, and the spectrum of each of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.axes import Axes

from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import TICK
from roughcontact.plot.spectrum_plot import spectrum_axes
from roughcontact.validation import numeric

if TYPE_CHECKING:
    from roughcontact.measurement.combined_spectrum import CombinedSpectrum

__all__ = ["combined_spectrum"]

_MEAN, _OUT = "#0072b2", "#d55e00"


@numeric
def combined_spectrum(spectrum: CombinedSpectrum, ax: Axes | None = None, *, level: float = 0.95) -> Axes:
    """Draw each measurement in its band, their mean, and its interval; those that differ are dashed and named.

    Parameters
    ----------
    spectrum : CombinedSpectrum
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    level : float
        Probability of the interval.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> places = {name: rc.self_affine(rc.Grid((64, 64), 1e-6), 0.8, 1e-7, seed) for seed, name in enumerate("abc")}
    >>> axes = rc.plot.combined_spectrum(rc.Measurements.of(places).combined_spectrum())
    >>> [text.get_text() for text in axes.get_legend().get_texts()]
    ['95 % interval', '3 measurements', 'mean']
    """
    axes = axes_for(ax)
    low, high = spectrum.interval(level)
    scales = spectrum_axes(axes, spectrum.kind, spectrum.wavelength, spectrum.density)
    q, unit = spectrum.wavenumber * scales.wavenumber, scales.density.factor
    axes.fill_between(
        q, low * unit, high * unit, color=_MEAN, alpha=0.2, linewidth=0, label=f"{100 * level:g} % interval"
    )
    label: str | None = f"{len(spectrum.names) - len(spectrum.outlying)} measurements"
    for name, density in zip(spectrum.names, spectrum.map_density, strict=True):
        if name in spectrum.outlying:
            axes.plot(q, density * unit, "--", color=_OUT, linewidth=1.0, label=f"{name}: differs")
        else:
            axes.plot(q, density * unit, color="0.6", linewidth=0.7, label=label)
            label = None
    axes.plot(q, spectrum.density * unit, ".-", color=_MEAN, markersize=4, linewidth=1.2, label="mean")
    axes.legend(loc="lower left", fontsize=TICK, frameon=False)
    return axes
