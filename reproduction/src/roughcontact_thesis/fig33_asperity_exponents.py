"""Figure 33: conductance of surfaces of several fractal dimensions, and the slopes of eq. 4.31."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.statistics.samples import standard_error
from roughcontact_thesis import drawing
from roughcontact_thesis.asperity_ensembles import (
    CHOSEN as SHARED,
    NEAR,
    asperity_averages,
    law_exponent,
    studies,
)
from roughcontact_thesis.ruling import exceeds, ruled
from roughcontact_thesis.verdict import Verdict, Verdicts, series

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "interacting asperities of surfaces of several fractal dimensions"
HURST = (0.1, 0.3, 0.5, 0.7, 0.9)
CHOSEN = (*SHARED, "D_f = 2.1, 2.3, 2.5, 2.7, 2.9; means over 25 surfaces, on the small scale 8")
SIZE = (drawing.PAGE, 3.6)


def averages(asperities: xarray.Dataset) -> xarray.Dataset:
    """Return mean stiffnesses and power laws."""
    found = asperity_averages(asperities.sel(hurst=list(HURST)))
    found["samples"] = found.sizes["sample"]
    # The realisations themselves are shown in figures 31 and 32.
    found["stiffness_error"] = standard_error(found["stiffness"])
    for name in ("stiffness", "independent"):
        found[name] = found[name].mean("sample", keep_attrs=True)
    return found.drop_vars("sample", errors="ignore")


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the mean stiffness for each fractal dimension with its slope (a), and the exponents (b)."""
    left, right = drawing.panels(figure, 1, 2, width_ratios=(1.5, 1))
    force = averages["force"].to_numpy()
    for hurst, one, colour in reversed([*drawing.by_hurst(averages)]):
        stiffness, low = one["stiffness"].to_numpy(), float(one["window_low"])
        seen = force >= low
        left.plot(force, stiffness, color=colour, linewidth=1.0, alpha=0.5)
        words = f"$D_f$ = {3 - hurst:.1f}"
        shown = one.isel(load=np.flatnonzero(seen))
        drawing.with_errors(left, shown, "stiffness", fmt="o-", color=colour, markersize=3, label=words)
        x = np.array([low, float(one["window_high"])])
        law = stiffness[seen][0] * (x / x[0]) ** law_exponent(hurst)
        left.plot(x, law, "--", color=colour, zorder=4)
        error = 2 * one["exponent_error"]
        right.errorbar(3 - hurst, one["exponent"], error, fmt="o", color=colour, capsize=2.5)
    drawing.key(left, "--", r"slopes $1/(4 - D_f)$")
    drawing.stiffness_axes(left)
    left.legend(loc="lower right")
    x = np.linspace(2.05, 2.95, 100)
    right.plot(x, 1 / (4 - x), "--", color="0.3", zorder=1, label=r"$1/(4 - D_f)$")
    drawing.label(right, "fractal dimension $D_f$", "exponent, with two standard errors")
    right.legend(loc="upper left")


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the exponents with 1/(4 - D_f), and those without interaction with what others found."""
    exponents, hurst = averages["exponent"], averages["hurst"]
    law = 1 / (1 + hurst)
    yield Verdict(
        "for small forces interacting asperities have an exponent close to 1/(4 - D_f)",
        "For small forces, a power-law is observed with an exponent close to the analytical prediction.",
        "section 4.6, fig. 33",
        f"{series(exponents)} for D_f = {series(3 - hurst, '.1f')}, the law {series(law)}, each ± "
        f"{float(averages['exponent_error'].max()):.3f} or less, from {int(averages['samples'])} surfaces",
        ruled(exponents / law - 1, averages["exponent_error"] / law, NEAR),
        "theory",
    )
    smooth, rough = (averages.isel(hurst=place) for place in (-1, 0))
    yield Verdict(
        "with interaction the law is less linear for H near 1 than for H near 0",
        "The nonlinearity was discovered to be more pronounced for H ≈ 1 than for H ≈ 0.",
        "section 4.6, of figs 31 and 32",
        f"exponents {float(smooth['exponent']):.3f} at H = {float(smooth['hurst']):g} and "
        f"{float(rough['exponent']):.3f} at H = {float(rough['hurst']):g}",
        exceeds(
            float(rough["exponent"] - smooth["exponent"]),
            float(rough["exponent_error"] + smooth["exponent_error"]),
            0.0,
            "+.3f",
            "a lower exponent near 1",
        ),
        "theory",
    )
    alone, error = averages["independent_exponent"], averages["independent_exponent_error"]
    yield Verdict(
        "models without interaction are power laws with exponents of 0.8 to 0.9",
        "the force-stiffness-relation is found to be a power-law k_N ∝ F_N^α with the power α between 0.8 and 0.9.",
        "section 3.1, eq. 3.10",
        f"the same summits without interaction {series(alone)} for D_f = {series(3 - hurst, '.1f')}; by Greenwood and "
        f"Williamson, from moments, {series(averages['classical_exponent'])}",
        ruled(alone - 0.85, error, 0.05, "+.3f"),
        "theory",
    )
