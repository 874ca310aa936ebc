"""Figure 32: independent and interacting asperities of a surface with D_f = 2.95, and the slope of eq. 4.31."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.thesis.asperity_ensembles import CHOSEN as _SHARED
from roughcontact.thesis.asperity_ensembles import asperity_averages, asperity_study, law_exponent
from roughcontact.thesis.asperity_view import draw_one, words_of
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "asperities with and without interaction, D_f = 2.95"
HURST = 0.05
CHOSEN = (*_SHARED, "25 surfaces, on the small scale 8, all shown")
SIZE = (5.8, 4.4)


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the study of asperities that figures 31 to 33 share."""
    return (asperity_study(scale),)


def averages(asperities: xarray.Dataset) -> xarray.Dataset:
    """Return every realisation of this fractal dimension, with means and power laws."""
    return asperity_averages(asperities.sel(hurst=[HURST])).isel(hurst=0)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw every realisation with interaction, the classical model, and the slope."""
    draw_one(figure, averages)


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare the slopes of both models."""
    exponent, error = float(averages["exponent"]), float(averages["exponent_error"])
    return (
        Verdict(
            "for D_f = 2.95 the slope of eq. 4.31 is too steep for interacting asperities",
            f"slightly below 1/(4 - D_f) = {law_exponent(HURST):.4f}",
            f"{words_of(averages)}, {averages.sizes['sample']} surfaces",
            exponent + 2 * error < law_exponent(HURST),
        ),
        Verdict(
            "the original model is linear",
            "slope 1",
            f"{words_of(averages, 'classical_')} from the moments of the surfaces; the summits themselves, without "
            f"interaction, {words_of(averages, 'independent_')}",
            float(averages["classical_exponent"]) > 0.85,
        ),
    )
