"""Figure 26: the exponent for low Hurst exponents on several numbers of cells."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.statistics.common_forces import on_common
from roughcontact.statistics.fit_window import force_window
from roughcontact_thesis import drawing
from roughcontact_thesis.averaging import without_parameters
from roughcontact_thesis.ensembles import curve_averages, curve_fits, resolution_studies
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import Ruling, ruled
from roughcontact_thesis.verdict import Verdict, Verdicts, series

__all__ = ["averages", "draw", "grown", "studies", "verdicts"]

TITLE = "exponent of the stiffness for low Hurst exponents on several numbers of cells"
COMMON = (0.025, 0.07)  # forces at which 257 x 257 cells are resolved for all H below 0.2
FORCE = 0.07
NEAR = 0.03  # of exponents: what counts as no difference
CHOSEN = (
    "free squares of 257 x 257, 513 x 513 (500 samples each) and 1025 x 1025 cells (200; small: two sizes, 20)",
    "filled: the window of figure 27, mean stiffness above 20 cells, forces F/(E* h L) up to 0.07: the finer the grid "
    "the lower it begins",
    f"open: one window for all, forces from {COMMON[0]:g} to {COMMON[1]:g}",
    "bars: 95 % of resampled ensembles",
)
SIZE = (drawing.COLUMN, 3.7)

_STYLES = (("#0072b2", "o"), ("#009e73", "s"), ("#d55e00", "^"))
_BOTH = ("exponent", "common_exponent")
_FITS = ("exponent", "exponent_error", "exponent_low", "exponent_high", "window_low", "count", "samples")


def studies(scale: Scale) -> Studies:
    """Return one study for each number of cells."""
    return resolution_studies(scale)


def averages(*squares: xarray.Dataset) -> xarray.Dataset:
    """Return exponents in the window of each grid and, named ``common_...``, in one window, and stiffnesses."""
    parts = []
    for each in squares:
        own = curve_fits(each)[list(_FITS)]
        common = curve_fits(each, window=force_window(*COMMON))[list(_FITS)]
        at = on_common(curve_averages(each), [FORCE], at="force").isel(force=0, drop=True)
        part = own.assign({f"common_{name}": values for name, values in common.items()})
        part = part.assign(at[["stiffness", "stiffness_error"]].data_vars)
        parts.append(without_parameters(part).expand_dims(points=[int(each["points"])]))
    return xarray.concat(parts, "points", combine_attrs="drop")


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the exponents, filled in the window of each grid and open in the common one."""
    axes = figure.subplots()
    hurst, grids = averages["hurst"].to_numpy(), averages["points"].to_numpy()
    for place, (points, (colour, mark)) in enumerate(zip(grids, _STYLES, strict=False)):
        one = averages.sel(points=points)
        # Side by side, so that bars do not cover each other.
        x = hurst + 0.012 * (place - (len(grids) - 1) / 2)
        words = f"{points}² cells, from {float(one['window_low'].mean()):.2g}"
        given: Any = {"color": colour, "markersize": 4.5, "linewidth": 1.0}
        drawing.with_intervals(axes, x, one, "exponent", fmt=f"{mark}-", label=words, **given)
        given |= {"fmt": f"{mark}:", "markerfacecolor": "white"}
        drawing.with_intervals(axes, x, one, "common_exponent", **given)
    drawing.key(axes, "o:", f"one window, from {COMMON[0]:g}", color="0.4", markerfacecolor="white")
    x = np.linspace(-0.02, hurst[-1] + 0.05, 50)
    axes.plot(x, 1 / (x + 1), "--", color="black", label="1/(H + 1)")
    lowest = float(min(averages["exponent_low"].min(), averages["common_exponent_low"].min()))
    drawing.hurst_axes(axes, hurst, drawing.EXPONENT, ylim=(lowest - 0.02, 1.02))
    drawing.legend_below(axes, title="cells, window in force")


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Say whether the exponent depends on the number of cells, in windows of each grid and in a common one."""
    # One surface of a grid is no mean, and has no error to be judged by.
    averages = averages.isel(points=averages["samples"][:, 0].to_numpy() > 1)
    low = averages.sel(hurst=slice(None, -0.2))
    flat = low["exponent"] - low["exponent"].mean("hurst")
    samples = zip(averages["samples"].values[:, 0], averages["points"].values, strict=True)
    counts = ", ".join(f"{int(n)} of {points}²" for n, points in samples)
    grid = low["stiffness"].isel(points=-1) / low["stiffness"].isel(points=0) - 1
    yield Verdict(
        "alpha of surfaces depends on the number of cells at low H",
        "dependency of the exponent α for low H on the system size.",
        "section 4.5.2, fig. 26",
        f"{_means(low['exponent'])} on {_sizes(averages)} cells for H < -0.2, each in the window above its 20 cells, "
        f"errors about {float(low['exponent_error'].mean()):.3f}; surfaces a value: {counts}",
        _grown(low["exponent"], low["exponent_error"]),
    )
    yield Verdict(
        "it depends on the number of scales, not on the forces of the fit",
        "in the case of H smaller than approx. 0, depends on the number of scales for which the fractal power-spectrum "
        "holds.",
        "chapter 6",
        f"{_means(low['common_exponent'])} where all are fitted between {COMMON[0]:g} and {COMMON[1]:g}, errors about "
        f"{float(low['common_exponent_error'].mean()):.3f}; stiffness at {FORCE:g} on the finest grid "
        f"{float(grid.mean()):+.1%} from the coarsest",
        _grown(low["common_exponent"], low["common_exponent_error"]),
    )
    yield Verdict(
        "a constant exponent of surfaces below H = 0",
        "starting from a constant value for H < 0",
        "section 4.5.2, of fig. 23",
        f"the same within {float(abs(flat).max()):.3f} from H = {float(low['hurst'][0]):g} to "
        f"{float(low['hurst'][-1]):g} on each grid",
        # Values share their phases: the error of a difference is at most the sum of both.
        ruled(flat, low["exponent_error"] + low["exponent_error"].max("hurst"), NEAR, "+.3f"),
    )


def findings(averages: xarray.Dataset) -> str:
    """Return in a sentence what the exponent at low H depends on."""
    low = averages.sel(hurst=slice(None, -0.2))
    apart = [float((low[name].isel(points=-1) - low[name].isel(points=0)).mean()) for name in _BOTH]
    first, last = (low["common_exponent_error"].isel(points=end).to_numpy() for end in (0, -1))
    error = float(np.hypot(first, last).mean())
    mostly = (
        ": most of the change is due to the window of the fit" if 2 * abs(apart[1]) < abs(apart[0]) else ""
    )
    grids = averages["points"].to_numpy()
    return (
        f"Below H = 0 no such law is expected. From {grids[0]}² to {grids[-1]}² cells, the fitted exponent grows by "
        f"{apart[0]:.3f} if each grid is fitted down to the stiffness of 20 of its cells, and by {apart[1]:.3f} ± "
        f"{error:.3f} if all are fitted between the same forces{mostly}."
    )


def _means(exponents: xarray.DataArray) -> str:
    return series(exponents.mean("hurst"))


def _sizes(averages: xarray.Dataset) -> str:
    return ", ".join(f"{points}²" for points in averages["points"].to_numpy())


def _grown(exponents: xarray.DataArray, errors: xarray.DataArray) -> Ruling:
    """Return whether the exponent is another on the finest grid than on the coarsest."""
    apart = float((exponents.isel(points=-1) - exponents.isel(points=0)).mean())
    # Samples are paired over H: the error of the mean is at most the mean of the errors.
    return grown(apart, float(np.hypot(errors.isel(points=-1), errors.isel(points=0)).mean()))


def grown(apart: float, error: float) -> Ruling:
    """Return whether two exponents that are `apart` are different."""
    told, words = f"{apart:+.3f} ± {error:.3f}", f"a difference; none below {NEAR:g}"
    if abs(apart) > 3 * error:
        return Ruling("holds", words, trigger=told)
    return Ruling("does not hold" if abs(apart) + 2 * error < NEAR else "not decided", words, trigger=told)
