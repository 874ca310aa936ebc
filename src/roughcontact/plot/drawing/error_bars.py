"""Errors of loads in a picture: bars, and the expected difference of other maps in words."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.evaluation.error_budget import ErrorBudget
from roughcontact.labels.engineering_units import Scale, written
from roughcontact.plot.drawing.ticks import TICK

__all__ = ["Errors", "error_bars", "sampling_lines"]

Errors = Mapping[float, ErrorBudget]
"""The errors of loads, by their force [N]."""

_COLOUR = "#0072b2"  # that of the points
_ROOM = 1.05  # factor of space beyond the end of a bar
_FARTHEST = 3.0  # largest ratio of the value to the shown end of a bar, because a bar may go down to zero


def error_bars(axes: Axes, errors: Errors, quantity: str, scales: tuple[Scale, Scale]) -> None:
    """Draw a bar for each load whose error of a quantity is known, and widen logarithmic axes to show it."""
    x, y = scales
    low, high = axes.get_ylim()
    style: Any = {"fmt": "none", "ecolor": _COLOUR, "capsize": 4, "elinewidth": 1.2, "label": "error"}
    for force, budget in errors.items():
        number = next((each for each in budget.numbers if each.name == quantity), None)
        if number is not None and math.isfinite(number.error) and math.isfinite(number.value):
            place, height = force * x.factor, number.value * y.factor
            reach = number.error * y.factor
            axes.errorbar([place], [height], yerr=[reach], **style)
            style["label"] = None  # one line in the legend for all
            low = min(low, max(height - reach, height / _FARTHEST) / _ROOM)
            high = max(high, min(height + reach, height * _FARTHEST) * _ROOM)
    axes.set_ylim(low, high)


def sampling_lines(figure: Figure, errors: Errors, load: Scale | None = None) -> None:
    """Write the expected difference of another map below a figure, for each load; `load` turns forces into loads."""
    words = {
        force: written(force, "N") if load is None else f"{force * load.factor:.3g} {load.unit}"
        for force in errors
    }
    lines = [f"at {words[force]}, {budget.sampling}" for force, budget in errors.items() if budget.sampling]
    if lines:
        figure.supxlabel("\n".join(lines), fontsize=TICK)
