"""Arrays as pictures: the places of cells on the axes, their unit, and colour bars."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colorbar import Colorbar
from matplotlib.colors import Colormap
from matplotlib.image import AxesImage

from roughcontact.errors import InputError
from roughcontact.grid import AnyGrid
from roughcontact.labels.engineering_units import Scale, scale, written
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.ticks import LABEL, TICK, label_axes
from roughcontact.plot.drawing.usual_range import usual_range
from roughcontact.validation import Array

__all__ = [
    "Window",
    "box",
    "colour_bar",
    "extent",
    "heights_image",
    "length_scale",
    "part",
    "pooled",
    "show",
]

Window = tuple[slice, slice]
Colours = Colormap | str

# More cells than this along a side are pooled before drawing: no page shows them, and a renderer that drops rows could
# drop the contact.
_DRAWN = 1024
_ALIKE = 0.05  # of their size: heights that differ by less are drawn above a datum


def part(grid: AnyGrid, window: Window | None) -> Window:
    """Return the cells to draw: those of `window`, or all.

    Raises
    ------
    ValueError
        If the grid has one axis.
    """
    if grid.ndim != 2:
        raise InputError("a map shows a surface of two axes", "draw the profile of a line or of rings")
    return (slice(0, grid.shape[0]), slice(0, grid.shape[1])) if window is None else window


def length_scale(grid: AnyGrid) -> Scale:
    """Return the unit of both axes of a map; a window keeps the unit of the whole."""
    return scale(max(grid.lengths), VARIABLES["lengths"].unit)


def extent(grid: AnyGrid, window: Window) -> tuple[float, float, float, float]:
    """Return the edges of `window` on the axes: left, right, bottom, top; row 0 is at the top."""
    factor = length_scale(grid).factor
    (y0, y1), (x0, x1) = (
        (cells.start * step * factor, cells.stop * step * factor)
        for cells, step in zip(window, grid.spacing, strict=True)
    )
    return x0, x1, y1, y0


def box(axes: Axes, across: tuple[float, float], upright: tuple[float, float], **style: Any) -> None:
    """Draw a rectangle from its limits along each axis."""
    (left, right), (low, high) = across, upright
    axes.plot((left, right, right, left, left), (low, low, high, high, low), **style)


def show(
    axes: Axes, values: Array, grid: AnyGrid, window: Window, colours: Colours, limits: tuple[float, float]
) -> AxesImage:
    """Draw `values`, the cells of `window`, without interpolation; NaN stays transparent."""
    values = pooled(values)
    rows, columns = values.shape
    left, right, bottom, top = extent(grid, window)
    # Pooling rounds the number of blocks up, so the image may extend beyond the edge; the axes do not.
    stride = [-(-(cells.stop - cells.start) // n) for cells, n in zip(window, (rows, columns), strict=True)]
    high = (bottom - top) * rows * stride[0] / (window[0].stop - window[0].start)
    wide = (right - left) * columns * stride[1] / (window[1].stop - window[1].start)
    place: Any = {"origin": "upper", "extent": (left, left + wide, top + high, top)}
    lowest, highest = limits
    image = axes.imshow(values, colours, vmin=lowest, vmax=highest, interpolation="nearest", **place)
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")
    unit = length_scale(grid).unit
    label_axes(axes, f"x [{unit}]", f"y [{unit}]")
    axes.locator_params(nbins=6)
    return image


def pooled(values: Array) -> Array:
    """Return the largest value of each block, with at most 1024 rows and columns; NaN only if all are NaN."""
    for axis in (0, 1):
        stride = -(-values.shape[axis] // _DRAWN)
        if stride > 1:
            values = np.fmax.reduceat(values, np.arange(0, values.shape[axis], stride), axis=axis)
    return values


def heights_image(
    axes: Axes, heights: Array, grid: AnyGrid, window: Window | None, colours: Colours
) -> tuple[AxesImage, str, bool]:
    """Draw heights, hatched where missing; return the image, its label, and whether heights exceed the colours.

    Heights that differ by a small part of their size are drawn above one of them, which the label contains.
    """
    window = part(grid, window)
    inside = heights[window]
    measured = inside[~np.isnan(inside)]
    whole = (float(measured.min()), float(measured.max())) if measured.size else (0.0, 0.0)
    low, high = (usual_range(measured) if measured.size else None) or whole
    words, unit, datum = VARIABLES["heights"].label, VARIABLES["heights"].unit, 0.0
    if 0 < high - low < _ALIKE * max(abs(low), abs(high)):
        datum = float(f"{low:.3g}")
        words += f" above {written(datum, unit)}"
    chosen = scale(max(abs(low - datum), abs(high - datum)), unit)
    words += f" [{chosen.unit}]"
    if cut := (low, high) != whole:
        words += f"\n(heights go from {written(whole[0], unit)} to {written(whole[1], unit)})"
    if measured.size < inside.size:
        axes.patch.set(facecolor="white", edgecolor="0.55", hatch="//////")
    shown, limits = (inside - datum) * chosen.factor, [(end - datum) * chosen.factor for end in (low, high)]
    return show(axes, shown, grid, window, colours, (limits[0], limits[1])), words, cut


def colour_bar(
    axes: Axes, image: AxesImage, label: str, extend: Literal["neither", "max", "both"] = "neither"
) -> None:
    """Put a colour bar beside the map, of the same height; its ends are pointed if values lie beyond its colours."""
    bar = Colorbar(axes.inset_axes((1.03, 0.0, 0.045, 1.0)), image, extend=extend)
    bar.set_label(label, fontsize=LABEL)
    bar.ax.tick_params(labelsize=TICK)
    bar.outline.set_linewidth(0.5)
