"""A viscoelastic contact in time: contact area and depth against logarithmic time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import scale
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import label_axes

if TYPE_CHECKING:
    from roughcontact.viscoelastic.viscoelastic_curve import ViscoelasticCurve

__all__ = ["creep_curve"]

_COLOURS = ("#0072b2", "#d55e00")


def creep_curve(
    curve: ViscoelasticCurve,
    ax: Axes | None = None,
    *,
    quantities: tuple[str, str] = ("contact_area", "depth"),
) -> Axes:
    """Draw two quantities against the time since the start, which is logarithmic; marks are the given times.

    Parameters
    ----------
    curve : ViscoelasticCurve
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    quantities : tuple of two str
        Columns of the curve: on the left and on the right axis.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the curve has no such column.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> curve = rc.viscoelastic_curve(ball, rubber, times=[0, 100], forces=[1e-6, 1e-6])
    >>> curve.plot(quantities=("contact_area", "mean_gap")).get_xlabel()
    'time since the start [s]'
    """
    axes = axes_for(ax)
    elapsed = curve.time - curve.time[0]
    later = elapsed > 0
    for place, name, colour in zip((axes, axes.twinx()), quantities, _COLOURS, strict=True):
        if name not in VARIABLES or not isinstance(values := getattr(curve, name, None), np.ndarray):
            raise InputError(
                f"the curve has no column {name!r}", "choose contact_area, depth or force", "quantities"
            )
        unit = scale(float(np.abs(values).max(initial=0.0)), unit_of(name, curve.geometry))
        place.plot(elapsed[later], values[later] * unit.factor, color=colour, linewidth=1.1)
        marks = later & curve.prescribed
        place.plot(elapsed[marks], values[marks] * unit.factor, "o", color=colour, markersize=3.5)
        label_axes(
            place, "time since the start [s]", f"{VARIABLES[name].label} [{unit.unit}]", grid=place is axes
        )
        place.yaxis.label.set_color(colour)
    axes.set_xscale("log")
    return axes
