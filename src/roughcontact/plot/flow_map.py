"""The flow of a fluid through the gap of a contact, as a map."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle

from roughcontact.fluid.gap_flow import GapFlow
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.raster import colour_bar, length_scale, part, show
from roughcontact.plot.drawing.ticks import LABEL
from roughcontact.validation import Array, numeric_method

__all__ = ["flow_map"]

_LINES, _MARK, _CONTACT = "#c8290b", "#d6006c", "#4d4d4d"
_LEAST = 1e-3  # of the largest flux: smaller fluxes have no lines
_MOST = 256  # blocks along an axis between which flow lines are traced


@numeric_method
def flow_map(flow: GapFlow, ax: Axes | None = None, *, direction: int = 0) -> Axes:
    """Draw the gap in colour and the contact in grey, flow lines, and a ring around the critical constriction.

    Flow lines are as wide as the root of the flux. They follow the flux of a drop along one direction.

    Parameters
    ----------
    flow : GapFlow
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    direction : int
        Axis of the mean drop on a periodic map; 0 otherwise.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> axes = rc.plot.flow_map(rc.gap_flow(rc.press(surface, 1e9, pressure=2e6)), direction=1)
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('x [µm]', 'y [µm]')
    """
    grid, axes = flow.solution.problem.grid, axes_for(ax)
    window = part(grid, None)
    usual = float(np.quantile(flow.gap, 0.99)) or float(flow.gap.max()) or 1.0
    chosen = scale(usual, VARIABLES["gap"].unit)
    gap = np.where(flow.gap > 0, flow.gap * chosen.factor, np.nan)
    image = show(axes, gap, grid, window, "Blues", (0.0, usual * chosen.factor))
    axes.patch.set_facecolor(_CONTACT)
    colour_bar(
        axes, image, f"gap [{chosen.unit}]; grey: closed", "max" if flow.gap.max() > usual else "neither"
    )
    if not flow.percolates:
        axes.set_title("no open path leads through the gap", fontsize=LABEL)
        return axes
    unit = length_scale(grid)
    _lines(axes, flow, direction, unit.factor)
    if (place := flow.constriction_along(direction)) is not None:
        y, x = (each * unit.factor for each in place.place)
        radius = max(0.5 * place.width, 0.03 * max(grid.lengths)) * unit.factor
        axes.add_patch(Circle((x, y), radius, fill=False, color=_MARK, linewidth=2.0, zorder=5))
        words = (
            f"ringed: critical constriction, {place.cells} open cells across, gap {written(place.gap, 'm')}"
        )
        axes.set_title(f"{words}\n{100 * place.share:.0f} % of the dissipation", fontsize=LABEL)
    return axes


def _lines(axes: Axes, flow: GapFlow, direction: int, factor: float) -> None:
    """Draw the flow lines, whose width grows with the flux."""
    grid = flow.solution.problem.grid
    down, right = (_means(each) for each in flow.flux(direction))
    flux = np.hypot(down, right)
    flux[flux < _LEAST * flux.max()] = 0.0  # stagnant pockets, and rounding errors
    speed = np.sqrt(flux)
    y, x = (
        (np.arange(n) + 0.5) * length / n * factor
        for n, length in zip(speed.shape, grid.lengths, strict=True)
    )
    widths = 0.3 + 1.9 * speed / speed.max()
    style: Any = {"color": _LINES, "arrowsize": 0.7, "density": 1.6, "zorder": 3, "linewidth": widths}
    # Lines end where nothing flows; zeros, unlike NaN, keep those through constrictions of one cell.
    axes.streamplot(x, y, np.where(flux > 0, right, 0.0), np.where(flux > 0, down, 0.0), **style)


def _means(values: Array) -> Array:
    """Return means over square blocks, at most `_MOST` along an axis."""
    for axis in (0, 1):
        stride = -(-values.shape[axis] // _MOST)
        ends = np.arange(0, values.shape[axis], stride)
        counts = np.diff(np.append(ends, values.shape[axis]))
        values = np.add.reduceat(values, ends, axis) / np.expand_dims(counts, 1 - axis)
    return values
