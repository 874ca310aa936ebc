"""Figure 27: the exponent of the stiffness against the Hurst exponent, by both methods."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.thesis import drawing
from roughcontact.thesis.ensembles import laws, square_study
from roughcontact.thesis.figures import Scale, Studies
from roughcontact.thesis.line_ensembles import line_studies
from roughcontact.thesis.verdict import Verdict, Verdicts, counted, judged, spanned

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "exponent of the stiffness against the Hurst exponent, by both methods"
CHOSEN = (
    "surfaces: free squares of 513 x 513 cells (small: 257 x 257), forces F/(E* h L) from 1e-4 to 0.07 in equal ratios",
    "fits: arithmetic means over the samples above the stiffness of 20 cells, forces up to 0.07, least squares in "
    "logarithms; bars and bands: 95 % of resampled ensembles",
    "the same phases for all Hurst exponents: neighbouring values share their errors",
)
SIZE = (6.4, 4.4)
NEAR = 0.1  # of an exponent: what counts as agreement with the law


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
    axes.legend(loc="upper right")


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the exponents with 1/(H + 1), with each other, and at both ends."""
    found = averages.dropna("hurst", subset=["exponent"])
    alpha, error, hurst = found["exponent"], found["exponent_error"], found["hurst"]
    away, spread = alpha * (hurst + 1) - 1, error * (hurst + 1)
    middle = slice(0.01, 2)
    inside = hurst.sel(hurst=middle).to_numpy()
    off = away.sel(hurst=middle).to_numpy()
    near, worst = inside[np.abs(off) <= NEAR], inside[np.abs(off).argmax()]
    apart = alpha - found["line_exponent"].isel(points=-1)
    both = np.hypot(error, found["line_exponent_error"].isel(points=-1))
    smooth, low = slice(2.01, None), slice(None, 0)
    ends = alpha.sel(hurst=smooth)[[0, -1]]
    plateau = alpha.sel(hurst=low)
    yield Verdict(
        "alpha = 1/(H + 1) for 0 < H < 2",
        "1/(H + 1)",
        f"within {NEAR:.0%} of it {_range(near)}; most off at H = {worst:.2f}: {alpha.sel(hurst=worst):.3f} instead of "
        f"{1 / (1 + worst):.3f}; errors about {float(error.mean()):.3f}, {counted(averages, 'surfaces')} a value",
        judged(away.sel(hurst=middle), spread.sel(hurst=middle), NEAR),
    )
    yield Verdict(
        "the Hertzian exponent for H >= 2",
        "1/3",
        " and ".join(f"{float(value):.3f} at H = {float(value['hurst']):.2f}" for value in ends)
        + "; in this window crests are not quite paraboloids any more",
        judged(3 * alpha.sel(hurst=smooth) - 1, 3 * error.sel(hurst=smooth), NEAR),
    )
    yield Verdict(
        "boundary elements and rough lines are almost a perfect match",
        "almost perfect",
        f"differences {spanned(apart.sel(hurst=slice(0.39, None)), '+.3f')} for H >= 0.4, "
        f"{spanned(apart.sel(hurst=low), '+.3f')} for H <= 0; errors about {float(both.mean()):.3f}",
        judged(apart, both, 0.05),
    )
    yield Verdict(
        "a constant for H below about 0",
        "constant, depends on the number of scales",
        f"{float(plateau.min()):.3f} to {float(plateau.max()):.3f} from H = {float(hurst[0]):.2f} to 0, errors about "
        f"{float(error.sel(hurst=low).mean()):.3f}; what it depends on: figures 23, 25 and 26",
        judged(plateau - plateau.mean(), error.sel(hurst=low), 0.03),
    )


def _range(hurst: np.typing.NDArray[np.float64]) -> str:
    return f"for {hurst.min():.2f} <= H <= {hurst.max():.2f}" if hurst.size else "nowhere"
