"""Distributions of heights and of the contact pressure, drawn on axes that the caller owns."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.contact.solution import Solution
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.engineering_units import scale, written
from roughcontact.plot.ticks import LABEL, TICK, label_axes
from roughcontact.surface.analysis.histogram import height_histogram
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array

__all__ = ["height_distribution", "pressure_distribution", "pressure_distribution_figure"]

Density = Callable[[Array], Array]

_BARS: Any = {"fill": True, "color": "#0072b2", "alpha": 0.45}
_LINES = ("#d55e00", "#009e73", "#cc79a7")
_BEYOND = 0.999  # quantile of the pressure where the axis ends: a few cells at the edges of spots carry many times more


def pressure_distribution(
    axes: Axes, solution: Solution, theories: Mapping[str, Density] | None = None, bins: int = 60
) -> None:
    """Draw the probability density of the pressure over the nominal area, without the part that carries none.

    Parameters
    ----------
    axes : Axes
    solution : Solution
        With at least one cell in contact.
    theories : mapping of str to callable, optional
        By name, the density [1/Pa] at pressures [Pa]; its integral is the theory's contact fraction.
    bins : int
        Number of bars at the most: of few cells Rice's rule, ``2 n^(1/3)``, makes fewer.

    Raises
    ------
    ValueError
        If nothing is in contact.
    """
    solution = solution.on_host()
    grid, unit = solution.problem.grid, unit_of("pressure", solution.problem.geometry)
    pressures = solution.pressure[solution.contact]
    if not pressures.size:
        raise ValueError("nothing is in contact: there is no pressure to show the distribution of")
    end = float(np.quantile(pressures, _BEYOND)) * 1.05
    x = scale(end, unit)
    areas = np.broadcast_to(solution.problem.operator.weights, grid.shape)[solution.contact]
    shares, edges = np.histogram(pressures, _fewer(bins, pressures), (0.0, end), weights=areas / grid.area)
    density = shares / np.diff(edges)
    computed = f"computed, {100 * solution.contact_fraction:.3g} % in contact"
    axes.stairs(density / x.factor, edges * x.factor, label=computed, **_BARS)
    stress = np.linspace(0.0, end, 400)
    for (name, theory), colour in zip((theories or {}).items(), cycle(_LINES), strict=False):
        axes.plot(stress * x.factor, theory(stress) / x.factor, color=colour, linewidth=1.6, label=name)
    axes.set_title(f"nominal pressure {written(solution.force / grid.area, unit)}", fontsize=LABEL)
    name = f"{VARIABLES['pressure'].label} [{x.unit}]"
    _finish(axes, (0.0, end * x.factor), name, f"part of the nominal area [1/{x.unit}]")


def pressure_distribution_figure(solution: Solution, theories: Mapping[str, Density] | None = None) -> Figure:
    """Return the distribution of the pressure and what theories say about it."""
    figure = Figure(figsize=(5.6, 4.0), layout="constrained")
    pressure_distribution(figure.subplots(), solution, theories)
    return figure


def height_distribution(axes: Axes, surface: Surface, bins: int = 60) -> None:
    """Draw the density of the heights above their mean, and the normal one of the same rms; missing points count not.

    A flat surface has no normal distribution; it is drawn without one. Of few points Rice's rule, ``2 n^(1/3)``, makes
    fewer bars than `bins`.
    """
    found = height_histogram(surface, bins=_fewer(bins, surface.heights[surface.measured]))
    reach = float(np.abs(found.edges).max())
    z = scale(reach, VARIABLES["heights"].unit)
    edges = found.edges * z.factor
    axes.stairs(found.density / z.factor, edges, label="heights", **_BARS)
    if found.rms > 0:
        points = np.linspace(found.edges[0], found.edges[-1], 400)
        normal, label = found.gaussian(points) / z.factor, f"normal, rms {written(found.rms, 'm')}"
        axes.plot(points * z.factor, normal, color=_LINES[0], linewidth=1.5, label=label)
    name = f"{VARIABLES['heights'].label} above the mean [{z.unit}]"
    _finish(axes, (float(edges[0]), float(edges[-1])), name, f"probability density [1/{z.unit}]")


def _fewer(bins: int, values: Array) -> int:
    """Return the number of bars: `bins`, or those of Rice's rule where these are fewer."""
    return min(bins, math.ceil(2 * math.cbrt(values.size)))


def _finish(axes: Axes, limits: tuple[float, float], x: str, y: str) -> None:
    axes.set_xlim(limits)
    axes.set_ylim(bottom=0.0)
    label_axes(axes, x, y)
    axes.legend(fontsize=TICK, frameon=False)
