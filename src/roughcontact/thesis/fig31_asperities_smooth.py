"""Figure 31: independent and interacting asperities of a surface with D_f = 2.05, and the slope of eq. 4.31."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.thesis.asperity_ensembles import law_exponent
from roughcontact.thesis.asperity_view import CHOSEN, SIZE, averages_of, draw, linear, studies, words_of
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    import xarray

__all__ = ["CHOSEN", "SIZE", "averages", "draw", "studies", "verdicts"]

TITLE = "asperities with and without interaction, D_f = 2.05"
HURST = 0.95


def averages(asperities: xarray.Dataset) -> xarray.Dataset:
    """Return every realisation of this fractal dimension, with means and power laws."""
    return averages_of(asperities, HURST)


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare the slopes of both models."""
    exponent = float(averages["exponent"])
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
        linear(
            averages,
            f"{words_of(averages, 'classical_')} from the moments of the surfaces (a little below 1, as Gaussian "
            f"heights are); the summits themselves, without interaction, {words_of(averages, 'independent_')}: the "
            "highest ones of a surface whose longest wave is its own size are no population",
        ),
    )
