"""A perspective view of a surface."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import LightSource
from mpl_toolkits.mplot3d import Axes3D  # type: ignore[import-untyped]

from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import scale
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.raster import length_scale
from roughcontact.plot.drawing.ticks import LABEL, label_axes
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import numeric

__all__ = ["surface_view"]

_DRAWN = 200  # points along a side: more are slow to draw, and no page shows them
_HEIGHT = 0.3  # of the box over its longer side: heights are enlarged


@numeric
@analysed_on_host
def surface_view(surface: Surface, ax: Axes3D | None = None, *, frame: bool = True) -> Axes3D:
    """Draw a perspective view of a surface with enlarged heights; points that were not measured are left open.

    More than 200 points along a side are averaged over blocks first. The first row of the picture lies at the back.

    Parameters
    ----------
    surface : Surface
        A surface on a grid of two axes.
    ax : Axes3D, optional
        Axes to draw on, made with ``projection="3d"``; by default those of a new figure.
    frame : bool
        Whether to draw the box with its scales.

    Returns
    -------
    Axes3D

    Raises
    ------
    ValueError
        If the surface is a line.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> rc.plot.surface_view(surface).get_zlabel()
    'height [nm]'
    """
    if surface.grid.ndim != 2:
        raise InputError("a profile has no perspective view", "draw it with profile_curve")
    axes: Any = axes_for(ax, projection="3d")
    small = _reduced(surface)
    grid = small.grid
    length, z = length_scale(grid), scale(float(np.nanmax(np.abs(small.heights))), VARIABLES["heights"].unit)
    y, x = (
        (np.arange(n) + 0.5) * step * length.factor for n, step in zip(grid.shape, grid.spacing, strict=True)
    )
    heights = small.heights * z.factor
    low, high = float(np.nanmin(heights)), float(np.nanmax(heights))
    # A flat surface has one colour, the middle one.
    level = (heights - low) / (high - low) if high > low else np.full(heights.shape, 0.5)
    colours = colormaps["viridis"](np.nan_to_num(level, nan=0.5))
    # Slopes as drawn in the box, so that tall and flat surfaces are lit alike.
    tall = np.nan_to_num(level, nan=0.5) * _HEIGHT * max(grid.lengths)
    light = LightSource(azdeg=315, altdeg=45)
    shaded = light.shade_rgb(
        colours[..., :3], tall, dx=grid.spacing[1], dy=grid.spacing[0], blend_mode="soft"
    )
    opaque = np.dstack([shaded, np.ones(heights.shape)])
    every = {"rstride": 1, "cstride": 1, "linewidth": 0, "antialiased": False, "shade": False}
    axes.plot_surface(*np.meshgrid(x, y), heights, facecolors=opaque, **every)
    _box(axes, surface, (length.factor, length.unit), (low, high, z.unit), frame)
    return axes


def _reduced(surface: Surface) -> Surface:
    """Return the surface with at most 200 points along each axis."""
    factors = tuple(-(-n // _DRAWN) for n in surface.grid.shape)
    if max(factors) == 1:
        return surface
    # Blocks need not fit the period of the surface.
    free = replace(surface, grid=replace(surface.grid, periodic=(False, False)))
    return free.averaged(factors)


def _box(
    axes: Any, surface: Surface, length: tuple[float, str], z: tuple[float, float, str], frame: bool
) -> None:
    high, wide = (side * length[0] for side in surface.grid.lengths)
    low, top, unit = z
    # Row 0 is at the back, as it is at the top of a map.
    axes.set(xlim=(0.0, wide), ylim=(high, 0.0))
    if top > low:
        axes.set_zlim(low, top)
    longest = max(high, wide)
    axes.set_box_aspect((wide / longest, high / longest, _HEIGHT))
    axes.view_init(elev=38, azim=-60)
    if not frame:
        axes.set_axis_off()
        return
    label_axes(axes, f"x [{length[1]}]", f"y [{length[1]}]")
    axes.set_zlabel(f"{VARIABLES['heights'].label} [{unit}]", fontsize=LABEL)
    axes.locator_params(nbins=4)
