"""Outlook: the contact area and the stiffness of surfaces with ever shorter waves, and on ever finer grids.

Surfaces of one sample are the same surface, seen with more or fewer of its short waves, on more or fewer cells.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.grid import Grid
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.plot.ticks import readable_ticks
from roughcontact.statistics.common_forces import on_common
from roughcontact.statistics.fit_window import CELLS
from roughcontact.study.study import Study
from roughcontact.surface.moments import grid_moments
from roughcontact.surface.spectrum import SelfAffineSpectrum
from roughcontact.theory import persson
from roughcontact.thesis.sample_means import apart, converged, means, plus_minus, same_for_all
from roughcontact.thesis.stiffness_view import quiet
from roughcontact.thesis.verdict import Verdict, judged

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "cutoff_study", "draw", "studies", "verdicts"]

TITLE = "contact area and stiffness with ever shorter waves, on ever finer grids"
HURST = (0.0, 0.2, 0.4, 0.7)
SHOWN = 0.7  # Hurst exponent of the curves
FORCES = np.geomspace(2e-3, 0.2, 11)  # F/(E* h L), h the rms height with all waves
FORCE = 0.05  # at which waves are counted
LEAST = 4  # cells a shortest wave
CHOSEN = (
    "free squares, H = " + ", ".join(f"{hurst:g}" for hurst in HURST),
    "shortest waves L/8 to L/128 on 512 x 512, 256 x 256 and 128 x 128 cells (small: to L/64 on 256 x 256, 128 x 128 "
    f"and 64 x 64), at least {LEAST} cells a wave; the longer waves of a sample are the same throughout",
    "20 samples (small: 12), compared one by one; forces over E* L and the rms height with all waves",
)
SIZE = (8.8, 7.2)
SEED = 11
_SIZES = {"small": (64, 128, 256), "thesis": (128, 256, 512)}
_SAMPLES = {"small": 12, "thesis": 20}
_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the one study, of every shortest wave on every grid that has four cells for it."""
    return (cutoff_study(scale),)


def cutoff_study(scale: Scale) -> Study:
    """Return the study, which outlook-scale shares; its last row is the finest grid with all waves."""
    sizes = _SIZES[scale]
    waves = [8 * 2**i for i in range(5) if 8 * 2**i * LEAST <= sizes[-1]]
    rows = [
        {"points": points, "short_cutoff": 1 / count}
        for points in sizes
        for count in waves
        if points >= LEAST * count
    ]
    return Study(
        name={"small": "outlook-cutoff-small", "thesis": "outlook-cutoff"}[scale],
        case="refined",
        seed=SEED,
        samples=_SAMPLES[scale],
        parameters={
            "size": 1.0,
            "modulus": 1.0,
            "rms": 0.01,
            "drawn_on": sizes[-1],
            "lowest_force": 1e-3,
            "highest_force": 0.3,
            "loads": 16,
            "tolerance": 1e-6,
        },
        table={"hurst": HURST},
        rows=rows,
    )


def averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return means over samples at common forces, along ``hurst``, ``points``, ``waves`` L over the shortest wave.

    Returns
    -------
    Dataset
        ``stiffness`` k/(E* L), ``area`` A/L^2 and ``spread`` A E* g/F, g the rms slope; ``stiffness_change`` and
        ``area_change``, these over those with all waves on the finest grid, sample by sample; ``slope`` g, and
        ``persson`` his A/L^2; ``cell_stiffness`` k/(E* L) of a cell. NaN where a wave has too few cells.
    """
    given = converged(exported)
    whole = _whole(given)
    # Higher waves on the same body: a surface of any amplitude has the same contact at a force in proportion.
    force = given["dimensionless_force"] * whole
    curves = given[["stiffness"]].assign(
        force=force,
        area=given["contact_area"],
        spread=given["contact_area"] * given["rms_slope"] / given["force"],
    )
    common = on_common(curves, FORCES, at="force")
    finest = common.isel(row=-1)
    found = means(
        {
            "stiffness": common["stiffness"],
            "area": common["area"],
            "spread": common["spread"],
            "stiffness_change": common["stiffness"] / finest["stiffness"],
            "area_change": common["area"] / finest["area"],
        }
    )
    slope = same_for_all(given["rms_slope"]) * whole
    found["slope"] = slope.assign_attrs(long_name="rms slope", units="1")
    found["cell_stiffness"] = same_for_all(given["cell_stiffness"])
    pressure = found["force"] * float(given["rms"].mean())
    found["persson"] = _persson(pressure, slope)
    waves = (1 / given["short_cutoff"]).round().astype(int)
    indexed = apart(found).drop_vars("short_cutoff").assign_coords(waves=("row", waves.values))
    told = {"surfaces": exported.sizes["sample"]}
    return indexed.set_index(row=["points", "waves"]).unstack("row").assign_attrs(told)


def _whole(exported: xarray.Dataset) -> xarray.DataArray:
    """Return the rms height of every row over that with all waves, of one spectrum."""
    import xarray

    points = int(exported["drawn_on"])
    grid = Grid((points, points), 1 / points)

    def height(hurst: float, shortest: float) -> float:
        return grid_moments(grid, SelfAffineSpectrum(hurst, short_cutoff=shortest)).rms_height

    rows = [
        [height(hurst, shortest) for hurst in exported["hurst"].values]
        for shortest in exported["short_cutoff"].values
    ]
    heights = xarray.DataArray(rows, dims=("row", "hurst"))
    return heights / heights.isel(row=-1)


def _persson(pressure: xarray.DataArray, slope: xarray.DataArray) -> xarray.DataArray:
    import xarray
    from scipy.special import erf

    # persson.contact_fraction for many slopes at once.
    fraction: xarray.DataArray = xarray.apply_ufunc(erf, np.sqrt(2) * pressure / slope)
    return fraction


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw area (a) and stiffness (b) against force, both against the shortest wave (c), and what cells do (d)."""
    (first, second), (third, fourth) = figure.subplots(2, 2)
    fine = averages.isel(points=-1)
    _curves(first, fine.sel(hurst=SHOWN), "area", r"contact area $A\,/\,L^2$")
    _curves(second, fine.sel(hurst=SHOWN), "stiffness", r"stiffness $k\,/\,(E^* L)$")
    _changes(third, fine.sel(force=FORCE, method="nearest"))
    _cells(fourth, averages.sel(hurst=SHOWN).sel(force=FORCE, method="nearest"))
    for letter, axes in zip("abcd", (first, second, third, fourth), strict=True):
        axes.set_title(f"({letter})", fontsize=TICK + 1, loc="left")
        quiet(axes)


def _curves(axes: Axes, fine: xarray.Dataset, name: str, label: str) -> None:
    for waves, colour in zip(fine["waves"].values, _COLOURS, strict=False):
        one = fine.sel(waves=waves)
        axes.errorbar(
            one["force"],
            one[name],
            one[f"{name}_error"],
            color=colour,
            linewidth=1.3,
            elinewidth=0.8,
            label=f"L/{waves}",
        )
        if name == "area":
            axes.plot(one["force"], one["persson"], ":", color=colour, linewidth=1.0)
    if name == "area":
        axes.plot([], [], ":", color="0.4", label="Persson")
    else:
        axes.axhline(CELLS * float(fine["cell_stiffness"].max()), color="0.5", linewidth=0.9, linestyle="--")
    axes.set(xscale="log", yscale="log")
    axes.set_xlabel(r"force $F\,/\,(E^* h L)$", fontsize=LABEL)
    axes.set_ylabel(f"{label}, H = {SHOWN:g}", fontsize=LABEL)
    if name == "stiffness":
        _ticks(axes)
    axes.legend(fontsize=TICK, frameon=False, title="shortest wave", title_fontsize=TICK)


def _changes(axes: Axes, fine: xarray.Dataset) -> None:
    for hurst, colour in zip(fine["hurst"].values, _COLOURS, strict=False):
        one = fine.sel(hurst=hurst)
        for name, mark in (("stiffness", "o-"), ("area", "s--")):
            axes.errorbar(
                one["waves"],
                one[f"{name}_change"],
                one[f"{name}_change_error"],
                fmt=mark,
                markersize=4,
                color=colour,
                linewidth=1.2,
                label=f"H = {hurst:g}" if name == "stiffness" else None,
            )
    axes.plot([], [], "o-", color="0.4", markersize=4, label="stiffness")
    axes.plot([], [], "s--", color="0.4", markersize=4, label="area")
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(fine["waves"].values, [f"L/{waves}" for waves in fine["waves"].values])
    axes.minorticks_off()
    _ticks(axes)
    axes.set_xlabel("shortest wave", fontsize=LABEL)
    axes.set_ylabel(f"over that with all waves, at a force of {FORCE:g}", fontsize=LABEL)
    axes.legend(fontsize=TICK, frameon=False)


def _ticks(axes: Axes) -> None:
    low, high = axes.get_ylim()
    readable_ticks(axes.yaxis, high / low)


def _cells(axes: Axes, one: xarray.Dataset) -> None:
    for waves, colour in zip(one["waves"].values, _COLOURS, strict=False):
        each = one.sel(waves=waves).dropna("points", subset=["spread"])
        axes.errorbar(
            each["points"] / waves,
            each["spread"],
            each["spread_error"],
            fmt="o-",
            color=colour,
            markersize=4,
            linewidth=1.2,
            label=f"L/{waves}",
        )
    for value, words, style in (
        (persson.AREA_SLOPE, "Persson", ":"),
        (2.0, "eq. 4.19", "--"),
        (np.sqrt(2 * np.pi), "Bush, Gibson, Thomas", "-."),
    ):
        axes.axhline(value, color="0.4", linestyle=style, linewidth=1.0, label=words)
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_ylim(1.4, 3.6)
    axes.set_xlabel("cells a shortest wave", fontsize=LABEL)
    axes.set_ylabel(rf"$A\,E^* g\,/\,F$ at a force of {FORCE:g}, H = {SHOWN:g}", fontsize=LABEL)
    axes.legend(fontsize=TICK, frameon=False, ncols=2)


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Say how the area goes with load and shortest wave, and how much the stiffness does."""
    found = [_of(averages.sel(hurst=hurst)) for hurst in averages["hurst"].values]
    return (
        *(area for area, _ in found),
        *(stiffness for _, stiffness in found),
        _grid(averages.sel(hurst=SHOWN)),
    )


def _of(averages: xarray.Dataset) -> tuple[Verdict, Verdict]:
    """Return the verdicts on area and stiffness of one Hurst exponent."""
    fine = averages.isel(points=-1)
    at = fine.sel(force=FORCE, method="nearest")
    few, many = at.isel(waves=0), at.isel(waves=-1)
    first, last = int(few["waves"]), int(many["waves"])
    cells = int(fine["points"])
    told = (
        f"H = {float(fine['hurst']):g}, {averages.attrs['surfaces']} samples of {cells}² cells, shortest wave from "
        f"L/{first} to L/{last}, F = {FORCE:g} E* h L"
    )
    growth, fall = float(many["slope"] / few["slope"]), float(few["area_change"])
    power = -np.log(fall) / np.log(growth)
    area = fine["area"].isel(waves=-1)
    load = np.polyfit(np.log(fine["force"]), np.log(area), 1)[0]
    halved = [
        f"L/{int(each['waves'])} {plus_minus(each, 'stiffness_change', '.3f')}"
        for each in (at.isel(waves=i) for i in range(at.sizes["waves"] - 1))
    ]
    least = fine.isel(force=0)
    return (
        Verdict(
            "contact area as a function of load and shortest wave (Outlook), from the pressure in contact of eq. 4.19: "
            "A = 2 F/(E* g), g the rms slope",
            "2",
            f"A E* g/F from {plus_minus(few, 'spread')} to {plus_minus(many, 'spread')}, while g grows by a factor of "
            f"{growth:.2f} and A falls by one of {fall:.2f}, as g^{power:.2f}; with all waves A ~ F^{load:.2f} "
            f"from {FORCES[0]:g} to {FORCES[-1]:g}; {told}",
            judged(at["spread"] / 2 - 1, at["spread_error"] / 2, 0.25),
        ),
        Verdict(
            "the stiffness is that of the longest waves and does not see the smallest scales (section 4.3)",
            "not sensitive",
            f"k over that with all waves, for a shortest wave of {', '.join(halved)}, where the area is {fall:.2f} to "
            f"1; at a force of {FORCES[0]:g}, where few cells touch, "
            f"{plus_minus(least.isel(waves=0), 'stiffness_change')} for L/{first}; {told}",
            judged(float(few["stiffness_change"] - 1), float(few["stiffness_change_error"]), 0.1),
        ),
    )


def _grid(averages: xarray.Dataset) -> Verdict:
    """Return the verdict on the number of cells for the same waves."""
    one = averages.isel(waves=0).sel(force=FORCE, method="nearest").dropna("points", subset=["spread"])
    rough, smooth, waves = one.isel(points=0), one.isel(points=-1), int(one["waves"])
    return Verdict(
        "contact area as a function of grid resolution (Outlook)",
        "asked",
        f"A E* g/F {plus_minus(rough, 'spread')} with {int(rough['points']) // waves} cells a shortest wave and "
        f"{plus_minus(smooth, 'spread')} with {int(smooth['points']) // waves}, on the same surfaces; the stiffness "
        f"{float(rough['stiffness'] / smooth['stiffness'] - 1):+.1%}; H = {SHOWN:g}, shortest wave L/{waves}, F = "
        f"{FORCE:g} E* h L",
        None,
    )
