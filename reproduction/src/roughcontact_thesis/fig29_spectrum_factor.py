"""Figure 29: the factor of the line's spectrum that makes it as stiff as the surface."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.mdr.lines.lattice_sums import lambda_rms
from roughcontact_thesis import drawing
from roughcontact_thesis.ensembles import square_study
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.line_ensembles import each_line, line_studies
from roughcontact_thesis.line_match import match, pairs
from roughcontact_thesis.ruling import exceeds, middle, ruled
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "factor of the spectrum C1D = lambda q C2D that makes a line as stiff as its surface"
HIGHEST = 0.05  # force F/(E* h L), a little below the last one of the surfaces
SINGLE_WAVE = 4.0  # exact for H to infinity
CHOSEN = (
    "lines and surfaces of figures 27 and 28, matched at equal mean stiffness",
    f"one window for both: stiffnesses from 20 cells of the surface up to that at a force of {HIGHEST:g}",
    "lambda_rms, of equal rms heights, for the waves of the surface's grid",
)
SIZE = (drawing.COLUMN, 3.4)


def studies(scale: Scale) -> Studies:
    """Return the studies of lines and of surfaces that figures 27 and 28 are made of."""
    return (*line_studies(scale), square_study(scale))


def averages(lines: xarray.Dataset, surfaces: xarray.Dataset) -> xarray.Dataset:
    """Return lambda with its standard error, that of equal rms heights, and how well the matched curves agree."""
    longest = each_line(lines).isel(points=-1)
    points = int(surfaces["points"])
    rows = []
    for hurst, line, surface in pairs(longest, surfaces):
        found = match(line, surface, HIGHEST)
        same = lambda_rms(hurst, (points - 1) // 2)
        factor = same * found.ratio**2
        rows.append((factor, 2 * found.error * factor, same, found.ratio, found.mismatch, *found.window))
    names = {
        "factor": "lambda of C1D = lambda q C2D",
        "factor_error": "standard error of lambda",
        "factor_rms": "lambda of equal rms heights",
        "ratio": "force of surfaces over that of lines at one stiffness",
        "mismatch": "largest difference of ln k in the window after the match",
        "window_low": "lowest k/(E* L) of the window",
        "window_high": "highest k/(E* L) of the window",
    }
    averages = xarray.Dataset(coords={"hurst": surfaces["hurst"]})
    for (name, words), column in zip(names.items(), np.transpose(rows), strict=True):
        averages[name] = "hurst", column, {"long_name": words, "units": "1"}
    sizes = {"samples": surfaces.sizes["sample"], "lines": longest.sizes["sample"]}
    return averages.assign_attrs(sizes | {"points": points})


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw lambda against the Hurst exponent, with that of equal rms heights, Geike's pi and the limit 4."""
    axes = figure.subplots()
    factor = averages["factor"]
    # An error of a logarithm: of few samples it is not small.
    spread = np.exp(2 * averages["factor_error"] / factor)
    shown = averages.assign(factor_low=factor / spread, factor_high=factor * spread)
    style = {"fmt": "o-", "color": drawing.COLOURS[0], "capsize": 2, "zorder": 3}
    words = "equal stiffness, with two standard errors"
    drawing.with_intervals(axes, averages["hurst"], shown, "factor", label=words, **style)
    words = r"$\lambda$ of equal rms heights"
    axes.plot(averages["hurst"], averages["factor_rms"], "--", color=drawing.COLOURS[1], label=words)
    limits: Any = {"color": "0.35", "linewidth": 1.0}
    axes.axhline(math.pi, linestyle="-.", label=r"$\pi$ (eq. 4.54)", **limits)
    axes.axhline(SINGLE_WAVE, linestyle=":", label=r"4: a single wave, $H \to \infty$", **limits)
    top = 1.4 * max(SINGLE_WAVE, float(shown["factor_high"].max()))
    words = r"factor $\lambda$ of $C_{\mathrm{1D}} = \lambda\, q\, C_{\mathrm{2D}}$"
    drawing.label(axes, "Hurst exponent H", words, ylim=(0, top))
    drawing.legend_below(axes, 1)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Say what lambda is, and whether it does what it is for."""
    inside = middle(averages)
    factor, error = averages["factor"], averages["factor_error"]
    few = averages.sel(hurst=[0.4, 1.0, 2.0, 2.95], method="nearest")
    rows = zip(few["factor"].values, few["factor_error"].values, few["hurst"].values, strict=True)
    values = ", ".join(f"{value:.2f} ± {spread:.2f} at H = {hurst:.2g}" for value, spread, hurst in rows)
    told = averages.attrs
    counts = f"{told['lines']} lines, {told['samples']} surfaces of {told['points']}² points"
    high, low = (
        averages.isel(hurst=int(factor.to_numpy().argmax())),
        averages.isel(hurst=int(factor.to_numpy().argmin())),
    )
    apart = float(high["factor"] - low["factor"])
    both = float(high["factor_error"] + low["factor_error"])  # at most, as they share their phases
    worst = float(inside["hurst"][int(inside["mismatch"].to_numpy().argmax())])
    over = (inside["factor"] / inside["factor_rms"]).to_numpy()
    yield Verdict(
        "lambda depends on H",
        "Instead of eq. A.73 we can assume a more general C_1D = λ(H) q C_2D",
        "section 4.5.3, eq. 4.75, fig. 29",
        f"{values}; lowest at H = {float(low['hurst']):.2f}, highest at {float(high['hurst']):.2f}; {counts}",
        exceeds(apart, both, 0.0, ".2f", "a difference between two H"),
    )
    yield Verdict(
        "with lambda a line is as stiff as the surface at low loads",
        "Using this prefactor to generate a rough line will result in the same asymptotical behavior as for the 3D "
        "equivalent, without the need to normalize to the rms roughness.",
        "section 4.5.3",
        f"mean stiffnesses agree to {float(inside['mismatch'].max()):.1%} all over the window, worst at H = "
        f"{worst:.2g}; lambda is {over.min():.2f} to {over.max():.2f} times that of equal rms heights",
        # ln k goes as alpha/2 of ln lambda, which has this error.
        ruled(
            inside["mismatch"], (error / factor / 2 / (averages["hurst"] + 1)).sel(hurst=inside["hurst"]), 0.1
        ),
    )
