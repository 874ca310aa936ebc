"""Whole figures, and how they reach the disk; no pyplot, no global state."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from roughcontact.files.aside import WriteError, written_aside
from roughcontact.plot.curves import area_curve, depth_curve, stiffness_curve
from roughcontact.plot.engineering_units import written
from roughcontact.plot.maps import contact_map, height_map, pressure_map
from roughcontact.plot.marks import contact_window
from roughcontact.plot.ticks import LABEL

if TYPE_CHECKING:
    from roughcontact.contact.compare import Law
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.solution import Solution
    from roughcontact.statistics.power_law import PowerLaw
    from roughcontact.surface.surface import Surface

__all__ = ["curve_figure", "save", "solution_figure", "surface_figure"]

_FORMATS = ("png", "pdf", "svg")


def solution_figure(solution: Solution) -> Figure:
    """Return the contact on the whole map beside the pressure; the pressure is enlarged where that helps."""
    solution = solution.on_host()
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
    shown, where = (solution.pressure, "") if window is None else (solution.pressure[window], " in the frame")
    second.set_title(f"pressure{where}, at most {written(float(shown.max()), 'Pa')}", fontsize=LABEL)
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
    ending = Path(path).suffix.lower().removeprefix(".")
    if ending not in _FORMATS:
        raise WriteError(f"cannot write the picture {path}: end its name in {', '.join(_FORMATS)}")
    with written_aside(path) as aside:
        figure.savefig(aside, format=ending, dpi=200)


def _summary(solution: Solution) -> str:
    spots = solution.spots.count
    return ",  ".join(
        (
            f"force {written(solution.force, 'N')}",
            f"depth {written(solution.depth, 'm')}",
            f"stiffness {written(solution.stiffness, 'N m-1')}",
            f"contact {100 * solution.contact_fraction:.3g} % in {spots} spot{'s' if spots != 1 else ''}",
        )
    )
