"""Figure 5: a fractal surface by random midpoint displacement, its two half steps and its stages."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.grid import Grid
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.plot.view import surface_view
from roughcontact.surface.midpoint import midpoint_surface
from roughcontact.surface.surface import Surface

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["case", "draw"]

TITLE = "random midpoint displacement of a surface, half steps and stages"
HURST = 0.8
RELATIVE = 0.25  # d over the side
LENGTH = 1.0
LEVELS = (1, 3, 7)
SEED = 6
CHOSEN = (
    f"H = {HURST:g}, d = {RELATIVE:g} L",
    "the same d in both half steps",
    "edges on the border: the mean of their three neighbours",
    f"surfaces of {', '.join(f'{2**n + 1}²' for n in LEVELS)} nodes",
)
SIZE = (7.2, 5.0)

_CENTRE, _EDGE, _DIAMOND, _NEXT = "#c8290b", "#0047b2", "#9ccbee", "#8fd08f"


def case(seed: int = SEED) -> tuple[Surface, ...]:
    """Return the surface after each of `LEVELS` levels; each holds the nodes of the one before."""
    return tuple(
        midpoint_surface(
            Grid((2**level + 1,) * 2, (LENGTH / 2**level,) * 2),
            HURST,
            np.random.default_rng(seed),
            displacement=RELATIVE * LENGTH,
        )
        for level in LEVELS
    )


def draw(figure: Figure, data: tuple[Surface, ...]) -> None:
    """Draw the half steps (a) to (c) seen from above, and the surface after some levels."""
    steps = (
        ("a", "centres of the squares", _square_step),
        ("b", "middles of the diamonds", _diamond_step),
        ("c", "squares of the next level", _next_level),
    )
    for place, (letter, words, step) in enumerate(steps, start=1):
        axes = figure.add_subplot(2, 3, place)
        _squares(axes)
        step(axes)
        axes.set_title(f"({letter}) {words}", fontsize=LABEL, loc="left")
    for place, (letter, level, surface) in enumerate(zip("def", LEVELS, data, strict=True), start=4):
        axes = figure.add_subplot(2, 3, place, projection="3d")
        surface_view(axes, surface, frame=False)
        words = "level" if level == 1 else "levels"
        axes.set_title(f"({letter}) {level} {words}", fontsize=LABEL, loc="left")


def _squares(axes: Axes) -> None:
    """Draw the squares of a level: two a side, so that diamonds between neighbours are seen."""
    for at in (0, 1, 2):
        axes.plot((0, 2), (at, at), color="black", linewidth=1.2, zorder=2)
        axes.plot((at, at), (0, 2), color="black", linewidth=1.2, zorder=2)
    nodes = np.arange(3)
    axes.plot(
        *(each.ravel() for each in np.meshgrid(nodes, nodes)), "s", color="black", markersize=4, zorder=3
    )
    axes.set(xlim=(-0.15, 2.15), ylim=(-0.15, 2.15), aspect="equal")
    axes.set_axis_off()
    axes.tick_params(labelsize=TICK)


def _square_step(axes: Axes) -> None:
    x, y = (each.ravel() for each in np.meshgrid((0.5, 1.5), (0.5, 1.5)))
    for centre in zip(x, y, strict=True):
        for corner in ((-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)):
            start = (centre[0] + 0.9 * corner[0], centre[1] + 0.9 * corner[1])
            end = (centre[0] + 0.2 * corner[0], centre[1] + 0.2 * corner[1])
            axes.annotate(
                "",
                end,
                start,
                arrowprops={"arrowstyle": "->", "color": _CENTRE, "linewidth": 0.8, "alpha": 0.6},
            )
    axes.plot(x, y, "o", color=_CENTRE, markersize=9, zorder=4)


def _diamond_step(axes: Axes) -> None:
    inner = [(0.5, 1.0), (1.5, 1.0), (1.0, 0.5), (1.0, 1.5)]
    border = [(0.5, 0.0), (1.5, 0.0), (0.5, 2.0), (1.5, 2.0), (0.0, 0.5), (0.0, 1.5), (2.0, 0.5), (2.0, 1.5)]
    for x, y in inner:
        diamond = np.array([(x - 0.5, y), (x, y - 0.5), (x + 0.5, y), (x, y + 0.5)])
        axes.fill(*diamond.T, facecolor=_DIAMOND, edgecolor="white", linewidth=1.2, alpha=0.8, zorder=1)
    for x, y in border:
        # On the border the diamond lacks its fourth corner.
        inward = np.clip(np.array([(x - 0.5, y), (x, y - 0.5), (x + 0.5, y), (x, y + 0.5)]), 0, 2)
        axes.fill(*inward.T, facecolor=_DIAMOND, edgecolor="white", linewidth=1.2, alpha=0.4, zorder=1)
    axes.plot(*np.meshgrid((0.5, 1.5), (0.5, 1.5)), "o", color=_CENTRE, markersize=9, zorder=4)
    axes.plot(*zip(*inner, *border, strict=True), "o", color=_EDGE, markersize=5, zorder=4)


def _next_level(axes: Axes) -> None:
    for x in (0.0, 0.5, 1.0, 1.5):
        for y in (0.0, 0.5, 1.0, 1.5):
            corners = np.array([(x, y), (x + 0.5, y), (x + 0.5, y + 0.5), (x, y + 0.5)])
            axes.fill(*corners.T, facecolor=_NEXT, edgecolor="#2e7d32", linewidth=0.9, alpha=0.55, zorder=1)
    _diamond_nodes(axes)


def _diamond_nodes(axes: Axes) -> None:
    nodes = np.arange(5) / 2
    x, y = (each.ravel() for each in np.meshgrid(nodes, nodes))
    halves = (2 * x).astype(int) % 2 + (2 * y).astype(int) % 2
    axes.plot(x[halves == 1], y[halves == 1], "o", color=_EDGE, markersize=5, zorder=4)
    axes.plot(x[halves == 2], y[halves == 2], "o", color=_CENTRE, markersize=9, zorder=4)
