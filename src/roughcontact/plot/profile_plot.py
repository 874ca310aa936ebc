"""Pictures of heights and pressure along a line."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.grid import AnyGrid, RadialGrid
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.raster import length_scale
from roughcontact.plot.drawing.ticks import LABEL, TICK, label_axes
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.preparation.spikes import Spikes
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, Mask, numeric, require

__all__ = [
    "contact_profile",
    "draw_contact",
    "field_profile",
    "places_of",
    "pressure_profile",
    "profile_curve",
]

_LINE, _SPIKE, _CONTACT = "#0072b2", "#d55e00", "#c8290b"
_FLAT = (7.0, 2.8)  # size of a picture of a line


@numeric
@analysed_on_host
def profile_curve(
    surface: Surface, ax: Axes | None = None, *, row: int | None = None, spikes: Spikes | None = None
) -> Axes:
    """Draw the heights along a row of a surface, or a profile; the curve has gaps at missing points.

    Parameters
    ----------
    surface : Surface
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    row : int, optional
        Row of the picture, counted from 0 at its top, or from -1 at its bottom; by default the middle row. A line scan
        has no rows.
    spikes : Spikes, optional
        Spikes, such as ``roughcontact.find_spikes(surface)``; those on the row are marked.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If there is no such row.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> axes = rc.plot.profile_curve(surface, row=20)
    >>> axes.get_ylabel(), len(axes.lines[0].get_xdata())
    ('height [nm]', 64)
    """
    heights = surface.heights
    marked = None if spikes is None else spikes.mask
    if surface.grid.ndim == 2:
        rows = heights.shape[0]
        chosen = rows // 2 if row is None else row
        if not -rows <= chosen < rows:
            raise about("row", f"must lie between {-rows} and {rows - 1}, not {chosen}")
        heights = heights[chosen]
        marked = None if marked is None else marked[chosen]
    elif row is not None:
        raise InputError(f"a profile has no row {row}", "leave row out")
    step = surface.grid.spacing[-1]
    places = (np.arange(heights.size) + 0.5) * step
    x = scale(heights.size * step, VARIABLES["lengths"].unit)
    # The unit follows from the whole surface, because a row may be missing.
    z = scale(float(np.nanmax(np.abs(surface.heights))), VARIABLES["heights"].unit)
    axes = axes_for(ax, _FLAT)
    axes.plot(places * x.factor, heights * z.factor, color=_LINE, linewidth=1.0)
    if spikes is not None and marked is not None and marked.any():
        style: Any = {"color": _SPIKE, "markersize": 4, "label": str(spikes)}
        axes.plot(places[marked] * x.factor, heights[marked] * z.factor, "o", **style)
        axes.set_title(str(spikes), fontsize=LABEL)
    axes.set_xlim(0.0, heights.size * step * x.factor)
    label_axes(axes, f"x [{x.unit}]", f"{VARIABLES['heights'].label} [{z.unit}]", grid=True)
    return axes


@numeric
def contact_profile(solution: Solution, ax: Axes | None = None) -> Axes:
    """Draw the heights of a line or of rings over the flat, before and under the load, and the cells in contact.

    Parameters
    ----------
    solution : Solution
        A solution on a grid of one axis.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the solution is that of a surface.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.RadialGrid.uniform(128, 1e-4)
    >>> ball = rc.RadialProfile(-(grid.radii**2) / 2e-2, grid)
    >>> axes = rc.plot.contact_profile(rc.press(ball, 1e9, force=1e-2))
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('r [µm]', 'height over the flat [nm]')
    """
    solution, axes = _of_line(solution), axes_for(ax, _FLAT)
    problem = solution.problem
    before = np.where(problem.measured, solution.depth - problem.separation, np.nan)
    z = scale(float(np.nanmax(np.abs(before))), VARIABLES["heights"].unit)
    x, unit, name = places_of(problem.grid)
    middle = (x[1:] + x[:-1]) / 2
    for heights, colour, words in ((before, "0.6", "before"), (-solution.gap, _LINE, "under the load")):
        axes.plot(middle, heights * z.factor, color=colour, linewidth=1.0, label=words)
    draw_contact(axes, x, solution.contact, color=_CONTACT, linewidth=3.0)
    axes.set_xlim(x[0], x[-1])
    label_axes(axes, f"{name} [{unit}]", f"height over the flat [{z.unit}]", grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes


@numeric
def pressure_profile(solution: Solution, ax: Axes | None = None) -> Axes:
    """Draw the pressure along a line or over the radius of rings, each cell as it is.

    Parameters
    ----------
    solution : Solution
        A solution on a grid of one axis.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the solution is that of a surface.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.RadialGrid.uniform(128, 1e-4)
    >>> ball = rc.RadialProfile(-(grid.radii**2) / 2e-2, grid)
    >>> axes = rc.plot.pressure_profile(rc.press(ball, 1e9, force=1e-2))
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('r [µm]', 'pressure [MPa]')
    """
    solution = _of_line(solution)
    unit = unit_of("pressure", solution.problem.geometry)
    axes = field_profile(solution, solution.pressure, (VARIABLES["pressure"].label, unit), ax)
    axes.set_title(f"at most {written(float(solution.pressure.max()), unit)}", fontsize=LABEL)
    return axes


def field_profile(solution: Solution, values: Array, label: tuple[str, str], ax: Axes | None) -> Axes:
    """Draw a field along a line or over the radius of rings, each cell as it is; label: name and unit."""
    axes = axes_for(ax, _FLAT)
    y, (x, of_x, name) = scale(float(values.max()), label[1]), places_of(solution.problem.grid)
    axes.stairs(values * y.factor, x, fill=True, color=_LINE)
    axes.set_xlim(x[0], x[-1])
    axes.set_ylim(bottom=0.0)
    label_axes(axes, f"{name} [{of_x}]", f"{label[0]} [{y.unit}]", grid=True)
    return axes


def _of_line(solution: Solution) -> Solution:
    """Return the solution on the host, if its grid has one axis."""
    require(solution.problem.grid.ndim == 1, "this is a surface", "draw it with pressure_map or contact_map")
    return solution.on_host()


def draw_contact(axes: Axes, edges: Array, contact: Mask, **style: Any) -> None:
    """Draw a bar at zero along the cells in contact, between their edges."""
    touched = np.flatnonzero(contact)
    if touched.size:
        axes.hlines(0.0 * touched, edges[touched], edges[touched + 1], label="in contact", zorder=3, **style)


def places_of(grid: AnyGrid) -> tuple[Array, str, str]:
    """Return the edges of the cells of a line or of rings, their unit and the name of their axis."""
    x = length_scale(grid)
    if isinstance(grid, RadialGrid):
        return grid.edges * x.factor, x.unit, "r"
    edges = np.arange(grid.size + 1, dtype=np.float64) * grid.spacing[0]
    return edges * x.factor, x.unit, "x"
