"""Resistance of a contact against force."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.points import Column, draw_points
from roughcontact.plot.raster import TICK

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
    force = Column(dataset["force"].to_numpy(), VARIABLES["force"].label, VARIABLES["force"].unit)
    column = Column(dataset[name].to_numpy(), name.replace("_", " "), VARIABLES[name].unit)
    draw_points(axes, force, column, dataset["resolved"].to_numpy().astype(bool), _COLOURS[name])
    if axes.lines:
        axes.legend(fontsize=TICK, frameon=False)
