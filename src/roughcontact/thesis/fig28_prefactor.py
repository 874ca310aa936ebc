"""Figure 28: the prefactor of the stiffness against the Hurst exponent, and what the laws amount to."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import TICK
from roughcontact.theory import pohrt_popov
from roughcontact.thesis.ensembles import (
    coarse_square_study,
    curve_averages,
    laws,
    square_study,
    stiffness_at,
    without_parameters,
)
from roughcontact.thesis.line_ensembles import line_averages, line_studies
from roughcontact.thesis.stiffness_view import exponent_axes
from roughcontact.thesis.verdict import Verdict, judged, spanned

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "prefactor of the stiffness against the Hurst exponent, by both methods, and the stiffness at three forces"
FORCES = (0.003, 0.015, 0.07)
CHOSEN = (
    "surfaces, lines and fits as in figure 27",
    "beside the prefactors, which lie far outside the forces of the fits, mean stiffnesses at forces F/(E* h L) of "
    + ", ".join(f"{force:g}" for force in FORCES)
    + ", where the grid resolves them",
    "and those of the same surfaces on half as many cells a side",
)
SIZE = (8.6, 4.2)
SMOOTH_SURFACE = (6 / (4 * math.pi**2)) ** (1 / 3)  # of two crossed cosines, the limit for large H
SMOOTH_LINE = (3 / (math.sqrt(2) * math.pi**2)) ** (1 / 3)
NEAR = 0.1

_LINES, _SURFACES, _LAW = "#c8290b", "black", "#0072b2"
_MARKS = ("v", "s", "^")


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the studies of figure 27, and surfaces on half as many cells a side."""
    return square_study(scale), *line_studies(scale), coarse_square_study(scale)


def averages(squares: xarray.Dataset, lines: xarray.Dataset, coarse: xarray.Dataset) -> xarray.Dataset:
    """Return the power laws of surfaces and lines, see `laws`, and stiffnesses at three forces."""
    found = laws(squares, lines)
    for prefix, means in (
        ("", curve_averages(squares)),
        ("coarse_", curve_averages(coarse)),
        ("line_", line_averages(lines)),
    ):
        at = stiffness_at(means, FORCES)
        if "resolved" in at:
            at = at.where(at["resolved"])
        for name in ("stiffness", "stiffness_error"):
            found[prefix + name] = without_parameters(at)[name]
    return found.assign_attrs(coarse_cells=int(coarse["points"]))


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the prefactors (a) and the stiffness at three forces (b)."""
    left, right = figure.subplots(1, 2)
    _prefactors(left, averages)
    _stiffnesses(right, averages)
    for letter, axes in zip("ab", (left, right), strict=True):
        axes.set_title(f"({letter})", fontsize=TICK + 1, loc="left")


def _prefactors(axes: Axes, averages: xarray.Dataset) -> None:
    hurst, zeta = averages["hurst"].to_numpy(), averages["prefactor"]
    fine = averages.isel(points=-1)
    axes.fill_between(
        hurst, fine["line_prefactor_low"], fine["line_prefactor_high"], color=_LINES, alpha=0.2, linewidth=0
    )
    words = rf"rough lines, $N = 2^{{{int(fine['points']).bit_length() - 1}}}$"
    axes.plot(hurst, fine["line_prefactor"], color=_LINES, linewidth=1.6, label=words)
    bars = abs(np.stack([averages["prefactor_low"] - zeta, averages["prefactor_high"] - zeta]))
    axes.errorbar(
        hurst,
        zeta,
        bars,
        fmt="x",
        color=_SURFACES,
        markersize=5.5,
        markeredgewidth=1.4,
        elinewidth=0.9,
        zorder=4,
        label=f"surfaces, {averages.attrs['cells']}² cells",
    )
    x = np.linspace(-0.15, hurst[-1], 200)
    axes.plot(x, 1.7 / (x + 1), color=_LAW, linewidth=1.2, zorder=2, label="1.7/(H + 1)")
    axes.axhline(SMOOTH_SURFACE, color="0.4", linestyle="-.", linewidth=1.0, label="two crossed waves")
    exponent_axes(axes, r"prefactor $\zeta$ of $k/(E^*L) = \zeta\,(F/(E^*hL))^{\alpha}$")
    axes.set(xlim=(hurst[0] - 0.05, hurst[-1] + 0.05), ylim=(0, 2.4))
    axes.legend(fontsize=TICK, frameon=False, loc="upper right")


def _stiffnesses(axes: Axes, averages: xarray.Dataset) -> None:
    hurst, fine = averages["hurst"].to_numpy(), averages.isel(points=-1)
    x = np.linspace(0.02, 2, 100)
    for force, mark in zip(averages["force"].to_numpy(), _MARKS, strict=True):
        one, line = averages.sel(force=force), fine["line_stiffness"].sel(force=force)
        axes.plot(hurst, line, color=_LINES, linewidth=1.3, zorder=2)
        axes.plot(x, pohrt_popov.stiffness(force, x, 1.0, 1.0, 1.0), color=_LAW, linewidth=1.2, zorder=2)
        axes.errorbar(
            hurst,
            one["stiffness"],
            one["stiffness_error"],
            fmt=mark,
            color=_SURFACES,
            markersize=3.5,
            elinewidth=0.9,
            zorder=4,
            label=rf"$F/(E^*hL)$ = {force:g}",
        )
        axes.plot(
            hurst, one["coarse_stiffness"], mark, color="0.55", markersize=5.5, fillstyle="none", zorder=3
        )
    axes.plot([], [], "o", color="0.55", fillstyle="none", label=f"{averages.attrs['coarse_cells']}² cells")
    axes.plot([], [], color=_LAW, linewidth=1.2, label="eq. 4.74")
    exponent_axes(axes, r"mean stiffness $k\,/\,(E^* L)$")
    axes.set(yscale="log", xlim=(hurst[0] - 0.05, hurst[-1] + 0.05))
    axes.legend(fontsize=TICK, frameon=False, loc="lower right")


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare prefactors with 1.7/(H + 1), and the stiffness with eq. 4.74 as a whole."""
    found = averages.dropna("hurst", subset=["prefactor"])
    zeta, error, hurst = found["prefactor"], found["prefactor_error"], found["hurst"]
    off, spread = zeta * (hurst + 1) / 1.7 - 1, error * (hurst + 1) / 1.7
    middle, last = slice(0.01, 2), float(hurst[-1])
    stiffness, relative = found["stiffness"], found["stiffness_error"] / found["stiffness"]
    law = stiffness.sel(hurst=middle).copy()
    law.values = pohrt_popov.stiffness(*_at(law), 1.0, 1.0, 1.0)
    curve = (stiffness / law - 1).sel(hurst=middle)
    apart = stiffness / found["line_stiffness"].isel(points=-1) - 1
    grid = found["coarse_stiffness"] / stiffness - 1
    rough, smooth = slice(None, 0.39), slice(0.39, None)
    said = f"{averages.attrs['surfaces']} surfaces of {averages.attrs['cells']}² cells a value"
    forces = ", ".join(f"{force:g}" for force in averages["force"].to_numpy())
    return (
        Verdict(
            "zeta = 1.7/(H + 1) is a fairly good approximation",
            "1.7/(H + 1)",
            f"{spanned(off.sel(hurst=middle), '+.0%')} from it for 0 < H <= 2, errors about "
            f"{float(error.mean()):.2f}; {said}",
            judged(off.sel(hurst=middle), spread.sel(hurst=middle), 2 * NEAR),
        ),
        Verdict(
            "the prefactor at the other end",
            f"1.7/(H + 1) = {1.7 / (1 + last):.2f} at H = {last:.2f}",
            f"{float(zeta[-1]):.2f} with an error of {float(error[-1]):.2f}; two crossed waves {SMOOTH_SURFACE:.3f} at "
            "vanishing force",
            judged(off[-1], spread[-1], 2 * NEAR),
        ),
        Verdict(
            "the whole law, k/(E* L) = 1.7/(H + 1) (F/(E* h L))^(1/(H + 1))",
            "eq. 4.74",
            f"mean stiffness {spanned(curve.sel(hurst=smooth), '+.0%')} from it for 0.4 <= H <= 2 and "
            f"{spanned(curve.sel(hurst=rough), '+.0%')} for 0 < H < 0.4, at forces of {forces} where resolved",
            judged(curve, relative.sel(hurst=middle), NEAR),
        ),
        Verdict(
            "the same stiffness by both methods",
            "a match",
            f"surfaces {spanned(apart.sel(hurst=smooth), '+.0%')} from rough lines for H >= 0.4, "
            f"{spanned(apart.sel(hurst=rough), '+.0%')} below, at these forces where resolved",
            judged(apart, relative, NEAR),
        ),
        Verdict(
            "what the grid does to curves",
            "not stated",
            f"{averages.attrs['coarse_cells']}² cells {spanned(grid, '+.0%')} from {averages.attrs['cells']}² where "
            "both resolve",
            None,
        ),
    )


def _at(values: xarray.DataArray) -> tuple[np.typing.NDArray[np.float64], np.typing.NDArray[np.float64]]:
    """Return the force and the Hurst exponent of every value."""
    force, hurst = (values[name].broadcast_like(values).to_numpy() for name in ("force", "hurst"))
    return force, hurst
