"""Figure 23: the exponent of rough lines against the Hurst exponent, for two numbers of points."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.statistics.fit_window import force_window
from roughcontact.theory import gaussian_heights
from roughcontact.thesis import drawing, line_ensembles
from roughcontact.thesis.figures import Scale, Studies
from roughcontact.thesis.line_ensembles import resolution_exponent
from roughcontact.thesis.verdict import Verdict, Verdicts, series

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "exponent of rough lines against the Hurst exponent, two resolutions"
POINTS = (2**9, 2**11)
COMMON = (0.03, 0.07)  # forces at which 35 springs of 2^9 and more carry load where H is low
CHOSEN = (
    "27 Hurst exponents from -0.95 to 2.95; 1000 lines of each, on the small scale 200",
    "fits: more than 20 springs, forces up to 0.07, means over the lines by least squares in logarithms",
    f"beside them one window for both, forces from {COMMON[0]:g} to {COMMON[1]:g}",
)
SIZE = (6.2, 4.2)

_COLOURS = {512: "#0072b2", 2048: "#009e73"}


def studies(scale: Scale) -> Studies:
    """Return the study of rough lines that this figure shares with others."""
    return line_ensembles.line_studies(scale)


def averages(lines: xarray.Dataset) -> xarray.Dataset:
    """Return exponents and their intervals, each in its own window and in a common one, and those of white heights."""
    chosen = lines.sel(points=list(POINTS))
    found = line_ensembles.fits_beside_white(chosen)
    common = line_ensembles.line_fits(chosen, window=force_window(*COMMON))
    found["common"], found["common_error"] = common["exponent"], common["exponent_error"]
    means = line_ensembles.line_averages(chosen)
    force = means["force"]
    inside = means.isel(load=np.flatnonzero((force >= COMMON[0]) & (force <= COMMON[1] * (1 + 1e-9))))
    found = found.merge(inside[["force", "stiffness", "stiffness_error"]])
    return found.assign_attrs(lines=means.attrs["lines"])


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the exponent of both resolutions, with 1/(H + 1) and what white heights would give."""
    axes = figure.subplots()
    hurst = averages["hurst"].to_numpy()
    for points, colour in _COLOURS.items():
        one, words = averages.sel(points=points), rf"$N = 2^{{{points.bit_length() - 1}}}$"
        drawing.band(axes, one, "exponent", color=colour, marker="o", markersize=3.2, zorder=3, label=words)
        axes.plot([hurst[0], -0.05], [float(one["white"][0])] * 2, ":", color=colour, linewidth=2.2, zorder=2)
    drawing.key(axes, ":", "independent Gaussian heights, same windows", linewidth=2.2)
    drawing.exponent_laws(axes, hurst, color="black", zorder=4, linestyle="--")
    drawing.hurst_axes(axes, hurst, drawing.EXPONENT, ylim=(0.25, 1.02))
    axes.legend(loc="upper right")


def _two(values: xarray.DataArray | list[float]) -> str:
    return series(values, between=" and ")


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the plateau at low H, its dependence on the number of points, and the law in between."""
    alpha, error = averages["exponent"], averages["exponent_error"]
    low = averages.sel(hurst=slice(None, -0.3))
    middle = averages.sel(hurst=slice(0.35, 2.05))
    high = alpha.sel(points=POINTS[-1], hurst=slice(2.05, None))
    spread = low["exponent"].max("hurst") - low["exponent"].min("hurst")
    plateau, common = low["exponent"].mean("hurst"), low["common"].mean("hurst")
    away = alpha - 1 / (alpha["hurst"] + 1)
    far = abs(away.sel(hurst=middle["hurst"], points=POINTS[-1]))
    white = gaussian_heights.stiffness(averages["force"].to_numpy(), 1.0, 1.0, 1.0)
    off = abs(low["stiffness"].mean("hurst") / xarray.DataArray(white, dims="load") - 1).max("load")
    worst = float(far["hurst"][int(np.argmax(far.to_numpy()))])
    ends = [float(high.isel(hurst=place)) for place in (0, -1)]
    said = f"{averages.attrs['lines']} lines a value"
    yield Verdict(
        "a constant exponent for H < 0",
        "constant",
        f"{_two(plateau)} for N = 2^9, 2^11 and H < -0.3, the same to {float(spread.max()):.3f}; {said}",
        bool(spread.max() < 0.03),
    )
    yield Verdict(
        "the constant grows with the number of points, in fits that leave out fewer than 20 springs (eq. 4.73)",
        f"{_two([resolution_exponent(n) for n in POINTS])} for N = 2^9, 2^11",
        f"{_two(plateau)}; of independent Gaussian heights in the same windows {_two(low['white'].mean('hurst'))}",
        bool(
            max(abs(float(p) - resolution_exponent(n)) for p, n in zip(plateau, POINTS, strict=True)) < 0.02
        ),
    )
    yield Verdict(
        "the relation of force and stiffness at low H depends on the number of modes",
        "it does",
        f"for N = 2^9 and 2^11 it is that of independent Gaussian heights, which knows no N, to {float(off[0]):.1%} "
        f"and {float(off[1]):.1%} at forces from {COMMON[0]:g} to {COMMON[1]:g}; fitted there alone the exponents are "
        f"{_two(common)}, both +-{float(low['common_error'].mean()):.3f}. With N grows the window of a fit, towards "
        "lower forces, where the curve is steeper",
        bool(off.max() > 0.02),
    )
    yield Verdict(
        "alpha = 1/(H + 1) between",
        "1/(H + 1)",
        f"for N = 2^11 within {float(far.max()):.3f} of it for 0.4 <= H <= 2 (most at H = {worst:g}); "
        f"{float(alpha.sel(points=POINTS[-1], hurst=-0.05, method='nearest')):.2f} instead of 1 near H = 0, errors "
        f"about {float(error.mean()):.3f}",
        bool(far.max() < 0.05),
    )
    yield Verdict(
        "the Hertzian exponent at the end",
        "1/3",
        f"{ends[0]:.3f} at H = {float(high['hurst'][0]):g}, {ends[1]:.3f} at H = {float(high['hurst'][-1]):g}",
        abs(ends[1] - 1 / 3) < 0.02,
    )
