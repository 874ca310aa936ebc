"""Maps of a surface and of a loaded state."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from roughcontact.contact.solution import Solution
from roughcontact.grid import AnyGrid
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.marks import faint_spots
from roughcontact.plot.drawing.raster import (
    Window,
    box,
    colour_bar,
    extent,
    heights_image,
    length_scale,
    part,
    show,
)
from roughcontact.plot.drawing.ticks import LABEL
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.preparation.spikes import Spikes
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric

__all__ = ["colour_limit", "contact_field", "contact_map", "height_map", "pressure_map"]

_CONTACT = "#c8290b"
_SPIKE, _RING = "#d55e00", 90  # a colour outside viridis, and the size of a ring [points^2]


@numeric
@analysed_on_host
def height_map(surface: Surface, ax: Axes | None = None, *, spikes: Spikes | None = None) -> Axes:
    """Draw the heights of a surface, with a colour bar; points that were not measured are hatched.

    If a few heights far out would take half of the colours, the colours end before them, and the label of the bar gives
    the range of the heights. Heights that differ by a small part of their size are shown above one of them.

    Parameters
    ----------
    surface : Surface
        A surface on a grid of two axes.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    spikes : Spikes, optional
        Spikes to mark by rings, such as ``roughcontact.find_spikes(surface)``.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the surface is a profile.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> axes = rc.plot.height_map(surface, spikes=rc.find_spikes(surface))
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('x [µm]', 'y [µm]')
    """
    window = part(surface.grid, None)
    axes = axes_for(ax)
    image, words, cut = heights_image(axes, surface.heights, surface.grid, window, "viridis")
    colour_bar(axes, image, words, "both" if cut else "neither")
    if spikes is not None and spikes.count:
        y, x = (_steps(surface.grid) * (spikes.places + 0.5)).T
        ring: Any = {"facecolors": "none", "edgecolors": _SPIKE, "linewidths": 1.1, "clip_on": False}
        axes.scatter(x, y, s=_RING, label=str(spikes), **ring)
        axes.set_title(f"{spikes}, ringed", fontsize=LABEL)
    return axes


@numeric
def pressure_map(solution: Solution, ax: Axes | None = None, *, window: Window | None = None) -> Axes:
    """Draw the pressure in colour over the heights in grey, with a colour bar.

    Spots that are too small to see at this scale get a dot in the colour of their largest pressure.

    Parameters
    ----------
    solution : Solution
        A surface on a grid of two axes.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    window : tuple of two slices, optional
        Rows and columns of the part to show.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the solution is that of a line or of rings.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> axes = rc.plot.pressure_map(rc.press(ball, 1e9, force=1e-2), window=(slice(16, 48), slice(16, 48)))
    >>> [float(x) for x in axes.get_xlim()], axes.get_xlabel()
    ([16.0, 48.0], 'x [µm]')
    """
    solution, column = solution.on_host(), VARIABLES["pressure"]
    return contact_field(solution, solution.pressure, (column.label, column.unit), ax, window)


def contact_field(
    solution: Solution, values: Array, label: tuple[str, str], ax: Axes | None, window: Window | None = None
) -> Axes:
    """Draw a field of the cells in contact in colour over the heights, as `pressure_map` does; label: name and unit."""
    grid, cells = solution.problem.grid, part(solution.problem.grid, window)
    axes = axes_for(ax)
    _backdrop(axes, solution, window)
    name, unit = label
    chosen = scale(float(values.max()), unit)
    shown = np.where(solution.contact[cells], values[cells] * chosen.factor, np.nan)
    highest, cut = colour_limit(shown[~np.isnan(shown)])
    words = f"\n(colours end at {written(highest / chosen.factor, unit)})" if cut else ""
    image = show(axes, shown, grid, cells, "inferno", (0.0, highest))
    x, y, places, _ = _marks(solution, cells)
    dots: Any = {"s": 16, "cmap": image.cmap, "norm": image.norm, "linewidths": 0.5, "edgecolors": "white"}
    axes.scatter(x, y, c=values[places] * chosen.factor, **dots)
    colour_bar(axes, image, f"{name} [{chosen.unit}]{words}", "max" if cut else "neither")
    return axes


@numeric
def contact_map(
    solution: Solution, ax: Axes | None = None, *, window: Window | None = None, frame: Window | None = None
) -> Axes:
    """Draw the cells in contact over the heights in grey.

    Spots that are too small to see at this scale get a ring, whose size grows with the load.

    Parameters
    ----------
    solution : Solution
        A surface on a grid of two axes.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    window : tuple of two slices, optional
        Rows and columns of the part to show.
    frame : tuple of two slices, optional
        Rows and columns of a part to outline, which another picture shows.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the solution is that of a line or of rings.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> axes = rc.plot.contact_map(rc.press(ball, 1e9, force=1e-2), frame=(slice(16, 48), slice(16, 48)))
    >>> [float(x) for x in axes.get_xlim()], axes.get_xlabel()  # the whole map, with a frame about its middle
    ([0.0, 64.0], 'x [µm]')
    """
    solution = solution.on_host()
    grid, cells = solution.problem.grid, part(solution.problem.grid, window)
    axes = axes_for(ax)
    _backdrop(axes, solution, window)
    touched = np.where(solution.contact[cells], 1.0, np.nan)
    show(axes, touched, grid, cells, ListedColormap([_CONTACT]), (0.0, 1.0))
    x, y, _, loads = _marks(solution, cells)
    sizes = 14 + 80 * loads / max(float(loads.max(initial=0.0)), np.finfo(float).tiny)
    axes.scatter(x, y, s=sizes, facecolors="none", edgecolors=_CONTACT, linewidths=0.9)
    if frame is not None:
        left, right, bottom, top = extent(grid, frame)
        box(axes, (left, right), (top, bottom), color="black", linewidth=1)
    return axes


def colour_limit(pressures: Array) -> tuple[float, bool]:
    """Return the upper end of the colours, and whether some pressures lie above it."""
    if pressures.size == 0:
        return 1.0, False
    # A few cells at the edges of rough spots carry many times the pressure of the others; if the colours went up to
    # their pressure, all other cells would be black.
    usual, largest = float(np.quantile(pressures, 0.95)), float(pressures.max())
    return (usual, True) if largest > 1.5 * usual else (largest, False)


def _backdrop(axes: Axes, solution: Solution, window: Window | None) -> None:
    """Draw the heights in light grey, distinct from the colours of a contact."""
    surface = solution.problem.surface
    if surface is not None:
        greys = ListedColormap(colormaps["gray"](np.linspace(0.6, 1.0, 128)))
        heights_image(axes, surface.heights, surface.grid, window, greys)


def _marks(solution: Solution, cells: Window) -> tuple[Array, Array, Any, Array]:
    """Return x, y on the axes, cell of the largest pressure and load [N] of the spots that need a mark."""
    spots, places = faint_spots(solution, cells)
    y, x = (_steps(solution.problem.grid) * (places + 0.5)).T
    return x, y, tuple(places.T), solution.spots.loads[spots]


def _steps(grid: AnyGrid) -> Array:
    """Return the sides of a cell in the unit of the axes, the factors from rows and columns to places."""
    return np.array(grid.spacing) * length_scale(grid).factor
