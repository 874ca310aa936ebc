"""Figure 31: independent and interacting asperities of a surface with D_f = 2.05, and the slope of eq. 4.31."""

from __future__ import annotations

import xarray

from roughcontact.thesis import asperity_ensembles
from roughcontact.thesis.asperity_ensembles import draw_realisations as draw, studies
from roughcontact.thesis.verdict import Verdict, Verdicts, spanned

__all__ = ["CHOSEN", "averages", "draw", "studies", "verdicts"]

TITLE = "asperities with and without interaction, D_f = 2.05"
HURST = 0.95
CHOSEN = (*asperity_ensembles.CHOSEN, "25 surfaces, on the small scale 8, all shown")
SIZE = (5.8, 4.4)


def averages(asperities: xarray.Dataset) -> xarray.Dataset:
    """Return every realisation of this fractal dimension, with means and power laws."""
    return asperity_ensembles.asperity_averages(asperities.sel(hurst=[HURST])).isel(hurst=0)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the slopes of both models."""
    exponent, law = float(averages["exponent"]), asperity_ensembles.law_exponent(HURST)
    inside = (averages["force"] >= averages["window_low"]) & (averages["force"] <= averages["window_high"])
    merged = averages["merged"].where(inside, drop=True)
    yield Verdict(
        "interacting asperities of D_f = 2.05 have the slope of eq. 4.31",
        f"1/(4 - D_f) = {law:.4f}",
        f"{asperity_ensembles.exponent_words(averages)}, {averages.sizes['sample']} surfaces; there "
        f"{spanned(merged, '.0%')} of the spots overlap others, which the model does not know",
        abs(exponent - law) < 0.05,
    )
    yield asperity_ensembles.linear_model(
        averages,
        " (a little below 1, as Gaussian heights are)",
        ": the highest ones of a surface whose longest wave is its own size are no population",
    )
