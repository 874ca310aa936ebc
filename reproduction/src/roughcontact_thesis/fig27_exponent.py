"""Figure 27: the exponent of the stiffness against the Hurst exponent, by both methods."""

from __future__ import annotations

from dataclasses import replace

import xarray
from matplotlib.figure import Figure

from roughcontact_thesis import drawing
from roughcontact_thesis.ensembles import laws, square_study
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.line_ensembles import line_studies
from roughcontact_thesis.ruling import VICINITY, middle, ranged, ruled, ruled_in_middle, undecided
from roughcontact_thesis.verdict import Verdict, Verdicts, beside, counted, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "exponent of the stiffness against the Hurst exponent, by both methods"
CHOSEN = (
    "surfaces: free squares of 513 x 513 cells (small: 257 x 257), forces F/(E* h L) from 1e-4 to 0.07 in equal ratios",
    "fits: arithmetic means over the samples above the stiffness of 20 cells, forces up to 0.07, least squares in "
    "logarithms; bars and bands: 95 % of resampled ensembles",
    "the same phases for all Hurst exponents: neighbouring values share their errors",
)
SIZE = (drawing.COLUMN, 3.6)
MATCHED = slice(VICINITY - 1e-9, None)  # Hurst exponents for which both methods are compared
NEAR = 0.1  # of an exponent: what counts as agreement with the law
MATCH = 0.05  # of exponents by both methods
CENTRED = (
    (
        "alpha = 1/(H + 1) for surfaces with the highest crest in the middle",
        "This is the central finding of the present work: α = 1/(H + 1).",
        "chapter 6, eq. 6.2",
    ),
    (
        "the exponent of Hertz above H = 2 with the highest crest in the middle",
        "which corresponds to the classical Hertzian case of single sine asperity.",
        "chapter 6",
    ),
)


def studies(scale: Scale) -> Studies:
    """Return the study of rough surfaces and that of rough lines, which figure 28 shares."""
    return square_study(scale), *line_studies(scale)


def averages(squares: xarray.Dataset, lines: xarray.Dataset) -> xarray.Dataset:
    """Return the power laws of surfaces and lines, see `laws`."""
    return laws(squares, lines)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the exponents of surfaces as crosses, those of lines as lines, and 1/(H + 1)."""
    axes = figure.subplots()
    hurst = averages["hurst"].to_numpy()
    for points, style in zip(averages["points"].to_numpy()[:-1], (":", "--"), strict=False):
        curve, words = averages["line_exponent"].sel(points=points), drawing.lines_words(points)
        axes.plot(hurst, curve, style, color=drawing.LINES, linewidth=1.0, label=words)
    drawing.both_methods(axes, averages, "exponent")
    drawing.exponent_laws(axes, hurst)
    drawing.hurst_axes(axes, hurst, drawing.EXPONENT, ylim=(0.28, 1.02))
    drawing.legend_below(axes)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the exponents with 1/(H + 1), with each other, and at both ends."""
    found, away, spread = _from_law(averages)
    alpha, error = found["exponent"], found["exponent_error"]
    apart = alpha - found["line_exponent"].isel(points=-1)
    both = (error**2 + found["line_exponent_error"].isel(points=-1) ** 2) ** 0.5
    ranges = ruled(apart, both, MATCH, "+.3f").ranges
    smooth = slice(2 + VICINITY, None)
    ends = alpha.sel(hurst=smooth)[[0, -1]]
    yield Verdict(
        "alpha = 1/(H + 1) for surfaces",
        "In the most relevant region of approximately 0 < H < 2, a new analytical expression is found [...] α = 1/(H + "
        "1)",
        "chapter 6, eq. 6.2; eq. 4.31",
        f"{ranged(away, spread, NEAR)}; {counted(averages, 'surfaces')} a value",
        ruled_in_middle(away, spread, NEAR),
    )
    yield Verdict(
        "the exponent of Hertz for surfaces above H = 2",
        "Seamlessly, this dependency transitions into α = 2/3 for H ≥ 2, which corresponds to the classical Hertzian "
        "case of single sine asperity.",
        "chapter 6, where 2/3 stands for 1/3",
        " and ".join(f"{float(value):.3f} at H = {float(value['hurst']):.2f}" for value in ends)
        + "; squares are cut at random, and a cut through the highest crest changes its law",
        ruled(3 * alpha.sel(hurst=smooth) - 1, 3 * error.sel(hurst=smooth), NEAR),
    )
    for claim, quote, source in CENTRED:
        cut = "these squares are cut at random, which changes the law of a crest at the border"
        why = undecided("no squares with the crest in the middle", f"{NEAR:.0%}")
        yield Verdict(claim, quote, source, cut, why)
    yield Verdict(
        "exponents of surfaces and of lines match",
        "It can be seen that the runs of the curves are almost a perfect match.",
        "section 4.5.3, fig. 27",
        f"differences {spanned(middle(apart), '+.3f')} for H from 0.25 to 1.75, {spanned(apart, '+.3f')} in all; "
        f"errors about {float(both.mean()):.3f}",
        # "For details of alpha with H < 0.2, see fig. 26": the thesis sets those apart.
        replace(ruled(apart.sel(hurst=MATCHED), both.sel(hurst=MATCHED), MATCH, "+.3f"), ranges=ranges),
    )


def findings(averages: xarray.Dataset) -> str:
    """Return in a sentence what the exponents are."""
    found, away, spread = _from_law(averages)
    line = found["line_exponent"].isel(points=-1) * (found["hurst"] + 1) - 1
    worst = int(abs(middle(away)).to_numpy().argmax())
    hurst = float(middle(away)["hurst"][worst])
    rule = ruled_in_middle(away, spread, NEAR)
    return (
        "The stiffness of rough squares grows as a power of the force. For Hurst exponents H from 0.25 to 1.75 its "
        f"exponent lies {beside(middle(away))} the 1/(H + 1) of the thesis. The difference is largest at H = "
        f"{hurst:.2f} (± {float(middle(spread)[worst]):.0%}). The exponent of rough lines lies {beside(middle(line))} "
        f"1/(H + 1). The central claim, an exponent of 1/(H + 1) within {NEAR:.0%}, {_WORDS[rule.word]} for "
        f"surfaces{f' ({rule.part})' if rule.part else ''}."
    )


_WORDS = {
    "holds": "holds",
    "holds in part": "holds in part",
    "does not hold": "does not hold",
    "not decided": "is not decided",
}


def _from_law(averages: xarray.Dataset) -> tuple[xarray.Dataset, xarray.DataArray, xarray.DataArray]:
    """Return what was found for surfaces, exponents over 1/(H + 1), less one, and the errors of these."""
    found = averages.dropna("hurst", subset=["exponent"])
    inverse = found["hurst"] + 1
    return found, found["exponent"] * inverse - 1, found["exponent_error"] * inverse
