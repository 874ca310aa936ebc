"""Pictures of nominally flat surfaces beside the laws that are to hold for them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import LABEL, TICK
from roughcontact.theory.interaction import SQUARE
from roughcontact.thesis.stiffness_view import quiet

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["draw_flat"]

SHOWN = 8  # L over the longest wave, of the surface beside all laws
_COLOURS = {1: "black", 2: "#0072b2", 4: "#009e73", 8: "#e69f00", 16: "#d55e00"}  # by L over the longest wave


def draw_flat(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw K/F with cut-off (a) and roll-off (b), and stiffness (c) and area (d) of one beside all laws."""
    (first, second), (third, fourth) = figure.subplots(2, 2)
    kinds = averages["kind"].values
    _levels(first, averages.isel(row=np.flatnonzero(kinds == "cut-off")), "cut-off")
    _levels(second, averages.isel(row=np.flatnonzero(kinds == "roll-off")), "roll-off")
    one = averages.isel(row=int(np.flatnonzero((kinds == "cut-off") & (averages["long"] == SHOWN))[0]))
    _stiffnesses(third, one)
    _areas(fourth, one)
    for letter, axes in zip("abcd", (first, second, third, fourth), strict=True):
        axes.set_xlabel(r"force $F\,/\,(E^* h L)$", fontsize=LABEL)
        axes.set_title(f"({letter})", fontsize=TICK + 1, loc="left")
        axes.legend(fontsize=TICK, frameon=False)
        quiet(axes)


def _levels(axes: Axes, averages: xarray.Dataset, kind: str) -> None:
    force = averages["force"].values
    for row in range(averages.sizes["row"]):
        one = averages.isel(row=row)
        long = int(one["long"])
        for periodic, style in ((True, "-"), (False, "--")):
            each = one.sel(periodic=periodic)
            axes.plot(
                force,
                each["interfacial"] / force,
                style,
                color=_COLOURS[long],
                linewidth=1.4 if periodic else 1.0,
                label=(f"L/{long}" if long > 1 else "none") if periodic else None,
            )
        axes.plot(force, one["persson"] / force, ":", color=_COLOURS[long], linewidth=1.0)
    axes.plot([], [], "--", color="0.4", label="free")
    axes.plot([], [], ":", color="0.4", label="Persson")
    axes.set(xscale="log", ylim=(0, 9))
    axes.set_ylabel(rf"$K h\,/\,F$, {kind}", fontsize=LABEL)


def _stiffnesses(axes: Axes, one: xarray.Dataset) -> None:
    force = one["force"].values
    scale = force  # over the force: a linear law is level
    periodic, free = one.sel(periodic=True), one.sel(periodic=False)
    axes.errorbar(
        force,
        periodic["interfacial"] / scale,
        periodic["interfacial_error"] / scale,
        fmt="o",
        markersize=3.5,
        color="black",
        label="periodic",
    )
    axes.errorbar(
        force,
        free["stiffness"] / scale,
        free["stiffness_error"] / scale,
        fmt="s",
        markersize=3.5,
        color="0.55",
        label="free, k",
    )
    body = one["persson"] / (1 + SQUARE * one["persson"])
    for name, values, colour, style in (
        ("Persson", one["persson"], "#0072b2", "-"),
        ("Persson on a finite body", body, "#0072b2", "--"),
        ("Greenwood, Williamson", one["gw"], "#009e73", "-."),
        ("sum over cells", one["cells"], "#d55e00", "-"),
        (r"$\lambda F$ of the maxima", float(one["decay"]) * force, "#d55e00", ":"),
    ):
        axes.plot(force, values / scale, style, color=colour, linewidth=1.3, label=name)
    axes.set(xscale="log", ylim=(0, 9))
    axes.set_ylabel(rf"$K h\,/\,F$, cut-off at L/{SHOWN}", fontsize=LABEL)


def _areas(axes: Axes, one: xarray.Dataset) -> None:
    force = one["force"].values
    for periodic, mark, colour in ((True, "o", "black"), (False, "s", "0.55")):
        each = one.sel(periodic=periodic)
        axes.errorbar(
            force,
            each["area"] / force,
            each["area_error"] / force,
            fmt=mark,
            markersize=3.5,
            color=colour,
            label="periodic" if periodic else "free",
        )
    axes.plot(force, one["persson_area"] / force, "-", color="#0072b2", linewidth=1.3, label="Persson")
    axes.plot(
        force, one["gw_area"] / force, "-.", color="#009e73", linewidth=1.3, label="Greenwood, Williamson"
    )
    axes.set(xscale="log")
    axes.set_ylim(bottom=0)
    axes.set_ylabel(rf"area over force $A E^* h\,/\,(F L)$, cut-off at L/{SHOWN}", fontsize=LABEL)
