"""Outlook: the force as a derivative of the elastic energy, against the mean gap and against the approach.

Between two loads the energy grows by the work of the force, int F dd along the approach (eq. 3.17), and int F d(-u)
along the mean gap u if eqs 3.12 and 3.13 hold. Both integrals are taken by cubics through force and stiffness.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact_thesis import averaging, drawing
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import in_part, ruled
from roughcontact_thesis.verdict import Verdict, Verdicts, counted, spanned

__all__ = ["averages", "draw", "studies", "verdicts", "work"]

TITLE = "the force as a derivative of the elastic energy, against mean gap and approach"
HURST = 0.7
ROLLOFF = (1.0, 0.125)  # over L: self-affine up to the side, and nominally flat
LOADS = (1e-3, 10.0)  # F/(E* h L)
CHOSEN = (
    f"free and periodic squares of 256 x 256 cells (small: 128 x 128), H = {HURST:g}, shortest wave of 4 cells, "
    "without and with a roll-off at L/8",
    f"41 forces F/(E* h L) from {LOADS[0]:g} to {LOADS[1]:g}; 24 samples (small: 6)",
    "interfacial energy of a free body: its energy less half the force times the mean displacement under the square",
)
SIZE = (drawing.PAGE, 6.2)
SEED = 13
ROUNDING = 1e-3  # of the work: what cubics through a staircase of the stiffness may miss
_STYLES = ((ROLLOFF[0], "-", ""), (ROLLOFF[1], "--", f", roll-off at L/{1 / ROLLOFF[1]:g}"))


def studies(scale: Scale) -> Studies:
    """Return the one study: free and periodic, with and without a roll-off."""
    points, samples = {"small": (128, 6), "thesis": (256, 24)}[scale]
    forces = {"lowest_force": LOADS[0], "highest_force": LOADS[1], "loads": 41, "tolerance": 1e-8}
    return averaging.outlook_studies(
        "energy",
        scale,
        {"points": points, "hurst": HURST, "short_cutoff": 4 / points} | forces,
        case="curve",
        seed=SEED,
        samples=samples,
        table={"periodic": (False, True), "rolloff": ROLLOFF},
    )


def work(force: xarray.DataArray, way: xarray.DataArray, stiffness: xarray.DataArray) -> xarray.DataArray:
    """Return the integral of a force along its way between neighbouring loads, by the cubic that has its slopes.

    ``(F1 + F2)/2 Dx - (k2 - k1)/12 Dx^2``, with k = dF/dx at both ends; along ``interval`` in place of ``load``.
    """
    step = _grown(way)
    return (_first(force) + _grown(force) / 2) * step - _grown(stiffness) / 12 * step**2


def _first(values: xarray.DataArray) -> xarray.DataArray:
    """Return values at the first of two neighbouring loads."""
    return values.isel(load=slice(0, -1)).rename(load="interval")


def _grown(values: xarray.DataArray) -> xarray.DataArray:
    """Return by how much values grow between neighbouring loads."""
    return values.isel(load=slice(1, None)).rename(load="interval") - _first(values)


def averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return means over samples along ``periodic`` and ``rolloff``.

    Returns
    -------
    Dataset
        Along ``load``: ``length``, U/F over h; ``interfacial_length``, the same of the interfacial energy;
        ``area_length``, U/A over E* h; ``area``, A/L^2; ``force`` F/(E* h L). Along ``interval``, between two loads:
        ``by_approach`` and ``by_gap``, what the force is by eqs 3.17 and 3.13 over what it is, and
        ``by_gap_interfacial``, the latter with the interfacial energy; ``between`` is the force in the middle.
        ``whole_by_approach`` and ``whole_by_gap`` are the former two from the first load to the last.
    """
    given = averaging.without_parameters(averaging.converged(exported))
    # Without contact the gap is the mean separation. A periodic body does not sink in, and has the same heights.
    separation = (given["mean_gap"] + given["depth"]).sel(periodic=True).isel(load=0)
    sunk = given["mean_gap"] + given["depth"] - separation.drop_vars("periodic")
    force, energy = given["force"], given["elastic_energy"]
    interfacial = energy - force * sunk / 2
    approaching = work(force, given["depth"], given["stiffness"])
    closing = work(force, -given["mean_gap"], given["interfacial_stiffness"])
    whole = _grown(energy).sum("interval")
    height = float(exported["rms"].mean())
    found = averaging.means(
        length=energy / force / height,
        interfacial_length=interfacial / force / height,
        area_length=energy / given["contact_area"] / height,
        area=given["contact_area"],
        by_approach=_grown(energy) / approaching,
        by_gap=_grown(energy) / closing,
        by_gap_interfacial=_grown(interfacial) / closing,
        whole_by_approach=whole / approaching.sum("interval"),
        whole_by_gap=whole / closing.sum("interval"),
    )
    loads = given["dimensionless_force"]
    found["force"] = loads
    found["between"] = np.sqrt(_first(loads) * (_first(loads) + _grown(loads)))
    return found.assign_attrs(averaging.counts(exported))


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the force from the energy of free (a) and periodic (b) bodies, energy over force (c) and over area (d)."""
    first, second, third, fourth = drawing.panels(figure, 2, 2)
    for axes, name, periodic in ((first, "free", False), (second, "periodic", True)):
        _forces(axes, averages.sel(periodic=periodic), all_one=periodic)
        axes.set_title(name, loc="center")
    second.set(ylim=(0.997, 1.006))
    second.axhspan(1 - ROUNDING, 1 + ROUNDING, color="0.9", zorder=0, label=f"within {ROUNDING:.1%}")
    second.legend(loc="upper left")
    first.set(yscale="log", ylim=(0.4, 30))
    drawing.readable(first)
    free = averages.sel(periodic=False)
    for axes, name, words in (
        (third, "length", r"energy over force $U\,/\,(F h)$"),
        (fourth, "area_length", r"energy over area $U\,/\,(A E^* h)$"),
    ):
        for body, colour in (("free", drawing.COLOURS[1]), ("periodic", drawing.COLOURS[0])):
            for rolloff, style, also in _STYLES:
                one = averages.sel(periodic=body == "periodic", rolloff=rolloff)
                drawing.with_errors(axes, one, name, fmt=style, color=colour, label=body + also)
        drawing.label(axes, drawing.FORCE, words, **drawing.LOG)
    for rolloff, style, _ in _STYLES:
        third.plot(free["force"], free["interfacial_length"].sel(rolloff=rolloff), style, color="0.5")
    drawing.key(third, "-", "free, interfacial energy", color="0.5")
    for axes in (third, fourth):
        axes.legend()


def _forces(axes: Axes, averages: xarray.Dataset, *, all_one: bool) -> None:
    # Of a periodic body all are one: the wider ones are seen beneath the others.
    for name, colour, words, width in (
        ("by_gap", "#c8290b", r"$-dU/du$, eq. 3.13", 3.4),
        ("by_gap_interfacial", "#009e73", r"$-dU/du$, interfacial energy", 2.0),
        ("by_approach", "black", r"$dU/dd$, eq. 3.17", 0.9),
    ):
        for rolloff, style, also in _STYLES:
            force, label = averages[name].sel(rolloff=rolloff), None if also else words
            axes.plot(
                averages["between"],
                force,
                style,
                color=colour,
                label=label,
                linewidth=width if all_one else 1.1,
            )
    drawing.key(axes, "--", f"with roll-off at L/{1 / ROLLOFF[1]:g}")
    drawing.label(axes, drawing.FORCE, "force from the energy over the force", xscale="log")
    axes.legend(loc="upper left")


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Say of which energy and which body eqs 3.13 to 3.17 hold."""
    free, periodic = averages.sel(periodic=False), averages.sel(periodic=True)
    approach, error = averages["whole_by_approach"] - 1, averages["whole_by_approach_error"]
    gap, gap_error = periodic["whole_by_gap"] - 1, periodic["whole_by_gap_error"]
    steps = averages["by_approach"] - 1
    one = free.sel(rolloff=ROLLOFF[0])
    total = one["by_gap"]
    between = averages["between"].values
    at = [int(np.argmin(np.abs(np.log(between / force)))) for force in (LOADS[0], 1e-2, 1e-1, 1.0)]
    grown = ", ".join(f"{float(total[i] - 1):+.1%} at {float(between[i]):.2g}" for i in at)
    inner = free["by_gap_interfacial"] - 1
    low = inner.isel(interval=np.flatnonzero(between < 1))
    flat = averages.sel(periodic=True, rolloff=ROLLOFF[1])
    inside = np.flatnonzero((flat["force"] >= 0.1) & (flat["area"] < 0.25))
    many = flat.isel(load=inside)
    length, area = (many[name] for name in ("length", "area_length"))
    span = f"forces {spanned(many['force'], '.2g')} E* h L"
    told = f"{counted(averages)}, H = {HURST:g}"
    yield Verdict(
        "the force is the derivative of the energy against the approach",
        "We can indeed derive U_el to find the force, but this has to be done with respect to the coordinate that "
        "refers to force location.",
        "section 3.2, eq. 3.17",
        f"the energy grows by {spanned(approach, '+.3%')} more than the work of the force from {LOADS[0]:g} to "
        f"{LOADS[1]:g} E* h L, from one load to the next by {spanned(steps, '+.2%')}; free and periodic; {told}",
        ruled(approach, error, ROUNDING, "+.3%"),
        "method",
    )
    wrong = ruled(gap, gap_error, ROUNDING, "+.3%")
    objection = wrong
    if wrong.word == "holds":
        objection = in_part(
            "for the whole energy of a finite body", wrong.tolerance, f"periodic {wrong.trigger}"
        )
    elif wrong.word == "does not hold":
        objection = replace(wrong, word="holds")
    yield Verdict(
        "the force is not the derivative of the energy against the mean gap",
        "From my understanding eq. 3.12 and 3.13 are actually not correct.",
        "section 3.2",
        f"for a periodic body, which they are about, they hold: {spanned(gap, '+.3%')} more than the work along the "
        f"mean gap; for the whole energy of a free one the objection is right: by {grown} E* h L",
        objection,
        "method",
    )
    first = one.isel(interval=0)
    yield Verdict(
        "for small forces both derivatives coincide",
        "For small forces, both eq. 3.13 and 3.17 coincide.",
        "section 3.2",
        f"of a free body the force by eq. 3.13 is off by {grown} E* h L; without the energy of its sinking in, which "
        f"is no part of the interface, by {spanned(low, '+.1%')} up to a force of 1 and {spanned(inner, '+.1%')} up to "
        f"{LOADS[1]:g}",
        ruled(
            first["by_gap"] - 1, first["by_gap_error"], 0.05, words=f"5% at {float(between[0]):.1g} E* h L"
        ),
        "method",
    )
    yield _proportional(
        many,
        "length",
        "the energy is proportional to the force, U = u0 F",
        "where u_0 is a characteristic length that depends on the surface roughness and is of the order of the rms "
        "roughness",
        "section 3.2, eq. 3.15",
        f"nominally flat, periodic: U/F from {float(length[0]):.2f} to {float(length[-1]):.2f} h, {span}; without "
        f"roll-off {spanned(averages['length'].sel(periodic=True, rolloff=ROLLOFF[0]), '.2f')} h over all forces",
    )
    yield _proportional(
        many,
        "area_length",
        "the energy is proportional to the contact area",
        "With the mean elastic energy and mean size per asperity being constant, both overall quantities grow in the "
        "same way",
        "section 3.2, eq. 3.14",
        f"nominally flat, periodic: U/A grows from {float(area[0]):.3f} to {float(area[-1]):.3f} E* h while A grows "
        f"from {float(many['area'][0]):.3f} to {float(many['area'][-1]):.3f} L^2; {span}",
    )


def _proportional(
    many: xarray.Dataset, name: str, claim: str, quote: str, source: str, found: str
) -> Verdict:
    """Return whether a ratio is the same at all forces."""
    ratio = many[name]
    level = float(np.exp(np.log(ratio).mean()))
    # Forces share their samples: the error of a difference is at most the sum of both.
    error = (many[f"{name}_error"] + float(many[f"{name}_error"].max())) / level
    rule = ruled(ratio / level - 1, error, 0.125, words="12.5% either way")
    return Verdict(claim, quote, source, found, rule, "theory")
