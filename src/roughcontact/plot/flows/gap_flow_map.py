"""The flow of a fluid through the gap of a contact, as a map."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from roughcontact.fluid.gap_flow import GapFlow
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.raster import colour_bar, length_scale, part, show
from roughcontact.plot.drawing.ticks import LABEL
from roughcontact.validation import Array, numeric_method

__all__ = ["flow_figure", "flow_map"]

_LINES, _MARK, _CONTACT = "#c8290b", "#d6006c", "#4d4d4d"
_LEAST = 1e-3  # of the largest flux: smaller fluxes have no lines
_SMALL_SHARE = 0.05  # of the dissipation, below which no constriction decides
_FEWEST, _MOST = 128, 256  # values along an axis from which flow lines are traced


def flow_figure(flow: GapFlow, direction: int) -> Figure:
    """Return a figure of the map, as high as the map needs."""
    height, width = flow.solution.problem.grid.lengths
    figure = Figure(figsize=(6.4, min(max(1.0 + 4.2 * height / width, 2.6), 9.0)), layout="constrained")
    flow_map(flow, figure.subplots(), direction=direction)
    return figure


@numeric_method
def flow_map(flow: GapFlow, ax: Axes | None = None, *, direction: int = 0) -> Axes:
    """Draw the gap in colour and the contact in grey, flow lines, and a ring around the critical constriction.

    A constriction with less than 5 % of the dissipation has no ring, because it does not decide the flow.

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
    down, right = (_means(each) for each in flow.flux(direction))
    grid, axes = flow.solution.problem.grid, axes_for(ax)
    window = part(grid, None)
    measured = flow.solution.problem.measured
    gaps = flow.gap[measured]  # the gap of an open cell without height is arbitrary
    usual = float(np.quantile(gaps, 0.99)) or float(gaps.max()) or 1.0
    chosen = scale(usual, VARIABLES["gap"].unit)
    gap = np.where(flow.gap > 0, flow.gap * chosen.factor, np.nan)
    image = show(axes, gap, grid, window, "Blues", (0.0, usual * chosen.factor))
    axes.patch.set_facecolor(_CONTACT)
    grey = "closed"
    if not measured.all():
        grey += "; not measured: darkest" if flow.gap[~measured].any() else " or not measured"
    label = f"gap [{chosen.unit}]; grey: {grey}"
    colour_bar(axes, image, label, "max" if flow.gap.max() > usual else "neither")
    if not flow.percolates:
        axes.set_title("no open path leads through the gap", fontsize=LABEL)
        return axes
    unit = length_scale(grid)
    _lines(axes, down, right, tuple(length * unit.factor for length in grid.lengths))
    place = flow.constriction_along(direction)
    if place is not None and place.share < _SMALL_SHARE:
        axes.set_title(
            f"no critical constriction: the tightest place has {_percent(place.share)} of the dissipation",
            fontsize=LABEL,
        )
    elif place is not None:
        y, x = (each * unit.factor for each in place.place)
        radius = max(0.5 * place.width, 0.03 * max(grid.lengths)) * unit.factor
        axes.add_patch(Circle((x, y), radius, fill=False, color=_MARK, linewidth=2.0, zorder=5))
        words = (
            f"ringed: critical constriction, {place.cells} open cells across, gap {written(place.gap, 'm')}"
        )
        axes.set_title(f"{words}\n{_percent(place.share)} of the dissipation", fontsize=LABEL)
    return axes


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %" if share >= 0.01 else "less than 1 %"


def _lines(axes: Axes, down: Array, right: Array, lengths: tuple[float, ...]) -> None:
    """Draw the flow lines, whose width grows with the flux."""
    # On few cells, lines between the centres would lead through contact, and end half a cell before the sides.
    finer = -(-_FEWEST // min(down.shape))
    down, right = (each.repeat(finer, 0).repeat(finer, 1) for each in (down, right))
    flux = np.hypot(down, right)
    flux[flux < _LEAST * flux.max()] = 0.0  # stagnant pockets, and rounding errors
    speed = np.sqrt(flux)
    y, x = ((np.arange(n) + 0.5) * length / n for n, length in zip(speed.shape, lengths, strict=True))
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
