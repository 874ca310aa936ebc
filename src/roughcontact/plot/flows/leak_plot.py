"""The flow through the gap along a loading curve, beside a theory."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from roughcontact.contact.curve import Curve
from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import Scale
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.curves import draw_points
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import TICK
from roughcontact.validation import numeric, require

__all__ = ["LEAKS", "leak_curve"]

_COLOUR, _THEORY = "#0072b2", "#009e73"
LEAKS = {"hydraulic_gap": 1 / 3, "transmissivity": 1.0}  # of the transmissivity
_BAND = 0.08  # height of the band of closed gaps, as a part of the axes


@numeric
def leak_curve(
    curve: Curve,
    ax: Axes | None = None,
    *,
    quantity: str = "hydraulic_gap",
    units: Mapping[str, Scale] | None = None,
) -> Axes:
    """Draw the hydraulic gap or the transmissivity against nominal pressure, and Bruggeman's theory of it.

    Both axes are logarithmic. Loads at which no open path leads through the gap have crosses in a band below.

    Parameters
    ----------
    curve : Curve
        With the measure `roughcontact.Transmissivity`.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    quantity : {"hydraulic_gap", "transmissivity"}
    units : mapping of str to Scale, optional
        Units of the axes, by ``"nominal_pressure"`` and the quantity.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the quantity is unknown, or the curve has no such column.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=32e-6, short_cutoff=8e-6)
    >>> curve = rc.loading_curve(surface, 1e9, pressures=[1e6, 4e6, 16e6], measures=[rc.Transmissivity(axis=0)])
    >>> axes = rc.plot.leak_curve(curve, units={"nominal_pressure": rc.plot.Scale(1e-5, "bar")})
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('nominal pressure [bar]', 'hydraulic gap [nm]')
    """
    require(
        quantity in LEAKS,
        f"quantity must be one of {', '.join(LEAKS)}, not {quantity!r}",
        place="quantity",
    )
    if quantity not in curve.measured:
        raise InputError(
            f"the curve has no {quantity.replace('_', ' ')}",
            "give measures=[rc.Transmissivity(axis=0)] to loading_curve",
            "curve",
        )
    axes, pressure = axes_for(ax), curve.nominal_pressure
    words = [(VARIABLES[each].label, VARIABLES[each].unit) for each in ("nominal_pressure", quantity)]
    given = tuple((units or {}).get(each) for each in ("nominal_pressure", quantity))
    values = curve.measured[quantity]
    x, y = draw_points(axes, (pressure, values), words, np.asarray(curve.resolved), _COLOUR, given)
    axes.set_ylim(axes.get_ylim())  # of the computed points
    theory = curve.measured["transmissivity_bruggeman"] ** LEAKS[quantity]
    order = np.argsort(pressure, kind="stable")
    shown = order[theory[order] > 0]
    style: Any = {"color": _THEORY, "linewidth": 1.4, "zorder": 2.5, "label": "Bruggeman's theory"}
    if shown.size:
        axes.plot(pressure[shown] * x.factor, theory[shown] * y.factor, **style)
    closed = curve.measured["percolates"] == 0
    if closed.any():  # below the computed points
        low, high = axes.get_ylim()
        bottom = low * (low / high) ** (_BAND / (1 - _BAND))
        axes.set_ylim(bottom, high)
        axes.axhspan(bottom, low, facecolor="0.92", zorder=0)
        style = {"transform": axes.get_xaxis_transform(), "color": _COLOUR, "label": "no open path"}
        axes.plot(
            pressure[closed] * x.factor, np.full(int(closed.sum()), _BAND / 2), "x", markersize=5, **style
        )
    axes.legend(fontsize=TICK, frameon=False)
    return axes
