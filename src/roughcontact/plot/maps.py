"""Maps of a surface and of one loaded state, drawn on axes that the caller owns."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from roughcontact.contact.solution import Solution
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.engineering_units import scale, written
from roughcontact.plot.marks import faint_spots
from roughcontact.plot.raster import Window, box, colour_bar, extent, heights_image, length_scale, part, show
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["contact_map", "height_map", "pressure_map"]

_CONTACT = "#c8290b"


def height_map(axes: Axes, surface: Surface) -> None:
    """Draw the heights of a surface, with a colour bar; points that were not measured are hatched."""
    image, unit = heights_image(axes, surface.heights, surface.grid, None, "viridis")
    colour_bar(axes, image, f"{VARIABLES['heights'].label} [{unit}]")


def pressure_map(axes: Axes, solution: Solution, window: Window | None = None) -> None:
    """Draw the pressure in colour over the heights in grey, with a colour bar.

    Spots too small to be seen at this scale get a dot in the colour of their largest pressure. A
    `window` of cells (two slices) shows a part of the map; see `contact_window`.
    """
    _backdrop(axes, solution, window)
    grid, cells = solution.problem.grid, part(solution.problem.grid, window)
    chosen = scale(float(solution.pressure.max()), VARIABLES["pressure"].unit)
    pressure = np.where(solution.contact[cells], solution.pressure[cells] * chosen.factor, np.nan)
    highest, cut = _limit(pressure[~np.isnan(pressure)])
    end = written(highest / chosen.factor, VARIABLES["pressure"].unit) if cut else ""
    image = show(axes, pressure, grid, cells, "inferno", (0.0, highest))
    x, y, peaks, _ = _marks(solution, cells)
    dots: Any = {"s": 16, "cmap": image.cmap, "norm": image.norm, "linewidths": 0.5, "edgecolors": "white"}
    axes.scatter(x, y, c=peaks * chosen.factor, **dots)
    colour_bar(axes, image, f"{VARIABLES['pressure'].label} [{chosen.unit}]", end)


def contact_map(
    axes: Axes, solution: Solution, window: Window | None = None, frame: Window | None = None
) -> None:
    """Draw the cells in contact over the heights in grey.

    Spots too small to be seen at this scale are ringed, the larger the load the larger the ring. A
    `window` of cells (two slices) shows a part; a `frame` outlines a part that is shown elsewhere.
    """
    _backdrop(axes, solution, window)
    grid, cells = solution.problem.grid, part(solution.problem.grid, window)
    touched = np.where(solution.contact[cells], 1.0, np.nan)
    show(axes, touched, grid, cells, ListedColormap([_CONTACT]), (0.0, 1.0))
    x, y, _, loads = _marks(solution, cells)
    sizes = 14 + 80 * loads / max(float(loads.max(initial=0.0)), np.finfo(float).tiny)
    axes.scatter(x, y, s=sizes, facecolors="none", edgecolors=_CONTACT, linewidths=0.9)
    if frame is not None:
        left, right, bottom, top = extent(grid, frame)
        box(axes, (left, right), (top, bottom), color="black", linewidth=1)


def _limit(pressures: Array) -> tuple[float, bool]:
    """Return the upper end of the colours, and whether it cuts off some pressures."""
    if pressures.size == 0:
        return 1.0, False
    # A few cells at the edges of rough spots carry many times what the others do; coloured up to their
    # pressure, all the rest would be black.
    usual, largest = float(np.quantile(pressures, 0.95)), float(pressures.max())
    return (usual, True) if largest > 1.5 * usual else (largest, False)


def _backdrop(axes: Axes, solution: Solution, window: Window | None) -> None:
    """Draw the heights in a light grey that no colour of a contact meets."""
    surface = solution.problem.surface
    if surface is not None:
        greys = ListedColormap(colormaps["gray"](np.linspace(0.6, 1.0, 128)))
        heights_image(axes, surface.heights, surface.grid, window, greys)


def _marks(solution: Solution, cells: Window) -> tuple[Array, Array, Array, Array]:
    """Return x, y on the axes, largest pressure [Pa] and load [N] of the spots that need a mark."""
    spots, places = faint_spots(solution, cells)
    peaks = solution.pressure[tuple(places.T)]
    steps = np.array(solution.problem.grid.spacing) * length_scale(solution.problem.grid).factor
    y, x = ((places + 0.5) * steps).T
    return x, y, peaks, solution.spots.loads[spots]
