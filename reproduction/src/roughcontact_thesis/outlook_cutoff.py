"""Outlook: the contact area and the stiffness of surfaces with ever shorter waves, and on ever finer grids.

Surfaces of one sample are the same surface, seen with more or fewer of its short waves, on more or fewer cells.
"""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure
from scipy.special import erf

from roughcontact.plot.drawing.level import level
from roughcontact.statistics.common_forces import on_common
from roughcontact.statistics.fit_window import CELLS
from roughcontact.theory.persson_theory import persson
from roughcontact_thesis import averaging, drawing
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import ranged, ruled, ruled_in_middle, undecided
from roughcontact_thesis.verdict import Verdict, Verdicts, plus_minus, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "contact area and stiffness with ever shorter waves, on ever finer grids"
HURST = (0.0, 0.2, 0.4, 0.7)
SHOWN = 0.7  # Hurst exponent of the curves
FORCES = np.geomspace(2e-3, 0.2, 11)  # F/(E* h L), h the rms height with all waves
FORCE = 0.05  # at which waves are counted
NEAR = 0.1  # of a stiffness: what counts as no influence
LEAST = 4  # cells a shortest wave
CHOSEN = (
    "free squares, H = " + ", ".join(f"{hurst:g}" for hurst in HURST),
    "shortest waves L/8 to L/128 on 512 x 512, 256 x 256 and 128 x 128 cells (small: to L/64 on 256 x 256, 128 x 128 "
    f"and 64 x 64), at least {LEAST} cells a wave; the longer waves of a sample are the same throughout",
    "20 samples (small: 12), compared one by one; forces over E* L and the rms height with all waves",
)
SIZE = (drawing.PAGE, 6.2)
SEED = 11


def studies(scale: Scale) -> Studies:
    """Return the one study, of every shortest wave on every grid that has four cells for it.

    Its last row is the finest grid with all waves. The figure outlook-scale shares it.
    """
    sizes, samples = {"small": ((64, 128, 256), 12), "thesis": ((128, 256, 512), 20)}[scale]
    waves = [8 * 2**i for i in range(5)]
    pairs = [(points, count) for points in sizes for count in waves if points >= LEAST * count]
    forces = {"lowest_force": 1e-3, "highest_force": 0.3, "loads": 16, "tolerance": 1e-6}
    return averaging.outlook_studies(
        "cutoff",
        scale,
        forces,
        case="curve",
        seed=SEED,
        samples=samples,
        table={"hurst": HURST},
        rows=[{"points": points, "short_cutoff": 1 / count} for points, count in pairs],
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
    given = averaging.converged(exported)
    heights = averaging.rms_heights(int(given["points"].max()), given["hurst"], given["short_cutoff"])
    whole = heights / heights.isel(row=-1)
    # Higher waves on the same body: a surface of any amplitude has the same contact at a force in proportion.
    curves = given[["stiffness"]].assign(
        force=given["dimensionless_force"] * whole,
        area=given["contact_area"],
        spread=given["contact_area"] * given["rms_slope"] / given["force"],
    )
    common = on_common(curves, FORCES, at="force")
    changes = {f"{name}_change": common[name] / common[name].isel(row=-1) for name in ("stiffness", "area")}
    found = averaging.means(**{name: common[name] for name in ("stiffness", "area", "spread")}, **changes)
    slope = averaging.same_for_all(given["rms_slope"]) * whole
    found["slope"] = slope.assign_attrs(long_name="rms slope", units="1")
    found["cell_stiffness"] = averaging.same_for_all(given["cell_stiffness"])
    # persson.contact_fraction for many slopes at once.
    pressure = found["force"] * float(given["rms"].mean())
    found["persson"] = xarray.apply_ufunc(erf, np.sqrt(2) * pressure / slope)
    waves = (1 / given["short_cutoff"]).round().astype(int)
    rows = averaging.without_parameters(found).drop_vars("short_cutoff")
    rows = rows.assign_coords(waves=("row", waves.values)).set_index(row=["points", "waves"])
    return rows.unstack("row").assign_attrs(surfaces=exported.sizes["sample"])


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw area (a) and stiffness (b) against force, both against the shortest wave (c), and what cells do (d)."""
    area, stiffness, changes, cells = drawing.panels(figure, 2, 2)
    fine = averages.isel(points=-1)
    shown = fine.sel(hurst=SHOWN)
    drawing.family(area, shown, "waves", {"area": "-", "persson": ":"}, "L/{}")
    drawing.key(area, ":", "Persson")
    drawing.family(stiffness, shown, "waves", {"stiffness": "-"}, "L/{}")
    level(stiffness, CELLS * float(shown["cell_stiffness"].max()))
    for axes, name in ((area, r"contact area $A\,/\,L^2$"), (stiffness, drawing.STIFFNESS)):
        drawing.label(axes, drawing.FORCE, f"{name}, H = {SHOWN:g}", **drawing.LOG)
        axes.legend(title="shortest wave")

    at = fine.sel(force=FORCE, method="nearest")
    both = {"stiffness_change": "o-", "area_change": "s--"}
    drawing.family(changes, at, "hurst", both, "H = {:g}", x="waves")
    for style, words in (("o-", "stiffness"), ("s--", "area")):
        drawing.key(changes, style, words)
    drawing.named_ticks(changes, fine["waves"].values, "L/{}")
    words = f"over that with all waves, at a force of {FORCE:g}"
    drawing.label(changes, "shortest wave", words, yscale="log")
    changes.legend()
    for axes in (stiffness, changes):
        drawing.readable(axes)

    one = averages.sel(hurst=SHOWN).sel(force=FORCE, method="nearest")
    one = one.assign(cells=one["points"] / one["waves"])
    drawing.family(cells, one, "waves", {"spread": "o-"}, "L/{}", x="cells")
    for value, words, style in (
        (persson.AREA_SLOPE, "Persson", ":"),
        (2.0, "eq. 4.19", "--"),
        (np.sqrt(2 * np.pi), "Bush, Gibson, Thomas", "-."),
    ):
        cells.axhline(value, color="0.4", linestyle=style, linewidth=1.0, label=words)
    cells.set_xscale("log", base=2)
    cells.xaxis.set_major_formatter("{x:g}")
    spread = rf"$A\,E^* g\,/\,F$ at a force of {FORCE:g}, H = {SHOWN:g}"
    drawing.label(cells, "cells a shortest wave", spread, ylim=(1.4, 3.6))
    cells.legend(ncols=2)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Say how the area goes with load and shortest wave, and how much the stiffness does."""
    fine = averages.isel(points=-1)
    at = fine.sel(force=FORCE, method="nearest")
    first, last = int(at["waves"][0]), int(at["waves"][-1])
    told = f"{averages.attrs['surfaces']} samples of {int(fine['points'])}² cells, F = {FORCE:g} E* h L"
    mean, error = 1 / at["spread"], at["spread_error"] / at["spread"] ** 2
    yield Verdict(
        "the pressure in contact is of the order of E* g/2, g the rms slope",
        "the contact stress at any particular scale has the order of magnitude σ ≈ E*∇z/2",
        "section 4.3, eq. 4.19",
        f"mean pressures of {spanned(mean, '.2f')} E* g for H = {_hursts(averages)} and shortest waves from L/{first} "
        f"to L/{last}; {told}",
        # As logarithms to the base of ten: half an order of magnitude either way.
        ruled(np.log10(2 * mean), error / mean / np.log(10), 0.5, "+.2f", words="half an order of magnitude"),
    )
    whole, half = at.isel(waves=-1), at.isel(waves=-2)
    change = half["stiffness_change"] - 1
    rows = [at.sel(hurst=hurst) for hurst in averages["hurst"].values]
    each = "; ".join(
        f"H = {float(one['hurst']):g}: "
        + ", ".join(
            f"L/{int(wave['waves'])} {plus_minus(wave, 'stiffness_change', '.3f')}"
            for wave in (one.isel(waves=n) for n in range(at.sizes["waves"] - 1))
        )
        for one in rows
    )
    yield Verdict(
        "the stiffness does not see the smallest scales",
        "The contact stiffness on the contrary is determined by the largest wavelength in the power spectrum of the "
        "surface roughness and is not sensitive to the occurrence on the atomic scale.",
        "section 4.3",
        f"without the shortest octave of waves, L/{int(half['waves'])} to L/{int(whole['waves'])}: "
        f"{ranged(change, half['stiffness_change_error'], NEAR)}; k over that with all waves for other shortest waves: "
        f"{each}; {told}",
        ruled_in_middle(change, half["stiffness_change_error"], NEAR),
    )
    yield _area(at, fine, told)


def _hursts(averages: xarray.Dataset) -> str:
    return ", ".join(f"{hurst:g}" for hurst in averages["hurst"].values)


def _area(at: xarray.Dataset, fine: xarray.Dataset, told: str) -> Verdict:
    """Return what load, shortest wave and grid do to the contact area."""
    few, many = at.isel(waves=0), at.isel(waves=-1)
    growth, fall = many["slope"] / few["slope"], few["area_change"]
    power = -np.log(fall) / np.log(growth)
    area = fine["area"].isel(waves=-1)
    loads = [np.polyfit(np.log(fine["force"]), np.log(area.sel(hurst=h)), 1)[0] for h in fine["hurst"].values]
    return Verdict(
        "the contact area as a function of load and shortest wave",
        "Can some of the ideas be used in estimating the contact area, not only as function of the applied load, but "
        "also on grid resolution / short wave cut-off?",
        "chapter 7",
        f"A E* g/F is {spanned(at['spread'], '.2f')}, A ~ F^{min(loads):.2f} to F^{max(loads):.2f} and, with more "
        f"waves, as g^{float(power.min()):.2f} to g^{float(power.max()):.2f}; {told}",
        undecided("a question; the area follows the rms slope"),
        "answer",
    )
