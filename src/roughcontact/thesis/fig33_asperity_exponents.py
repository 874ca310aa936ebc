"""Figure 33: conductance of surfaces of several fractal dimensions, and the slopes of eq. 4.31."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import LABEL, TICK
from roughcontact.thesis.asperity_ensembles import CHOSEN as _SHARED
from roughcontact.thesis.asperity_ensembles import asperity_averages, law_exponent
from roughcontact.thesis.asperity_view import studies
from roughcontact.thesis.stiffness_view import hurst_colours, quiet, stiffness_axes
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure


__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "interacting asperities of surfaces of several fractal dimensions"
HURST = (0.1, 0.3, 0.5, 0.7, 0.9)
CHOSEN = (*_SHARED, "D_f = 2.1, 2.3, 2.5, 2.7, 2.9; means over 25 surfaces, on the small scale 8")
SIZE = (7.4, 4.0)


def averages(asperities: xarray.Dataset) -> xarray.Dataset:
    """Return mean stiffnesses and power laws."""
    found = asperity_averages(asperities.sel(hurst=list(HURST)))
    found["samples"] = found.sizes["sample"]
    # The realisations themselves are shown in figures 31 and 32.
    for name in ("stiffness", "independent"):
        found[name] = found[name].mean("sample", keep_attrs=True)
    return found.drop_vars("sample", errors="ignore")


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the mean stiffness for each fractal dimension with its slope (a), and the exponents (b)."""
    left, right = figure.subplots(1, 2, width_ratios=(1.5, 1))
    colours = hurst_colours(min(HURST), max(HURST))
    _curves(left, averages, colours)
    _exponents(right, averages, colours)
    for letter, axes in zip("ab", (left, right), strict=True):
        axes.set_title(f"({letter})", fontsize=LABEL, loc="left")


def _curves(axes: Axes, averages: xarray.Dataset, colours: ScalarMappable) -> None:
    stiffness_axes(axes)
    force = averages["force"].to_numpy()
    for each in averages["hurst"].to_numpy()[::-1]:
        one, colour = averages.sel(hurst=each), colours.to_rgba(each)
        stiffness, low = one["stiffness"].to_numpy(), float(one["window_low"])
        seen = force >= low
        axes.plot(force, stiffness, color=colour, linewidth=1.0, alpha=0.35)
        axes.plot(force[seen], stiffness[seen], "o-", color=colour, markersize=3, linewidth=1.2)
        axes.plot([], [], "o-", color=colour, markersize=3, linewidth=1.2, label=f"$D_f$ = {3 - each:.1f}")
        x = np.array([low, float(one["window_high"])])
        law = stiffness[seen][0] * (x / x[0]) ** law_exponent(float(each))
        axes.plot(x, law, "--", color=colour, linewidth=1.3, zorder=4)
    axes.plot([], [], "--", color="0.3", linewidth=1.3, label=r"slopes $1/(4 - D_f)$")
    axes.legend(fontsize=TICK, frameon=False, loc="lower right")


def _exponents(axes: Axes, averages: xarray.Dataset, colours: ScalarMappable) -> None:
    dimension = 3 - averages["hurst"].to_numpy()
    every = zip(dimension, averages["exponent"].values, averages["exponent_error"].values, strict=True)
    for x, y, error in every:
        axes.errorbar(x, y, 2 * error, fmt="o", color=colours.to_rgba(3 - x), markersize=4.5, capsize=2.5)
    x = np.linspace(2.05, 2.95, 100)
    axes.plot(x, 1 / (4 - x), "--", color="0.3", linewidth=1.3, zorder=1, label=r"$1/(4 - D_f)$")
    axes.set_xlabel("fractal dimension $D_f$", fontsize=LABEL)
    axes.set_ylabel("exponent, with two standard errors", fontsize=LABEL)
    quiet(axes)
    axes.legend(fontsize=TICK, frameon=False, loc="upper left")


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare the exponents."""
    exponents = averages["exponent"].to_numpy()
    laws = np.array([law_exponent(float(each)) for each in averages["hurst"]])
    errors = averages["exponent_error"].to_numpy()
    return (
        Verdict(
            "for small forces a power law with an exponent close to 1/(4 - D_f)",
            f"{_row(laws)} for D_f = {_row(3 - averages['hurst'].to_numpy(), 1)}",
            f"{_row(exponents)}, each +-{errors.max():.3f} or less, from {int(averages['samples'])} surfaces; the "
            "law is too steep where H is low",
            bool(np.abs(exponents - laws).max() < 0.05),
        ),
    )


def _row(values: np.typing.NDArray[np.float64], digits: int = 3) -> str:
    return ", ".join(f"{value:.{digits}f}" for value in values)
