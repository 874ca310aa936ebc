"""What figures 31 and 32 have in common: one fractal dimension, all realisations, and the slope of eq. 4.31."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import TICK
from roughcontact.thesis.asperity_ensembles import CHOSEN as _SHARED
from roughcontact.thesis.asperity_ensembles import SPOTS, asperity_averages, asperity_study, law_exponent
from roughcontact.thesis.stiffness_view import stiffness_axes
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

__all__ = ["CHOSEN", "SIZE", "averages_of", "draw", "linear", "studies", "words_of"]

CHOSEN = (*_SHARED, "25 surfaces, on the small scale 8, all shown")
SIZE = (5.8, 4.4)
_SPOTS, _CLASSICAL, _SLOPE = "#c8290b", "#0072b2", "#2e8b2e"


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the study of asperities that figures 31 to 33 share."""
    return (asperity_study(scale),)


def averages_of(asperities: xarray.Dataset, hurst: float) -> xarray.Dataset:
    """Return every realisation of one fractal dimension, with means and power laws."""
    return asperity_averages(asperities.sel(hurst=[hurst])).isel(hurst=0)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw every realisation with interaction, the classical model, and the slope."""
    axes = figure.subplots()
    stiffness_axes(axes)
    force = averages["force"].to_numpy()
    # The spots of all surfaces lie in their load's column: a little aside each, so that they can be counted.
    aside = np.linspace(-0.35, 0.35, averages.sizes["sample"]) * np.log(force[1] / force[0])
    every = averages["stiffness"].transpose("sample", "load").to_numpy()
    for curve, shift in zip(every, aside, strict=True):
        axes.plot(force * np.exp(shift), curve, ".", color=_SPOTS, markersize=2.2, zorder=2)
    axes.plot([], [], ".", color=_SPOTS, markersize=5, label=f"with interaction, {len(every)} surfaces")
    mean = averages["independent"].mean("sample")
    axes.plot(
        force, mean, color=_CLASSICAL, linewidth=1.0, linestyle="--", label="the same summits, independent"
    )
    axes.plot(force, averages["classical"], color=_CLASSICAL, linewidth=1.6, label="Greenwood and Williamson")
    low, high = float(averages["window_low"]), float(averages["window_high"])
    alpha = law_exponent(float(averages["hurst"]))
    middle = np.sqrt(low * high)
    means = averages["stiffness"].mean("sample").to_numpy()
    here = 0.4 * np.exp(np.interp(np.log(middle), np.log(force), np.log(means)))
    x = np.array([low, high])
    axes.plot(x, here * (x / middle) ** alpha, "--", color=_SLOPE, linewidth=2.0, label=f"slope {alpha:.4f}")
    axes.axvspan(force[0] * np.exp(aside[0]), low, color="0.95", zorder=0)
    axes.text(
        force[0], means[-1], f"fewer than {SPOTS:g} summits\nin contact", fontsize=TICK, color="0.4", va="top"
    )
    axes.set_xlim(force[0] * np.exp(aside[0]), force[-1] * np.exp(aside[-1]))
    axes.legend(fontsize=TICK, frameon=False, loc="lower right")


def words_of(averages: xarray.Dataset, prefix: str = "") -> str:
    """Return an exponent with its error, and where it was found."""
    error = f" +- {float(averages[f'{prefix}exponent_error']):.3f}" if prefix != "classical_" else ""
    return (
        f"{float(averages[f'{prefix}exponent']):.3f}{error} at forces from {float(averages['window_low']):.1g} to "
        f"{float(averages['window_high']):.2g}"
    )


def linear(averages: xarray.Dataset, here: str) -> Verdict:
    """Return whether the model of Greenwood and Williamson is linear, `here` in words."""
    return Verdict(
        "the original model is linear", "slope 1", here, float(averages["classical_exponent"]) > 0.85
    )
