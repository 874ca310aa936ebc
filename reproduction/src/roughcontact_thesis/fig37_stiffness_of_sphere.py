"""Figure 37: stiffness of a rough sphere against force, between roughness and sphere."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.theory.spheres_and_punches import rough_sphere
from roughcontact.theory.spheres_and_punches.hertz import point
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact_thesis import drawing
from roughcontact_thesis.ensembles import RADIUS, SPHERE_HURST, SPHERE_RMS, curve_averages, sphere_study
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import exactly, ruled, undecided
from roughcontact_thesis.verdict import Verdict, Verdicts, beside, counted, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "stiffness of a rough sphere against force"
CHOSEN = (
    f"R = {RADIUS:g} L, H = {SPHERE_HURST:g}, h = {SPHERE_RMS:g} L; free squares of 513 x 513 cells (small: 257 x 257)",
    "33 forces F/(E* L^2) from 1e-6 to 1e-2; arithmetic means over 50 samples (small: 20)",
    "open circles below the stiffness of 20 cells, which is that of the crossover",
)
SIZE = (drawing.COLUMN, 3.7)
LEAST = 0.02  # of a stiffness: what these samples can tell
NEAR = 0.1  # of a stiffness: what counts as agreement

_BODY = {"radius": RADIUS, "hurst": SPHERE_HURST, "rms": SPHERE_RMS, "length": 1.0, "modulus": 1.0}


def studies(scale: Scale) -> Studies:
    """Return the one study: a paraboloid with roughness."""
    return (sphere_study(scale),)


def averages(spheres: xarray.Dataset) -> xarray.Dataset:
    """Return mean stiffnesses k/(E* L) with the force F/(E* L^2), and what the laws say."""
    found = curve_averages(spheres)
    force = (found["force"] * SPHERE_RMS).assign_attrs(long_name="force / (E* L^2)", units="1")
    found = found.assign(force=force)
    forces = force.to_numpy()
    rough = pohrt_popov.stiffness(forces, SPHERE_HURST, SPHERE_RMS, 1.0, 1.0)
    for name, values, words in (
        ("law", rough_sphere.stiffness(forces, **_BODY), "eq. 5.9"),
        ("hertz", point(1.0, radius=RADIUS, force=forces).stiffness, "the smooth sphere, eq. 5.4"),
        ("roughness", rough, "the roughness alone, eq. 5.5"),
    ):
        found[name] = "load", values, {"long_name": f"k/(E* L) by {words}", "units": "1"}
    return found


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw computed stiffnesses over the sum of both forces, both asymptotes, and their crossover."""
    axes = figure.subplots()
    force = averages["force"].to_numpy()
    for name, style, colour, width, words in (
        ("law", ":", "black", 3.2, "eq. 5.9"),
        ("hertz", "--", "#0072b2", 1.2, "sphere alone, slope 1/3"),
        ("roughness", "-.", "#009e73", 1.2, "roughness, slope 1/(H + 1)"),
    ):
        axes.plot(force, averages[name], style, color=colour, linewidth=width, zorder=2, label=words)
    resolved, colour = averages["resolved"], drawing.LINES
    for chosen, fill, also in ((resolved, colour, {"label": counted(averages)}), (~resolved, "white", {})):
        given: Any = {"color": colour, "markerfacecolor": fill, "zorder": 4} | also
        drawing.with_errors(axes, averages.where(chosen), "stiffness", fmt="o", **given)
    crossing = float(rough_sphere.crossover_force(*_BODY.values()))
    axes.axvline(crossing, color="0.5", linewidth=0.9, zorder=1)
    words = rf"crossover, ${1e5 * crossing:.2f} \cdot 10^{{-5}}$"
    axes.text(1.05 * crossing, 3.4e-3, words, fontsize=drawing.TICK, color="0.3")
    limits = {"xlim": (force[0] / 1.2, force[-1] * 1.2), "ylim": (3e-3, 0.6)}
    drawing.label(axes, r"force $F\,/\,(E^* L^2)$", drawing.STIFFNESS, **drawing.LOG, **limits)
    drawing.legend_below(axes)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare computed stiffnesses with eq. 5.9, with the asymptotes, and the crossover with where they meet."""
    one, ratio, error = _from_law(averages)
    hertz = averages["stiffness"] / averages["hertz"] - 1
    errors = averages["stiffness_error"] / averages["hertz"]
    crossing = float(rough_sphere.crossover_force(*_BODY.values()))
    # Where ln k of both asymptotes is one.
    apart = np.log((averages["roughness"] / averages["hertz"]).to_numpy())
    meeting = float(np.exp(np.interp(0, apart, np.log(averages["force"].to_numpy()))))
    below = one.isel(load=np.flatnonzero(one["force"].to_numpy() < crossing))
    faint = averages.isel(load=np.flatnonzero(averages["force"].to_numpy() < crossing))
    deviation = faint["stiffness"] / faint["law"] - 1
    yield Verdict(
        "sphere and roughness act as their forces added",
        "derive an analytical approximation for the entire range of forces.",
        "section 5.2, eq. 5.9",
        f"{spanned(ratio, '+.1%')} from eq. 5.9 where resolved (forces {spanned(one['force'], '.2g')} E* L^2), errors "
        f"{spanned(error, '.1%')}; {counted(averages)}",
        ruled(ratio, error, NEAR),
    )
    yield Verdict(
        "the crossover lies where both asymptotes meet",
        "The crossover is expected to take place at the intersection of both",
        "section 5.2, eq. 5.10",
        f"{crossing:.4g} by eq. 5.10, {meeting:.4g} where eqs 5.4 and 5.5 meet",
        exactly(bool(abs(crossing / meeting - 1) < 0.01), "1%", f"{crossing / meeting - 1:+.1%}"),
        "method",
    )
    yield Verdict(
        "for small forces the stiffness is that of the roughness",
        "For small normal forces, the system is dominated by the roughness and the stiffness approaches eq. 5.5.",
        "section 5.2, fig. 37",
        f"{spanned(deviation, '+.1%')} from eq. 5.9 below the crossover, of which {below.sizes['load']} of "
        f"{faint.sizes['load']} forces are resolved",
        undecided("fewer than 20 cells carry well below the crossover", f"{NEAR:.0%}"),
    )
    yield Verdict(
        "taken for a smooth sphere the stiffness can only be overestimated",
        "When such a rough indenter is treated as purely Hertzian, then the contact stiffness can only be "
        "overestimated.",
        "section 5.2",
        f"means {spanned(hertz, '+.1%')} from that of the smooth sphere",
        ruled(hertz, errors, LEAST, above=True),
    )


def findings(averages: xarray.Dataset) -> str:
    """Return in a sentence what is found about the rough sphere."""
    _, ratio, error = _from_law(averages)
    hertz = averages["stiffness"] / averages["hertz"] - 1
    return (
        f"Where the grid resolves it, the stiffness of a rough sphere of H = {SPHERE_HURST:g} lies {beside(ratio)} (± "
        f"{float(error.max()):.0%} or less) the closed form of the thesis, eq. 5.9. Over all forces, it lies "
        f"{beside(hertz)} that of the smooth sphere."
    )


def _from_law(averages: xarray.Dataset) -> tuple[xarray.Dataset, xarray.DataArray, xarray.DataArray]:
    """Return what is resolved, its stiffness over eq. 5.9, less one, and the errors of that."""
    one = averages.isel(load=np.flatnonzero(averages["resolved"].to_numpy()))
    return one, one["stiffness"] / one["law"] - 1, one["stiffness_error"] / one["law"]
