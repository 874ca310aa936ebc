"""Whole figures and their files, without pyplot and without global state."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.contact.compare import Law
from roughcontact.contact.curve import Curve
from roughcontact.contact.solution import Solution
from roughcontact.evaluation.error_budget import ErrorBudget
from roughcontact.files.aside import WriteError, written_aside
from roughcontact.labels.engineering_units import Scale, scale, written
from roughcontact.labels.variables import unit_of
from roughcontact.plot.curves import areal_curve, force_curve, resistance_curve
from roughcontact.plot.distributions import Density, height_distribution, pressure_distribution
from roughcontact.plot.drawing.error_bars import Errors, sampling_lines
from roughcontact.plot.drawing.marks import contact_window
from roughcontact.plot.drawing.raster import Window
from roughcontact.plot.drawing.ticks import LABEL, TICK
from roughcontact.plot.maps import contact_map, height_map, pressure_map
from roughcontact.plot.profile_plot import contact_profile, pressure_profile, profile_curve
from roughcontact.statistics.power_law import PowerLaw
from roughcontact.surface.preparation.spikes import Spikes
from roughcontact.surface.surface import Surface
from roughcontact.validation import numeric

__all__ = [
    *("areal_figure", "curve_figure", "pressure_distribution_figure", "resistance_figure"),
    *("require_picture", "save", "solution_figure", "surface_figure"),
]

_FORMATS = ("png", "pdf", "svg")


@numeric
def solution_figure(solution: Solution, errors: ErrorBudget | None = None) -> Figure:
    """Return the contact on the whole map beside the pressure, which is enlarged if the contact is small.

    Parameters
    ----------
    solution : Solution
        The solution for a surface, a line or rings.
    errors : ErrorBudget, optional
        Errors of the solution; the expected difference of another map is written below the maps.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4), 1e9, force=1e-2)
    >>> rc.plot.solution_figure(solution).get_suptitle()
    'force 10 mN,  depth 823 nm,  stiffness 18 kN/m,  contact 6.35 % in 1 spot'
    """
    solution = solution.on_host()
    grid = solution.problem.grid
    if grid.ndim == 1:
        figure = Figure(figsize=(7.0, 4.6), layout="constrained")
        first, second = figure.subplots(2, 1, sharex=True)
        contact_profile(solution, first)
        pressure_profile(solution, second)
        first.set_xlabel("")
    else:
        window = contact_window(solution)
        height, width = grid.lengths
        if width <= 1.8 * height:
            figure = Figure(figsize=(9.0, 4.2), layout="constrained")
            first, second = figure.subplots(1, 2)
        else:  # two wide maps fit better one above the other
            figure = Figure(figsize=(7.0, max(1.8 + 11.0 * height / width, 3.2)), layout="constrained")
            first, second = figure.subplots(2, 1)
        contact_map(solution, first, frame=window)
        pressure_map(solution, second, window=window)
        first.set_title("contact over the heights", fontsize=LABEL)
        second.set_title(_peak(solution, window), fontsize=LABEL)
    figure.suptitle(_summary(solution), fontsize=LABEL + 1)
    if errors is not None:
        sampling_lines(figure, {solution.force: errors})
    return figure


@numeric
def pressure_distribution_figure(solution: Solution, theories: Mapping[str, Density] | None = None) -> Figure:
    """Return the distribution of the pressure, with the predictions of theories.

    Parameters
    ----------
    solution : Solution
        A solution with at least one cell in contact.
    theories : mapping of str to callable, optional
        Functions by name: the density [1/Pa] at pressures [Pa].

    Returns
    -------
    Figure

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4), 1e9, force=1e-2)
    >>> figure = rc.plot.pressure_distribution_figure(solution)
    >>> figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
    ('pressure [MPa]', 'part of the nominal area [1/MPa]')
    """
    figure = Figure(figsize=(5.6, 4.0), layout="constrained")
    pressure_distribution(solution, figure.subplots(), theories=theories)
    return figure


@numeric
def curve_figure(
    curve: Curve,
    law: PowerLaw | None = None,
    theories: Sequence[Law] = (),
    errors: Errors | None = None,
) -> Figure:
    """Return stiffness, contact area and depth against force, with the predictions of theories.

    Parameters
    ----------
    curve : Curve
    law : PowerLaw, optional
        A law to draw, such as ``curve.fit()``.
    theories : sequence of Law, optional
        Theories to draw, such as those of `roughcontact.loading_laws`.
    errors : mapping of float to ErrorBudget, optional
        Errors by force [N]: bars at these loads, and a line for each load with the expected difference of another map.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> curve = rc.loading_curve(ball, 1e9, forces=np.geomspace(1e-2, 1e-1, 9))
    >>> figure = rc.plot.curve_figure(curve, curve.fit(), [rc.theory.hertz.law(radius=1e-4, modulus=1e9)])
    >>> [axes.get_ylabel() for axes in figure.axes[:3]]
    ['stiffness [kN/m]', 'contact area [µm²]', 'depth [µm]']
    """
    figure = Figure(figsize=(9.5, 5.2), layout="constrained")
    axes = figure.subplot_mosaic([["stiffness", "area"], ["stiffness", "depth"]], width_ratios=(1.6, 1))
    force_curve(curve, axes["stiffness"], law=law, theories=theories, errors=errors)
    force_curve(curve, axes["area"], quantity="contact_area", theories=theories, errors=errors)
    force_curve(curve, axes["depth"], quantity="depth", theories=theories, errors=errors)
    sampling_lines(figure, errors or {})
    return figure


@numeric
def areal_figure(
    curve: Curve,
    law: PowerLaw | None = None,
    theories: Sequence[Law] = (),
    units: Mapping[str, Scale] | None = None,
    errors: Errors | None = None,
) -> Figure:
    """Return K/A0, A/A0 and mean gap against nominal pressure, which do not depend on the size of a joint.

    Parameters
    ----------
    curve : Curve
    law : PowerLaw, optional
        A law of k, such as ``curve.fit()``; drawn only on a periodic grid.
    theories : sequence of Law, optional
        Theories to draw, such as those of `roughcontact.loading_laws`.
    units : mapping of str to Scale, optional
        Units of the axes, by ``"nominal_pressure"``, ``"interfacial_stiffness_per_area"`` and ``"mean_gap"``.
    errors : mapping of float to ErrorBudget, optional
        Errors by force [N]: bars at these loads, and a line for each load with the expected difference of another map.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), long_cutoff=3e-5)
    >>> curve = rc.loading_curve(surface, 1e9, pressures=np.geomspace(1e6, 1e7, 6))
    >>> figure = rc.plot.areal_figure(curve, theories=rc.loading_laws(surface, 1e9, "persson"))
    >>> [axes.get_xlabel() for axes in figure.axes[:3]]
    ['nominal pressure [MPa]', 'nominal pressure [MPa]', 'nominal pressure [MPa]']
    """
    figure = Figure(figsize=(9.5, 5.2), layout="constrained")
    axes = figure.subplot_mosaic([["stiffness", "area"], ["stiffness", "gap"]], width_ratios=(1.6, 1))
    both: Any = {"theories": theories, "units": units, "errors": errors}
    areal_curve(curve, axes["stiffness"], law=law, **both)
    if axes["stiffness"].get_legend_handles_labels()[0]:
        axes["stiffness"].legend(loc="best" if theories else "upper left", fontsize=TICK, frameon=False)
    areal_curve(curve, axes["area"], quantity="contact_fraction", **both)
    areal_curve(curve, axes["gap"], quantity="mean_gap", **both)
    finite = curve.nominal_pressure[np.isfinite(curve.nominal_pressure)]
    pressure = (units or {}).get("nominal_pressure") or scale(
        float(finite.max(initial=0.0)), unit_of("nominal_pressure", curve.geometry)
    )
    of_force = Scale(pressure.factor / curve.nominal_area, pressure.unit)
    sampling_lines(figure, errors or {}, of_force)
    return figure


def resistance_figure(dataset: xarray.Dataset) -> Figure:
    """Return the electrical and thermal resistances in a dataset, per area for an interface.

    Parameters
    ----------
    dataset : Dataset
        The result of `roughcontact.conductance` for the dataset of a curve.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1), long_cutoff=3e-5)
    >>> curve = rc.loading_curve(surface, 1e9, pressures=np.geomspace(1e6, 1e7, 6)).to_dataset()
    >>> both = rc.conductance(curve, resistivities=(1.7e-8, 2.7e-8), conductivities=(400.0, 240.0))
    >>> [axes.get_xlabel() for axes in rc.plot.resistance_figure(both).axes]
    ['nominal pressure [MPa]', 'nominal pressure [MPa]']
    """
    names = ("electrical_resistance", "thermal_resistance")
    areal = [f"{name}_per_area" for name in names if f"{name}_per_area" in dataset]
    found = areal or [name for name in names if name in dataset]
    figure = Figure(figsize=(4.8 * len(found), 4.0), layout="constrained")
    for axes, name in zip(np.ravel(figure.subplots(1, len(found))), found, strict=True):
        resistance_curve(dataset, name, axes)
    return figure


@numeric
def surface_figure(surface: Surface, spikes: Spikes | None = None) -> Figure:
    """Return the heights of a surface or a profile beside their distribution.

    Parameters
    ----------
    surface : Surface
    spikes : Spikes, optional
        Spikes to mark, such as ``roughcontact.find_spikes(surface)``.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.self_affine(rc.Grid((64, 64), 1e-6), hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> [axes.get_xlabel() for axes in rc.plot.surface_figure(surface, rc.find_spikes(surface)).axes[:2]]
    ['x [µm]', 'height above the mean [nm]']
    """
    figure = Figure(figsize=(9.6, 4.2), layout="constrained")
    heights, distribution = figure.subplots(1, 2, width_ratios=(1.25, 1))
    draw = height_map if surface.grid.ndim == 2 else profile_curve
    draw(surface, heights, spikes=spikes)
    height_distribution(surface, distribution)
    return figure


def save(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure as PNG, PDF or SVG, by the ending of `path`; on an error no file is left behind.

    Parameters
    ----------
    figure : Figure
        The figure; for axes, their ``ax.figure``.
    path : path-like
        Its name ends in ``.png``, ``.pdf`` or ``.svg``.

    Raises
    ------
    WriteError
        If the ending is unknown or the file cannot be written.

    Examples
    --------
    >>> import pathlib
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4), 1e9, force=1e-2)
    >>> rc.plot.save(solution.plot().figure, "pressure.png")
    >>> pathlib.Path("pressure.png").stat().st_size > 1000
    True
    """
    ending = require_picture(path)
    with written_aside(path) as aside:
        figure.savefig(aside, format=ending, dpi=200)


def require_picture(path: str | os.PathLike[str]) -> str:
    """Return the format of a picture from the ending of `path`, for checks before a long computation.

    Raises
    ------
    WriteError
        If the ending is not that of a picture.
    """
    ending = Path(path).suffix.lower().removeprefix(".")
    if ending not in _FORMATS:
        raise WriteError(f"cannot write the picture {path}", f"end its name in {', '.join(_FORMATS)}")
    return ending


def _peak(solution: Solution, window: Window | None) -> str:
    """Return the largest pressure in the window; if that of the map is larger, also the latter and its place."""
    pressure, grid = solution.pressure, solution.problem.grid
    largest = float(pressure.max())
    if window is None:
        return f"pressure, at most {written(largest, 'Pa')}"
    shown = float(pressure[window].max())
    words = f"pressure in the frame, at most {written(shown, 'Pa')}"
    if shown == largest:
        return words
    cell = np.unravel_index(int(pressure.argmax()), pressure.shape)
    y, x = (written((i + 0.5) * step, "m") for i, step in zip(cell, grid.spacing, strict=True))
    return f"{words}\non the map at most {written(largest, 'Pa')}, at x = {x}, y = {y}"


def _summary(solution: Solution) -> str:
    spots, kind = solution.spots.count, solution.problem.geometry
    return (
        f"force {written(solution.force, unit_of('force', kind))},  depth {written(solution.depth, 'm')},  "
        f"stiffness {written(solution.stiffness, unit_of('stiffness', kind))},  "
        f"contact {100 * solution.contact_fraction:.3g} % in {spots} spot{'s' if spots != 1 else ''}"
    )
