"""Figure 37: stiffness of a rough sphere against force, between roughness and sphere."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.plot.ticks import TICK
from roughcontact.theory import pohrt_popov, rough_sphere
from roughcontact.theory.hertz import point
from roughcontact.thesis import drawing
from roughcontact.thesis.ensembles import RADIUS, SPHERE_HURST, SPHERE_RMS, curve_averages, sphere_study
from roughcontact.thesis.figures import Scale, Studies
from roughcontact.thesis.verdict import Verdict, Verdicts, counted, judged, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "stiffness of a rough sphere against force"
CROSSOVER = 8e-5  # thesis, eq. 5.10
CHOSEN = (
    f"R = {RADIUS:g} L, H = {SPHERE_HURST:g}, h = {SPHERE_RMS:g} L; free squares of 513 x 513 cells (small: 257 x 257)",
    "33 forces F/(E* L^2) from 1e-6 to 1e-2; arithmetic means over 50 samples (small: 20)",
    "open circles below the stiffness of 20 cells, which is that of the crossover",
)
SIZE = (6.2, 4.6)
NEAR = 0.05

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
        ("hertz", "--", "#0072b2", 1.2, "smooth sphere, slope 1/3"),
        ("roughness", "-.", "#009e73", 1.2, "roughness alone, slope 1/(H + 1)"),
    ):
        axes.plot(force, averages[name], style, color=colour, linewidth=width, zorder=2, label=words)
    resolved, colour = averages["resolved"], drawing.LINES
    for chosen, fill, also in ((resolved, colour, {"label": counted(averages)}), (~resolved, "white", {})):
        given: Any = {"color": colour, "markerfacecolor": fill, "zorder": 4} | also
        drawing.with_errors(axes, averages.where(chosen), "stiffness", fmt="o", **given)
    crossing = float(rough_sphere.crossover_force(*_BODY.values()))
    axes.axvline(crossing, color="0.5", linewidth=0.9, zorder=1)
    words = rf"crossover, ${1e5 * crossing:.2f} \cdot 10^{{-5}}$"
    axes.text(1.05 * crossing, 3.4e-3, words, fontsize=TICK, color="0.3")
    limits = {"xlim": (force[0] / 1.2, force[-1] * 1.2), "ylim": (3e-3, 0.6)}
    drawing.label(axes, r"force $F\,/\,(E^* L^2)$", drawing.STIFFNESS, **drawing.LOG, **limits)
    axes.legend(loc="upper left")


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare computed stiffnesses with eq. 5.9, with the asymptotes, and the crossover with its number."""
    inside = averages["resolved"].to_numpy()
    one = averages.isel(load=np.flatnonzero(inside))
    ratio, error = one["stiffness"] / one["law"] - 1, one["stiffness_error"] / one["law"]
    hertz = averages["stiffness"] / averages["hertz"] - 1
    errors = averages["stiffness_error"] / averages["hertz"]
    crossing = float(rough_sphere.crossover_force(*_BODY.values()))
    below = averages.isel(load=np.flatnonzero(averages["force"].to_numpy() < crossing))
    faint = below["stiffness"] / below["law"] - 1
    yield Verdict(
        "sphere and roughness act as their forces added (eq. 5.9)",
        "eq. 5.9",
        f"{spanned(ratio, '+.1%')} from it where resolved (forces {spanned(one['force'], '.2g')} E* L^2), errors "
        f"{spanned(error, '.1%')}; {counted(averages)}",
        judged(ratio, error, NEAR),
    )
    yield Verdict(
        "the crossover between roughness and sphere",
        f"{CROSSOVER:g}",
        f"{crossing:.4g} by eq. 5.10; there the computed stiffness is "
        f"{float((averages['stiffness'] / averages['hertz']).interp(load=_place(averages, crossing))):.2f} of that of "
        "the smooth sphere",
        bool(abs(crossing / CROSSOVER - 1) < 0.01),
    )
    yield Verdict(
        "below the crossover the roughness decides",
        "slope 1/(H + 1)",
        f"{spanned(faint, '+.1%')} from eq. 5.9 below the crossover, mostly on fewer than 20 cells",
        None,
    )
    yield Verdict(
        "taken for a smooth sphere the stiffness can only be overestimated",
        "only",
        f"means {spanned(hertz, '+.1%')} from that of the smooth sphere",
        judged(np.maximum(hertz, 0), errors, 0.0),
    )


def _place(averages: xarray.Dataset, force: float) -> float:
    """Return the place of a force along the loads."""
    return float(np.interp(np.log(force), np.log(averages["force"]), np.arange(averages.sizes["load"])))
