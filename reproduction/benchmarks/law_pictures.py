"""Pictures of what the ensembles of the law say; see `law.py`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import xarray
from law_ensembles import CELLS, FOLDER, Values, error, law, read, resampled, value
from law_tables import HIGHEST, LIMITS, MIDDLE, between, curves, e1_laws, load_at, nested, on_grids
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact_thesis import drawing

SHOWN = (7e-4, 7e-3, HIGHEST)  # forces at which convergence is drawn
LEAST = 5  # cells of stiffness below which nothing is drawn
SPAN = 2  # loads on either side of a local exponent: 0.8 decades in all


def pictures(folder: Path = FOLDER) -> Iterator[tuple[str, Figure]]:
    """Yield every picture for which there are ensembles, by name."""
    surfaces, lines = read("e1-surfaces", folder), read("e1-lines", folder)
    if surfaces is not None and lines is not None:
        yield "exponents", drawn(4.0, exponents, surfaces, lines)
    ensembles = on_grids(folder)
    for name, (words, wanted) in LIMITS.items():
        same = nested(ensembles, wanted)
        if len(same) == len(wanted):
            yield name, drawn(4.4, convergence, same, words)
    for name, limit in (("local-exponents", "e2-all"), ("local-exponents-4096", "e2-all-4096")):
        every = nested(ensembles, LIMITS[limit][1])
        if len(every) == len(LIMITS[limit][1]):
            yield name, drawn(4.4, local_exponents, every)


def drawn(height: float, draw: Any, *given: Any) -> Figure:
    picture = Figure(figsize=(drawing.PAGE, height), layout="constrained")
    with matplotlib.rc_context(drawing.STYLE):
        draw(picture, *given)
    for axes in picture.axes:
        axes.tick_params(labelsize=drawing.TICK, which="both")
    return picture


def exponents(figure: Figure, surfaces: xarray.Dataset, lines: xarray.Dataset) -> None:
    """Draw exponents (a) and stiffnesses at one force (b) of surfaces and lines beside the thesis' law."""
    left, right = drawing.panels(figure, 1, 2)
    found = e1_laws(surfaces)
    samples, hurst = found.attrs["samples"], found["hurst"].to_numpy()
    force, stiffness, batches = curves(lines.isel(points=-1))
    mean = resampled(stiffness)
    inside = between(force, found["lowest"], HIGHEST)
    alpha, zeta = law(force, mean, inside)
    level = zeta * MIDDLE**alpha
    for axes, of_surfaces, of_lines in ((left, found["alpha_mean"], alpha), (right, found["k_mean"], level)):
        style = {"color": drawing.LINES, "marker": ".", "markersize": 3, "linewidth": 1.0, "zorder": 3}
        axes.errorbar(hurst, value(of_lines), 2 * error(of_lines, batches), label="rough lines", **style)
        style = {
            "color": drawing.SURFACES,
            "fmt": "x",
            "markersize": 5,
            "elinewidth": 0.9,
            "capsize": 2,
            "zorder": 4,
        }
        words = f"{samples} rough squares, {int(surfaces['points'])}² cells"
        axes.errorbar(hurst, value(of_surfaces), 2 * error(of_surfaces, samples), label=words, **style)
    drawing.exponent_laws(left, hurst)
    x = np.linspace(hurst[0], 2, 200)
    right.plot(
        x, 1.7 / (x + 1) * MIDDLE ** (1 / (x + 1)), color=drawing.LAW, label="1.7/(H + 1) $F^{1/(H+1)}$"
    )
    drawing.hurst_axes(left, hurst, drawing.EXPONENT)
    drawing.hurst_axes(right, hurst, rf"mean {drawing.STIFFNESS} at $F/(E^*hL)$ = {MIDDLE:g}")
    for axes in (left, right):
        axes.legend(loc="best")


def convergence(figure: Figure, same: dict[int, xarray.Dataset], words: str) -> None:
    """Draw stiffnesses on every grid over those on the finest, a panel for every Hurst exponent."""
    finest = max(same)
    force, _, samples = curves(same[finest])
    means = {n: resampled(one["dimensionless_stiffness"]) for n, one in same.items()}
    hurst = same[finest]["hurst"].to_numpy()
    panels = by_hurst(figure, hurst)
    for place, axes in enumerate(panels):
        for at, colour, mark in zip(SHOWN, drawing.COLOURS, "v^o", strict=False):
            load = load_at(force, at)
            rows = []
            for n, one in same.items():
                k = means[n].isel(hurst=place, load=load)
                if float(value(k)) >= LEAST * float(one["cell_stiffness"].isel(hurst=place)):
                    ratio = 100 * (k / means[finest].isel(hurst=place, load=load) - 1)
                    rows.append((n, float(value(ratio)), 2 * float(error(ratio, samples))))
            if rows:
                n, off, bars = np.array(rows).T
                # Side by side, so that bars do not cover each other.
                n = n * (1 + 0.05 * (SHOWN.index(at) - 1))
                style = {"color": colour, "marker": mark, "elinewidth": 0.9, "capsize": 2}
                axes.errorbar(n, off, np.nan_to_num(bars), label=f"F/(E* h L) = {at:g}", **style)
        axes.axhline(0, color="0.5", linewidth=0.7)
        drawing.label(axes, "cells a side", "k over finest, %", xscale="log")
        drawing.named_ticks(axes, np.array([*same][:: 2 if len(same) > 4 else 1]), "{}")
        axes.minorticks_off()
    key(figure, panels, f"{words}; {samples} surfaces")


def local_exponents(figure: Figure, same: dict[int, xarray.Dataset]) -> None:
    """Draw the local exponent against the force on every grid, dotted where the mean is below 20 cells."""
    hurst = same[max(same)]["hurst"].to_numpy()
    panels = by_hurst(figure, hurst)
    for place, axes in enumerate(panels):
        for (n, one), colour in zip(same.items(), drawing.COLOURS, strict=False):
            force, stiffness, samples = curves(one.isel(hurst=place))
            mean = resampled(stiffness)
            alpha = local(force, mean)
            x, y = force.to_numpy(), value(alpha).to_numpy()
            good = value(mean).to_numpy() >= CELLS * float(one["cell_stiffness"].isel(hurst=place))
            axes.plot(x, y, ":", color=colour, linewidth=0.8)
            axes.plot(x, np.where(good, y, np.nan), "-", color=colour, label=f"{n}² cells")
            if n == max(same):
                spread = 2 * error(alpha, samples).to_numpy()
                here = {"where": good, "color": colour, "alpha": 0.2, "linewidth": 0}
                axes.fill_between(x, y - spread, y + spread, **here)
        axes.axhline(1 / (hurst[place] + 1), color="0.4", linestyle="--", linewidth=0.9, label="1/(H + 1)")
        axes.axhline(1 / 3, color="0.4", linestyle="-.", linewidth=0.9, label="1/3")
        drawing.label(axes, drawing.FORCE, r"$d\ln k/d\ln F$", xscale="log", ylim=(0.2, 1.05))
    key(figure, panels, f"{samples} surfaces")


def local(force: Values, mean: Values) -> Values:
    """Return slopes of ln k over ln F in windows about every load."""
    loads = mean.sizes["load"]
    found = []
    for load in range(loads):
        near = slice(max(load - SPAN, 0), load + SPAN + 1)
        inside = xarray.ones_like(force.isel(load=near), dtype=bool)
        slope, _ = law(force.isel(load=near), mean.isel(load=near), inside)
        found.append(slope if SPAN <= load < loads - SPAN else slope * np.nan)
    return xarray.concat(found, "load")


def by_hurst(figure: Figure, hurst: Any) -> list[Axes]:
    """Return a panel for every Hurst exponent, in two rows."""
    columns = -(-len(hurst) // 2)
    every = list(figure.subplots(2, columns, squeeze=False).ravel())
    for axes in every[len(hurst) :]:
        axes.set_axis_off()
    for axes, h in zip(every, hurst, strict=False):
        axes.set_title(f"H = {h:g}")
    return every[: len(hurst)]


def key(figure: Figure, panels: list[Axes], title: str) -> None:
    """Put one legend for all panels below them."""
    handles, words = panels[-1].get_legend_handles_labels()
    figure.legend(handles, words, loc="outside lower center", ncols=len(words), title=title)
