"""Outlook: nominally flat surfaces, cut off or rolled off at ever shorter waves, finite and periodic (section 5.1).

A surface without long waves consists of cells as long as its longest ones. By section 5.1 each is a rough indenter of
its own under eq. 5.5; if their maxima are distributed exponentially, the stiffness is proportional to the force.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.theory.asperity_models.interaction import SQUARE
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact.validation import Array
from roughcontact_thesis import averaging, drawing
from roughcontact_thesis.averaging import RMS, exponential, logarithm
from roughcontact_thesis.cell_law import cells_stiffness, exponential_rate, single_cell_stiffness
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import Ruling, ruled
from roughcontact_thesis.verdict import Verdict, Verdicts, listed, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "nominally flat surfaces, finite and periodic, beside theories and the law of their cells' maxima"
HURST = 0.8
CUTOFF = (1, 2, 4, 8, 16)  # L over the longest wave; a cut-off at L is none
ROLLOFF = (4, 8, 16)
FEW = 4  # cells along a side from which a surface is nominally flat
MANY = 0.2  # force F/(E* h l) a cell from which many cells carry: about the crossover to a linear law
NEAR = 0.05  # of an exponent: half of what is between a linear law and 0.9
FULL = 0.15  # part of the nominal area in contact up to which a law is looked for
CHOSEN = (
    f"squares of 512 x 512 cells (small: 128 x 128), H = {HURST:g}, shortest wave of 4 cells; cut-off at L to L/16 and "
    "roll-off at L/4 to L/16",
    "17 forces F/(E* h L) from 1e-3 to 3; 10 samples (small: 16)",
    "stiffness against the mean gap, in which free and periodic bodies can be compared",
    "cells: squares as long as the longest waves, each with eq. 5.5 from its highest point on, h that of the surface; "
    "1/lambda of the exponential distribution: the mean height of the upper half of the maxima above their median",
    f"a linear law is looked for from {MANY:g} E* h l on, l the longest wave, up to a contact fraction of {FULL:g}",
)
SIZE = (drawing.PAGE, 6.6)
SEED = 15
_THEORIES = ("persson", "gw")
_SHOWN = 8  # L over the longest wave, of the surface beside all laws
_COLOURS = {1: "black", 2: "#0072b2", 4: "#009e73", 8: "#a67500", 16: "#d55e00"}  # by L over the longest wave
_PERSSON, _GREENWOOD, _CELLS = "#0072b2", "#009e73", "#d55e00"
_BODIES = ((True, "o", "black"), (False, "s", "0.4"))  # periodic, free


def studies(scale: Scale) -> Studies:
    """Return the one study: its rows are the cut-offs, then the roll-offs; each free and periodic."""
    points, samples = {"small": (128, 16), "thesis": (512, 10)}[scale]
    forces = {"lowest_force": 1e-3, "highest_force": 3.0, "loads": 17, "tolerance": 1e-6}
    return averaging.outlook_studies(
        "flat",
        scale,
        {"points": points, "hurst": HURST, "short_cutoff": 4 / points} | forces,
        case="cells",
        seed=SEED,
        samples=samples,
        table={"periodic": (False, True)},
        rows=[*({"long_cutoff": 1 / each} for each in CUTOFF), *({"rolloff": 1 / each} for each in ROLLOFF)],
    )


def averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return means over samples along ``row``, ``periodic`` and ``load``.

    Returns
    -------
    Dataset
        ``stiffness`` k and ``interfacial`` K over E* L, ``area`` A/L^2; ``cells``, what the sum over cells says, and
        ``decay`` (row), lambda h of their maxima; ``persson``, ``gw`` and, with ``_area``, their areas; ``exponent``
        of K over the force in the window, ``level``, the geometric mean of K h/F there, and ``over_decay``, the same
        of K over lambda F; ``alone``, k over that of one cell that carries all, where the fits of eq. 5.5 end.
        ``long`` (row), L over the longest wave, and ``kind``, "cut-off" or "roll-off"; ``force`` F/(E* h L);
        ``window``.
    """
    given = averaging.without_parameters(averaging.converged(exported))
    force = given["dimensionless_force"]
    interfacial, area = given["interfacial_stiffness"], given["contact_area"]
    cutoff, rolloff = given["long_cutoff"], given["rolloff"]
    length = cutoff.fillna(rolloff)
    cells, decay = _of_cells(given["below"].isel(periodic=1, drop=True) / RMS, length, force)
    floor = 20 * averaging.same_for_all(given["cell_stiffness"])
    window = (force >= MANY * length) & (area.mean("sample") <= FULL) & (interfacial.mean("sample") > floor)
    held = interfacial.where(window)
    alone = xarray.apply_ufunc(single_cell_stiffness, length, force, HURST)
    nearest = abs(logarithm(force / length / pohrt_popov.FORCE_LIMIT)).argmin("load")
    found = averaging.means(
        stiffness=given["stiffness"],
        interfacial=interfacial,
        area=area,
        cells=cells,
        decay=decay,
        exponent=averaging.slope(logarithm(held), logarithm(force), "load"),
        level=exponential(logarithm(held / force).mean("load")),
        over_decay=exponential(logarithm(held / force / decay).mean("load")),
        alone=(given["stiffness"] / alone).isel(load=nearest),
    )
    for name, values in _theories(exported, force.values).items():
        found[name] = ("row", "load"), values
    found["force"], found["window"] = force, window
    found["long"] = "row", (1 / length.values).round().astype(int)
    found["kind"] = "row", np.where(np.isnan(cutoff.values), "roll-off", "cut-off")
    told = {"surfaces": exported.sizes["sample"], "points": int(exported["points"])}
    return found.drop_vars(["long_cutoff", "rolloff"]).assign_attrs(told)


def _of_cells(
    below: xarray.DataArray, length: xarray.DataArray, force: xarray.DataArray
) -> tuple[xarray.DataArray, xarray.DataArray]:
    """Return the stiffness of the sum over cells at every load, and lambda h of their tops, of every row and sample."""

    def model(values: Array, side: float, forces: Array) -> tuple[Array, float]:
        tops = values[np.isfinite(values)]
        if not tops.size:
            return np.full(forces.shape, np.nan), np.nan
        return cells_stiffness(tops, side, forces, HURST), exponential_rate(tops)

    read: list[list[str]] = [["cell"], [], ["load"]]
    found: list[list[str]] = [["load"], []]
    cells, decay = xarray.apply_ufunc(
        model, below, length, force, input_core_dims=read, output_core_dims=found, vectorize=True
    )
    return cells, decay


def _theories(exported: xarray.Dataset, force: Any) -> dict[str, Any]:
    """Return K/(E* L) and A/L^2 of the theories for every row; all samples of a row have one spectrum."""
    points = int(exported["points"])
    grid = rc.Grid((points, points), 1 / points, periodic=True)
    shape = (exported.sizes["row"], len(force))
    found = {name: np.empty(shape) for each in _THEORIES for name in (each, f"{each}_area")}
    for row in range(shape[0]):
        ends: dict[str, Any] = {"short_cutoff": exported["short_cutoff"].item()}
        ends |= {name: exported[name].values[row] for name in ("long_cutoff", "rolloff")}
        limits = {name: each for name, each in ends.items() if np.isfinite(each)}
        surface = rc.self_affine(grid, HURST, RMS, np.random.default_rng(0), **limits)
        for name, law in zip(_THEORIES, rc.loading_laws(surface, 1.0, _THEORIES), strict=True):
            found[name][row] = law.predict("interfacial_stiffness", force * RMS)
            found[f"{name}_area"][row] = law.predict("contact_area", force * RMS)
    return found


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw K/F with cut-off (a) and roll-off (b), and stiffness (c) and area (d) of one beside all laws."""
    first, second, third, fourth = drawing.panels(figure, 2, 2)
    force = averages["force"]
    for axes, kind in ((first, "cut-off"), (second, "roll-off")):
        _levels(axes, _rows(averages, kind, least=1))
        drawing.label(axes, drawing.FORCE, rf"$K h\,/\,F$, {kind}", xscale="log", ylim=(0, 9))
    one = _rows(averages, "cut-off", least=1)
    one = one.isel(row=int(np.flatnonzero(one["long"] == _SHOWN)[0]))
    body = one["persson"] / (1 + SQUARE * one["persson"])
    # Over the force: a linear law is level.
    names = (("interfacial", "periodic"), ("stiffness", "free, k"))
    for (periodic, mark, colour), (name, words) in zip(_BODIES, names, strict=True):
        _over_force(third, one.sel(periodic=periodic), name, fmt=mark, color=colour, label=words)
    for words, values, colour, style in (
        ("Persson", one["persson"], _PERSSON, "-"),
        ("Persson on a finite body", body, _PERSSON, "--"),
        ("Greenwood, Williamson", one["gw"], _GREENWOOD, "-."),
        ("sum over cells", one["cells"], _CELLS, "-"),
        (r"$\lambda F$ of the maxima", one["decay"] * force, _CELLS, ":"),
    ):
        third.plot(force, values / force, style, color=colour, label=words)
    words = rf"$K h\,/\,F$, cut-off at L/{_SHOWN}"
    drawing.label(third, drawing.FORCE, words, xscale="log", ylim=(0, 9))
    for periodic, mark, colour in _BODIES:
        words = "periodic" if periodic else "free"
        _over_force(fourth, one.sel(periodic=periodic), "area", fmt=mark, color=colour, label=words)
    fourth.plot(force, one["persson_area"] / force, "-", color=_PERSSON, label="Persson")
    fourth.plot(force, one["gw_area"] / force, "-.", color=_GREENWOOD, label="Greenwood, Williamson")
    words = rf"area over force $A E^* h\,/\,(F L)$, cut-off at L/{_SHOWN}"
    drawing.label(fourth, drawing.FORCE, words, xscale="log")
    fourth.set_ylim(bottom=0)
    for axes in (first, second, third, fourth):
        axes.legend()


def _levels(axes: Axes, averages: xarray.Dataset) -> None:
    force = averages["force"]
    for row in range(averages.sizes["row"]):
        one = averages.isel(row=row)
        long = int(one["long"])
        words = f"L/{long}" if long > 1 else "none"
        given: Any = {"color": _COLOURS[long], "markersize": 0, "elinewidth": 0.8}
        _over_force(axes, one.sel(periodic=True), "interfacial", label=words, **given)
        for values, style in ((one["interfacial"].sel(periodic=False), "--"), (one["persson"], ":")):
            axes.plot(force, values / force, style, color=_COLOURS[long])
    drawing.key(axes, "--", "free")
    drawing.key(axes, ":", "Persson")


def _over_force(axes: Axes, one: xarray.Dataset, name: str, **style: Any) -> None:
    """Draw a mean over the force, with its errors."""
    force, error = one["force"], one[f"{name}_error"]
    axes.errorbar(force, one[name] / force, error / force, **({"markersize": 3.5} | style))


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Judge the linear law of section 5.1, where it comes from, and the theories beside it."""
    cut, roll = _rows(averages, "cut-off"), _rows(averages, "roll-off")
    told = f"{averages.attrs['surfaces']} samples of {averages.attrs['points']}² cells, H = {HURST:g}"
    yield Verdict(
        "with a cut-off the stiffness is proportional to the force",
        "we can find the contact stiffness to be proportional to the normal force for fractal rough surfaces that have "
        "a considerable Cut-Off.",
        "section 5.1",
        f"exponents of K over the window, periodic {_each(cut, 'exponent', True)}; free "
        f"{_each(cut, 'exponent', False)}; {told}",
        _of_rows(cut, cut["exponent"] - 1, cut["exponent_error"], NEAR, "+.2f"),
    )
    yield Verdict(
        "with a roll-off the exponent is about 0.9",
        "Here we expect k ∝ F^α with α ≈ 0.9.",
        "section 5.1",
        f"periodic {_each(roll, 'exponent', True)}; free {_each(roll, 'exponent', False)}; {told}",
        _of_rows(roll, roll["exponent"] - 0.9, roll["exponent_error"], NEAR, "+.2f"),
    )
    inside = cut["window"].sel(periodic=True)
    yield Verdict(
        "each length of the longest wave acts as an indenter of its own under eq. 5.5",
        "The behavior of an individual spring in this model is now the behavior of on single λcutoff-asperity, as "
        "described by the Pohrt/Popov power law",
        "section 5.1, eq. 5.1",
        "K over the sum over cells, with their own maxima, from the lowest force of the window to the highest, "
        f"cut-off, periodic {_ends(cut, 'cells')}; roll-off {_ends(roll, 'cells')}; over lambda F of the maxima "
        f"{_each(cut, 'over_decay', True)}; {told}",
        _of_rows(
            cut,
            (cut["interfacial"] / cut["cells"] - 1).sel(periodic=True).where(inside),
            (cut["interfacial_error"].sel(periodic=True) / cut["cells"]).where(inside),
            0.2,
            "+.0%",
        ),
    )
    yield _finite(cut, told)
    yield from (_theory(averages, name, told) for name in _THEORIES)


def findings(averages: xarray.Dataset) -> str:
    """Return in a sentence what is found about nominally flat surfaces."""
    cut = _rows(averages, "cut-off")
    last = cut.isel(row=-1)["exponent"].sel(periodic=True)
    error = cut.isel(row=-1)["exponent_error"].sel(periodic=True)
    return (
        f"On nominally flat surfaces, cut off at L/{int(cut['long'][-1])}, the stiffness grows as "
        f"F^{float(last):.2f} (± {float(error):.2f}). The thesis expects it to be proportional to the force."
    )


def _of_rows(
    averages: xarray.Dataset,
    deviation: xarray.DataArray,
    error: xarray.DataArray,
    tolerance: float,
    form: str,
) -> Ruling:
    """Return the ruling on rows, each called by its longest wave."""
    named = deviation.rename(row="long").assign_coords(long=("long", averages["long"].values))
    spread = error.rename(row="long").assign_coords(long=("long", averages["long"].values))
    return ruled(named, spread, tolerance, form)


def _theory(averages: xarray.Dataset, name: str, told: str) -> Verdict:
    """Return how far a theory's stiffness and area are from those computed, periodic, in the window."""
    inside = averages["window"].sel(periodic=True) & (averages["long"] >= FEW)
    one = averages.sel(periodic=True)
    stiffness = (one["interfacial"] / one[name] - 1).where(inside)
    area = (one["area"] / one[f"{name}_area"] - 1).where(inside)
    error = (one["interfacial_error"] / one[name]).where(inside)
    words = {"persson": "Persson", "gw": "Greenwood and Williamson, from the spectrum"}[name]
    quotes = {
        "persson": ("we find that it must rise linearly with the load A_0 p.", "section 3.2, eq. 3.16"),
        "gw": ("In many cases involving a characteristic wavelength, the assumptions of the GW-model are indeed "
               "reasonable.", "chapter 1"),
    }  # fmt: skip
    return Verdict(
        f"the stiffness of nominally flat surfaces by {words}",
        *quotes[name],
        f"computed stiffness {spanned(stiffness, '+.0%')} from it, area {spanned(area, '+.0%')}, periodic, cut-off and "
        "roll-off from L/4 on, in the window; K over it from its lowest force to its highest, cut-off "
        f"{_ends(_rows(averages, 'cut-off'), name)}; roll-off {_ends(_rows(averages, 'roll-off'), name)}; {told}",
        _of_forces(averages["force"], stiffness, error),
        "theory",
    )


def _of_forces(force: xarray.DataArray, deviation: xarray.DataArray, error: xarray.DataArray) -> Ruling:
    """Return the ruling on a theory at every force, with the whole range: few spots carry at the lowest ones."""
    away, errors = (each.assign_coords(load=force.values).rename(load="force") for each in (deviation, error))
    rule = ruled(away, errors, 0.2)
    first, last = deviation.max("row").dropna("load")[[0, -1]].values
    words = (
        f"up to {first:+.0%} at the lowest force, where few spots carry, and to {last:+.0%} at the highest"
    )
    return replace(rule, trigger=words)


def _finite(cut: xarray.Dataset, told: str) -> Verdict:
    """Return what a free edge does."""
    inside = cut["window"].all("periodic")
    free, periodic = (cut.sel(periodic=each) for each in (False, True))
    gap = (free["interfacial"] / periodic["interfacial"] - 1).where(inside)
    bulk = free["stiffness"] / periodic["interfacial"]
    expected = 1 / (1 + SQUARE * periodic["interfacial"])
    off, lost = (bulk / expected - 1).where(inside), (bulk - 1).where(inside)
    # Of the same surfaces: the error of the ratio is at most the sum of both.
    error = bulk * (
        free["stiffness_error"] / free["stiffness"] + periodic["interfacial_error"] / periodic["interfacial"]
    )
    return Verdict(
        "coupling over more than the longest wave is negligible",
        "Elastic coupling for distances greater than λcutoff is negligible",
        "section 5.1",
        f"of a finite body k is {spanned(lost, '+.0%')} from that of a periodic one: the body sinks in as a whole; it "
        f"is {spanned(off, '+.1%')} from 1/k = 1/K + {SQUARE:.3f}/(E* L), and K of the one {spanned(gap, '+.1%')} from "
        f"K of the other; {told}",
        _of_rows(cut, lost, error.where(inside), 0.1, "+.0%"),
        "assumption",
    )


def _rows(averages: xarray.Dataset, kind: str, least: int = FEW) -> xarray.Dataset:
    """Return the rows of cut-offs or roll-offs, from so many cells along a side on."""
    chosen = (averages["kind"] == kind) & (averages["long"] >= least)
    return averages.isel(row=np.flatnonzero(chosen))


def _each(averages: xarray.Dataset, name: str, periodic: bool | None) -> str:
    """Return a mean of every row in words."""
    chosen = averages if periodic is None else averages.sel(periodic=periodic)
    rows = chosen.assign_coords(row=[f"L/{long}" if long > 1 else "L" for long in chosen["long"].values])
    return listed(rows, name, "row", words="{}")


def _ends(averages: xarray.Dataset, law: str) -> str:
    """Return K over a law at the first and the last force of the window, periodic, of every row in words."""
    words = []
    for row in range(averages.sizes["row"]):
        one = averages.isel(row=row).sel(periodic=True)
        inside = np.flatnonzero(one["window"])
        if len(inside):
            ratio = (one["interfacial"] / one[law]).values[inside]
            words.append(f"{ratio[0]:.2f} to {ratio[-1]:.2f} at L/{int(one['long'])}")
    return ", ".join(words) or "none"
