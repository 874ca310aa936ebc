"""Figure 22: stiffness of rough lines against force, from the first spring to the last."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import TICK
from roughcontact.study.ranges import Range
from roughcontact.thesis.line_ensembles import line_averages, line_fits, line_study
from roughcontact.thesis.stiffness_view import colour_key, hurst_colours, stiffness_axes
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "stiffness of rough lines against force, by the reduced model"
POINTS, LINES = 500, 1500
CHOSEN = (
    "forces F/(E* h L) from 1e-8 to 10 in equal ratios; the thesis gives their number only",
    "lines by the inverse Fourier transform with exact amplitudes, paired across H",
    "arithmetic means over the lines at each force",
)
SIZE = (6.4, 4.4)


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the one study: 11 Hurst exponents, 400 forces, 1500 lines of 500 points."""
    return (
        line_study(
            "lines-of-figure-22",
            scale,
            table={"hurst": Range(start=0.0, stop=2.0, step=0.2)},
            parameters={"points": POINTS, "lowest_force": 1e-8, "highest_force": 10.0, "loads": 400},
            lines=LINES,
        ),
    )


def averages(lines: xarray.Dataset) -> xarray.Dataset:
    """Return mean stiffnesses, their power laws, and the time that all lines took [s]."""
    found = line_averages(lines).merge(line_fits(lines), combine_attrs="drop_conflicts")
    if "case_seconds" in lines:
        seconds = lines["case_seconds"].sum()
        found["seconds"] = seconds.assign_attrs(long_name="computing time of all lines", units="s")
    return found


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the mean stiffness for each Hurst exponent, between its two plateaus."""
    axes = figure.subplots()
    stiffness_axes(axes)
    hurst = averages["hurst"].to_numpy()
    colours = hurst_colours(hurst[0], hurst[-1])
    force = averages["force"].to_numpy()
    for each in hurst:
        axes.plot(
            force, averages["stiffness"].sel(hurst=each), color=colours.to_rgba(each), linewidth=1.2, zorder=3
        )
    points = float(averages["points"])
    for level, words in ((1.0, "every spring carries load"), (1 / points, "one spring carries load")):
        axes.axhline(level, color="0.5", linewidth=0.9, linestyle=":", zorder=1)
        axes.annotate(
            words,
            (force[0], level),
            xytext=(2, -3),
            textcoords="offset points",
            va="top",
            fontsize=TICK,
            color="0.35",
        )
    for each, place, law in (
        (hurst[0], 1.1, np.array([3e-3, 4e-2])),
        (hurst[-1], 1.0, np.array([1e-6, 1e-3])),
    ):
        slope = place * law ** (1 / (1 + each))
        axes.plot(law, slope, "--", color=colours.to_rgba(each), linewidth=1.2, zorder=2)
    axes.plot([], [], "--", color="0.3", linewidth=1.2, label="slopes 1/(H + 1) at H = 0 and 2")
    axes.legend(fontsize=TICK, frameon=False, loc="upper left", bbox_to_anchor=(0.0, 0.85))
    axes.set(xlim=(force[0], force[-1]), ylim=(0.5 / points, 2))
    colour_key(figure, axes, colours, hurst[-1])


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare plateaus, laws and time."""
    points, lines = float(averages["points"]), averages.attrs["lines"]
    first, last = (averages["stiffness"].isel(load=place) for place in (0, -1))
    low, high = float(abs(first * points - 1).max()), float(abs(last - 1).max())
    misfit, hurst = averages["misfit"].to_numpy(), averages["hurst"].to_numpy()
    found = [
        Verdict(
            "stiffness saturates at low and at high forces",
            "k/(E* L) = 1/N and 1",
            f"within {low:.1g} and {high:.1g} of them at the first and the last force; {lines} lines of {points:.0f} "
            f"points for each of {hurst.size} H",
            low < 0.05 and high < 0.05,
        ),
        Verdict(
            "a power law in the medium range",
            "straight lines in logarithmic axes",
            f"straight to {misfit.min():.1%} (H = {hurst[np.argmin(misfit)]:g}) to {misfit.max():.1%} "
            f"(H = {hurst[np.argmax(misfit)]:g}), from 20 springs to a force of 0.07",
            bool(misfit.max() < 0.05),
        ),
    ]
    if "seconds" in averages:
        seconds = float(averages["seconds"])
        said = f"{seconds:.1f} s for {lines} lines a Hurst exponent, on one core"
        # A longer time may be that of a busy computer.
        soon = True if lines >= LINES and seconds < 4 else None
        found.append(Verdict("computing time of the figure", "4 s", said, soon))
    return tuple(found)
