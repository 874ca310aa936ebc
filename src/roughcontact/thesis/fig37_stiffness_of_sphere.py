"""Figure 37: stiffness of a rough sphere against force, between roughness and sphere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import LABEL, TICK
from roughcontact.theory import pohrt_popov, rough_sphere
from roughcontact.theory.hertz import point
from roughcontact.thesis.ensembles import RADIUS, SPHERE_HURST, SPHERE_RMS, curve_averages, sphere_study
from roughcontact.thesis.stiffness_view import quiet
from roughcontact.thesis.verdict import Verdict, judged, spanned

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

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

_POINTS, _HERTZ, _ROUGH = "#c8290b", "#0072b2", "#009e73"
_BODY = {"radius": RADIUS, "hurst": SPHERE_HURST, "rms": SPHERE_RMS, "length": 1.0, "modulus": 1.0}


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the one study: a paraboloid with roughness."""
    return (sphere_study(scale),)


def averages(spheres: xarray.Dataset) -> xarray.Dataset:
    """Return mean stiffnesses k/(E* L) with the force F/(E* L^2), and what the laws say."""
    found = curve_averages(spheres)
    force = (found["force"] * SPHERE_RMS).assign_attrs(long_name="force / (E* L^2)", units="1")
    found = found.assign(force=force)
    laws = {
        "law": (rough_sphere.stiffness(force.to_numpy(), **_BODY), "k/(E* L) by eq. 5.9"),
        "hertz": (
            point(1.0, radius=RADIUS, force=force.to_numpy()).stiffness,
            "k/(E* L) of the smooth sphere, eq. 5.4",
        ),
        "roughness": (
            pohrt_popov.stiffness(force.to_numpy(), SPHERE_HURST, SPHERE_RMS, 1.0, 1.0),
            "k/(E* L) of the roughness alone, eq. 5.5",
        ),
    }
    for name, (values, words) in laws.items():
        found[name] = "load", values, {"long_name": words, "units": "1"}
    return found


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw computed stiffnesses over the sum of both forces, both asymptotes, and their crossover."""
    axes = figure.subplots()
    force = averages["force"].to_numpy()
    axes.plot(force, averages["law"], ":", color="black", linewidth=3.2, zorder=2, label="eq. 5.9")
    axes.plot(
        force,
        averages["hertz"],
        "--",
        color=_HERTZ,
        linewidth=1.2,
        zorder=2,
        label="smooth sphere, slope 1/3",
    )
    words = "roughness alone, slope 1/(H + 1)"
    axes.plot(force, averages["roughness"], "-.", color=_ROUGH, linewidth=1.2, zorder=2, label=words)
    for chosen, fill, text in (
        (
            averages["resolved"],
            _POINTS,
            f"{averages.attrs['surfaces']} samples of {averages.attrs['cells']}² cells",
        ),
        (~averages["resolved"], "white", None),
    ):
        axes.errorbar(
            force,
            averages["stiffness"].where(chosen),
            averages["stiffness_error"],
            fmt="o",
            color=_POINTS,
            markerfacecolor=fill,
            markersize=4,
            elinewidth=0.9,
            zorder=4,
            label=text,
        )
    crossing = float(rough_sphere.crossover_force(*_BODY.values()))
    axes.axvline(crossing, color="0.5", linewidth=0.9, zorder=1)
    axes.annotate(
        rf"crossover, ${1e5 * crossing:.2f} \cdot 10^{{-5}}$",
        (crossing, 0.02),
        (4, 2),
        ("data", "axes fraction"),
        "offset points",
        fontsize=TICK,
        color="0.3",
    )
    axes.set(xscale="log", yscale="log", xlim=(force[0] / 1.2, force[-1] * 1.2), ylim=(3e-3, 0.6))
    axes.set_xlabel(r"force $F\,/\,(E^* L^2)$", fontsize=LABEL)
    axes.set_ylabel(r"stiffness $k\,/\,(E^* L)$", fontsize=LABEL)
    quiet(axes)
    axes.legend(fontsize=TICK, frameon=False, loc="upper left")


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare computed stiffnesses with eq. 5.9, with the asymptotes, and the crossover with its number."""
    inside = averages["resolved"].to_numpy()
    one = averages.isel(load=np.flatnonzero(inside))
    ratio, error = one["stiffness"] / one["law"] - 1, one["stiffness_error"] / one["law"]
    hertz = averages["stiffness"] / averages["hertz"] - 1
    errors = averages["stiffness_error"] / averages["hertz"]
    crossing = float(rough_sphere.crossover_force(*_BODY.values()))
    below = averages.isel(load=np.flatnonzero(averages["force"].to_numpy() < crossing))
    faint = below["stiffness"] / below["law"] - 1
    return (
        Verdict(
            "sphere and roughness act as their forces added (eq. 5.9)",
            "eq. 5.9",
            f"{spanned(ratio, '+.1%')} from it where resolved (forces {spanned(one['force'], '.2g')} E* L^2), errors "
            f"{spanned(error, '.1%')}; {averages.attrs['surfaces']} samples of {averages.attrs['cells']}² cells",
            judged(ratio, error, NEAR),
        ),
        Verdict(
            "the crossover between roughness and sphere",
            f"{CROSSOVER:g}",
            f"{crossing:.4g} by eq. 5.10; there the computed stiffness is "
            f"{float((averages['stiffness'] / averages['hertz']).interp(load=_place(averages, crossing))):.2f} of "
            "that of the smooth sphere",
            bool(abs(crossing / CROSSOVER - 1) < 0.01),
        ),
        Verdict(
            "below the crossover the roughness decides",
            "slope 1/(H + 1)",
            f"{spanned(faint, '+.1%')} from eq. 5.9 below the crossover, mostly on fewer than 20 cells",
            None,
        ),
        Verdict(
            "taken for a smooth sphere the stiffness can only be overestimated",
            "only",
            f"means {spanned(hertz, '+.1%')} from that of the smooth sphere",
            judged(np.maximum(hertz, 0), errors, 0.0),
        ),
    )


def _place(averages: xarray.Dataset, force: float) -> float:
    """Return the place of a force along the loads."""
    return float(np.interp(np.log(force), np.log(averages["force"]), np.arange(averages.sizes["load"])))
