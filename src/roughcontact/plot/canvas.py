"""Whole figures, and how they reach the disk; no pyplot, no global state."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from roughcontact.contact.compare import Law
from roughcontact.contact.curve import Curve
from roughcontact.contact.solution import Solution
from roughcontact.files.aside import WriteError, written_aside
from roughcontact.plot.curves import area_curve, areal_curve, depth_curve, stiffness_curve
from roughcontact.plot.engineering_units import Scale, written
from roughcontact.plot.maps import contact_map, height_map, pressure_map
from roughcontact.plot.marks import contact_window
from roughcontact.plot.pressed_profile import pressed_profile_figure
from roughcontact.plot.raster import Window
from roughcontact.plot.ticks import LABEL, TICK
from roughcontact.statistics.power_law import PowerLaw
from roughcontact.surface.surface import Surface

__all__ = ["areal_figure", "curve_figure", "require_picture", "save", "solution_figure", "surface_figure"]

_FORMATS = ("png", "pdf", "svg")


def solution_figure(solution: Solution) -> Figure:
    """Return the contact on the whole map beside the pressure; the pressure is enlarged where that helps.

    Of a profile the heights before and under the load, over the pressure.
    """
    solution = solution.on_host()
    if solution.problem.grid.ndim == 1:
        return pressed_profile_figure(solution)
    window = contact_window(solution)
    height, width = solution.problem.grid.lengths
    if width <= 1.8 * height:
        figure = Figure(figsize=(9.0, 4.2), layout="constrained")
        first, second = figure.subplots(1, 2)
    else:  # of a wide map two are better one above the other
        figure = Figure(figsize=(7.0, max(1.8 + 11.0 * height / width, 3.2)), layout="constrained")
        first, second = figure.subplots(2, 1)
    contact_map(first, solution, frame=window)
    pressure_map(second, solution, window)
    first.set_title("contact over the heights", fontsize=LABEL)
    second.set_title(_peak(solution, window), fontsize=LABEL)
    figure.suptitle(_summary(solution), fontsize=LABEL + 1)
    return figure


def curve_figure(curve: Curve, law: PowerLaw | None = None, theories: Sequence[Law] = ()) -> Figure:
    """Return stiffness, contact area and depth against force, and what theories say about them."""
    figure = Figure(figsize=(9.5, 5.2), layout="constrained")
    axes = figure.subplot_mosaic([["stiffness", "area"], ["stiffness", "depth"]], width_ratios=(1.6, 1))
    stiffness_curve(axes["stiffness"], curve, law, theories)
    area_curve(axes["area"], curve, theories)
    depth_curve(axes["depth"], curve, theories)
    return figure


def areal_figure(
    curve: Curve,
    law: PowerLaw | None = None,
    theories: Sequence[Law] = (),
    units: Mapping[str, Scale] | None = None,
) -> Figure:
    """Return K/A0, A/A0 and mean gap against nominal pressure: what a joint has whatever its size."""
    figure = Figure(figsize=(9.5, 5.2), layout="constrained")
    axes = figure.subplot_mosaic([["stiffness", "area"], ["stiffness", "gap"]], width_ratios=(1.6, 1))
    areal_curve(axes["stiffness"], curve, "interfacial_stiffness_per_area", law, theories, units)
    if axes["stiffness"].get_legend_handles_labels()[0]:
        axes["stiffness"].legend(loc="upper left", fontsize=TICK, frameon=False)
    areal_curve(axes["area"], curve, "contact_fraction", None, theories, units)
    areal_curve(axes["gap"], curve, "mean_gap", None, theories, units)
    return figure


def surface_figure(surface: Surface) -> Figure:
    """Return the heights of a surface."""
    figure = Figure(figsize=(5.2, 4.2), layout="constrained")
    height_map(figure.subplots(), surface)
    return figure


def save(figure: Figure, path: str | os.PathLike[str]) -> None:
    """Write a figure as PNG, PDF or SVG, by the ending of `path`; whole or not at all.

    Raises
    ------
    WriteError
        If the ending is another or the file cannot be written.
    """
    ending = require_picture(path)
    with written_aside(path) as aside:
        figure.savefig(aside, format=ending, dpi=200)


def require_picture(path: str | os.PathLike[str]) -> str:
    """Return the format of a picture, by the ending of `path`; meant to be asked before a long computation.

    Raises
    ------
    WriteError
        If the ending is none of a picture.
    """
    ending = Path(path).suffix.lower().removeprefix(".")
    if ending not in _FORMATS:
        raise WriteError(f"cannot write the picture {path}: end its name in {', '.join(_FORMATS)}")
    return ending


def _peak(solution: Solution, window: Window | None) -> str:
    """Return the largest pressure of what is shown, and where that of the map is if it is larger."""
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
    spots = solution.spots.count
    return (
        f"force {written(solution.force, 'N')},  depth {written(solution.depth, 'm')},  "
        f"stiffness {written(solution.stiffness, 'N m-1')},  "
        f"contact {100 * solution.contact_fraction:.3g} % in {spots} spot{'s' if spots != 1 else ''}"
    )
