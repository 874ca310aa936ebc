"""Figure 25: the exponent at low Hurst exponents against the number of points."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact_thesis import drawing, line_ensembles
from roughcontact_thesis.ensembles import curve_fits, resolution_studies
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.line_ensembles import resolution_exponent
from roughcontact_thesis.ruling import ruled
from roughcontact_thesis.verdict import Verdict, Verdicts, series

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "exponent at a low Hurst exponent against the number of points"
HURST = -0.5
NEAR = 0.03  # of an exponent: half of what N changes between 2^8 and 2^15
POINTS = tuple(2**n for n in range(8, 16))
CHOSEN = (
    f"H = {HURST:g}; lines of 2^8 to 2^15 points, 1000 of each; on the small scale to 2^13, 200 of each",
    "fits: more than 20 springs or cells, forces up to 0.07; of fewer points nothing is left of this window",
    "surfaces: those of figure 26",
)
SIZE = (drawing.COLUMN, 3.6)

_LAW, _SIDE, _AREA, _WHITE = "#c8290b", "#009e73", "#8e44ad", "0.45"


def studies(scale: Scale) -> Studies:
    """Return a study of lines of many lengths, and those of surfaces that figure 26 is made of."""
    table = {"points": POINTS[: {"small": 6, "thesis": 8}[scale]]}
    lines = line_ensembles.line_study(
        "lines-of-figure-25", scale, table, hurst=HURST, lowest_force=7e-5, highest_force=0.07, loads=73
    )
    return (lines, *resolution_studies(scale))


def averages(lines: xarray.Dataset, *surfaces: xarray.Dataset) -> xarray.Dataset:
    """Return the exponents of lines and of surfaces, and what white heights give in the windows of the lines."""
    found = line_ensembles.fits_beside_white(lines)
    means = line_ensembles.line_averages(lines)
    last = means.isel(load=-1)
    found = found.assign(last[["force", "stiffness", "stiffness_error"]].data_vars)
    # Surfaces without three forces in the window have no exponent.
    parts = [curve_fits(each)[list(line_ensembles.WINDOWED)].sel(hurst=HURST) for each in surfaces]
    parts = [each.assign_coords(cells=int(each["points"])).drop_vars("points") for each in parts]
    squares = xarray.concat(parts, "cells", coords="minimal", compat="override")
    named = squares.rename({name: f"surface_{name}" for name in line_ensembles.WINDOWED})
    return found.merge(named, compat="override").assign_attrs(lines=means.attrs["lines"])


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw exponents against the number of points: of lines, of surfaces in two readings, and eq. 4.73."""
    axes = figure.subplots()
    points, cells = (averages[name].to_numpy().astype(float) for name in ("points", "cells"))
    x = np.geomspace(points[0] / 1.5, max(points[-1], cells[-1] ** 2) * 1.5, 200)
    axes.plot(x, [resolution_exponent(n) for n in x], color=_LAW, label="eq. 4.73")
    white = averages["white"]
    axes.plot(points, white, ":", color=_WHITE, linewidth=2.0, label="independent Gaussian heights")
    for places, name, style, words in (
        (points, "exponent", {"fmt": "x", "color": "black"}, "lines"),
        (cells, "surface_exponent", {"fmt": "P", "color": _SIDE}, "surfaces, N points a side"),
        (cells**2, "surface_exponent", {"fmt": "P", "color": _AREA}, "surfaces, N points in all"),
    ):
        drawing.with_intervals(axes, places, averages, name, markersize=5.5, label=words, **style)
    axes.set_xscale("log", base=2)
    drawing.label(axes, "number of points N", drawing.EXPONENT, xlim=(x[0], x[-1]))
    drawing.legend_below(axes)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare exponents with eq. 4.73, and say what their growth is."""
    points, cells = averages["points"], averages["cells"]
    law = xarray.DataArray([resolution_exponent(n) for n in points.to_numpy()], dims="points")
    readings = [
        xarray.DataArray([resolution_exponent(n**power) for n in cells.to_numpy()], {"cells": cells}, "cells")
        for power in (1, 2)
    ]
    surface, uncertain = (averages[f"surface_exponent{end}"] for end in ("", "_error"))
    relative = averages["stiffness_error"] / averages["stiffness"]
    spread = float(np.ptp(averages["stiffness"].to_numpy()) / averages["stiffness"].mean())
    nearest = min(readings, key=lambda reading: float(abs(surface - reading).max()))
    yield Verdict(
        "exponents of lines at low H grow with the number of points by eq. 4.73",
        "α = (β + 1)/(β + 2) = (1 + log2(N))/(3 + log2(N))",
        "section 4.5.2, eq. 4.73",
        f"{series(averages['exponent'])} for N = 2^{int(np.log2(points[0]))} to 2^{int(np.log2(points[-1]))}, "
        f"{series(law)} by the law, H = {HURST:g}, {averages.attrs['lines']} lines each. Its cause is another: "
        f"independent Gaussian heights, whose stiffness does not depend on N, give {series(averages['white'])} in "
        f"the same windows, and at a force of {float(averages['force']):.2g} the stiffness is the same for all N to "
        f"{spread:.1%} "
        f"(errors up to {float(relative.max()):.1%})",
        ruled(averages["exponent"] - law, averages["exponent_error"], NEAR, "+.3f"),
    )
    yield Verdict(
        "exponents of surfaces grow likewise with the number of cells",
        "A similar dependency can be found in 3 dimensions [...] N can be interpreted in two different ways",
        "section 4.5.2, fig. 25",
        f"{series(surface)} for {', '.join(str(n) for n in cells.to_numpy())} points a side, errors up to "
        f"{float(uncertain.max()):.3f}, H = {HURST:g}; eq. 4.73 has {series(readings[0])} with N points a side, "
        f"{series(readings[1])} with N in all",
        ruled(surface - nearest, uncertain, NEAR, "+.3f"),
    )
