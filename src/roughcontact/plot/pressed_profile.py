"""A profile under load: the heights before and under it, over the pressure."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.contact.solution import Solution
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.engineering_units import scale, written
from roughcontact.plot.ticks import LABEL, TICK, label_axes
from roughcontact.validation import Array

__all__ = ["pressed_profile", "pressed_profile_figure", "profile_pressure"]

_BODY, _FREE, _FLAT, _PRESSURE = "#0072b2", "#999999", "#000000", "#d55e00"


def pressed_profile(axes: Axes, solution: Solution) -> None:
    """Draw the heights of a profile before the load and under it, and the flat, which is at height 0."""
    problem = solution.problem
    places, z = _places(solution), scale(problem.mean_separation + solution.depth, "m")
    x = scale(problem.grid.lengths[0], "m")
    free = np.where(problem.measured, solution.depth - problem.separation, np.nan)
    for heights, colour, words in ((free, _FREE, "before"), (-solution.gap, _BODY, "under the load")):
        axes.plot(places * x.factor, heights * z.factor, color=colour, linewidth=1.0, label=words)
    axes.axhline(0.0, color=_FLAT, linewidth=0.8, label="flat")
    axes.set_xlim(0.0, problem.grid.lengths[0] * x.factor)
    axes.legend(
        fontsize=TICK, frameon=False, ncols=3, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderpad=0
    )
    label_axes(axes, f"x [{x.unit}]", f"height over the flat [{z.unit}]", grid=True)


def profile_pressure(axes: Axes, solution: Solution) -> None:
    """Draw the pressure along a profile; that of springs is a force per length."""
    problem = solution.problem
    x = scale(problem.grid.lengths[0], "m")
    p = scale(float(solution.pressure.max()), unit_of("pressure", problem.geometry))
    axes.fill_between(
        _places(solution) * x.factor, solution.pressure * p.factor, step="mid", color=_PRESSURE, linewidth=0.5
    )
    axes.set_xlim(0.0, problem.grid.lengths[0] * x.factor)
    axes.set_ylim(bottom=0.0)
    label_axes(axes, f"x [{x.unit}]", f"{VARIABLES['pressure'].label} [{p.unit}]", grid=True)


def pressed_profile_figure(solution: Solution) -> Figure:
    """Return the heights of a profile under load over its pressure."""
    figure = Figure(figsize=(8.0, 5.2), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True)
    pressed_profile(upper, solution)
    profile_pressure(lower, solution)
    upper.set_xlabel("")
    kind, count = solution.problem.geometry, solution.spots.count
    names = ("force", "depth", "stiffness")
    told = [f"{name} {written(getattr(solution, name), unit_of(name, kind))}" for name in names]
    told.append(f"contact {100 * solution.contact_fraction:.3g} % in {count} spot{'s' if count != 1 else ''}")
    figure.suptitle(",  ".join(told), fontsize=LABEL + 1)
    return figure


def _places(solution: Solution) -> Array:
    """Return the centres of the cells [m]."""
    return solution.problem.grid.coordinates[0]
