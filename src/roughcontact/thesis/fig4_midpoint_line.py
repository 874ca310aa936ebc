"""Figure 4: a fractal line by random midpoint displacement, one stage after the other."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.grid import Grid
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.surface.midpoint import midpoint_line
from roughcontact.surface.surface import Surface

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["case", "draw"]

TITLE = "random midpoint displacement of a line, four stages"
HURST = 0.8
DISPLACEMENT = 1.0  # d; the picture is drawn in its units
LENGTH = 1.0
STAGES = 4
SEED = 8
CHOSEN = (f"H = {HURST:g}", "displacements uniform within ±d, d as the unit of height")
SIZE = (6.5, 4.6)

_BEFORE, _LINE, _MOVED = "0.55", "#0072b2", "#d55e00"


def case(seed: int = SEED) -> tuple[Surface, ...]:
    """Return the line after each stage, of 3, 5, 9 and 17 nodes; each holds the nodes of the one before."""
    return tuple(
        midpoint_line(
            Grid((2**stage + 1,), (LENGTH / 2**stage,)),
            HURST,
            np.random.default_rng(seed),
            displacement=DISPLACEMENT,
        )
        for stage in range(1, STAGES + 1)
    )


def draw(figure: Figure, data: tuple[Surface, ...]) -> None:
    """Draw the stages (a) to (d): the line before, the middles that move, the line after."""
    panels = figure.subplots(2, 2, sharex=True, sharey=True).ravel()
    before = np.zeros(2)
    for letter, axes, line in zip("abcd", panels, data, strict=True):
        _stage(axes, before, line.heights)
        axes.set_title(f"({letter})", fontsize=LABEL, loc="left")
        before = line.heights
    reach = 1.15 * max(float(np.abs(line.heights).max()) for line in data)
    panels[0].set_ylim(-reach, reach)
    for axes in panels[2:]:
        axes.set_xlabel("x / L", fontsize=LABEL)
    for axes in panels[::2]:
        axes.set_ylabel("height / d", fontsize=LABEL)


def _stage(axes: Axes, before: np.typing.NDArray[np.float64], after: np.typing.NDArray[np.float64]) -> None:
    x = np.linspace(0, 1, after.size)
    axes.plot(x[::2], before, "--", color=_BEFORE, linewidth=1.0)
    middle = (before[1:] + before[:-1]) / 2
    for place, start, end in zip(x[1::2], middle, after[1::2], strict=True):
        axes.annotate(
            "",
            (place, end),
            (place, start),
            arrowprops={"arrowstyle": "->", "color": _MOVED, "linewidth": 1.0, "shrinkA": 0, "shrinkB": 0},
        )
    axes.plot(x, after, "-", color=_LINE, linewidth=1.4)
    axes.plot(x[::2], after[::2], "o", color="black", markersize=3)
    axes.plot(x[1::2], after[1::2], "o", color=_MOVED, markersize=3.5)
    axes.tick_params(labelsize=TICK)
    axes.grid(True, color="0.93", linewidth=0.8)
    axes.set_axisbelow(True)
