"""Labels and ticks of axes: enough numbers to read values, few enough not to overlap."""

from __future__ import annotations

from typing import Any, Literal

from matplotlib import ticker
from matplotlib.axes import Axes
from matplotlib.axis import Axis

__all__ = ["LABEL", "TICK", "label_axes", "outer_axis", "readable_ticks"]

LABEL, TICK = 9, 8  # sizes of text [points]

_DECADES = 100.0  # ratio from which powers of ten are enough
_STEPS = 5.0  # ratio below which an axis may have fewer than two of 1, 2 and 5 times a power of ten


def readable_ticks(axis: Axis, ratio: float) -> None:
    """Choose the ticks of a logarithmic axis whose largest number is `ratio` times its smallest."""
    axis.set_minor_formatter(ticker.NullFormatter())
    if ratio >= _DECADES:
        return
    if ratio >= _STEPS:
        axis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
    else:
        axis.set_major_locator(ticker.MaxNLocator(4, steps=[1, 2, 5, 10]))
        axis.set_minor_locator(ticker.NullLocator())
    axis.set_major_formatter(ticker.FormatStrFormatter("%g"))


def label_axes(axes: Axes, x: str, y: str, *, grid: bool = False) -> None:
    """Write the names of both axes in the text size of all pictures; with `grid`, draw lines at the major ticks."""
    axes.set_xlabel(x, fontsize=LABEL)
    axes.set_ylabel(y, fontsize=LABEL)
    axes.tick_params(labelsize=TICK, which="both")
    if grid:
        axes.grid(True, which="major", color="0.92", linewidth=0.8)
        axes.set_axisbelow(True)


def outer_axis(axes: Axes, side: Literal["right", "top"], name: str, functions: Any) -> Any:
    """Return a second axis on the right or at the top; `functions` convert from the first axis and back."""
    outer: Any
    if side == "right":
        outer = axes.secondary_yaxis(side, functions=functions)
        outer.set_ylabel(name, fontsize=LABEL)
    else:
        outer = axes.secondary_xaxis(side, functions=functions)
        outer.set_xlabel(name, fontsize=LABEL)
    outer.tick_params(labelsize=TICK, which="both")
    return outer
