"""The thermal conductance of a joint by its parts, against pressure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from roughcontact.contact.curve import Curve
from roughcontact.errors import InputError
from roughcontact.labels.column import names_of
from roughcontact.labels.engineering_units import Scale, pretty, scale
from roughcontact.labels.flux_columns import HEAT_PARTS
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import TICK, label_axes, readable_ticks
from roughcontact.validation import Array, numeric

__all__ = ["conductance_curve"]

# Distinct for colour-blind readers, and by their marks and dashes without colour.
_SMALL = 1e-3  # of the joint, below which a part has no line
_STYLES = (("#d55e00", "o", "--"), ("#0072b2", "s", "-."), ("#009e73", "^", ":"), ("black", "D", "-"))


@numeric
def conductance_curve(
    curve: Curve, ax: Axes | None = None, *, units: Mapping[str, Scale] | None = None
) -> Axes:
    """Draw the thermal conductance per area of spots, gas, radiation and the joint against pressure, both logarithmic.

    Loads that the grid does not resolve are open. Values that are zero or infinite, and parts below 0.1 % of the joint
    at all loads, are left out.

    Parameters
    ----------
    curve : Curve
        Computed with ``measures=[rc.ConductanceParts(...)]``.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    units : mapping of str to Scale, optional
        Units of the axes, by ``"nominal_pressure"`` and ``"joint_conductance_per_area"``.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the curve has no parts of a conductance.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 4e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=1, rolloff=64e-6, short_cutoff=32e-6)
    >>> air = rc.Gas("air", pressure=101325, accommodation=(0.9, 0.9))
    >>> parts = rc.ConductanceParts(conductivities=(50, 160), gas=air)
    >>> curve = rc.loading_curve(surface, 1.1e11, pressures=[1e7, 3e7], measures=[parts])
    >>> axes = rc.plot.conductance_curve(curve)
    >>> axes.get_ylabel(), axes.get_legend_handles_labels()[1]
    ('thermal conductance per area [kW/m²/K]', ['spots', 'gas', 'joint'])
    """
    names = names_of(HEAT_PARTS)[: len(_STYLES)]
    if names[-1] not in curve.measured:
        raise InputError(
            "the curve has no parts of a conductance",
            "compute it with measures=[rc.ConductanceParts(conductivities=(50, 160))]",
            "curve",
        )
    pressure, given = curve.nominal_pressure, units or {}
    drawn = {name: np.where(np.isfinite(curve.measured[name]), curve.measured[name], 0.0) for name in names}
    x, y = (
        Scale(given[name].factor, pretty(given[name].unit))
        if name in given
        else scale(float(np.max(values, initial=0.0)), VARIABLES[name].unit)
        for name, values in (("nominal_pressure", pressure), (names[-1], drawn[names[-1]]))
    )
    axes = axes_for(ax)
    axes.set(xscale="log", yscale="log")
    for (name, values), (colour, mark, dashes) in zip(drawn.items(), _STYLES, strict=True):
        shown = (values > 0) & (pressure > 0)
        if not (values > _SMALL * drawn[names[-1]])[shown].any():
            continue
        style: Any = {"color": colour, "marker": mark, "markersize": 4.5, "linewidth": 1.2}
        loads, heat = pressure * x.factor, values * y.factor
        label = name.partition("_")[0]
        axes.plot(loads[shown], heat[shown], dashes, markerfacecolor="white", label=label, **style)
        filled = shown & curve.resolved
        axes.plot(loads[filled], heat[filled], linestyle="none", **style)
    labels = {"nominal pressure": x, "thermal conductance per area": y}
    label_axes(axes, *(f"{text} [{each.unit}]" for text, each in labels.items()), grid=True)
    for axis, span in ((axes.xaxis, pressure[pressure > 0]), (axes.yaxis, _drawn(axes))):
        if span.size:
            readable_ticks(axis, float(span.max() / span.min()))
    if axes.lines:
        axes.legend(fontsize=TICK, frameon=False)
    return axes


def _drawn(axes: Axes) -> Array:
    """Return the values of all lines."""
    return np.concatenate([np.empty(0), *(np.asarray(line.get_ydata(), float) for line in axes.lines)])
