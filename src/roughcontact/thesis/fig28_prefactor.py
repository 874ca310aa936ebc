"""Figure 28: the prefactor of the stiffness against the Hurst exponent, and what the laws amount to."""

from __future__ import annotations

import math

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.statistics.common_forces import on_common
from roughcontact.theory import pohrt_popov
from roughcontact.thesis import drawing
from roughcontact.thesis.averaging import without_parameters
from roughcontact.thesis.ensembles import coarse_square_study, curve_averages, laws, square_study
from roughcontact.thesis.figures import Scale, Studies
from roughcontact.thesis.line_ensembles import line_averages, line_studies
from roughcontact.thesis.verdict import Verdict, Verdicts, counted, judged, series, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "prefactor of the stiffness against the Hurst exponent, by both methods, and the stiffness at three forces"
FORCES = (0.003, 0.015, 0.07)
CHOSEN = (
    "surfaces, lines and fits as in figure 27",
    "beside the prefactors, which lie far outside the forces of the fits, mean stiffnesses at forces F/(E* h L) of "
    f"{series(FORCES, 'g')}, where the grid resolves them",
    "and those of the same surfaces on half as many cells a side",
)
SIZE = (8.6, 4.2)
SMOOTH_SURFACE = (6 / (4 * math.pi**2)) ** (1 / 3)  # of two crossed cosines, the limit for large H
NEAR = 0.1

_MARKS = ("v", "s", "^")


def studies(scale: Scale) -> Studies:
    """Return the studies of figure 27, and surfaces on half as many cells a side."""
    return square_study(scale), *line_studies(scale), coarse_square_study(scale)


def averages(squares: xarray.Dataset, lines: xarray.Dataset, coarse: xarray.Dataset) -> xarray.Dataset:
    """Return the power laws of surfaces and lines, see `laws`, and stiffnesses at three forces."""
    found = laws(squares, lines)
    every = {"": curve_averages(squares), "coarse_": curve_averages(coarse), "line_": line_averages(lines)}
    for prefix, means in every.items():
        at = on_common(means, FORCES, at="force")
        at = at.where(at["resolved"]) if "resolved" in at else at
        for name in ("stiffness", "stiffness_error"):
            found[prefix + name] = without_parameters(at)[name]
    return found.assign_attrs(coarse_cells=int(coarse["points"]))


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the prefactors (a) and the stiffness at three forces (b)."""
    left, right = drawing.panels(figure, 1, 2)
    hurst = averages["hurst"].to_numpy()
    drawing.both_methods(left, averages, "prefactor")
    x = np.linspace(-0.15, hurst[-1], 200)
    left.plot(x, 1.7 / (x + 1), color=drawing.LAW, zorder=2, label="1.7/(H + 1)")
    left.axhline(SMOOTH_SURFACE, color="0.4", linestyle="-.", linewidth=1.0, label="two crossed waves")
    zeta = r"prefactor $\zeta$ of $k/(E^*L) = \zeta\,(F/(E^*hL))^{\alpha}$"
    drawing.hurst_axes(left, hurst, zeta, ylim=(0, 2.4))
    left.legend(loc="upper right")
    _stiffnesses(right, averages)
    drawing.hurst_axes(right, hurst, r"mean stiffness $k\,/\,(E^* L)$", yscale="log")
    right.legend(loc="lower right")


def _stiffnesses(axes: Axes, averages: xarray.Dataset) -> None:
    hurst, lines = averages["hurst"], averages["line_stiffness"].isel(points=-1)
    x = np.linspace(0.02, 2, 100)
    for force, mark in zip(averages["force"].to_numpy(), _MARKS, strict=True):
        one, words = averages.sel(force=force), rf"$F/(E^*hL)$ = {force:g}"
        axes.plot(hurst, lines.sel(force=force), color=drawing.LINES, zorder=2)
        axes.plot(x, pohrt_popov.stiffness(force, x, 1.0, 1.0, 1.0), color=drawing.LAW, zorder=2)
        given = {"fmt": mark, "color": drawing.SURFACES, "markersize": 3.5, "zorder": 4, "label": words}
        drawing.with_errors(axes, one, "stiffness", "hurst", **given)
        coarse = one["coarse_stiffness"]
        axes.plot(hurst, coarse, mark, color="0.55", markersize=5.5, fillstyle="none", zorder=3)
    words = f"{averages.attrs['coarse_cells']}² cells"
    drawing.key(axes, "o", words, color="0.55", markersize=6, fillstyle="none")
    drawing.key(axes, "-", "eq. 4.74", color=drawing.LAW)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare prefactors with 1.7/(H + 1), and the stiffness with eq. 4.74 as a whole."""
    found = averages.dropna("hurst", subset=["prefactor"])
    zeta, error, hurst = found["prefactor"], found["prefactor_error"], found["hurst"]
    off, spread = zeta * (hurst + 1) / 1.7 - 1, error * (hurst + 1) / 1.7
    middle, last = slice(0.01, 2), float(hurst[-1])
    stiffness, relative = found["stiffness"], found["stiffness_error"] / found["stiffness"]
    forces, exponents = stiffness["force"], stiffness["hurst"].sel(hurst=middle)
    law = xarray.apply_ufunc(pohrt_popov.stiffness, forces, exponents, 1.0, 1.0, 1.0)
    curve = (stiffness / law - 1).sel(hurst=middle)
    apart = stiffness / found["line_stiffness"].isel(points=-1) - 1
    grid = found["coarse_stiffness"] / stiffness - 1
    rough, smooth = slice(None, 0.39), slice(0.39, None)
    yield Verdict(
        "zeta = 1.7/(H + 1) is a fairly good approximation",
        "1.7/(H + 1)",
        f"{spanned(off.sel(hurst=middle), '+.0%')} from it for 0 < H <= 2, errors about {float(error.mean()):.2f}; "
        f"{counted(averages, 'surfaces')} a value",
        judged(off.sel(hurst=middle), spread.sel(hurst=middle), 2 * NEAR),
    )
    yield Verdict(
        "the prefactor at the other end",
        f"1.7/(H + 1) = {1.7 / (1 + last):.2f} at H = {last:.2f}",
        f"{float(zeta[-1]):.2f} with an error of {float(error[-1]):.2f}; two crossed waves {SMOOTH_SURFACE:.3f} at "
        "vanishing force",
        judged(off[-1], spread[-1], 2 * NEAR),
    )
    yield Verdict(
        "the whole law, k/(E* L) = 1.7/(H + 1) (F/(E* h L))^(1/(H + 1))",
        "eq. 4.74",
        f"mean stiffness {spanned(curve.sel(hurst=smooth), '+.0%')} from it for 0.4 <= H <= 2 and "
        f"{spanned(curve.sel(hurst=rough), '+.0%')} for 0 < H < 0.4, at forces of {series(forces, 'g')} where resolved",
        judged(curve, relative.sel(hurst=middle), NEAR),
    )
    yield Verdict(
        "the same stiffness by both methods",
        "a match",
        f"surfaces {spanned(apart.sel(hurst=smooth), '+.0%')} from rough lines for H >= 0.4, "
        f"{spanned(apart.sel(hurst=rough), '+.0%')} below, at these forces where resolved",
        judged(apart, relative, NEAR),
    )
    yield Verdict(
        "what the grid does to curves",
        "not stated",
        f"{averages.attrs['coarse_cells']}² cells {spanned(grid, '+.0%')} from {averages.attrs['cells']}² where both "
        "resolve",
        None,
    )
