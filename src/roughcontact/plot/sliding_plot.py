"""Hysteretic friction against sliding speed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import LABEL, TICK, label_axes
from roughcontact.validation import Array

if TYPE_CHECKING:
    import xarray

    from roughcontact.viscoelastic.friction_curve import FrictionCurve

__all__ = ["friction_speeds"]

_THEORIES = {
    "persson_friction_coefficient": "--",
    "persson_friction_coefficient_half": ":",
    "persson_contact_fraction": "--",
}
_FRICTION, _AREA = "#0072b2", "#d55e00"


def friction_speeds(
    curve: FrictionCurve, ax: Axes | None = None, *, theory: xarray.Dataset | None = None
) -> Axes:
    """Draw the friction coefficient and the relative contact area against speed; speeds without convergence are open.

    Parameters
    ----------
    curve : FrictionCurve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    theory : Dataset, optional
        A dataset with columns of Persson's theory, to be drawn as lines.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> surface = rc.shapes.wave(rc.Grid((16, 64), 1e-5, periodic=True), 1e-5, 6.4e-4)
    >>> curve = rc.friction_curve(surface, rubber, speeds=[0.01, 0.1, 1.0], pressure=1e5)
    >>> curve.plot().get_xlabel()
    'sliding speed [m/s]'
    """
    axes = axes_for(ax)
    right = axes.twinx()
    converged = np.array([status.converged for status in curve.status])

    def draw(on: Axes, values: Array, colour: str, mark: str, label: str) -> None:
        on.plot(curve.speed, values, color=colour, linewidth=0.9, label=label)
        for which, face in ((converged, colour), (~converged, "none")):
            on.plot(
                *(curve.speed[which], values[which]), mark, color=colour, markerfacecolor=face, markersize=4
            )
        on.set_ylim(0, 1.1 * float(values.max()) or 1.0)
        on.set_ylabel(label, color=colour, fontsize=LABEL)
        on.tick_params(labelsize=TICK)

    label_axes(axes, "sliding speed [m/s]", "", grid=True)
    draw(axes, curve.friction_coefficient, _FRICTION, "o", "friction coefficient")
    top = axes.get_ylim()[1]
    for name, style in _THEORIES.items():
        if theory is None or name not in theory:
            continue
        on, colour = (right, _AREA) if name.endswith("fraction") else (axes, _FRICTION)
        values = theory[name].to_numpy()
        on.plot(curve.speed, values, style, color=colour, linewidth=0.9, label=VARIABLES[name].label)
        top = max(top, 1.1 * float(values.max())) if on is axes else top
    draw(right, curve.contact_fraction, _AREA, "s", "relative real contact area A/A0")
    axes.set_ylim(0, top)
    if theory is not None:
        lines = [
            line for on in (axes, right) for line in on.lines if not str(line.get_label()).startswith("_")
        ]
        right.legend(handles=lines, fontsize=TICK, ncols=2, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    if curve.speed[0] > 0:
        axes.set_xscale("log")
    return axes
