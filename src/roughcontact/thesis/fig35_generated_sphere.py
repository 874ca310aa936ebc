"""Figure 35: a rough sphere, generated."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.plot.view import surface_view

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
SIZE = (5.4, 3.2)


def case(seed: int = SEED) -> rc.Surface:
    """Return the paraboloid with the roughness on it."""
    grid = rc.Grid((POINTS, POINTS), LENGTH / (POINTS - 1))
    roughness = rc.self_affine(grid, HURST, RMS * LENGTH, np.random.default_rng(seed), nodal=True)
    return rc.shapes.paraboloid(grid, RADIUS) + roughness


def draw(figure: Figure, data: rc.Surface) -> None:
    """Draw the sphere from aside."""
    # Axes in space are square, and leave much of their square empty: these reach over the page.
    axes: Any = figure.add_subplot(projection="3d")
    tall = SIZE[0] / SIZE[1]
    axes.set_position((0.0, 0.61 - tall / 2, 1.0, tall))
    grid = data.grid
    y, x = (place - length / 2 for place, length in zip(grid.coordinates, grid.lengths, strict=True))
    inside = np.hypot(*np.meshgrid(y, x, indexing="ij")) <= LENGTH / 2
    surface_view(rc.Surface(np.where(inside, data.heights, np.nan), grid), axes, frame=False)
    axes.set_box_aspect((1, 1, 0.3), zoom=1.15)
