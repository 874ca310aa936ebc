"""Figure 21: stiffness of rough surfaces against force, from the power law to saturation."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import TICK
from roughcontact.theory.punch.polygon import SQUARE
from roughcontact.thesis.ensembles import curve_averages, curve_fits, saturation_study
from roughcontact.thesis.stiffness_view import colour_key, hurst_colours, stiffness_axes
from roughcontact.thesis.verdict import Verdict, judged

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "stiffness of rough surfaces against force up to saturation"
PLATEAU = 1.1419  # thesis, eq. 4.14: 1.012 times 2/sqrt(pi)
CHOSEN = (
    "free squares of 1025 x 1025 cells, 3 samples (small: 129 x 129, 6); the thesis gives neither samples nor forces",
    "H = 0, 0.2, ..., 1: fractal dimensions 3 to 2; forces F/(E* h L) from 1e-4 to 300 in equal ratios",
    "arithmetic means over the samples; open circles below the stiffness of 20 cells",
)
SIZE = (6.4, 4.4)


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the one study: six Hurst exponents to full contact."""
    return (saturation_study(scale),)


def averages(squares: xarray.Dataset) -> xarray.Dataset:
    """Return mean stiffnesses, and power laws where three forces lie in their window."""
    found = curve_averages(squares)
    fits = curve_fits(squares)
    for name in ("exponent", "exponent_error", "prefactor", "prefactor_error", "window_low", "window_high"):
        found[name] = fits[name]
    return found


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the mean stiffness for each Hurst exponent up to the stiffness of the square punch."""
    axes = figure.subplots()
    stiffness_axes(axes)
    hurst, force = averages["hurst"].to_numpy(), averages["force"].to_numpy()
    colours = hurst_colours(hurst[0], hurst[-1])
    for each in hurst:
        one, colour = averages.sel(hurst=each), colours.to_rgba(each)
        shown = one["resolved"] | (one["stiffness"] > 0.5)
        axes.plot(force, one["stiffness"], "-", color=colour, linewidth=0.9, zorder=2)
        axes.plot(
            force, one["stiffness"].where(~shown), "o", color=colour, markersize=3, fillstyle="none", zorder=3
        )
        axes.plot(force, one["stiffness"].where(shown), "o", color=colour, markersize=3, zorder=3)
    cell = 20 * float(averages["cell_stiffness"].max())
    for level, words, style in (
        (SQUARE.value, f"square punch, {SQUARE.value:.4f}", "-"),
        (cell, "20 cells", (0, (6, 3))),
    ):
        axes.axhline(level, color="0.35", linewidth=0.9, linestyle=style, zorder=1)
        axes.annotate(
            words, (force[0], level), (2, 2), textcoords="offset points", fontsize=TICK, color="0.3"
        )
    law = np.geomspace(4e-3, 0.1, 2)
    for each, place in ((hurst[0], 1.3), (hurst[-1], 1.15)):
        axes.plot(
            law, place * law ** (1 / (1 + each)), "--", color=colours.to_rgba(each), linewidth=1.1, zorder=2
        )
    axes.plot([], [], "--", color="0.3", linewidth=1.1, label="slopes 1/(H + 1) of H = 0 and 1")
    axes.legend(fontsize=TICK, frameon=False, loc="lower right")
    axes.set(xlim=(force[0] / 1.3, force[-1] * 1.3), ylim=(float(averages["stiffness"].min()) / 1.5, 2))
    colour_key(figure, axes, colours, hurst[-1])


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare the plateau with the thesis' number, and the beginning with a power law."""
    last, cells = averages["stiffness"].isel(load=-1), averages.attrs["cells"]
    plateau, spread = float(last.mean()), float(last.max() - last.min())
    alpha = averages["exponent"].dropna("hurst")
    listed = (
        ", ".join(f"{float(a):.2f} (H = {float(a['hurst']):g})" for a in alpha) or "too few forces resolved"
    )
    said = f"{averages.attrs['surfaces']} surfaces of {cells}² cells a value"
    law = alpha * (alpha["hurst"] + 1) - 1
    error = averages["exponent_error"].sel(hurst=alpha["hurst"]) * (alpha["hurst"] + 1)
    return (
        Verdict(
            "the stiffness saturates in full contact",
            f"k/(E* L) = {PLATEAU}",
            f"{plateau:.4f} at a force of {float(averages['force'][-1]):g}, the same for all H to {spread:.1g}; of "
            f"ever finer cells {SQUARE.value:.4f}: the thesis' number is {1 - PLATEAU / SQUARE.value:.1%} too low",
            bool(abs(plateau / PLATEAU - 1) < 0.002),
        ),
        Verdict(
            "a power law for smaller forces",
            "1/(H + 1) in section 4.4, read from newer data",
            f"exponents {listed}; {said}",
            judged(law, error, 0.1) if alpha.size else None,
        ),
        Verdict(
            "where saturation sets in",
            "about the force at which the power law reaches it",
            f"half of the plateau at forces of {_half(averages)}",
            None,
        ),
    )


def _half(averages: xarray.Dataset) -> str:
    """Return the forces at which the stiffness is half of what it becomes, from the lowest H to the highest."""
    force = np.log(averages["force"].to_numpy())
    places = []
    for hurst in averages["hurst"].to_numpy():
        stiffness = np.log(averages["stiffness"].sel(hurst=hurst).to_numpy())
        places.append(math.exp(np.interp(stiffness[-1] - math.log(2), stiffness, force)))
    return f"{min(places):.2f} to {max(places):.2f}"
