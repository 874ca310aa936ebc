"""Outlook: contact area and stiffness under a ceiling of the pressure, on one surface and with ever shorter waves."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.statistics.common_forces import on_common
from roughcontact_thesis import averaging, drawing
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import Ruling, exceeds, ruled
from roughcontact_thesis.verdict import Verdict, Verdicts, counted, plus_minus, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "contact area and stiffness under a ceiling of the pressure"
HURST = 0.7
CEILINGS = (2.0, 1.0, 0.5, 0.25, 0.125)  # over E* g, g the rms slope with all waves
GIVEN = 0.5  # the ceiling under which waves are added: the mean pressure in contact by eq. 4.19
FORCES = np.geomspace(0.01, 0.3, 9)  # F/(E* h L), h the rms height with all waves
NONE = 0.01  # of the contact area: what counts as elastic
FORCE = 0.05  # at which ceilings are compared
CHOSEN = (
    f"free squares of 256 x 256 cells, H = {HURST:g}, shortest wave L/64 (small: 128 x 128, L/32)",
    f"ceilings of {', '.join(f'{each:g}' for each in CEILINGS)} E* g and none, g the rms slope; on the same surfaces "
    "with shortest waves from L/8 on none and the one of half E* g with all waves",
    "two stiffnesses: that of pressing on, in which cells at the ceiling have no part; and that of the contact region "
    "as it stands, for the first step back and for what it conducts",
    "10 samples, compared one by one; depths from 0.2 to 2.8 h",
)
SIZE = (drawing.PAGE, 6.2)
SEED = 12
_CELLS = 4  # a shortest wave
_COLOURS = ("black", "#0072b2", "#2f8fcf", "#009e73", "#a67500", "#d55e00")
_AREA = "#c8290b"
_NAMES = ("stiffness", "region_stiffness", "area")


def studies(scale: Scale) -> Studies:
    """Return the one study: its rows are the ceilings with all waves, then the waves without and with a ceiling."""
    points = {"small": 128, "thesis": 256}[scale]
    last = points // _CELLS
    rows: list[dict[str, Any]] = [{"short_cutoff": 1 / last}]
    rows += [{"short_cutoff": 1 / last, "relative_hardness": each} for each in CEILINGS]
    waves = [8 * 2**i for i in range(10) if 8 * 2**i < last]
    rows += [{"short_cutoff": 1 / each} for each in waves]
    # The ceiling in the units of a surface whose rms height is that with all waves.
    slope = _moments(points, 1 / last).rms_slope
    for each in waves:
        part = _moments(points, 1 / each)
        rows.append({"short_cutoff": 1 / each, "relative_hardness": GIVEN * slope / part.rms_slope})
    depths = {"lowest_depth": 0.2, "highest_depth": 2.8, "loads": 16}
    parameters = {"points": points, "hurst": HURST} | depths
    return averaging.outlook_studies(
        "hardness", scale, parameters, case="yielding", seed=SEED, samples=10, rows=rows
    )


def averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return means over samples at common forces.

    Returns
    -------
    Dataset
        Along ``ceiling`` (over E* g, infinite for none) and ``force``: ``stiffness`` of pressing on,
        ``region_stiffness`` of the whole contact, both over E* L, ``area`` A/L^2 and ``yielded``, the part of it at
        the ceiling; with ``_change`` the first three over those without a ceiling, sample by sample. The same, named
        ``waves_...``, along ``waves`` (L over the shortest wave) and ``kind`` ("elastic", "ceiling"), changes over
        those without a ceiling and with all waves. ``elastic_..._grown`` and ``ceiling_..._grown``: by which part
        stiffness of the region and area grow from the fewest waves to all. ``slope`` along ``waves``.
    """
    given = averaging.converged(exported)
    heights = averaging.rms_heights(int(given["points"]), given["hurst"], given["short_cutoff"])
    whole = heights / heights.isel(row=0)
    scale = float(given["modulus"] * given["size"])
    # Higher waves on the same body: contact and stiffness are the same at a force in proportion.
    curves = given[["yielded"]].assign(
        force=given["dimensionless_force"] * whole,
        stiffness=given["stiffness"] / scale,
        region_stiffness=given["region_stiffness"] / scale,
        area=given["contact_area"],
    )
    common = on_common(curves.drop_vars(["short_cutoff", "relative_hardness"]), FORCES, at="force")
    values = {name: common[name] for name in (*_NAMES, "yielded")}
    values |= {f"{name}_change": common[name] / common[name].isel(row=0) for name in _NAMES}
    elastic, hard = _rows_of_waves(given.sizes["row"])
    for kind, rows in (("elastic", elastic), ("ceiling", hard)):
        for name in ("region_stiffness", "area"):
            first, last = (common[name].isel(row=rows[i], drop=True) for i in (0, -1))
            values[f"{kind}_{name}_grown"] = last / first - 1
    every = averaging.without_parameters(averaging.means(**values))
    ceilings = [np.inf, *CEILINGS]
    found = every.isel(row=slice(0, len(ceilings))).rename(row="ceiling").assign_coords(ceiling=ceilings)
    waves = (1 / given["short_cutoff"].values).round().astype(int)
    along_rows = every[[name for name, each in every.data_vars.items() if "row" in each.dims]]
    kinds = [along_rows.isel(row=rows).drop_vars("row").rename(row="waves") for rows in (elastic, hard)]
    along = xarray.concat(kinds, "kind").assign_coords(waves=waves[elastic], kind=["elastic", "ceiling"])
    slope = (averaging.same_for_all(given["rms_slope"]) * whole).values[elastic]
    found = found.assign({f"waves_{name}": each for name, each in along.data_vars.items()})
    found["slope"] = "waves", slope, {"long_name": "rms slope", "units": "1"}
    return found.assign_attrs(averaging.counts(exported))


def _rows_of_waves(count: int) -> tuple[list[int], list[int]]:
    """Return the rows of all waves, the fewest first, without a ceiling and with the one; see `studies`."""
    first = len(CEILINGS) + 1
    middle = (first + count) // 2
    return [*range(first, middle), 0], [*range(middle, count), 1 + CEILINGS.index(GIVEN)]


def _moments(points: int, shortest: float) -> rc.Moments:
    """Return the moments of a surface with waves down to a shortest one; the scale is that of the spectrum."""
    spectrum = rc.SelfAffineSpectrum(HURST, short_cutoff=shortest)
    return rc.grid_moments(rc.Grid((points, points), 1 / points), spectrum)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw area (a) and stiffness (b) against force, both against the ceiling (c), and against the waves (d)."""
    first, second, third, fourth = drawing.panels(figure, 2, 2)
    for ceiling, colour in zip(averages["ceiling"].values, _COLOURS, strict=True):
        one = averages.sel(ceiling=ceiling)
        words = f"{ceiling:g} E* g" if np.isfinite(ceiling) else "elastic"
        drawing.with_errors(first, one, "area", color=colour, label=words)
        drawing.with_errors(second, one, "stiffness", color=colour, label=words)
        second.plot(one["force"], one["region_stiffness"], "--", color=colour)
    drawing.key(second, "--", "whole region")
    for axes, words in ((first, r"contact area $A\,/\,L^2$"), (second, drawing.STIFFNESS)):
        drawing.label(axes, drawing.FORCE, words, **drawing.LOG)
        drawing.readable(axes)

    at = averages.sel(force=FORCE, method="nearest")
    hard = at.isel(ceiling=slice(1, None))
    for name, style, colour, words in (
        ("stiffness_change", "o-", "black", "k of pressing on"),
        ("region_stiffness_change", "o--", "black", "k of the whole region"),
        ("area_change", "s-", _AREA, "area"),
    ):
        drawing.with_errors(third, hard, name, "ceiling", fmt=style, color=colour, label=words)
    third.plot(hard["ceiling"], hard["yielded"], ":", color="0.4", label="part at the ceiling")
    third.axhline(1, color="0.6", linewidth=0.8)
    drawing.named_ticks(third, hard["ceiling"].values, "{:g}")
    words = f"over the elastic one, at a force of {FORCE:g}"
    drawing.label(third, r"ceiling $\sigma_0\,/\,(E^* g)$", words)

    for kind, style, words in (("elastic", "-", "elastic"), ("ceiling", "--", "one ceiling")):
        one = at.sel(kind=kind)
        for name, mark, colour in (("region_stiffness", "o", "black"), ("area", "s", _AREA)):
            given = {
                "fmt": mark + style,
                "color": colour,
                "label": f"{name.removeprefix('region_')}, {words}",
            }
            drawing.with_errors(fourth, one, f"waves_{name}_change", "waves", **given)
    drawing.named_ticks(fourth, at["waves"].values, "L/{}")
    drawing.label(fourth, "shortest wave", f"over that with all waves, elastic, at {FORCE:g}")
    for axes in (first, second, third, fourth):
        axes.legend()


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Say what a ceiling does to stiffness and area, and when contact is elastic."""
    at = averages.sel(force=FORCE, method="nearest")
    told = f"{counted(averages)}, H = {HURST:g}"
    hard = [at.isel(ceiling=i) for i in range(1, at.sizes["ceiling"])]
    each = {
        name: ", ".join(
            f"{float(one['ceiling']):g}: {plus_minus(one, f'{name}_change', '.3f')}" for one in hard
        )
        for name in _NAMES
    }
    given = at.sel(ceiling=GIVEN)
    grown = at["ceiling_region_stiffness_grown"]
    off = np.array([*(float(given[f"{name}_change"]) - 1 for name in _NAMES[:2]), float(grown)])
    errors = [*(float(given[f"{name}_change_error"]) for name in _NAMES[:2])]
    errors.append(float(at["ceiling_region_stiffness_grown_error"]))
    first, last = (int(averages["waves"][i]) for i in (0, -1))
    kinds = [f"{kind}_{name}" for kind in ("ceiling", "elastic") for name in ("region_stiffness", "area")]
    more = {name: plus_minus(at, f"{name}_grown", "+.1%") for name in kinds}
    yielded = averages["yielded"]
    soft = averages.sel(ceiling=0.5)
    yield Verdict(
        "elasticity on all scales plays no crucial role for the stiffness",
        "Still, the assumption of elasticity on all scales does not play a crucial role in the current findings.",
        "section 4.3",
        f"k over the elastic one at F = {FORCE:g} E* h L, by the ceiling over E* g: pressing on {each['stiffness']}; "
        f"of the whole contact region {each['region_stiffness']}; the area {each['area']}. Under one ceiling, waves "
        f"from L/{first} to L/{last} change the stiffness of the contact region by {more['ceiling_region_stiffness']} "
        f"and the area by {more['ceiling_area']}; without it by {more['elastic_region_stiffness']} and "
        f"{more['elastic_area']}; {told}. Judged at {GIVEN:g}, the mean pressure of eq. 4.19",
        ruled(off, np.array(errors), 0.1),
    )
    yield Verdict(
        "contact is elastic for a plasticity index E* g/sigma_0 below 2/3",
        "They argued that elastic contact can only occur for Ψ < 2/3.",
        "section 4.3, eq. 4.17",
        f"{spanned(yielded.sel(ceiling=2.0), '.1%')} of the contact area yields at an index of 0.5, "
        f"{spanned(yielded.sel(ceiling=1.0), '.1%')} at 1, {spanned(yielded.sel(ceiling=0.5), '.1%')} at 2; forces "
        f"from {FORCES[0]:g} to {FORCES[-1]:g} E* h L; at 2 it goes from {plus_minus(soft.isel(force=0), 'yielded')} "
        f"to {plus_minus(soft.isel(force=-1), 'yielded')} as the force grows",
        _elastic(averages),
        "theory",
    )


def _elastic(averages: xarray.Dataset) -> Ruling:
    """Return whether nothing yields at an index of 0.5, and something at 1."""
    low, high = (averages.sel(ceiling=ceiling) for ceiling in (2.0, 1.0))
    below = ruled(low["yielded"], low["yielded_error"], NONE, above=True)
    if below.word != "holds":
        return below
    least = int(high["yielded"].to_numpy().argmin())
    value, error = (float(high[f"yielded{end}"][least]) for end in ("", "_error"))
    return exceeds(value, error, NONE, ".1%", f"{NONE:.0%} of the area at 0.5, more at 1")
