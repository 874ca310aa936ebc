"""A quantity against force, both logarithmic: points that the grid resolves filled, the others open."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.plot.engineering_units import Scale, scale
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.plot.ticks import readable_ticks

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Column", "draw_points"]

Array = npt.NDArray[Any]


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """Numbers with the words of their axis.

    Parameters
    ----------
    values : array, shape (n,)
        In the SI unit `unit`.
    label, unit : str
        As in `roughcontact.labels.variables`.
    """

    values: Array
    label: str
    unit: str


def draw_points(
    axes: Axes, force: Column, column: Column, resolved: npt.NDArray[np.bool_], colour: str
) -> tuple[Scale, Scale]:
    """Draw a column against force and label both axes; return their scales.

    A logarithmic axis has no place for zero, and none for infinity: such points are left out.
    """
    loads, values = force.values, column.values
    x, y = (
        scale(float(np.max(c.values, initial=0.0, where=np.isfinite(c.values))), c.unit)
        for c in (force, column)
    )
    axes.set(xscale="log", yscale="log")
    shown = np.isfinite(values) & (values > 0) & (loads > 0)
    size = 4.5 if loads.size <= 60 else 3.0
    for chosen, fill, text in ((resolved, colour, "resolved"), (~resolved, "white", "not resolved")):
        points = shown & chosen
        if points.any():
            axes.plot(
                loads[points] * x.factor,
                values[points] * y.factor,
                "o",
                markersize=size,
                color=colour,
                markerfacecolor=fill,
                label=text,
                zorder=3,
            )
    for axis, numbers in ((axes.xaxis, loads[shown]), (axes.yaxis, values[shown])):
        if numbers.size:
            readable_ticks(axis, float(numbers.max() / numbers.min()))
    axes.set_xlabel(f"{force.label} [{x.unit}]", fontsize=LABEL)
    axes.set_ylabel(f"{column.label} [{y.unit}]", fontsize=LABEL)
    axes.tick_params(labelsize=TICK, which="both")
    axes.grid(True, which="major", color="0.92", linewidth=0.8)
    axes.set_axisbelow(True)
    return x, y
