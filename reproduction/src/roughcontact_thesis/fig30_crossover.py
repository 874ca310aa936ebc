"""Figure 30: lines and surfaces from the power law to full contact, matched at low loads."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.study.ranges import Range
from roughcontact_thesis import drawing
from roughcontact_thesis.ensembles import curve_averages, full_contact_study
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.line_ensembles import each_line, line_study
from roughcontact_thesis.line_match import match, pairs
from roughcontact_thesis.ruling import Ruling
from roughcontact_thesis.verdict import Verdict, Verdicts

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
SIZE = (drawing.COLUMN, 4.6)


def studies(scale: Scale) -> Studies:
    """Return a study of lines at the Hurst exponents of figure 21, and that of its surfaces."""
    table = {"hurst": Range(start=0.0, stop=1.0, step=0.2)}
    lines = line_study(
        "lines-of-figure-30", scale, table, points=POINTS, lowest_force=7e-6, highest_force=70.0, loads=85
    )
    return lines, full_contact_study(scale)


def averages(lines: xarray.Dataset, surfaces: xarray.Dataset) -> xarray.Dataset:
    """Return the mean curves of both on the forces of the surfaces, matched at low loads."""
    every = each_line(lines)
    force = surfaces["dimensionless_force"].to_numpy()
    found = []
    for _, line, surface in pairs(every, surfaces):
        matched = match(line, surface, HIGHEST)
        moved = np.interp(np.log(force / matched.ratio), np.log(line.force), np.log(line.mean()))
        found.append((np.exp(moved), matched.ratio, matched.ratio * matched.error, matched.window[0]))
    line_stiffness, ratio, error, lowest = map(np.array, zip(*found, strict=True))
    whole = curve_averages(surfaces)[["force", "stiffness", "stiffness_error"]]
    whole = whole.rename(stiffness="surface", stiffness_error="surface_error")
    for name, values, words in (
        ("line", line_stiffness, "stiffness of lines at matched forces"),
        ("ratio", ratio, "force of surfaces over that of lines"),
        ("ratio_error", error, "standard error of it"),
        ("resolved", lowest, "lowest stiffness of the match"),
    ):
        whole[name] = ("hurst", "load")[: values.ndim], values, {"long_name": words, "units": "1"}
    sizes = {"samples": surfaces.sizes["sample"], "lines": every.sizes["sample"]}
    return whole.assign_attrs(sizes | {"points": int(surfaces["points"])})


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw both stiffnesses, and beneath them one over the other."""
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(2.4, 1))
    force = averages["force"]
    for hurst, one, colour in drawing.by_hurst(averages):
        surface = one["surface"].where(one["surface"] >= one["resolved"])
        upper.plot(force, one["line"], color=colour, label=f"H = {hurst:g}")
        shown = one.assign(surface=surface)
        drawing.with_errors(upper, shown, "surface", fmt="x", color=colour, markersize=4.5)
        ratio = one["line"] / surface
        lower.errorbar(force, ratio, ratio * one["surface_error"] / surface, color=colour, elinewidth=0.8)
    drawing.key(upper, "-", "lines")
    drawing.key(upper, "x", "surfaces", markersize=4.5)
    drawing.stiffness_axes(upper)
    upper.set_xlabel("")
    drawing.legend_below(upper, 4)
    lower.axhline(1, color="0.5", linewidth=0.8, zorder=1)
    drawing.label(lower, f"dimensionless {drawing.FORCE}", "lines / surfaces")


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Say how far lines and surfaces are apart in the crossover."""
    ratio = averages["line"] / averages["surface"]
    error = ratio * averages["surface_error"] / averages["surface"]
    force = averages["force"]
    inside = np.flatnonzero((force >= CROSSOVER[0]) & (force <= CROSSOVER[1]))
    between, errors = ratio.isel(load=inside) - 1, error.isel(load=inside)
    high, low = between.max("load"), between.min("load")
    rows = zip(low.values, high.values, averages["hurst"].values, strict=True)
    each = ", ".join(f"{least:+.0%} to {most:+.0%} at H = {hurst:g}" for least, most, hurst in rows)
    place = between.argmax(...)
    first, sure = between.isel(place), errors.isel(place)
    last = between.isel(place | {"hurst": int(high.to_numpy().argmin())})
    fewer = errors.isel(place | {"hurst": int(high.to_numpy().argmin())})
    apart, both = float(first - last), float(sure + fewer)  # at most, as they share their phases
    told = averages.attrs
    deviates = float(first) - 3 * float(sure) > 0.05
    yield Verdict(
        "lines deviate from surfaces in the transition, by an amount that depends on H",
        "Some deviations can be found, which depend on the Hurst exponent.",
        "section 4.5.3, fig. 30",
        f"at forces from {CROSSOVER[0]:g} to {CROSSOVER[1]:g}: {each}; {told['lines']} lines, {told['samples']} "
        f"surfaces of {told['points']}² points",
        Ruling(
            "not decided" if not deviates else "holds" if apart > 3 * both else "holds in part",
            "5%, and a difference between H",
            trigger=f"{float(first):+.0%} ± {float(sure):.0%} at H = {float(first['hurst']):g}; "
            f"{apart:.0%} ± {both:.0%} more than at H = {float(last['hurst']):g}",
            part="they deviate" if deviates and apart <= 3 * both else "",
        ),
    )
