"""Figure 32: independent and interacting asperities of a surface with D_f = 2.95, and the slope of eq. 4.31."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.thesis.asperity_ensembles import law_exponent
from roughcontact.thesis.asperity_view import CHOSEN, SIZE, averages_of, draw, linear, studies, words_of
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    import xarray

__all__ = ["CHOSEN", "SIZE", "averages", "draw", "studies", "verdicts"]

TITLE = "asperities with and without interaction, D_f = 2.95"
HURST = 0.05


def averages(asperities: xarray.Dataset) -> xarray.Dataset:
    """Return every realisation of this fractal dimension, with means and power laws."""
    return averages_of(asperities, HURST)


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
        linear(
            averages,
            f"{words_of(averages, 'classical_')} from the moments of the surfaces; the summits themselves, without "
            f"interaction, {words_of(averages, 'independent_')}",
        ),
    )
