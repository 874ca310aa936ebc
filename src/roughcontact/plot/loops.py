"""Pictures of loops of loads, and of the surface before and after them."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.arrays import on_host
from roughcontact.contact.flow import Flow
from roughcontact.contact.loop import Loop
from roughcontact.contact.problem import Body
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.raster import length_scale
from roughcontact.plot.drawing.ticks import LABEL, TICK, label_axes, readable_ticks
from roughcontact.plot.maps import height_map
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric

__all__ = ["bearing_curves", "depth_loop", "flattened_figure", "loop_figure", "stiffness_loop"]

# First loading, unloading and reloading: colours that are distinct for every reader, and different marks.
_STYLES: dict[str, Any] = {
    "loading": {"color": "#0072b2", "marker": "o", "label": "first loading"},
    "unloading": {"color": "#d55e00", "marker": "v", "label": "unloading"},
    "reloading": {"color": "#009e73", "marker": "^", "markerfacecolor": "none", "label": "reloading"},
}
_BEFORE, _AFTER = "0.55", "#0072b2"
_POINTS = 2000  # of a bearing curve: more are invisible


@numeric
def depth_loop(loop: Loop, ax: Axes | None = None) -> Axes:
    """Draw force against depth along the loop, and the residual depth.

    Parameters
    ----------
    loop : Loop
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> axes = rc.plot.depth_loop(rc.loading_loop(ball, 1e11, hardness=2e9, forces=[0.05, 0.1, 0.2]))
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('depth [nm]', 'force [mN]')
    """
    axes, kind = axes_for(ax), loop.loading.geometry
    x = scale(float(np.abs(loop.loading.depth).max()), VARIABLES["depth"].unit)
    y = scale(float(loop.loading.force.max()), unit_of("force", kind))
    for name, curve in loop.curves.items():
        start = 0.0 if name == "loading" else loop.residual_depth
        ends = (np.append(curve.force, 0.0), np.append(curve.depth, start))
        force, depth = ends if name == "unloading" else (np.roll(end, 1) for end in ends)
        axes.plot(depth * x.factor, force * y.factor, markersize=4, linewidth=1.1, **_STYLES[name])
    words = f"residual depth {written(loop.residual_depth, 'm')}"
    axes.set_title(words, fontsize=LABEL)
    label_axes(axes, f"depth [{x.unit}]", f"force [{y.unit}]", grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes


@numeric
def stiffness_loop(loop: Loop, ax: Axes | None = None) -> Axes:
    """Draw the interfacial stiffness per area against the nominal pressure along the loop, both logarithmic.

    The line is the stiffness of unloading from each load of first loading. Infinite values are left out.

    Parameters
    ----------
    loop : Loop
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> axes = rc.plot.stiffness_loop(rc.loading_loop(ball, 1e11, hardness=2e9, forces=[0.05, 0.1, 0.2]))
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('nominal pressure [MPa]', 'interfacial stiffness per area K/A0 [N/µm/mm²]')
    """
    axes, kind = axes_for(ax), loop.loading.geometry
    load, stiff = "nominal_pressure", "interfacial_stiffness_per_area"
    values = {name: curve.interfacial_stiffness_per_area for name, curve in loop.curves.items()}
    finite = np.concatenate([each[np.isfinite(each) & (each > 0)] for each in values.values()])
    x = scale(float(loop.loading.nominal_pressure.max()), unit_of(load, kind))
    y = scale(float(finite.max(initial=0.0)), unit_of(stiff, kind))
    axes.set(xscale="log", yscale="log")

    def draw(pressure: Array, stiffness: Array, **style: Any) -> None:
        shown = np.isfinite(stiffness) & (stiffness > 0)
        axes.plot(pressure[shown] * x.factor, stiffness[shown] * y.factor, **style)

    if loop.loading.flow is not None:
        turns = loop.loading.flow.unloading_interfacial_stiffness / loop.loading.nominal_area
        draw(loop.loading.nominal_pressure, turns, color="0.3", linewidth=1.0, label="where unloading begins")
    for name, curve in loop.curves.items():
        draw(curve.nominal_pressure, values[name], markersize=4.5, linestyle="none", **_STYLES[name])
    for axis, drawn in ((axes.xaxis, loop.loading.nominal_pressure), (axes.yaxis, finite)):
        if drawn.size:
            readable_ticks(axis, float(drawn.max() / drawn.min()))
    names = (f"{VARIABLES[load].label} [{x.unit}]", f"{VARIABLES[stiff].label} [{y.unit}]")
    label_axes(axes, *names, grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes


@numeric
def bearing_curves(surface: Body, flow: Flow, ax: Axes | None = None) -> Axes:
    """Draw the bearing (Abbott) curve of a surface before and after it has flowed: heights above the first mean.

    Parameters
    ----------
    surface : Surface or RadialProfile
        The original surface.
    flow : Flow
        The flow, such as ``solution.flow``.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> axes = rc.plot.bearing_curves(ball, rc.press(ball, 1e11, force=0.2, hardness=2e9).flow)
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('area above the height [%]', 'height above the mean [µm]')
    """
    axes = axes_for(ax)
    curves = {"before": bearing_of(surface), "after": bearing_of(flow.flatten(surface))}
    share, heights = curves["before"]
    mean = float(np.average(heights, weights=np.diff(share, prepend=0.0)))
    z = scale(float(np.abs(heights - mean).max()), VARIABLES["heights"].unit)
    for (words, (part, height)), colour in zip(curves.items(), (_BEFORE, _AFTER), strict=True):
        some = np.unique(np.linspace(0, height.size - 1, _POINTS).astype(int))
        axes.plot(100 * part[some], (height[some] - mean) * z.factor, color=colour, label=words)
    axes.set_xlim(0.0, 100.0)
    label_axes(axes, "area above the height [%]", f"height above the mean [{z.unit}]", grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes


def bearing_of(surface: Body) -> tuple[Array, Array]:
    """Return the part of the area at or above each height, and the heights [m], from the highest down."""
    heights = np.ravel(on_host(surface.heights))
    areas = np.broadcast_to(surface.grid.cell_area, surface.grid.shape).ravel()
    there = np.isfinite(heights)
    order = np.argsort(-heights[there], kind="stable")
    above = np.cumsum(areas[there][order])
    return above / above[-1], heights[there][order]


@numeric
def loop_figure(loop: Loop) -> Figure:
    """Return force against depth beside stiffness against pressure, along a loop.

    Parameters
    ----------
    loop : Loop

    Returns
    -------
    Figure

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> loop = rc.loading_loop(ball, 1e11, hardness=2e9, forces=[0.05, 0.1, 0.2])
    >>> [axes.get_xlabel() for axes in rc.plot.loop_figure(loop).axes]
    ['depth [nm]', 'nominal pressure [MPa]']
    """
    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    first, second = figure.subplots(1, 2)
    depth_loop(loop, first)
    stiffness_loop(loop, second)
    return figure


@numeric
def flattened_figure(surface: Body, flow: Flow) -> Figure:
    """Return the flattened surface beside its bearing curve, before and after.

    Parameters
    ----------
    surface : Surface or RadialProfile
        The original surface.
    flow : Flow
        The flow, such as ``solution.flow``.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> figure = rc.plot.flattened_figure(ball, rc.press(ball, 1e11, force=0.2, hardness=2e9).flow)
    >>> [axes.get_xlabel() for axes in figure.axes[:2]]
    ['x [µm]', 'area above the height [%]']
    """
    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    heights, bearing = figure.subplots(1, 2, width_ratios=(1.25, 1))
    after = flow.flatten(surface)
    if isinstance(after, Surface) and after.grid.ndim == 2:
        height_map(after, heights)
    else:
        _profiles(surface, after, heights)
    heights.set_title(f"flattened by up to {written(float(flow.depth.max()), 'm')}", fontsize=LABEL)
    bearing_curves(surface, flow, bearing)
    return figure


def _profiles(before: Body, after: Body, axes: Axes) -> None:
    """Draw a line or rings before and after."""
    grid = before.grid
    [places], x = grid.coordinates, length_scale(grid)
    z = scale(float(np.nanmax(np.abs(before.heights))), VARIABLES["heights"].unit)
    for body, colour, words in ((before, _BEFORE, "before"), (after, _AFTER, "after")):
        axes.plot(places * x.factor, body.heights * z.factor, color=colour, linewidth=1.0, label=words)
    axes.legend(fontsize=TICK, frameon=False)
    name = Geometry.of(grid).axes[0]
    label_axes(axes, f"{name} [{x.unit}]", f"{VARIABLES['heights'].label} [{z.unit}]", grid=True)
