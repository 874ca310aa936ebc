"""Figure 18: how much the stiffness of surfaces and of lines of one type scatters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.raster import LABEL, TICK
from roughcontact.thesis.ensembles import curve_averages, square_study, without_parameters
from roughcontact.thesis.line_ensembles import line_averages, line_studies
from roughcontact.thesis.stiffness_view import colour_key, hurst_colours, quiet
from roughcontact.thesis.verdict import Verdict, judged

if TYPE_CHECKING:
    import xarray
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from roughcontact.study.study import Study
    from roughcontact.thesis.figures import Scale

__all__ = ["averages", "draw", "studies", "verdicts"]

TITLE = "scatter of the stiffness over surfaces and over lines of the same type"
CHOSEN = (
    "standard deviation over mean of the stiffness at each force; surfaces and lines differ in their phases alone",
    "surfaces of figure 27; lines of 2^13 points",
    "faint where the mean is below the stiffness of 20 cells or springs: there single cells decide",
)
SIZE = (8.2, 4.0)
CLAIM = 0.3
NEAR = 0.05

_CELLS = 20


def studies(scale: Scale) -> tuple[Study, ...]:
    """Return the studies of figure 27."""
    return square_study(scale), *line_studies(scale)


def averages(squares: xarray.Dataset, lines: xarray.Dataset) -> xarray.Dataset:
    """Return the scatter of surfaces and, named ``line_...``, of lines, and where it is resolved."""
    names = ["force", "stiffness", "scatter", "resolved"]
    surfaces = curve_averages(squares)[names]
    reduced = line_averages(lines.isel(points=-1))
    means = reduced["stiffness"]
    reduced = reduced.assign(resolved=(means > _CELLS / lines["points"][-1]) & (means < 0.9))
    reduced = reduced[names].rename({name: f"line_{name}" for name in ("load", "hurst", *names)})
    sizes = {"points": int(lines["points"][-1]), "lines": reduced.attrs["lines"]}
    return without_parameters(surfaces).assign(without_parameters(reduced)).assign_attrs(sizes)


def draw(figure: Figure, averages: xarray.Dataset) -> None:
    """Draw the scatter of surfaces (left) and of lines (right) against force."""
    left, right = figure.subplots(1, 2, sharey=True)
    highest = float(max(averages["hurst"].max(), averages["line_hurst"].max()))
    colours = hurst_colours(float(min(averages["hurst"].min(), averages["line_hurst"].min())), highest)
    for axes, prefix, title in (
        (left, "", f"{averages.attrs['surfaces']} surfaces of {averages.attrs['cells']}² cells"),
        (right, "line_", f"{averages.attrs['lines']} lines of {averages.attrs['points']} points"),
    ):
        force = averages[f"{prefix}force"].to_numpy()
        for hurst in averages[f"{prefix}hurst"].to_numpy():
            one = averages.sel({f"{prefix}hurst": hurst})
            scatter, resolved = one[f"{prefix}scatter"], one[f"{prefix}resolved"]
            colour = colours.to_rgba(hurst)
            axes.plot(force, scatter, color=colour, linewidth=0.7, alpha=0.3, zorder=2)
            axes.plot(force, scatter.where(resolved), color=colour, linewidth=1.3, zorder=3)
        _words(axes, title)
    left.set_ylabel("standard deviation / mean of the stiffness", fontsize=LABEL)
    left.set_ylim(0, 0.6)
    colour_key(figure, right, colours, highest)


def _words(axes: Axes, title: str) -> None:
    axes.axhline(CLAIM, color="0.2", linestyle="--", linewidth=1.0, zorder=4)
    axes.annotate(
        "30 %", (0.99, CLAIM), (0, 2), ("axes fraction", "data"), "offset points", ha="right", fontsize=TICK
    )
    axes.set(xscale="log")
    axes.set_title(title, fontsize=LABEL)
    axes.set_xlabel(r"dimensionless force $F\,/\,(E^* h L)$", fontsize=LABEL)
    quiet(axes)


def verdicts(averages: xarray.Dataset) -> tuple[Verdict, ...]:
    """Compare the scatter with 30 %."""
    return tuple(
        _verdict(averages, prefix, method, averages.attrs[count])
        for prefix, method, count in (
            ("", "boundary elements", "surfaces"),
            ("line_", "rough lines", "lines"),
        )
    )


def _verdict(averages: xarray.Dataset, prefix: str, method: str, samples: int) -> Verdict:
    scatter, force, hurst = (averages[prefix + name] for name in ("scatter", "force", "hurst"))
    resolved = scatter.where(averages[f"{prefix}resolved"] & (force <= 0.07 * (1 + 1e-9)))
    # Over the forces: a single one is uncertain by 1/sqrt(2 n) of itself.
    typical = resolved.mean(f"{prefix}load")
    most = resolved.max(f"{prefix}load")
    worst = float(hurst[int(most.fillna(0).argmax(f"{prefix}hurst"))])
    used = force.to_numpy()[resolved.notnull().any(f"{prefix}hurst").to_numpy()]
    decades = np.log10(used.max() / used.min())
    return Verdict(
        f"the scatter is limited to about 30 % over many orders of magnitude of the force ({method})",
        "30 %",
        f"{float(typical.min()):.0%} to {float(typical.max()):.0%} on the average over forces, by Hurst exponent; at "
        f"most {float(most.max()):.0%} (H = {worst:.2f}), over {decades:.1f} decades where resolved; "
        f"{samples} samples",
        judged(np.maximum(most - CLAIM, 0), most / np.sqrt(2 * samples), NEAR),
    )
