"""Figure 31: independent and interacting asperities of a surface with D_f = 2.05, and the slope of eq. 4.31."""

from __future__ import annotations

import numpy as np
import xarray
from scipy.integrate import quad

from roughcontact_thesis import asperity_ensembles, drawing
from roughcontact_thesis.asperity_ensembles import draw_realisations as draw, studies
from roughcontact_thesis.ruling import exactly, ruled
from roughcontact_thesis.verdict import Verdict, Verdicts, spanned

__all__ = ["CHOSEN", "averages", "draw", "studies", "verdicts"]

TITLE = "asperities with and without interaction, D_f = 2.05"
HURST = 0.95
CHOSEN = (*asperity_ensembles.CHOSEN, "25 surfaces, on the small scale 8, all shown")
SIZE = (drawing.COLUMN, 3.7)


def averages(asperities: xarray.Dataset) -> xarray.Dataset:
    """Return every realisation of this fractal dimension, with means and power laws."""
    return asperity_ensembles.asperity_averages(asperities.sel(hurst=[HURST])).isel(hurst=0)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the slopes of both models, and the law that stands behind the linear one."""
    law = asperity_ensembles.law_exponent(HURST)
    inside = (averages["force"] >= averages["window_low"]) & (averages["force"] <= averages["window_high"])
    merged = averages["merged"].where(inside, drop=True)
    yield Verdict(
        "interacting asperities of D_f = 2.05 have the slope 1/(4 - D_f)",
        "Very good agreement between the improved discrete GW model and the corresponding slope from eq. 4.31 can be "
        "found",
        "section 4.6, fig. 31",
        f"{asperity_ensembles.exponent_words(averages)}, the law {law:.3f}, {averages.sizes['sample']} surfaces; there "
        f"{spanned(merged, '.0%')} of the spots overlap others, which the model does not know",
        ruled(averages["exponent"] / law - 1, averages["exponent_error"] / law, asperity_ensembles.NEAR),
        "theory",
    )
    yield asperity_ensembles.linear_model(
        averages,
        " (a little below 1, as Gaussian heights are)",
        ": the highest ones of a surface whose longest wave is its own size are no population",
    )
    yield _exponential_heights()


def _exponential_heights() -> Verdict:
    """Return k/F of springs F = d^beta with exponential heights, for any beta and plane above the lowest (eq. 3.9)."""
    off = 0.0
    for beta in (0.5, 1.5, 3.0):
        for plane in (0.0, 1.0, 4.0):
            force = quad(lambda z, p=plane, b=beta: np.exp(-z) * (z - p) ** b, plane, np.inf)[0]
            step = 1e-4
            further = quad(lambda z, p=plane + step, b=beta: np.exp(-z) * (z - p) ** b, plane + step, np.inf)[
                0
            ]
            off = max(off, abs(np.log(force / further) / step - 1))
    return Verdict(
        "springs of any power with exponential heights have k = lambda F",
        "This relation is universally true for all nonlinear springs as defined in eq. 3.2 with Real(β) > -1.",
        "section 3.1, eq. 3.9",
        f"k/(lambda F) within {off:.0e} of 1 for beta = 0.5, 1.5, 3, while the plane stands above the lowest spring",
        exactly(off < 1e-5, "1e-5, of quadrature"),
        "theory",
    )
