"""Figure 32: independent and interacting asperities of a surface with D_f = 2.95, and the slope of eq. 4.31."""

from __future__ import annotations

import xarray

from roughcontact_thesis import asperity_ensembles
from roughcontact_thesis.asperity_ensembles import draw_realisations as draw, studies
from roughcontact_thesis.fig31_asperities_smooth import CHOSEN, SIZE
from roughcontact_thesis.ruling import exceeds, undecided
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["CHOSEN", "SIZE", "averages", "draw", "studies", "verdicts"]

TITLE = "asperities with and without interaction, D_f = 2.95"
HURST = 0.05


def averages(asperities: xarray.Dataset) -> xarray.Dataset:
    """Return every realisation of this fractal dimension, with means and power laws."""
    return asperity_ensembles.asperity_averages(asperities.sel(hurst=[HURST])).isel(hurst=0)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the slopes of both models."""
    exponent, error = float(averages["exponent"]), float(averages["exponent_error"])
    law = asperity_ensembles.law_exponent(HURST)
    yield Verdict(
        "for D_f = 2.95 the slope 1/(4 - D_f) is too steep",
        "The slope is slightly overestimated, due to the resolution dependence for low H, see fig. 25.",
        "section 4.6, fig. 32",
        f"{asperity_ensembles.exponent_words(averages)}, the law {law:.3f}, {averages.sizes['sample']} surfaces",
        exceeds(law - exponent, error, 0.0, "+.3f", "a lower slope"),
        "theory",
    )
    yield Verdict(
        "it is too steep because of the resolution",
        "is clear that by using 1/(H + 1), I overestimate the power by not taking into account the resolution "
        "dependence, see fig. 25.",
        "section 4.6, of fig. 32",
        "one number of points",
        undecided("one number of points", "what is missing at H = 0, on ever finer grids"),
        "theory",
    )
    yield asperity_ensembles.linear_model(averages)
