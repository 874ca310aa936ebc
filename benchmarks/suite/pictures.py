"""Pictures of rows: time against the number of cells, and against the load."""

from __future__ import annotations

import math
from collections import defaultdict
from pathlib import Path
from statistics import median
from typing import Any

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot as plt

from suite.cases import CASES
from suite.rows import refusal

__all__ = ["draw"]

COLOURS = {
    "roughcontact": "#0072b2",
    "aspher": "#d55e00",
    "tamaas": "#009e73",
    "contactmechanics": "#cc79a7",
}
ACROSS = 4  # panels in a row

Times = dict[tuple[str, str], dict[float, float]]  # of a program and a case: seconds at each place


def draw(rows: list[dict[str, Any]], folder: Path) -> list[Path]:
    """Write the pictures and return where they are; one that would show nothing is left out."""
    folder.mkdir(parents=True, exist_ok=True)
    rows = [row for row in rows if not refusal(row, CASES.get(row["case"]))]
    written = []
    for name, picture in (("time-against-n.png", _against_n), ("time-against-load.png", _against_load)):
        figure = picture(rows)
        if figure is not None:
            figure.savefig(folder / name, dpi=150)
            plt.close(figure)
            written.append(folder / name)
    return written


def _against_n(rows: list[dict[str, Any]]) -> Any:
    times: Times = defaultdict(dict)
    for (program, case, n), seconds in _medians(rows, lambda row: row["n"]).items():
        times[program, case][n] = seconds
    return _panels(times, "cells a side")


def _against_load(rows: list[dict[str, Any]]) -> Any:
    fractal = [row for row in rows if row["case"].startswith("fractal-")]
    times: Times = defaultdict(dict)
    for (program, case, n), seconds in _medians(fractal, lambda row: row["n"]).items():
        _, hurst, load = case.split("-", 2)
        times[program, f"fractal, H = {hurst}, n = {n:g}"][float(load)] = seconds
    return _panels(times, r"dimensionless force $F/(E^*hL)$")


def _medians(rows: list[dict[str, Any]], place: Any) -> dict[tuple[str, str, float], float]:
    """Return the median over seeds of the median over rounds, where every seed has one."""
    found = defaultdict(list)
    for row in rows:
        found[row["program"], row["case"], place(row)].append(row["median"])
    return {key: median(values) for key, values in found.items() if all(map(math.isfinite, values))}


def _panels(times: Times, label: str) -> Any:
    """Return a panel for each case that has two places or more, a line a program."""
    cases = [case for case in dict.fromkeys(case for _, case in times) if _places(times, case) > 1]
    if not cases:
        return None
    down, across = -(-len(cases) // ACROSS), min(ACROSS, len(cases))
    figure, grid = plt.subplots(
        down, across, figsize=(3.0 * across, 2.7 * down), squeeze=False, sharey=True, layout="constrained"
    )
    for axes, case in zip(grid.flat, cases, strict=False):
        for program in dict.fromkeys(program for program, _ in times):
            line = sorted(times.get((program, case), {}).items())
            if line:
                axes.loglog(
                    *zip(*line, strict=True), "o-", color=COLOURS.get(program, "grey"), label=program, ms=4
                )
        ticks = sorted({x for (_, name), line in times.items() if name == case for x in line})
        axes.set_xticks(ticks, [f"{x:g}" for x in ticks])
        axes.minorticks_off()
        axes.set_title(case, fontsize=9)
        axes.grid(alpha=0.3)
    for axes in grid.flat[len(cases) :]:
        axes.set_visible(False)
    for row in grid:
        row[0].set_ylabel("time / s")
    for axes in grid.flat[max(0, len(cases) - across) : len(cases)]:
        axes.set_xlabel(label)
    handles = dict(
        reversed(pair) for axes in grid.flat for pair in zip(*axes.get_legend_handles_labels(), strict=True)
    )
    figure.legend(
        handles.values(), handles.keys(), loc="outside upper center", ncols=len(handles), frameon=False
    )
    return figure


def _places(times: Times, case: str) -> int:
    return max(len(line) for (_, name), line in times.items() if name == case)
