"""The asperities that figures 31 to 33 stand on, run once for all three.

The thesis shows data of others there. Here the discrete asperity model of Ciavarella, Delfine and Demelio is run on
surfaces of our own: slopes can be compared, numbers cannot.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact import statistics
from roughcontact.statistics.fit import fit_power_laws
from roughcontact.statistics.fit_window import force_window
from roughcontact.study.study import Study
from roughcontact.theory.asperity_models import greenwood_williamson
from roughcontact.validation import Array
from roughcontact_thesis import drawing
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict

__all__ = [
    "CHOSEN",
    "asperity_averages",
    "draw_realisations",
    "exponent_words",
    "greenwood_williamson_stiffness",
    "law_exponent",
    "linear_model",
    "studies",
]

HURST = (0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95)
POINTS = {"small": 256, "thesis": 512}
SPOTS = 10.0  # on the average: below, it is the shape of single summits that speaks
HIGHEST = 0.07  # force F/(E* h L)
NEAR = 0.1  # of an exponent: what counts as agreement with a law
_CLASSICAL, _SLOPE = "#0072b2", "#2e8b2e"
CHOSEN = (
    "in place of the data of others: summits of surfaces by the inverse Fourier transform, points higher "
    "than their eight neighbours, as spheres of their own curvature that push each other down like point forces",
    f"{POINTS['thesis']} x {POINTS['thesis']} points; on the small scale {POINTS['small']} x {POINTS['small']}",
    f"slopes from {SPOTS:g} summits in contact on the average up to a force of {HIGHEST:g}",
)


def studies(scale: Scale) -> Studies:
    """Return the one study, which figures 31 to 33 share: 25 surfaces of each of seven fractal dimensions."""
    name, samples = {"small": ("asperities-small", 8), "thesis": ("asperities", 25)}[scale]
    parameters = {"points": POINTS[scale], "lowest_force": 1e-4, "highest_force": 0.1, "loads": 25}
    table: dict[str, Any] = {"hurst": HURST}
    return (Study(name=name, case="asperities", samples=samples, parameters=parameters, table=table),)


def law_exponent(hurst: float) -> float:
    """Return 1/(4 - D_f) of thesis eq. 4.31 with D_f = 3 - H."""
    return 1 / (1 + hurst)


def asperity_averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return the stiffness of every realisation, the means and their power laws.

    Returns
    -------
    Dataset
        ``force`` (load); along Hurst exponent, sample and load ``stiffness`` with interaction and ``independent``
        without; ``classical``, that of Greenwood and Williamson; ``spots`` on the average and the part of them that
        is ``merged``; ``exponent``, ``independent_exponent`` and ``classical_exponent`` between ``window_low``
        and ``window_high``.
    """
    force = exported["dimensionless_force"]
    spots, merged = (statistics.mean(exported[name]) for name in ("spots", "merged"))
    found = xarray.Dataset({"force": force, "stiffness": exported["dimensionless_stiffness"]})
    found = found.assign(independent=exported["independent_stiffness"], spots=spots, merged=merged / spots)
    laws = [_laws(found.sel(hurst=hurst), int(exported["points"])) for hurst in found["hurst"]]
    return found.merge(xarray.concat(laws, "hurst"))


def greenwood_williamson_stiffness(force: Array, hurst: float, points: int) -> Array:
    """Return k/(E* L) of independent spheres with the moments of the surfaces (McCool) at forces F/(E* h L)."""
    grid = rc.Grid((points, points), 1 / points, periodic=True)
    moments = rc.grid_moments(grid, rc.SelfAffineSpectrum(hurst).scaled(1.0, grid))
    law = greenwood_williamson.law(moments, 1.0, 1.0)
    return np.asarray(law.quantities["interfacial_stiffness"](force))


def _laws(one: xarray.Dataset, points: int) -> xarray.Dataset:
    """Return the classical curve of one Hurst exponent, and the exponents of all three."""
    force = one["force"].to_numpy()
    classical = greenwood_williamson_stiffness(force, float(one["hurst"]), points)
    low = float(force[np.flatnonzero(one["spots"] >= SPOTS)[0]])
    laws = xarray.Dataset({"classical": ("load", classical), "window_low": low, "window_high": HIGHEST})
    # The last is the same fit of a curve that has no samples.
    every = one["stiffness"], one["independent"], laws["classical"].expand_dims("sample")
    for stiffness, prefix in zip(every, ("", "independent_", "classical_"), strict=True):
        curves = {"dimensionless_force": one["force"], "dimensionless_stiffness": stiffness}
        rng = np.random.default_rng(0)
        fit = fit_power_laws(xarray.Dataset(curves), force_window(low, HIGHEST), rng=rng)
        laws[f"{prefix}exponent"], laws[f"{prefix}exponent_error"] = fit["exponent"], fit["exponent_error"]
    return laws.drop_vars("classical_exponent_error").assign_coords(hurst=one["hurst"])


def draw_realisations(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw every realisation of one fractal dimension with interaction, the classical model, and the slope."""
    axes = figure.subplots()
    force = averages["force"].to_numpy()
    # The spots of all surfaces lie in their load's column: a little aside each, so that they can be counted.
    aside = np.exp(np.linspace(-0.35, 0.35, averages.sizes["sample"]) * np.log(force[1] / force[0]))
    every = averages["stiffness"].transpose("sample", "load").to_numpy()
    for curve, shift in zip(every, aside, strict=True):
        axes.plot(force * shift, curve, ".", color=drawing.LINES, markersize=2.2, zorder=2)
    words = f"with interaction, {len(every)} surfaces"
    drawing.key(axes, ".", words, color=drawing.LINES, markersize=5)
    mean = averages["independent"].mean("sample")
    axes.plot(force, mean, "--", color=_CLASSICAL, label="the same summits, independent")
    axes.plot(force, averages["classical"], color=_CLASSICAL, linewidth=1.6, label="Greenwood and Williamson")
    low, high = float(averages["window_low"]), float(averages["window_high"])
    alpha = law_exponent(float(averages["hurst"]))
    middle = np.sqrt(low * high)
    means = averages["stiffness"].mean("sample").to_numpy()
    here = 0.4 * np.exp(np.interp(np.log(middle), np.log(force), np.log(means)))
    x = np.array([low, high])
    axes.plot(x, here * (x / middle) ** alpha, "--", color=_SLOPE, linewidth=2.0, label=f"slope {alpha:.4f}")
    # Up to between the columns of the first force that counts and of the one before.
    axes.axvspan(force[0] * aside[0], low * np.sqrt(force[0] / force[1]), color="0.93", zorder=0)
    words = f"fewer than {SPOTS:g} summits in contact"
    above: Any = {"transform": axes.get_xaxis_transform(), "va": "bottom", "color": "0.3"}
    axes.text(float(force[0] * aside[0]), 1.0, words, fontsize=drawing.TICK, **above)
    drawing.stiffness_axes(axes, xlim=(force[0] * aside[0], force[-1] * aside[-1]))
    drawing.legend_below(axes, 1)


def exponent_words(averages: xarray.Dataset, prefix: str = "") -> str:
    """Return an exponent with its error, and where it was found."""
    error = "" if prefix == "classical_" else f" +- {float(averages[f'{prefix}exponent_error']):.3f}"
    return (
        f"{float(averages[f'{prefix}exponent']):.3f}{error} at forces from {float(averages['window_low']):.1g} to "
        f"{float(averages['window_high']):.2g}"
    )


def linear_model(averages: xarray.Dataset, classical: str = "", independent: str = "") -> Verdict:
    """Return whether the model of Greenwood and Williamson is linear; words may follow what both models find."""
    slope = float(averages["classical_exponent"])
    return Verdict(
        f"the original model is linear, D_f = {3 - float(averages['hurst']):g}",
        "while the original GW model has a qualitatively different behavior (linear).",
        "section 4.6, fig. 31",
        f"{exponent_words(averages, 'classical_')} from the moments of the surfaces{classical}; the summits "
        f"themselves, without interaction, {exponent_words(averages, 'independent_')}{independent}",
        exactly(abs(slope - 1) < NEAR, f"{NEAR:.0%}", f"{slope - 1:+.1%}"),
        "theory",
    )
