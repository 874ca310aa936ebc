"""Figure 21: stiffness of rough surfaces against force, from the power law to full contact."""

from __future__ import annotations

import math

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.plot.level import level
from roughcontact.statistics.fit_window import CELLS
from roughcontact.theory.punch.polygon import SQUARE
from roughcontact.thesis import drawing
from roughcontact.thesis.ensembles import curve_averages, curve_fits, full_contact_study
from roughcontact.thesis.figures import Scale, Studies
from roughcontact.thesis.verdict import Verdict, Verdicts, counted, judged

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "stiffness of rough surfaces against force up to full contact"
PLATEAU = 1.1419  # thesis, eq. 4.14: 1.012 times 2/sqrt(pi)
CHOSEN = (
    "free squares of 1025 x 1025 cells, 3 samples (small: 129 x 129, 6); the thesis gives neither samples nor forces",
    "H = 0, 0.2, ..., 1: fractal dimensions 3 to 2; forces F/(E* h L) from 1e-4 to 300 in equal ratios",
    "arithmetic means over the samples; open circles below the stiffness of 20 cells",
)
SIZE = (6.4, 4.4)


def studies(scale: Scale) -> Studies:
    """Return the one study: six Hurst exponents to full contact."""
    return (full_contact_study(scale),)


def averages(squares: xarray.Dataset) -> xarray.Dataset:
    """Return mean stiffnesses, and power laws where three forces lie in their window."""
    names = ["exponent", "exponent_error", "prefactor", "prefactor_error", "window_low", "window_high"]
    return curve_averages(squares).assign(curve_fits(squares)[names].data_vars)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the mean stiffness for each Hurst exponent up to the stiffness of the square punch."""
    axes = figure.subplots()
    force, law = averages["force"].to_numpy(), np.geomspace(4e-3, 0.1, 2)
    places = {0.0: 1.3, 1.0: 1.15}  # of the laws
    for hurst, one, colour in drawing.by_hurst(averages):
        shown = one["resolved"] | (one["stiffness"] > 0.5)
        axes.plot(force, one["stiffness"], "-", color=colour, linewidth=0.9, zorder=2)
        for chosen, fill in ((~shown, "none"), (shown, "full")):
            points = one["stiffness"].where(chosen)
            axes.plot(force, points, "o", color=colour, markersize=3, fillstyle=fill, zorder=3)
        if hurst in places:
            axes.plot(law, places[hurst] * law ** (1 / (1 + hurst)), "--", color=colour, zorder=2)
    level(axes, SQUARE.value, f"square punch, {SQUARE.value:.4f}", "-")
    level(axes, CELLS * float(averages["cell_stiffness"].max()), "20 cells", (0, (6, 3)))
    drawing.key(axes, "--", "slopes 1/(H + 1) of H = 0 and 1")
    axes.legend(loc="lower right")
    lowest = float(averages["stiffness"].min())
    drawing.stiffness_axes(axes, xlim=(force[0] / 1.3, force[-1] * 1.3), ylim=(lowest / 1.5, 2))
    drawing.colour_key(figure, axes, averages["hurst"].to_numpy())


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the plateau with the thesis' number, and the beginning with a power law."""
    last = averages["stiffness"].isel(load=-1)
    plateau, spread = float(last.mean()), float(last.max() - last.min())
    alpha = averages["exponent"].dropna("hurst")
    each = ", ".join(f"{float(a):.2f} (H = {float(a['hurst']):g})" for a in alpha)
    law = alpha * (alpha["hurst"] + 1) - 1
    error = averages["exponent_error"].sel(hurst=alpha["hurst"]) * (alpha["hurst"] + 1)
    yield Verdict(
        "the stiffness saturates in full contact",
        f"k/(E* L) = {PLATEAU}",
        f"{plateau:.4f} at a force of {float(averages['force'][-1]):g}, the same for all H to {spread:.1g}; of ever "
        f"finer cells {SQUARE.value:.4f}: the thesis' number is {1 - PLATEAU / SQUARE.value:.1%} too low",
        bool(abs(plateau / PLATEAU - 1) < 0.002),
    )
    yield Verdict(
        "a power law for smaller forces",
        "1/(H + 1) in section 4.4, read from newer data",
        f"exponents {each or 'too few forces resolved'}; {counted(averages, 'surfaces')} a value",
        judged(law, error, 0.1) if alpha.size else None,
    )
    yield Verdict(
        "where full contact sets in",
        "about the force at which the power law reaches it",
        f"half of the plateau at forces of {_half(averages)}",
        None,
    )


def _half(averages: xarray.Dataset) -> str:
    """Return the forces at which the stiffness is half of what it becomes, from the lowest H to the highest."""
    force = np.log(averages["force"].to_numpy())
    curves = np.log(averages["stiffness"].transpose("hurst", "load").to_numpy())
    places = [math.exp(np.interp(curve[-1] - math.log(2), curve, force)) for curve in curves]
    return f"{min(places):.2f} to {max(places):.2f}"
