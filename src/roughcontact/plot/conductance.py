"""Resistance of a contact against force."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from roughcontact.contact.variables import VARIABLES
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.plot.ticks import readable_ticks
from roughcontact.plot.units import scale

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes

__all__ = ["resistance_curve", "resistance_figure"]

_COLOURS = {"electrical_resistance": "#0072b2", "thermal_resistance": "#d55e00"}


def resistance_figure(dataset: xarray.Dataset) -> Figure:
    """Return the electrical and the thermal resistance against force, those that the dataset holds."""
    names = [name for name in _COLOURS if name in dataset]
    figure = Figure(figsize=(4.8 * len(names), 4.0), layout="constrained")
    for axes, name in zip(np.ravel(figure.subplots(1, len(names))), names, strict=True):
        resistance_curve(axes, dataset, name)
    return figure


def resistance_curve(axes: Axes, dataset: xarray.Dataset, name: str) -> None:
    """Draw one resistance against force, both logarithmic; what is infinite has no place on the axis.

    Points that the grid resolves are filled, the others open.
    """
    force, values = dataset["force"].to_numpy(), dataset[name].to_numpy()
    shown = np.isfinite(values) & (values > 0) & (force > 0)
    x, y = (
        scale(float(v[shown].max(initial=0.0)), VARIABLES[n].unit)
        for n, v in (("force", force), (name, values))
    )
    axes.set(xscale="log", yscale="log")
    axes.plot(force[shown] * x.factor, values[shown] * y.factor, color=_COLOURS[name])
    resolved = dataset["resolved"].to_numpy().astype(bool)
    for chosen, fill, text in (
        (shown & resolved, _COLOURS[name], "resolved"),
        (shown & ~resolved, "white", "not resolved"),
    ):
        if chosen.any():
            axes.plot(
                force[chosen] * x.factor,
                values[chosen] * y.factor,
                "o",
                color=_COLOURS[name],
                markerfacecolor=fill,
                markersize=4.5,
                label=text,
            )
    if shown.any():
        axes.legend(fontsize=TICK, frameon=False)
    for axis, numbers in ((axes.xaxis, force[shown]), (axes.yaxis, values[shown])):
        if numbers.size:
            readable_ticks(axis, float(numbers.max() / numbers.min()))
    axes.set_xlabel(f"{VARIABLES['force'].label} [{x.unit}]", fontsize=LABEL)
    axes.set_ylabel(f"{name.replace('_', ' ')} [{y.unit}]", fontsize=LABEL)
    axes.tick_params(labelsize=TICK, which="both")
    axes.grid(True, which="major", color="0.92", linewidth=0.8)
    axes.set_axisbelow(True)
