"""The rough lines that figures 18, 23 and 27 to 30 stand on, run once for all of them, and what they say together."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray

from roughcontact.statistics.ensemble_mean import Mean
from roughcontact.statistics.fit import fit_power_laws
from roughcontact.statistics.fit_window import Window, resolved_window
from roughcontact.study.ranges import Range
from roughcontact.study.study import Study
from roughcontact.theory.springs import gaussian_heights
from roughcontact_thesis.averaging import curve_statistics
from roughcontact_thesis.figures import Scale, Studies

__all__ = [
    "HURST",
    "POINTS",
    "WINDOWED",
    "each_line",
    "fits_beside_white",
    "line_averages",
    "line_fits",
    "line_studies",
    "line_study",
    "resolution_exponent",
    "white_exponent",
]

HURST = Range(start=-0.95, stop=2.95, step=0.15)  # from -0.5 on the 24 values of the boundary elements
POINTS = (2**9, 2**11, 2**13)
LINES = 50  # a sample
WINDOWED = (
    *("exponent", "exponent_error", "exponent_low", "exponent_high"),
    *("window_low", "window_high", "count"),
)
"""Of a fit: its exponent, and the window that it was found in."""


def line_studies(scale: Scale) -> Studies:
    """Return the one study of rough lines: 27 Hurst exponents, three numbers of points, 1000 lines of each."""
    return (line_study("lines", scale, {"points": POINTS, "hurst": HURST}),)


def line_study(
    name: str, scale: Scale, table: dict[str, Any], *, lines: int = 1000, **parameters: Any
) -> Study:
    """Return a study of rough lines: that many of every combination, on the small scale a fifth."""
    if scale == "small":
        name, lines = f"{name}-small", lines // 5
    every = {"lines": LINES} | parameters
    return Study(name=name, case="lines", samples=lines // LINES, parameters=every, table=table)


def each_line(exported: xarray.Dataset) -> xarray.Dataset:
    """Return what a study of lines exports with every line as a sample, as the statistics of a study want it."""
    stacked = exported["dimensionless_stiffness"].stack(one=("sample", "line"))
    lines = stacked.drop_vars(["one", "sample", "line"]).rename(one="sample")
    force = exported["dimensionless_force"]
    return xarray.Dataset({"dimensionless_force": force, "dimensionless_stiffness": lines})


def line_averages(exported: xarray.Dataset) -> xarray.Dataset:
    """Return the mean stiffness of lines, its standard error and its scatter at every force.

    Parameters
    ----------
    exported : Dataset
        Of `line_studies`, or of another `line_study`.

    Returns
    -------
    Dataset
        ``force`` F/(E* h L) along ``load``; ``stiffness`` k/(E* L), ``stiffness_error`` and ``scatter`` along ``load``
        and what varies in the study. How many lines there are is an attribute.
    """
    lines = each_line(exported)
    averaged = curve_statistics(lines["dimensionless_force"], lines["dimensionless_stiffness"])
    return averaged.assign_attrs(lines=lines.sizes["sample"])


def line_fits(
    exported: xarray.Dataset, *, window: Window | None = None, mean: Mean = "arithmetic"
) -> xarray.Dataset:
    """Return the power laws of the mean stiffness of lines, with intervals; see `fit_power_laws`.

    Parameters
    ----------
    exported : Dataset
        See `line_averages`.
    window : Window, optional
        Without: where more than 20 springs and fewer than 90 % of all carry load, up to a force of 0.07.
    mean : {"arithmetic", "geometric"}
        Which mean over the lines.
    """
    if window is None:
        window = resolved_window(1 / exported["points"], 1.0)
    return fit_power_laws(each_line(exported), rng=np.random.default_rng(0), window=window, mean=mean)


def white_exponent(force: xarray.DataArray, fits: xarray.Dataset) -> xarray.DataArray:
    """Return what exponents the same fits find where heights are white, and the stiffness knows no number of points.

    Parameters
    ----------
    force : DataArray
        The forces F/(E* h L) of the curves.
    fits : Dataset
        As `fit_power_laws` returns them: their windows count.
    """
    every = np.unique(force.to_numpy())

    def fitted(low: float, high: float) -> float:
        inside = every[(every >= low * (1 - 1e-9)) & (every <= high * (1 + 1e-9))]
        if inside.size < 2:
            return np.nan
        stiffness = gaussian_heights.stiffness(inside, 1.0, 1.0, 1.0)
        return float(np.polyfit(np.log(inside), np.log(stiffness), 1)[0])

    windows = fits["window_low"], fits["window_high"]
    found: xarray.DataArray = xarray.apply_ufunc(fitted, *windows, vectorize=True)
    return found


def fits_beside_white(exported: xarray.Dataset) -> xarray.Dataset:
    """Return the exponents of lines with their windows, see `line_fits`, and `white_exponent` in these windows."""
    fits = line_fits(exported)
    return fits[list(WINDOWED)].assign(white=white_exponent(exported["dimensionless_force"], fits))


def resolution_exponent(points: float) -> float:
    """Return alpha of eq. 4.73 for a number N of points: ``(1 + log2 N)/(3 + log2 N)``."""
    return (1 + math.log2(points)) / (3 + math.log2(points))
