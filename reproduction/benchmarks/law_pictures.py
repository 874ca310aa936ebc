"""Pictures of what the ensembles of the law say; see `law.py`."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import xarray
from law_crest import at_border, by_cut, effects, laws_of
from law_cut import LARGER, PERIOD, mean_effect, stiffness_ratio
from law_ensembles import CELLS, FOLDER, Values, error, law, read, resampled, value
from law_tables import HIGHEST, LIMITS, MIDDLE, between, curves, load_at, nested, on_grids
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact_thesis import drawing

SHOWN = (7e-4, 7e-3, HIGHEST)  # forces at which convergence is drawn
LEAST = 5  # cells of stiffness below which nothing is drawn
CRESTS = (0.7, 1.3, 2.95)  # H of the crests at a border that are drawn
EFFECTS = (0.25, 0.7, 1.3, 1.9, 2.95)  # H of the effects of a cut that are drawn
SPAN = 2  # loads on either side of a local exponent: 0.8 decades in all


def pictures(folder: Path = FOLDER) -> Iterator[tuple[str, Figure]]:
    """Yield every picture for which there are ensembles, by name."""
    surfaces, lines, border = (read(name, folder) for name in ("e8-cut", "e1-lines", "e8-border"))
    if surfaces is not None and lines is not None:
        yield "exponents", drawn(4.0, exponents, surfaces, lines)
    if surfaces is not None and border is not None:
        yield "cut", drawn(4.0, cut, surfaces, border)
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


def exponents(figure: Figure, ensemble: xarray.Dataset, lines: xarray.Dataset) -> None:
    """Draw exponents (a) and stiffnesses at one force (b) of both cuts and of lines beside the thesis' law."""
    left, right = drawing.panels(figure, 1, 2)
    cuts = by_cut(ensemble)
    samples, hurst = ensemble.sizes["sample"], ensemble["hurst"].to_numpy()
    force, stiffness, batches = curves(lines.isel(points=-1))
    lowest = ensemble["dimensionless_force"].where(cuts["period"]["inside"]).min("load")
    alpha, zeta = law(force, resampled(stiffness), between(force, lowest, HIGHEST))
    found = {
        "rough lines": (alpha, zeta * MIDDLE**alpha, batches),
        "squares cut at random": (*laws_of(cuts["period"]), samples),
        "squares, interior": (*laws_of(cuts["interior"]), samples),
    }
    marks = (("0.6", "."), (drawing.LINES, "s"), (drawing.SURFACES, "x"))
    for (words, (*both, count)), (colour, mark) in zip(found.items(), marks, strict=True):
        for axes, one in zip((left, right), both, strict=True):
            style = {"color": colour, "marker": mark, "markersize": 4, "linewidth": 0.8, "capsize": 2}
            bars = 2 * error(one, count)
            axes.errorbar(hurst, value(one), bars, label=words, markerfacecolor="none", **style)
    drawing.exponent_laws(left, hurst)
    x = np.linspace(hurst[0], 2, 200)
    level = 1.7 / (x + 1) * MIDDLE ** (1 / (x + 1))
    right.plot(x, level, color=drawing.LAW, label="1.7/(H + 1) $F^{1/(H+1)}$")
    drawing.hurst_axes(left, hurst, drawing.EXPONENT)
    drawing.hurst_axes(right, hurst, rf"mean {drawing.STIFFNESS} at $F/(E^*hL)$ = {MIDDLE:g}")
    for axes in (left, right):
        axes.legend(loc="best")


def cut(figure: Figure, ensemble: xarray.Dataset, border: xarray.Dataset) -> None:
    """Draw s(x) of one crest with the crests of E8 (a), and the effect of a random cut beside its theory (b)."""
    left, right = drawing.panels(figure, 1, 2)
    x = np.linspace(0, 1.6, 200)
    for name, words, colour in ((PERIOD, "period", drawing.SURFACES), (LARGER, "patch", drawing.LINES)):
        left.plot(x, stiffness_ratio(x, name), color=colour, label=f"smooth, {words}")
    for h, mark in zip(CRESTS, "ov^", strict=True):
        rows = at_border(ensemble, border, h)
        style = {"fmt": mark, "color": "0.3", "markersize": 4, "markerfacecolor": "none", "elinewidth": 0.8}
        left.errorbar(*rows, label=f"E8, H = {h:g}", **style)
    left.axhline(1, color="0.5", linewidth=0.7)
    drawing.label(left, "distance to the border over a", "k over that in the middle")
    left.set(xlim=(-0.05, 1.6), ylim=(0.82, 1.5))
    found = effects(ensemble)
    shown = [float(h) for h in found["hurst"] if float(h) in EFFECTS]
    for h, mark in zip(shown, "xo^sv", strict=False):
        one = found.sel(hurst=h)
        right.errorbar(
            one["width"], 100 * one["effect"], 200 * one["spread"], fmt=mark, markersize=4, elinewidth=0.8,
            markerfacecolor="none", label=f"H = {h:g}",
        )  # fmt: skip
    width = np.linspace(0, 0.45, 100)
    right.plot(width, 100 * mean_effect(width / 4, PERIOD), color=drawing.LAW, label="theory of one crest")
    drawing.label(right, "4 a/L", "a random cut adds to k, %")
    left.legend(loc="upper right", ncols=2)
    right.legend(loc="upper left")


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
