"""Figure 23: the exponent of rough lines against the Hurst exponent, for two numbers of points."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.statistics.fit_window import force_window
from roughcontact.theory.springs import gaussian_heights
from roughcontact_thesis import drawing, line_ensembles
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.ruling import VICINITY, Ruling, exactly, ranged, ruled, ruled_in_middle
from roughcontact_thesis.verdict import Verdict, Verdicts, series

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "exponent of rough lines against the Hurst exponent, two resolutions"
POINTS = (2**9, 2**11)
NEAR = 0.1  # of an exponent: what counts as agreement with a law
COMMON = (0.03, 0.07)  # forces at which 35 springs of 2^9 and more carry load where H is low
CHOSEN = (
    "27 Hurst exponents from -0.95 to 2.95; 1000 lines of each, on the small scale 200",
    "fits: more than 20 springs, forces up to 0.07, means over the lines by least squares in logarithms",
    f"beside them one window for both, forces from {COMMON[0]:g} to {COMMON[1]:g}",
)
SIZE = (drawing.COLUMN, 3.6)

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
    drawing.key(axes, ":", "independent Gaussian heights", linewidth=2.2)
    drawing.exponent_laws(axes, hurst, color="black", zorder=4, linestyle="--")
    drawing.hurst_axes(axes, hurst, drawing.EXPONENT, ylim=(0.25, 1.02))
    drawing.legend_below(axes)


def _two(values: xarray.DataArray | list[float]) -> str:
    return series(values, between=" and ")


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the plateau at low H, its dependence on the number of points, and the law in between."""
    alpha = averages["exponent"]
    low = averages.sel(hurst=slice(None, -VICINITY - 1e-9))
    high = averages.isel(points=-1).sel(hurst=slice(2 + VICINITY, None))
    fine = averages.isel(points=-1)
    plateau, common = low["exponent"].mean("hurst"), low["common"].mean("hurst")
    away = low["exponent"] - plateau
    hurst = alpha["hurst"].where(alpha["hurst"] > -1 + 1e-9)
    law = fine["exponent"] * (hurst + 1) - 1
    spread = fine["exponent_error"] * (hurst + 1)
    said = f"{averages.attrs['lines']} lines a value"
    far = law.where(abs(hurst - 1) >= 1 + VICINITY, drop=True)
    yield Verdict(
        "a constant exponent of lines below H = 0",
        "starting from a constant value for H < 0",
        "section 4.5.2, fig. 23",
        f"{_two(plateau)} for N = 2^9, 2^11, the same to {float(abs(away).max()):.3f}; {said}",
        # Values share their phases: the error of a difference is at most the sum of both.
        ruled(away, low["exponent_error"] + low["exponent_error"].max("hurst"), 0.03, "+.3f"),
    )
    yield _modes(low, common)
    yield Verdict(
        "alpha = 1/(H + 1) for lines",
        "We will call this region the Pohrt/Popov-range, because it limits the validity of the Pohrt/Popov-power-law "
        "eq. 4.53 with α = (H + 1)^-1.",
        "section 4.5.2",
        f"N = 2^11: {ranged(law, spread, NEAR)}; {said}",
        ruled_in_middle(law, spread, NEAR),
    )
    yield Verdict(
        "the power law 1/(H + 1) ends at H = 0 and 2",
        "the power law can only be valid for 0 < H < 2, but deviations are expected in the vicinity of these limits.",
        "section 4.4.2, eq. 4.52",
        f"exponents of lines of 2^11 points are {float(far.min()):+.0%} to {float(far.max()):+.0%} from it "
        "further than "
        f"{VICINITY:g} outside",
        _ends_there(abs(far) - 3 * spread.sel(hurst=far["hurst"])),
    )
    yield Verdict(
        "the exponent of Hertz for lines above H = 2",
        "ending at the Hertzian regime",
        "section 4.5.2, fig. 23",
        f"{float(high['exponent'][0]):.3f} at H = {float(high['hurst'][0]):g}, "
        f"{float(high['exponent'][-1]):.3f} at H = "
        f"{float(high['hurst'][-1]):g}",
        ruled(3 * high["exponent"] - 1, 3 * high["exponent_error"], NEAR),
    )


def _ends_there(beyond: xarray.DataArray) -> Ruling:
    """Return whether all exponents are off the law by more than what counts as agreement."""
    return exactly(
        bool((beyond > NEAR).all()), f"off by more than {NEAR:.0%}", f"at least {float(beyond.min()):.0%}"
    )


def _modes(low: xarray.Dataset, common: xarray.DataArray) -> Verdict:
    """Return whether the number of modes makes the exponent at low H, as fitted and at given forces."""
    white = xarray.DataArray(gaussian_heights.stiffness(low["force"].to_numpy(), 1.0, 1.0, 1.0), dims="load")
    off = low["stiffness"] / white - 1
    grown = low["exponent"].diff("points").mean("hurst")
    same = ruled(off, low["stiffness_error"] / white, 0.05)
    fitted = bool(grown.item() > 3 * float(low["exponent_error"].sum("points").max()))
    rule: Ruling = same
    if fitted:
        word = {"holds": "holds in part", "does not hold": "holds"}.get(same.word, "not decided")
        part = "of fits above 20 springs, not at given forces" if word == "holds in part" else ""
        rule = Ruling(word, "5% of k at given forces", same.span, same.trigger, part)  # type: ignore[arg-type]
    return Verdict(
        "the number of modes decides about the exponent of lines at low H",
        "More specifically for this region, the resulting power in the force-stiffness-relation depends on the number "
        "of modes that are included.",
        "section 4.5.2",
        f"fitted above 20 springs {_two(low['exponent'].mean('hurst'))} for N = 2^9, 2^11; at forces from "
        f"{COMMON[0]:g} to {COMMON[1]:g} {_two(common)}, both ± {float(low['common_error'].mean()):.3f}, and there the "
        "stiffness is that of independent Gaussian heights, which does not depend on N, to "
        f"{float(abs(off).max()):.1%}. With N grows the window of a fit, towards lower forces, where the curve is "
        "steeper",
        rule,
    )
