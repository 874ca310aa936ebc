"""Figure 31: independent and interacting asperities of a surface with D_f = 2.05, and the slope of eq. 4.31."""

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

TITLE = "asperities with and without interaction, D_f = 2.05"
HURST = 0.95
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
    exponent = float(averages["exponent"])
    classical = float(averages["classical_exponent"])
    inside = (averages["force"] >= averages["window_low"]) & (averages["force"] <= averages["window_high"])
    merged = averages["merged"].where(inside, drop=True)
    return (
        Verdict(
            "interacting asperities of D_f = 2.05 have the slope of eq. 4.31",
            f"1/(4 - D_f) = {law_exponent(HURST):.4f}",
            f"{words_of(averages)}, {averages.sizes['sample']} surfaces; there {float(merged.min()):.0%} to "
            f"{float(merged.max()):.0%} of the spots overlap others, which the model does not know",
            abs(exponent - law_exponent(HURST)) < 0.05,
        ),
        Verdict(
            "the original model is linear",
            "slope 1",
            f"{words_of(averages, 'classical_')} from the moments of the surfaces (a little below 1, as Gaussian "
            f"heights are); the summits themselves, without interaction, {words_of(averages, 'independent_')}: the "
            "highest ones of a surface whose longest wave is its own size are no population",
            classical > 0.85,
        ),
    )
