"""Figure 35: a rough sphere, generated."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.view import surface_view
from roughcontact_thesis import drawing

__all__ = ["case", "draw"]

TITLE = "a rough sphere, H = 0.7"
HURST = 0.7
POINTS = 161
LENGTH = 1.0
RADIUS = 0.5
RMS = 9e-3
SEED = 2
CHOSEN = (
    f"R = {RADIUS:g} L and rms height {RMS:g} L as in figure 37, {POINTS} x {POINTS} points",
    "the sphere as the paraboloid r^2/(2R), as the thesis approximates it; drawn as far as r = L/2",
)
SIZE = (drawing.COLUMN, 2.5)


def case(seed: int = SEED) -> rc.Surface:
    """Return the paraboloid with the roughness on it."""
    grid = rc.Grid((POINTS, POINTS), LENGTH / (POINTS - 1))
    roughness = rc.self_affine(grid, HURST, RMS * LENGTH, np.random.default_rng(seed), nodal=True)
    return rc.shapes.paraboloid(grid, RADIUS) + roughness


def draw(figure: Figure, data: rc.Surface) -> None:
    """Draw the sphere from aside."""
    # Axes in space are square, and leave much of their square empty: these reach over the page.
    axes: Any = figure.add_subplot(projection="3d")
    tall, wide = SIZE[0] / SIZE[1], 0.86
    axes.set_position((-0.02, 0.62 - wide * tall / 2, wide, wide * tall))
    grid = data.grid
    y, x = (place - length / 2 for place, length in zip(grid.coordinates, grid.lengths, strict=True))
    inside = np.hypot(*np.meshgrid(y, x, indexing="ij")) <= LENGTH / 2
    shown = np.where(inside, data.heights, np.nan)
    surface_view(rc.Surface(shown, grid), axes, frame=False)
    colours = ScalarMappable(Normalize(float(np.nanmin(shown)), float(np.nanmax(shown))), "viridis")
    bar = figure.colorbar(colours, cax=figure.add_axes((0.8, 0.2, 0.025, 0.62)))
    bar.set_label(r"height $z\,/\,L$")
    # The box is 0.3 of its width high.
    enlarged = 0.3 * LENGTH / float(np.nanmax(shown) - np.nanmin(shown))
    words = rf"base: a circle of diameter $L$; heights times {enlarged:.1f}"
    figure.text(0.41, 0.04, words, ha="center", fontsize=drawing.TICK)
    axes.set_box_aspect((1, 1, 0.3), zoom=1.15)
