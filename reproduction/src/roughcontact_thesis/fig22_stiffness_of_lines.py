"""Figure 22: stiffness of rough lines against force, from the first spring to the last."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.plot.drawing.level import level
from roughcontact.study.ranges import Range
from roughcontact_thesis import drawing
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.line_ensembles import line_averages, line_fits, line_study
from roughcontact_thesis.ruling import ruled
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "stiffness of rough lines against force, by the reduced model"
POINTS, LINES = 500, 1500
CHOSEN = (
    "forces F/(E* h L) from 1e-8 to 10 in equal ratios; the thesis gives their number only",
    "lines by the inverse Fourier transform with exact amplitudes, paired across H",
    "arithmetic means over the lines at each force",
)
SIZE = (drawing.COLUMN, 3.2)


def studies(scale: Scale) -> Studies:
    """Return the one study: 11 Hurst exponents, 400 forces, 1500 lines of 500 points."""
    table = {"hurst": Range(start=0.0, stop=2.0, step=0.2)}
    forces = {"lowest_force": 1e-8, "highest_force": 10.0, "loads": 400}
    return (line_study("lines-of-figure-22", scale, table, lines=LINES, points=POINTS, **forces),)


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
    force, points = averages["force"].to_numpy(), float(averages["points"])
    laws = {0.0: (1.1, np.array([3e-3, 4e-2])), 2.0: (1.0, np.array([1e-6, 1e-3]))}  # their places and forces
    for hurst, one, colour in drawing.by_hurst(averages):
        axes.plot(force, one["stiffness"], color=colour, zorder=3)
        if hurst in laws:
            place, law = laws[hurst]
            axes.plot(law, place * law ** (1 / (1 + hurst)), "--", color=colour, zorder=2)
    level(axes, 1.0, "every spring carries load", ":", va="top")
    level(axes, 1 / points, "one spring carries load", ":", va="top")
    drawing.key(axes, "--", "slopes 1/(H + 1) at H = 0 and 2")
    drawing.legend_below(axes)
    drawing.stiffness_axes(axes, xlim=(force[0], force[-1]), ylim=(0.5 / points, 2))
    drawing.colour_key(figure, axes, averages["hurst"].to_numpy())


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare plateaus and laws."""
    points, lines = float(averages["points"]), averages.attrs["lines"]
    ends = averages["stiffness"].isel(load=[0, -1]) * np.array([points, 1.0]) - 1
    errors = averages["stiffness_error"].isel(load=[0, -1]) * np.array([points, 1.0])
    low, high = (float(abs(each).max()) for each in ends.transpose("load", "hurst"))
    misfit, hurst = averages["misfit"], averages["hurst"].to_numpy()
    inside = (averages["force"] >= averages["window_low"]) & (averages["force"] <= averages["window_high"])
    error = (averages["stiffness_error"] / averages["stiffness"]).where(inside).max("load")
    yield Verdict(
        "the stiffness of lines saturates at both ends",
        "Both saturation values for small and high forces can be seen directly.",
        "section 4.5.2, fig. 22",
        f"within {low:.1g} and {high:.1g} of 1/N and of 1 at the first and the last force; {lines} lines of "
        f"{points:.0f} points for each of {hurst.size} H",
        ruled(ends, errors, 0.05),
    )
    yield Verdict(
        "a power law of lines in the medium range",
        "In the medium range, a power-law is observed.",
        "section 4.5.2, fig. 22",
        f"straight to {float(misfit.min()):.1%} (H = {hurst[int(misfit.to_numpy().argmin())]:g}) to "
        f"{float(misfit.max()):.1%} (H "
        f"= {hurst[int(misfit.to_numpy().argmax())]:g}), from 20 springs to a force of 0.07",
        ruled(misfit, error, 0.05),
    )
