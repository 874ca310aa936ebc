"""Pictures of pressure and tension of adhesive surfaces."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.detachment_state import DetachmentState
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.raster import colour_bar, length_scale, part, pooled, show
from roughcontact.plot.drawing.ticks import LABEL, TICK, label_axes
from roughcontact.plot.maps import colour_limit
from roughcontact.plot.profile_plot import draw_contact, places_of
from roughcontact.validation import Array, Mask

__all__ = ["state_figure", "tension_map", "tension_profile"]

State = AdhesiveState | DetachmentState
_PRESSED, _PULLED, _CONTACT = "#c8290b", "#2166ac", "black"


def tension_map(state: State, ax: Axes | None = None) -> Axes:
    """Draw the pressure, zero in the middle of the colours: tension blue, each side on its own scale; contact outlined.

    Parameters
    ----------
    state : AdhesiveState or DetachmentState
        A state on a grid of two axes.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the state is that of a line or of rings.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 2e-8), radius=1e-5)
    >>> state = rc.adhesive_state(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=2e-9)
    >>> axes = rc.plot.tension_map(state)
    >>> axes.images[0].norm.vcenter, axes.images[0].norm.vmin < 0 < axes.images[0].norm.vmax
    (0, True)
    """
    grid = state.problem.operator.grid
    cells, axes = part(grid, None), axes_for(ax)
    unit = VARIABLES["pressure"].unit
    # As in other maps, the colours end before the pressure of a few cells at the edges of spots.
    highest, cut = colour_limit(state.pressure[state.pressure > 0])
    lowest = float(np.maximum(-state.pressure, 0.0).max()) or highest
    chosen = scale(max(highest, lowest), unit)
    measured = np.isfinite(state.problem.separation)
    values = np.where(measured, state.pressure * chosen.factor, np.nan)
    most, least = (
        pooled(values),
        -pooled(-values),
    )  # the larger of pressure and tension of each block of cells
    if not measured.all():
        axes.patch.set(facecolor="white", edgecolor="0.55", hatch="//////")
    limits = (-lowest * chosen.factor, highest * chosen.factor)
    image = show(axes, np.where(-least > most, least, most), grid, cells, "RdBu_r", limits)
    image.set_norm(TwoSlopeNorm(0, *limits))
    edges = _outline(state.contact) * (np.array(grid.spacing[::-1]) * length_scale(grid).factor)
    axes.add_collection(LineCollection(list(edges), colors=_CONTACT, linewidths=0.6))
    end = f"\n(colours end at {written(highest, unit)})" if cut else ""
    colour_bar(axes, image, f"pressure, tension negative [{chosen.unit}]{end}", "max" if cut else "neither")
    return axes


def tension_profile(state: State, ax: Axes | None = None) -> Axes:
    """Draw the pressure along a line or the radius of rings, tension below zero; contact is a bar at zero.

    Parameters
    ----------
    state : AdhesiveState or DetachmentState
        A state on a grid of one axis.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the state is that of a surface.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> axes = rc.plot.tension_profile(rc.adhesive_state(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=0.0))
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('r [nm]', 'pressure, tension negative [MPa]')
    """
    x, of_x, name = places_of(state.problem.operator.grid)
    axes = axes_for(ax, (7.0, 2.8))
    unit = unit_of("pressure", state.geometry)
    p = scale(float(np.abs(state.pressure).max()), unit)
    for sign, colour in ((1, _PRESSED), (-1, _PULLED)):
        some = np.maximum(sign * state.pressure, 0.0) * (sign * p.factor)
        axes.stairs(some, x, fill=True, color=colour, linewidth=0)
    if state.contact.any():
        draw_contact(axes, x, state.contact, color=_CONTACT, linewidth=2.5)
        axes.legend(fontsize=TICK, frameon=False)
    axes.set_xlim(x[0], x[-1])
    label_axes(axes, f"{name} [{of_x}]", f"pressure, tension negative [{p.unit}]", grid=True)
    return axes


def state_figure(state: State) -> Figure:
    """Return the pressure and tension of adhesive surfaces, with force and depth in the title.

    Parameters
    ----------
    state : AdhesiveState or DetachmentState

    Returns
    -------
    Figure

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> figure = rc.plot.state_figure(rc.adhesive_state(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=0.0))
    >>> figure.axes[0].get_title()
    'force -440 nN,  depth 0 m,  contact 32.1 %,  stability 0.39'
    """
    if state.problem.operator.grid.ndim == 1:
        figure = Figure(figsize=(7.0, 3.0), layout="constrained")
        axes = tension_profile(state, figure.subplots())
    else:
        height, width = state.problem.operator.grid.lengths
        figure = Figure(figsize=(6.2, min(max(1.2 + 3.6 * height / width, 2.0), 9.0)), layout="constrained")
        axes = tension_map(state, figure.subplots())
    axes.set_title(_summary(state), fontsize=LABEL)
    return figure


def _outline(contact: Mask) -> Array:
    """Return the edges between cells in contact and others, in cells: shape (n, 2, 2), each end as x and y."""
    ringed = np.pad(contact, 1)
    y, x = np.nonzero(ringed[1:, 1:-1] != ringed[:-1, 1:-1])
    level = np.stack([np.stack([x, y], -1), np.stack([x + 1, y], -1)], 1)
    y, x = np.nonzero(ringed[1:-1, 1:] != ringed[1:-1, :-1])
    upright = np.stack([np.stack([x, y], -1), np.stack([x, y + 1], -1)], 1)
    return np.concatenate([level, upright]).astype(np.float64)


def _summary(state: State) -> str:
    words = (
        f"force {written(state.force, unit_of('force', state.geometry))},  depth {written(state.depth, 'm')},  "
        f"contact {100 * state.contact_fraction:.3g} %"
    )
    if isinstance(state, DetachmentState):
        return words
    words += f",  stability {state.stability:.2f}"
    return words + (" (unresolved)" if state.unresolved else "")
