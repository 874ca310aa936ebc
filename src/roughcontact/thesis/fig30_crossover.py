"""Figure 30: lines and surfaces from the power law to full contact, matched at low loads."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import LABEL, TICK
from roughcontact.study.ranges import Range
from roughcontact.thesis.ensembles import curve_averages, saturation_study
from roughcontact.thesis.line_ensembles import each_line, line_study
from roughcontact.thesis.line_match import match, pairs
from roughcontact.thesis.stiffness_view import FORCE_LABEL, hurst_colours, quiet, stiffness_axes
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "lines and surfaces in the crossover from the power law to full contact"
POINTS = 2**13
HIGHEST = 0.1  # force F/(E* h L) up to which both are matched
CROSSOVER = (0.1, 10.0)  # forces F/(E* h L) of the surfaces
CHOSEN = (
    "surfaces of figure 21: H = 0, 0.2, ... 1",
    f"lines of 2^{POINTS.bit_length() - 1} points, their forces times the ratio that makes both equally stiff from 20 "
    f"cells of the surface up to a force of {HIGHEST:g}",
    "the ratio of both beneath",
)
SIZE = (6.2, 5.6)


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return a study of lines at the Hurst exponents of figure 21, and that of its surfaces."""
    lines = line_study(
        "lines-of-figure-30",
        scale,
        table={"hurst": Range(start=0.0, stop=1.0, step=0.2)},
        parameters={"points": POINTS, "lowest_force": 7e-6, "highest_force": 70.0, "loads": 85},
    )
    return lines, saturation_study(scale)


def averages(lines: xarray.Dataset, surfaces: xarray.Dataset) -> xarray.Dataset:
    """Return the mean curves of both on the forces of the surfaces, matched at low loads."""
    import xarray

    every = each_line(lines)
    force = surfaces["dimensionless_force"].to_numpy()
    found = []
    for _, line, surface in pairs(every, surfaces):
        matched = match(line, surface, HIGHEST)
        moved = np.interp(np.log(force / matched.ratio), np.log(line.force), np.log(line.mean()))
        found.append((np.exp(moved), matched.ratio, matched.ratio * matched.error, matched.window[0]))
    stiffness, ratio, error, low = map(np.array, zip(*found, strict=True))
    whole = curve_averages(surfaces)[["force", "stiffness", "stiffness_error"]]
    told = {
        "samples": surfaces.sizes["sample"],
        "lines": every.sizes["sample"],
        "points": int(surfaces["points"]),
    }
    return (
        whole.rename(stiffness="surface", stiffness_error="surface_error")
        .assign(
            line=xarray.DataArray(
                stiffness,
                dims=("hurst", "load"),
                attrs={"long_name": "stiffness of lines at matched forces", "units": "1"},
            ),
            ratio=("hurst", ratio, {"long_name": "force of surfaces over that of lines", "units": "1"}),
            ratio_error=("hurst", error, {"long_name": "standard error of it", "units": "1"}),
            resolved=("hurst", low, {"long_name": "lowest stiffness of the match", "units": "1"}),
        )
        .assign_attrs(told)
    )


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw both stiffnesses, and beneath them one over the other."""
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2.4, 1))
    stiffness_axes(upper)
    hurst = averages["hurst"].to_numpy()
    colours = hurst_colours(hurst[0], hurst[-1])
    force = averages["force"].to_numpy()
    for each in hurst:
        one, colour = averages.sel(hurst=each), colours.to_rgba(each)
        seen = one["surface"].to_numpy() >= float(one["resolved"])
        upper.plot(force, one["line"], color=colour, linewidth=1.2, label=f"H = {each:g}")
        upper.plot(force[seen], one["surface"].to_numpy()[seen], "x", color=colour, markersize=4.5)
        lower.plot(force[seen], (one["line"] / one["surface"]).to_numpy()[seen], color=colour, linewidth=1.2)
    upper.plot([], [], color="0.3", linewidth=1.2, label="lines")
    upper.plot([], [], "x", color="0.3", markersize=4.5, label="surfaces")
    upper.legend(fontsize=TICK, frameon=False, loc="lower right", ncols=2)
    upper.set_xlabel("")
    lower.axhline(1, color="0.5", linewidth=0.8, zorder=1)
    lower.set_ylabel("lines / surfaces", fontsize=LABEL)
    lower.set_xlabel(FORCE_LABEL, fontsize=LABEL)
    quiet(lower)


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Say how far lines and surfaces are apart in the crossover, and at its end."""
    ratio = averages["line"] / averages["surface"]
    force = averages["force"]
    between = ratio.isel(load=np.flatnonzero((force >= CROSSOVER[0]) & (force <= CROSSOVER[1])))
    high, low = between.max("load") - 1, between.min("load") - 1
    rows = zip(low.values, high.values, averages["hurst"].values, strict=True)
    each = ", ".join(f"{least:+.0%} to {most:+.0%} at H = {hurst:g}" for least, most, hurst in rows)
    last = float(averages["surface"].isel(load=-1).mean())
    told = averages.attrs
    counts = f"{told['lines']} lines, {told['samples']} surfaces of {told['points']}² points"
    return (
        Verdict(
            "some deviations of lines from surfaces in the transition, which depend on H",
            "figure only",
            f"at forces from {CROSSOVER[0]:g} to {CROSSOVER[1]:g}: {each}; {counts}",
            bool(max(abs(low).max(), high.max()) > 0.05),
        ),
        Verdict(
            "both end in a constant stiffness",
            "1 and 1.142 (eqs 4.7 and 4.14; exactly 1.1523)",
            f"{float(averages['line'].isel(load=-1).mean()):.3f} and {last:.3f} at a force of {float(force[-1]):.3g}",
            bool(abs(last / 1.1523 - 1) < 0.02),
        ),
    )
