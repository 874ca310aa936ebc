"""Figure 21: stiffness of rough surfaces against force, from the power law to full contact."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.plot.drawing.level import level
from roughcontact.statistics.fit_window import CELLS
from roughcontact.theory.spheres_and_punches.punch.polygon import SQUARE
from roughcontact_thesis import bounds, drawing
from roughcontact_thesis.ensembles import curve_averages, curve_fits, full_contact_study
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import ruled, undecided
from roughcontact_thesis.verdict import Verdict, Verdicts, counted

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "stiffness of rough surfaces against force up to full contact"
BENT = 0.05  # of the stiffness: what a power law may miss
SHAPE = 0.05  # of the stiffness: what a shape that plays no role may change
CHOSEN = (
    "free squares of 1025 x 1025 cells, 3 samples (small: 129 x 129, 6); the thesis gives neither samples nor forces",
    "H = 0, 0.2, ..., 1: fractal dimensions 3 to 2; forces F/(E* h L) from 1e-4 to 300 in equal ratios",
    "arithmetic means over the samples; open circles below the stiffness of 20 cells",
)
SIZE = (drawing.COLUMN, 3.2)


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
            fewer = one.assign(stiffness=points)
            given = {"fmt": "o", "color": colour, "markersize": 3, "fillstyle": fill, "zorder": 3}
            drawing.with_errors(axes, fewer, "stiffness", **given)
        if hurst in places:
            axes.plot(law, places[hurst] * law ** (1 / (1 + hurst)), "--", color=colour, zorder=2)
    level(axes, SQUARE.value, f"square punch, {SQUARE.value:.4f}", "-")
    level(axes, CELLS * float(averages["cell_stiffness"].max()), "20 cells", (0, (6, 3)), ha="right")
    drawing.key(axes, "--", "slopes 1/(H + 1) of H = 0 and 1")
    drawing.legend_below(axes)
    lowest = float(averages["stiffness"].min())
    drawing.stiffness_axes(axes, xlim=(force[0] / 1.3, force[-1] * 1.3), ylim=(lowest / 1.5, 2))
    drawing.colour_key(figure, axes, averages["hurst"].to_numpy())


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Say whether the stiffness saturates, and whether it begins with a power law."""
    last = averages.isel(load=-1)
    plateau, spread = float(last["stiffness"].mean()), float(np.ptp(last["stiffness"].to_numpy()))
    whole = last["stiffness"] / last["full_contact_stiffness"] - 1
    alpha = averages["exponent"].dropna("hurst")
    each = ", ".join(f"{float(a):.2f} (H = {float(a['hurst']):g})" for a in alpha)
    inside = (averages["force"] >= averages["window_low"] * (1 - 1e-9)) & (
        averages["force"] <= averages["window_high"] * (1 + 1e-9)
    )
    law = averages["prefactor"] * averages["force"] ** averages["exponent"]
    printed = float(bounds.king_full_contact_stiffness(1.0, 1.0))
    bent = (averages["stiffness"] / law - 1).where(inside)
    yield Verdict(
        "the stiffness of surfaces saturates at high forces",
        "One can easily see the saturation in the stiffness for high values of the normal force",
        "section 4.5.1, eq. 4.14",
        f"{plateau:.4f} E* L at a force of {float(averages['force'][-1]):g}, the same for all H to {spread:.1g}; of "
        f"ever finer cells {SQUARE.value:.4f}, where eq. 4.14 prints {printed:.4f}",
        ruled(whole, last["stiffness_error"] / last["full_contact_stiffness"], 0.01),
    )
    yield Verdict(
        "a power law for smaller forces",
        "Furthermore the transition to a power-law-behavior for smaller forces is found.",
        "section 4.5.1, fig. 21",
        f"exponents {each or 'too few forces resolved'}; {counted(averages, 'surfaces')} a value",
        ruled(bent, (averages["stiffness_error"] / averages["stiffness"]).where(inside), BENT),
    )
    yield Verdict(
        "the shape of the square plays no role at low loads",
        "The fact that the global shape is a square actually doesn't play any role in the low-load-regime.",
        "chapter 4",
        "these squares are cut at random, a crest near the border with them; the same surfaces with the highest crest "
        "in the middle are needed beside them",
        undecided("no squares with the crest in the middle", f"{SHAPE:.0%} of the mean stiffness"),
    )
