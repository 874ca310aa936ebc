"""Figure 25: the exponent at low Hurst exponents against the number of points."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from roughcontact.plot.raster import LABEL, TICK
from roughcontact.thesis.ensembles import curve_fits, resolution_studies
from roughcontact.thesis.line_ensembles import (
    line_averages,
    line_fits,
    line_study,
    resolution_exponent,
    white_exponent,
)
from roughcontact.thesis.stiffness_view import quiet
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "draw", "studies", "verdicts"]

Array = npt.NDArray[np.float64]

TITLE = "exponent at a low Hurst exponent against the number of points"
HURST = -0.5
POINTS = tuple(2**n for n in range(8, 16))
CHOSEN = (
    f"H = {HURST:g}; lines of 2^8 to 2^15 points, 1000 of each; on the small scale to 2^13, 200 of each",
    "fits: more than 20 springs or cells, forces up to 0.07; of fewer points nothing is left of this window",
    "surfaces: those of figure 26",
)
SIZE = (6.2, 4.2)

_LAW, _SIDE, _AREA, _WHITE = "#c8290b", "#009e73", "#8e44ad", "0.45"


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return a study of lines of many lengths, and those of surfaces that figure 26 is made of."""
    lines = line_study(
        "lines-of-figure-25",
        scale,
        table={"points": POINTS[: {"small": 6, "thesis": 8}[scale]]},
        parameters={"hurst": HURST, "lowest_force": 7e-5, "highest_force": 0.07, "loads": 73},
    )
    return (lines, *resolution_studies(scale))


def averages(lines: xarray.Dataset, *surfaces: xarray.Dataset) -> xarray.Dataset:
    """Return the exponents of lines and of surfaces, and what white heights give in the windows of the lines."""
    import xarray

    names = [
        "exponent",
        "exponent_error",
        "exponent_low",
        "exponent_high",
        "window_low",
        "window_high",
        "count",
    ]
    fits = line_fits(lines)
    found = fits[names].assign(white=white_exponent(lines["dimensionless_force"], fits))
    means = line_averages(lines)
    last = means.isel(load=-1)
    found["force"], found["stiffness"], found["stiffness_error"] = (
        last[name] for name in ("force", "stiffness", "stiffness_error")
    )
    parts = [
        curve_fits(each)[names].sel(hurst=HURST).assign_coords(cells=int(each["points"])).drop_vars("points")
        for each in surfaces
    ]
    squares = xarray.concat(parts, "cells", coords="minimal", compat="override")
    # Surfaces without three forces in the window have no exponent.
    return found.merge(
        squares.rename({name: f"surface_{name}" for name in names}), compat="override"
    ).assign_attrs(lines=means.attrs["lines"])


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw exponents against the number of points: of lines, of surfaces in two readings, and eq. 4.73."""
    axes = figure.subplots()
    points = averages["points"].to_numpy().astype(float)
    cells = averages["cells"].to_numpy().astype(float)
    x = np.geomspace(points[0] / 1.5, max(points[-1], cells[-1] ** 2) * 1.5, 200)
    axes.plot(x, [resolution_exponent(n) for n in x], color=_LAW, linewidth=1.4, label="eq. 4.73")
    axes.plot(
        points, averages["white"], ":", color=_WHITE, linewidth=2.0, label="independent Gaussian heights"
    )
    _points(axes, points, averages, "", mark="x", colour="black", words="lines")
    _points(axes, cells, averages, "surface_", mark="P", colour=_SIDE, words="surfaces, N points a side")
    _points(axes, cells**2, averages, "surface_", mark="P", colour=_AREA, words="surfaces, N points in all")
    axes.set_xscale("log", base=2)
    axes.set_xlim(x[0], x[-1])
    axes.set_xlabel("number of points N", fontsize=LABEL)
    axes.set_ylabel(r"exponent $\alpha$ of $k \sim F^{\alpha}$", fontsize=LABEL)
    quiet(axes)
    axes.legend(fontsize=TICK, frameon=False, loc="lower right")


def _points(
    axes: Axes, points: Array, averages: xarray.Dataset, prefix: str, *, mark: str, colour: str, words: str
) -> None:
    y, low, high = (averages[f"{prefix}exponent{end}"].to_numpy() for end in ("", "_low", "_high"))
    errors = np.maximum([y - low, high - y], 0)  # an interval may lie beside a value by a rounding
    axes.errorbar(
        points, y, errors, fmt=mark, color=colour, markersize=5.5, elinewidth=0.9, zorder=3, label=words
    )


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare exponents with eq. 4.73, and say what their growth is."""
    points = averages["points"].to_numpy()
    law = np.array([resolution_exponent(n) for n in points])
    alpha, white = averages["exponent"].to_numpy(), averages["white"].to_numpy()
    stiffness, error = averages["stiffness"].to_numpy(), averages["stiffness_error"].to_numpy()
    spread = np.ptp(stiffness) / stiffness.mean()
    cells = averages["cells"].to_numpy()
    surface, spread_of = (
        averages["surface_exponent"].to_numpy(),
        averages["surface_exponent_error"].to_numpy(),
    )
    side = np.array([resolution_exponent(n) for n in cells])
    area = np.array([resolution_exponent(n**2) for n in cells])
    return (
        Verdict(
            "exponents of lines at low H, fitted above 20 springs, follow eq. 4.73",
            _row(law),
            f"{_row(alpha)} for N = 2^{int(np.log2(points[0]))} to 2^{int(np.log2(points[-1]))}, H = {HURST:g}, "
            f"{averages.attrs['lines']} lines each",
            bool(np.nanmax(np.abs(alpha - law)) < 0.02),
        ),
        Verdict(
            "the number of modes makes the exponent",
            "the density of heights is a power of N, eq. 4.72",
            f"independent Gaussian heights, whose stiffness knows no N, give {_row(white)} in the same windows; "
            f"the stiffness at a force of {float(averages['force']):.2g} is the same for all N to {spread:.1%} "
            f"(errors up to {(error / stiffness).max():.1%})",
            bool(spread > 0.05),
        ),
        Verdict(
            "exponents of surfaces follow the same law, with N points a side or in all",
            f"{_row(side)} or {_row(area)}",
            f"{_row(surface)} for {', '.join(str(n) for n in cells)} points a side, errors up to "
            f"{np.nanmax(spread_of):.3f}, "
            f"H = {HURST:g}",
            bool(min(np.nanmax(np.abs(surface - reading)) for reading in (side, area)) < 0.03),
        ),
    )


def _row(values: Array) -> str:
    return ", ".join(f"{value:.3f}" for value in values)
