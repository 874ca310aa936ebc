"""Figure 4: a fractal line by random midpoint displacement, one stage after the other."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.validation import Array
from roughcontact_thesis import drawing

__all__ = ["case", "draw"]

TITLE = "random midpoint displacement of a line, four stages"
HURST = 0.8
DISPLACEMENT = 1.0  # d; the picture is drawn in its units
LENGTH = 1.0
STAGES = 4
SEED = 8
CHOSEN = (f"H = {HURST:g}", "displacements uniform within ±d, d as the unit of height")
SIZE = (drawing.PAGE, 4.4)

_LINE, _MOVED = "#0072b2", "#d55e00"


def case(seed: int = SEED) -> tuple[rc.Surface, ...]:
    """Return the line after each stage, of 3, 5, 9 and 17 nodes; each holds the nodes of the one before."""
    grids = (rc.Grid((2**stage + 1,), (LENGTH / 2**stage,)) for stage in range(1, STAGES + 1))
    return tuple(
        rc.midpoint_line(grid, HURST, np.random.default_rng(seed), displacement=DISPLACEMENT)
        for grid in grids
    )


def draw(figure: Figure, data: tuple[rc.Surface, ...]) -> None:
    """Draw the stages (a) to (d): the line before, the middles that move, the line after."""
    panels = drawing.panels(figure, 2, 2, sharex=True, sharey=True)
    reach = 1.15 * max(float(np.abs(line.heights).max()) for line in data)
    before = np.zeros(2)
    for axes, line in zip(panels, data, strict=True):
        _stage(axes, before, line.heights)
        drawing.label(axes, "x / L", "height / d", ylim=(-reach, reach))
        axes.label_outer()
        before = line.heights


def _stage(axes: Axes, before: Array, after: Array) -> None:
    x = np.linspace(0, 1, after.size)
    axes.plot(x[::2], before, "--", color="0.55", linewidth=1.0)
    for place, start, end in zip(x[1::2], (before[1:] + before[:-1]) / 2, after[1::2], strict=True):
        drawing.arrow(axes, (place, start), (place, end), color=_MOVED)
    axes.plot(x, after, "-", color=_LINE, linewidth=1.4)
    axes.plot(x[::2], after[::2], "o", color="black", markersize=3)
    axes.plot(x[1::2], after[1::2], "o", color=_MOVED, markersize=3.5)
