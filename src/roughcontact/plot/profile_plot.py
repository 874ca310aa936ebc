"""Heights along a line, drawn on axes that the caller owns."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.engineering_units import scale
from roughcontact.plot.ticks import label_axes
from roughcontact.surface.surface import Surface

__all__ = ["profile_curve"]

_LINE = "#0072b2"


def profile_curve(axes: Axes, surface: Surface, row: int | None = None) -> None:
    """Draw the heights along a row of a surface, or a profile; the curve is broken where points are missing.

    Parameters
    ----------
    axes : Axes
    surface : Surface
    row : int, optional
        Row of the picture, counted from 0 at its top, or from -1 at its bottom; by default the middle one. A line
        scan has none.

    Raises
    ------
    ValueError
        If there is no such row.
    """
    heights = surface.heights
    if surface.grid.ndim == 2:
        rows = heights.shape[0]
        chosen = rows // 2 if row is None else row
        if not -rows <= chosen < rows:
            raise ValueError(f"row must lie between {-rows} and {rows - 1}, not at {chosen}")
        heights = heights[chosen]
    elif row is not None:
        raise ValueError(f"a profile has no row {row}: leave row out")
    step = surface.grid.spacing[-1]
    places = (np.arange(heights.size) + 0.5) * step
    x = scale(heights.size * step, VARIABLES["lengths"].unit)
    # One missing row says nothing about the unit of the picture.
    z = scale(float(np.nanmax(np.abs(surface.heights))), VARIABLES["heights"].unit)
    axes.plot(places * x.factor, heights * z.factor, color=_LINE, linewidth=1.0)
    axes.set_xlim(0.0, heights.size * step * x.factor)
    label_axes(axes, f"x [{x.unit}]", f"{VARIABLES['heights'].label} [{z.unit}]", grid=True)
