"""Figure 28: the prefactor of the stiffness against the Hurst exponent, and what the laws amount to."""

from __future__ import annotations

import math

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from roughcontact.statistics.common_forces import on_common
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact_thesis import drawing
from roughcontact_thesis.averaging import converged, means, without_parameters
from roughcontact_thesis.ensembles import coarse_square_study, curve_averages, laws, square_study
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.line_ensembles import line_averages, line_studies
from roughcontact_thesis.ruling import VICINITY, middle, ranged, ruled, ruled_in_middle, undecided
from roughcontact_thesis.verdict import Verdict, Verdicts, beside, counted, series, spanned

__all__ = ["averages", "changes", "draw", "studies", "verdicts"]

TITLE = "prefactor of the stiffness against the Hurst exponent, by both methods, and the stiffness at three forces"
FORCES = (0.003, 0.015, 0.07)
CHOSEN = (
    "surfaces, lines and fits as in figure 27",
    "beside the prefactors, which lie far outside the forces of the fits, mean stiffnesses at forces F/(E* h L) of "
    f"{series(FORCES, 'g')}, where the grid resolves them",
    "and those of the same surfaces on half as many cells a side",
)
SIZE = (drawing.PAGE, 4.2)
SMOOTH_SURFACE = (6 / (4 * math.pi**2)) ** (1 / 3)  # of two crossed cosines, the limit for large H
NEAR = 0.1  # of a stiffness: what counts as agreement
FAIR = 0.2  # the same of a "fairly good approximation", and of what is made of it
SUFFICIENT = 0.05  # of a stiffness: what cells may do to it

_MARKS = ("v", "s", "^")


def studies(scale: Scale) -> Studies:
    """Return the studies of figure 27, and surfaces on half as many cells a side."""
    return square_study(scale), *line_studies(scale), coarse_square_study(scale)


def averages(squares: xarray.Dataset, lines: xarray.Dataset, coarse: xarray.Dataset) -> xarray.Dataset:
    """Return the power laws of surfaces and lines, see `laws`, and stiffnesses at three forces."""
    found = laws(squares, lines)
    every = {"": curve_averages(squares), "coarse_": curve_averages(coarse), "line_": line_averages(lines)}
    for prefix, curves in every.items():
        at = on_common(curves, FORCES, at="force")
        at = at.where(at["resolved"]) if "resolved" in at else at
        for name in ("stiffness", "stiffness_error"):
            found[prefix + name] = without_parameters(at)[name]
    pairs = [_at_forces(each) for each in (coarse, squares)]
    ratio = (pairs[0] / pairs[1]).where(found["coarse_stiffness"].notnull() & found["stiffness"].notnull())
    found = found.assign(means(grid=ratio).data_vars)
    return found.assign_attrs(coarse_cells=int(coarse["points"]))


def _at_forces(exported: xarray.Dataset) -> xarray.DataArray:
    """Return the stiffness of every surface at the three forces."""
    curves = converged(exported)[["dimensionless_force", "dimensionless_stiffness"]]
    return without_parameters(on_common(curves, FORCES))["dimensionless_stiffness"].rename(
        dimensionless_force="force"
    )


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
    left.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
    _stiffnesses(right, averages)
    drawing.hurst_axes(right, hurst, r"mean stiffness $k\,/\,(E^* L)$", yscale="log")
    right.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)


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
        axes.plot(hurst, coarse, mark, color="0.45", markersize=5.5, fillstyle="none", zorder=3)
    words = f"{averages.attrs['coarse_cells']}² cells"
    drawing.key(axes, "o", words, color="0.45", markersize=6, fillstyle="none")
    drawing.key(axes, "-", r"$1.7\,F^{1/(H+1)}/(H+1)$", color=drawing.LAW)
    drawing.key(axes, "-", drawing.lines_words(int(lines["points"])), color=drawing.LINES)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare prefactors with 1.7/(H + 1), and the stiffness with three laws."""
    found = averages.dropna("hurst", subset=["prefactor"])
    zeta, error, hurst = found["prefactor"], found["prefactor_error"], found["hurst"]
    off, spread = zeta * (hurst + 1) / 1.7 - 1, error * (hurst + 1) / 1.7
    told = f"mean stiffness at forces of {series(found['force'], 'g')}, where resolved"
    relative = found["stiffness_error"] / found["stiffness"]
    line, line_error = (found[f"line_stiffness{end}"].isel(points=-1) for end in ("", "_error"))
    apart, both = found["stiffness"] / line - 1, (relative**2 + (line_error / line) ** 2) ** 0.5
    yield Verdict(
        "zeta = 1.7/(H + 1) is a fairly good approximation",
        "A fairly good approximation for ζ is given by ζ = 1.7/(H + 1).",
        "section 4.5.3, fig. 28",
        f"{ranged(off, spread, FAIR)}; {counted(averages, 'surfaces')} a value",
        ruled_in_middle(off, spread, FAIR),
    )
    for name, claim, quote, source in LAWS:
        away, uncertain = _off(found, name)
        yield Verdict(
            claim,
            quote,
            source,
            f"{told}: {ranged(away, uncertain, FAIR)}",
            ruled_in_middle(away, uncertain, FAIR),
        )
    yield Verdict(
        "lines of the same rms height have the stiffness of surfaces",
        "A given threedimensional contact problem can be mapped onto an equivalent onedimensional system, while "
        "preserving all interdependencies between normal force F_N, indentation depth d, contact stiffness k_N",
        "section A.2; for rough surfaces by one rms roughness, eqs A.73 to A.75",
        f"surfaces over lines, {told}: {ranged(apart, both, NEAR)}",
        ruled_in_middle(apart, both, NEAR),
        "method",
    )
    yield _smooth(found)
    yield _twenty_cells(averages, found)
    if "prefactor_geometric" in found:
        yield _averaging(found)
    yield Verdict(
        "the prefactor analytically",
        "Can we find the prefactor ζ analytically?",
        "chapter 7",
        f"in one limit: two crossed waves have {SMOOTH_SURFACE:.4f} at vanishing force; found {float(zeta[-1]):.3f} ± "
        f"{float(error[-1]):.3f} at H = {float(hurst[-1]):g}, with an exponent of {float(found['exponent'][-1]):.3f}",
        undecided("a limit is no formula"),
        "answer",
    )


def findings(averages: xarray.Dataset) -> str:
    """Return in a sentence how well the law as a whole gives the stiffness."""
    found = averages.dropna("hurst", subset=["prefactor"])
    whole = beside(middle(_off(found, "law")[0]))
    return (
        "In the same range of H, at forces F/(E\\* h L) of "
        f"{series(found['force'], 'g')}, the mean stiffness lies {whole} the whole law of the thesis, k/(E\\* L) = "
        "1.7/(H + 1) (F/(E\\* h L))^(1/(H + 1))."
    )


LAWS = (
    (
        "measured",
        "k = 1.7/(H + 1) F^alpha with the exponent as measured",
        "So eq. 4.53 can be expressed as k = 1.7/(H + 1) F^α(H).",
        "section 4.5.3, eq. 4.74",
    ),
    (
        "law",
        "k = 1.7/(H + 1) F^(1/(H + 1)), the whole law",
        "For fractal rough surfaces the dependency reads k/(E*L) = 1.7/(H + 1) (F/(E*hL))^(1/(H + 1))",
        "eqs 5.5 and 7.3",
    ),
)


def _off(found: xarray.Dataset, name: str) -> tuple[xarray.DataArray, xarray.DataArray]:
    """Return mean stiffnesses over a law, less one, with errors, for H above 0."""
    hurst, force = found["hurst"], found["force"]
    alpha = 1 / (hurst.where(hurst > 0) + 1)
    relative = found["stiffness_error"] / found["stiffness"]
    if name == "law":
        law = 1.7 * alpha * force**alpha
    else:
        law = 1.7 * alpha * force ** found["exponent"]
        # The exponent is one of the same surfaces: errors add up at most.
        relative = relative + abs(np.log(force)) * found["exponent_error"]
    ratio = found["stiffness"] / law
    return ratio - 1, relative * ratio


def changes(stiffness: xarray.DataArray) -> xarray.DataArray:
    """Return how much the stiffness differs from that of the highest Hurst exponent, beyond the vicinity of 2."""
    smooth = stiffness.sel(hurst=slice(2 + VICINITY, None))
    found: xarray.DataArray = smooth.isel(hurst=slice(None, -1)) / smooth.isel(hurst=-1, drop=True) - 1
    return found


def _smooth(found: xarray.Dataset) -> Verdict:
    """Return whether the stiffness depends on the Hurst exponent above 2."""
    away, relative = changes(found["stiffness"]), found["stiffness_error"] / found["stiffness"]
    below = found["stiffness"].sel(hurst=[1.3, 1.9], method="nearest")
    last = below["hurst"].to_numpy()
    # Of the same phases: the error of a ratio is at most the sum of both.
    error = (relative + relative.isel(hurst=-1, drop=True)).sel(hurst=away["hurst"])
    return Verdict(
        "only above H = 2 does the stiffness not depend on H",
        "we will see later that only for H ≥ 2 will there be no more significant influence of H on the contact "
        "behavior.",
        "section 2.2",
        f"from H = {2 + VICINITY:g} on {spanned(away, '+.1%')} from the stiffness at H = {found['hurst'][-1]:g}, at "
        f"one force; from H = {last[0]:g} to {last[1]:g} it grows by "
        f"{spanned(below.isel(hurst=1) / below.isel(hurst=0) - 1, '.0%')}",
        ruled(away, error, NEAR),
    )


def _averaging(found: xarray.Dataset) -> Verdict:
    """Return what other ways to average do to the prefactor."""
    ways = {"geometric": "of geometric means", "of_fits": "of means of the fits of each surface"}
    off = {name: middle(found[f"prefactor_{name}"] / found["prefactor"] - 1) for name in ways}
    told = ", ".join(f"{words} {spanned(off[name], '+.0%')}" for name, words in ways.items())
    each = xarray.concat(list(off.values()), "way")
    # Of the same surfaces: the error of the ratio is at most the sum of both.
    errors = [found[f"prefactor_{name}_error"] / found["prefactor"] for name in ways]
    error = xarray.concat(
        [middle(one + found["prefactor_error"] / found["prefactor"]) for one in errors], "way"
    )
    return Verdict(
        "the way to average does not move the prefactor",
        "Fig. 21 shows the averaging over multiple samples.",
        "section 4.5.1",
        f"from that of mean curves, which is taken here as it is what many joints side by side have: {told}, "
        "for H from "
        "0.25 to 1.75",
        ruled(each, error, NEAR),
        "method",
    )


def _twenty_cells(averages: xarray.Dataset, found: xarray.Dataset) -> Verdict:
    """Return what half as many cells do to the stiffness of the same surfaces, where more than 20 carry."""
    grid = found["coarse_stiffness"] / found["stiffness"] - 1
    # Of the same surfaces: the error of the ratio is at most the sum of both.
    error = sum(found[f"{name}_error"] / found[name] for name in ("coarse_stiffness", "stiffness"))
    if "grid" in found:  # surface by surface
        grid, error = found["grid"] - 1, found["grid_error"]
    return Verdict(
        "stiffnesses above twenty times that of a cell can be used",
        "In my experience, it is sufficient to discard any stiffness value below 20 times the limiting value eq. 4.16.",
        "section 4.3",
        f"{averages.attrs['coarse_cells']}² cells {spanned(grid, '+.1%')} from {averages.attrs['cells']}² on the same "
        "surfaces where more than 20 cells carry on both",
        ruled(grid, error, SUFFICIENT),
    )
