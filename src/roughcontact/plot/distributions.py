"""Distributions of heights and of the contact pressure."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import cycle
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES, unit_of
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import LABEL, TICK, label_axes
from roughcontact.plot.drawing.usual_range import usual_range
from roughcontact.plot.pressure_bars import fewer, pressure_bars
from roughcontact.surface.analysis.histogram import height_histogram
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric

__all__ = ["Density", "height_distribution", "pressure_distribution"]

Density = Callable[[Array], Array]

_BARS: Any = {"fill": True, "color": "#0072b2", "alpha": 0.45}
_LINES = ("#d55e00", "#009e73", "#cc79a7")
_ABOVE = 1.25  # height of the axes over that of the bars, to leave room for the legend


@numeric
def pressure_distribution(
    solution: Solution,
    ax: Axes | None = None,
    *,
    theories: Mapping[str, Density] | None = None,
    bins: int = 60,
) -> Axes:
    """Draw the probability density of the pressure over the nominal area, without the part outside contact.

    A few cells at the edges of spots may carry many times the pressure of all others. If they would take a quarter of
    the axis, the axis ends before them, and the legend shows the part beyond.

    Parameters
    ----------
    solution : Solution
        A solution with at least one cell in contact.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    theories : mapping of str to callable, optional
        Functions by name: the density [1/Pa] at pressures [Pa], whose integral is the theory's contact fraction.
    bins : int
        Largest number of bars; for few cells it is lower by Rice's rule, ``2 n^(1/3)``.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If nothing is in contact.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4), 1e9, force=1e-2)
    >>> peak = solution.pressure.max()  # Hertz: the density of p is 2 p/p0^2
    >>> axes = rc.plot.pressure_distribution(solution, theories={"Hertz": lambda p: 2 * p / peak**2 * (p < peak)})
    >>> axes.get_xlabel(), [text.get_text() for text in axes.get_legend().get_texts()]
    ('pressure [MPa]', ['computed, 6.35 % in contact', 'Hertz'])
    """
    solution = solution.on_host()
    unit = unit_of("pressure", solution.problem.geometry)
    if not solution.contact.any():
        raise InputError("nothing is in contact, so the pressure has no distribution")
    axes = axes_for(ax)
    bars = pressure_bars(solution, bins)
    end = float(bars.edges[-1])
    x = scale(end, unit)
    computed = f"computed, {100 * solution.contact_fraction:.3g} % in contact"
    if bars.beyond:
        computed += f",\n{100 * bars.beyond:.2g} % of it beyond, up to {written(bars.largest, unit)}"
    axes.stairs(bars.density / x.factor, bars.edges * x.factor, label=computed, **_BARS)
    stress = np.linspace(0.0, end, 400)
    for (name, theory), colour in zip((theories or {}).items(), cycle(_LINES), strict=False):
        axes.plot(stress * x.factor, theory(stress) / x.factor, color=colour, linewidth=1.6, label=name)
    axes.set_title(f"nominal pressure {written(solution.nominal_pressure, unit)}", fontsize=LABEL)
    name = f"{VARIABLES['pressure'].label} [{x.unit}]"
    _finish(axes, (0.0, end * x.factor), name, f"part of the nominal area [1/{x.unit}]")
    return axes


@numeric
@analysed_on_host
def height_distribution(surface: Surface, ax: Axes | None = None, *, bins: int = 60) -> Axes:
    """Draw the density of the measured heights above their mean, and the normal density of the same rms.

    A flat surface is drawn without the normal density. If a few points would take half of the axis, the axis ends
    before them, and the legend shows the part beyond.

    Parameters
    ----------
    surface : Surface
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    bins : int
        Largest number of bars; for few points it is lower by Rice's rule, ``2 n^(1/3)``.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> axes = rc.plot.height_distribution(surface, bins=40)
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('height above the mean [nm]', 'probability density [1/nm]')
    """
    axes = axes_for(ax)
    heights = surface.heights[surface.measured]
    heights = heights - heights.mean()
    found = height_histogram(surface, bins=fewer(bins, heights), ends=usual_range(heights))
    z = scale(float(np.abs(found.edges).max()), VARIABLES["heights"].unit)
    label = "heights"
    if beyond := 100 * (1 - float(found.count.sum()) / heights.size):
        low, high = (written(float(end), "m") for end in (heights.min(), heights.max()))
        label += f",\n{beyond:.2g} % of them beyond, {low} to {high}"
    edges = found.edges * z.factor
    axes.stairs(found.density / z.factor, edges, label=label, **_BARS)
    if found.rms > 0:
        points = np.linspace(found.edges[0], found.edges[-1], 400)
        normal, words = found.gaussian(points) / z.factor, f"normal, rms {written(found.rms, 'm')}"
        axes.plot(points * z.factor, normal, color=_LINES[0], linewidth=1.5, label=words)
    name = f"{VARIABLES['heights'].label} above the mean [{z.unit}]"
    _finish(axes, (float(edges[0]), float(edges[-1])), name, f"probability density [1/{z.unit}]")
    return axes


def _finish(axes: Axes, limits: tuple[float, float], x: str, y: str) -> None:
    axes.set_xlim(limits)
    axes.set_ylim(0.0, _ABOVE * axes.get_ylim()[1])
    label_axes(axes, x, y)
    axes.legend(loc="upper right", fontsize=TICK, frameon=False)
