"""Figure 18: how much the stiffness of surfaces and of lines of one type scatters."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from roughcontact.plot.drawing.level import level
from roughcontact.statistics.fit_window import CELLS
from roughcontact_thesis import drawing
from roughcontact_thesis.averaging import without_parameters
from roughcontact_thesis.ensembles import curve_averages, square_study
from roughcontact_thesis.figures import Scale, Studies
from roughcontact_thesis.line_ensembles import line_averages, line_studies
from roughcontact_thesis.ruling import ruled
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "scatter of the stiffness over surfaces and over lines of the same type"
CHOSEN = (
    "standard deviation over mean of the stiffness at each force; surfaces and lines differ only in their phases",
    "surfaces of figure 27; lines of 2^13 points",
    "faint where the mean is below the stiffness of 20 cells or springs: there single cells decide",
)
SIZE = (drawing.PAGE, 3.4)
CLAIM = 0.3
NEAR = 0.05


def studies(scale: Scale) -> Studies:
    """Return the studies of figure 27."""
    return square_study(scale), *line_studies(scale)


def averages(squares: xarray.Dataset, lines: xarray.Dataset) -> xarray.Dataset:
    """Return the scatter of surfaces and, named ``line_...``, of lines, and where it is resolved."""
    names = ["force", "stiffness", "scatter", "resolved"]
    surfaces = curve_averages(squares)[names]
    reduced = line_averages(lines.isel(points=-1))
    means = reduced["stiffness"]
    reduced = reduced.assign(resolved=(means > CELLS / lines["points"][-1]) & (means < 0.9))
    reduced = reduced[names].rename({name: f"line_{name}" for name in ("load", "hurst", *names)})
    sizes = {"points": int(lines["points"][-1]), "lines": reduced.attrs["lines"]}
    return without_parameters(surfaces).assign(without_parameters(reduced)).assign_attrs(sizes)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the scatter of surfaces (left) and of lines (right) against force."""
    left, right = figure.subplots(1, 2, sharey=True)
    every = np.concatenate([averages["hurst"], averages["line_hurst"]])
    colours = drawing.hurst_colours(every.min(), every.max())
    for axes, prefix, title in (
        (left, "", f"{averages.attrs['surfaces']} surfaces of {averages.attrs['cells']}² cells"),
        (right, "line_", f"{averages.attrs['lines']} lines of {averages.attrs['points']} points"),
    ):
        force = averages[f"{prefix}force"]
        for hurst in averages[f"{prefix}hurst"].to_numpy():
            one, colour = averages.sel({f"{prefix}hurst": hurst}), colours.to_rgba(hurst)
            scatter, resolved = one[f"{prefix}scatter"], one[f"{prefix}resolved"]
            axes.plot(force, scatter, color=colour, linewidth=0.7, alpha=0.5, zorder=2)
            axes.plot(force, scatter.where(resolved), color=colour, zorder=3)
        level(axes, CLAIM, "30 %", ha="right")
        axes.set_title(title, loc="center")
        drawing.label(axes, f"dimensionless {drawing.FORCE}", "", xscale="log")
    left.set(ylabel="standard deviation / mean of the stiffness", ylim=(0, 0.6))
    drawing.colour_key(figure, right, every)


def verdicts(averages: xarray.Dataset) -> Verdicts:
    """Compare the scatter with 30 %."""
    yield _verdict(averages, "", "surfaces", averages.attrs["surfaces"])
    yield _verdict(averages, "line_", "lines", averages.attrs["lines"])


def _verdict(averages: xarray.Dataset, prefix: str, method: str, samples: int) -> Verdict:
    scatter, force, hurst = (averages[prefix + name] for name in ("scatter", "force", "hurst"))
    resolved = scatter.where(averages[f"{prefix}resolved"] & (force <= 0.07 * (1 + 1e-9)))
    # Over the forces: a single one is uncertain by 1/sqrt(2 n) of itself.
    typical, most = resolved.mean(f"{prefix}load"), resolved.max(f"{prefix}load")
    worst = float(hurst[int(most.fillna(0).argmax(f"{prefix}hurst"))])
    used = force.to_numpy()[resolved.notnull().any(f"{prefix}hurst").to_numpy()]
    decades = np.log10(used.max() / used.min())
    return Verdict(
        f"the stiffness of {method} scatters by about 30 % at most",
        "the standard deviation of the stiffness for different samples is limited to about 30% over many orders of "
        "magnitude for the normal force F",
        "section 4.4.2, fig. 18",
        f"{float(typical.min()):.0%} to {float(typical.max()):.0%} on the average over forces, by Hurst exponent; at "
        f"most {float(most.max()):.0%} (H = {worst:.2f}), over {decades:.1f} decades where resolved; {samples} samples",
        ruled(most - CLAIM, most / np.sqrt(2 * samples), NEAR, words="30% + 5%", above=True),
    )
