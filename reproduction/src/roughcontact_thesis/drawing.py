"""How figures are drawn: one style, panels with letters, labelled axes, curves with errors, colours by exponent.

All is drawn within the settings `STYLE`, see `figures.drawn`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import xarray
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from roughcontact.plot.drawing.ticks import readable_ticks

__all__ = [
    "COLOURS",
    "COLUMN",
    "EXPONENT",
    "FORCE",
    "LABEL",
    "LAW",
    "LINES",
    "LOG",
    "PAGE",
    "STIFFNESS",
    "STYLE",
    "SURFACES",
    "TICK",
    "arrow",
    "band",
    "both_methods",
    "by_hurst",
    "colour_key",
    "exponent_laws",
    "family",
    "frameless",
    "hurst_axes",
    "hurst_colours",
    "key",
    "label",
    "legend_below",
    "lines_words",
    "named_ticks",
    "panels",
    "readable",
    "scale_bar",
    "stiffness_axes",
    "with_errors",
    "with_intervals",
]

Place = tuple[float, float]

COLUMN, PAGE = 3.5, 7.2  # inches: widths of a column and of a page of a journal
LABEL, TICK = 8, 7  # sizes of text there [points]

STYLE: Any = {
    "axes.labelsize": LABEL,
    "axes.titlelocation": "left",
    "axes.titlesize": LABEL,
    "font.size": LABEL,
    "legend.fontsize": TICK,
    "legend.frameon": False,
    "legend.title_fontsize": TICK,
    "legend.handlelength": 1.8,
    "lines.linewidth": 1.1,
    "lines.markersize": 3.5,
    "axes.linewidth": 0.7,
}
"""Settings of matplotlib under which every figure is drawn."""
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#b0508a", "#a67500")  # none too pale for print
LINES, SURFACES, LAW = "#c8290b", "black", "#0072b2"  # of both methods, and of what the thesis says
LOG: dict[str, Any] = {"xscale": "log", "yscale": "log"}
FORCE = r"force $F\,/\,(E^* h L)$"
STIFFNESS = r"stiffness $k\,/\,(E^* L)$"
EXPONENT = r"exponent $\alpha$ of $k \sim F^{\alpha}$"


def panels(figure: Figure, rows: int, columns: int, **given: Any) -> list[Axes]:
    """Return axes with letters in rows and columns; further keywords are those of `Figure.subplots`."""
    every = list(figure.subplots(rows, columns, squeeze=False, **given).ravel())
    for letter, axes in zip("abcdef", every, strict=False):
        axes.set_title(f"({letter})")
    return every


def label(axes: Axes, x: str, y: str, **given: Any) -> None:
    """Label both axes and lay a faint grid under the curves; further keywords are those of `Axes.set`."""
    axes.set(xlabel=x, ylabel=y, **given)
    axes.grid(True, which="major", color="0.92", linewidth=0.8)
    axes.set_axisbelow(True)


def frameless(axes: Axes, **given: Any) -> None:
    """Take the frame off a map drawn to scale; further keywords are those of `Axes.set`."""
    axes.set(xticks=[], yticks=[], aspect="equal", **given)
    axes.spines[:].set_visible(False)


def legend_below(axes: Axes, columns: int = 2, **given: Any) -> None:
    """Put the legend below the axes, where it covers nothing; further keywords are those of `Figure.legend`."""
    figure: Any = axes.figure
    handles, words = axes.get_legend_handles_labels()
    figure.legend(handles, words, loc="outside lower center", ncols=columns, **given)


def scale_bar(axes: Axes, start: Place, length: float, words: str) -> None:
    """Draw a bar of a length from its left end on a map, with what it is beneath."""
    axes.plot([start[0], start[0] + length], [start[1]] * 2, color="black", linewidth=1.4, clip_on=False)
    place: Any = (start[0] + length / 2, start[1])
    axes.annotate(words, place, (0, -2), textcoords="offset points", ha="center", va="top", fontsize=TICK)


def arrow(axes: Axes, start: Place, end: Place, style: str = "->", **given: Any) -> None:
    """Draw an arrow; further keywords are those of its line."""
    line = {"arrowstyle": style, "linewidth": 1.0, "shrinkA": 0, "shrinkB": 0} | given
    axes.annotate("", end, start, arrowprops=line, zorder=5)


def stiffness_axes(axes: Axes, **given: Any) -> None:
    """Label logarithmic axes of dimensionless stiffness against dimensionless force."""
    label(axes, f"dimensionless {FORCE}", f"dimensionless {STIFFNESS}", **LOG, **given)


def hurst_axes(axes: Axes, hurst: npt.NDArray[np.float64], y: str, **given: Any) -> None:
    """Label axes of something that depends on the Hurst exponent."""
    label(axes, "Hurst exponent H", y, xlim=(hurst[0] - 0.05, hurst[-1] + 0.05), **given)


def readable(axes: Axes) -> None:
    """Choose numbers of a logarithmic y axis that can be read."""
    low, high = axes.get_ylim()
    readable_ticks(axes.yaxis, high / low)


def named_ticks(axes: Axes, values: npt.NDArray[Any], words: str) -> None:
    """Put ticks at values of a logarithmic x axis, and nowhere else."""
    axes.set_xscale("log")
    axes.set_xticks(values, [words.format(value) for value in values])
    axes.minorticks_off()


def key(axes: Axes, style: str, words: str, **given: Any) -> None:
    """Add to the legend what a style of curve means, whatever its colour."""
    axes.plot([], [], style, label=words, **({"color": "0.3"} | given))


def with_errors(axes: Axes, one: xarray.Dataset, name: str, x: str = "force", **style: Any) -> None:
    """Draw a variable of a dataset, with the standard errors ``NAME_error`` where it holds them."""
    axes.errorbar(one[x], one[name], one.get(f"{name}_error"), **({"elinewidth": 0.9} | style))


def with_intervals(axes: Axes, x: npt.ArrayLike, one: xarray.Dataset, name: str, **style: Any) -> None:
    """Draw a variable of a dataset with its intervals, from ``NAME_low`` to ``NAME_high``."""
    bars = np.abs([one[f"{name}_{end}"] - one[name] for end in ("low", "high")])
    axes.errorbar(x, one[name], bars, **({"elinewidth": 0.9, "zorder": 4} | style))


def band(axes: Axes, one: xarray.Dataset, name: str, **style: Any) -> None:
    """Draw a variable that depends on the Hurst exponent as a curve in the band of its intervals."""
    low, high = one[f"{name}_low"], one[f"{name}_high"]
    axes.fill_between(one["hurst"], low, high, color=style["color"], alpha=0.2, linewidth=0)
    axes.plot(one["hurst"], one[name], **style)


def lines_words(points: int) -> str:
    """Return what the legend says of rough lines of a number of points, a power of two."""
    return rf"rough lines, $N = 2^{{{int(points).bit_length() - 1}}}$"


def both_methods(axes: Axes, averages: xarray.Dataset, name: str) -> None:
    """Draw a constant of the power law against H: of the finest rough lines in their band, of surfaces as crosses."""
    fine = averages.isel(points=-1)
    words = lines_words(int(fine["points"]))
    band(axes, fine, f"line_{name}", color=LINES, linewidth=1.6, label=words)
    words = f"surfaces, {averages.attrs['cells']}² cells"
    style = {"color": SURFACES, "markersize": 5.5, "markeredgewidth": 1.4}
    with_intervals(axes, averages["hurst"], averages, name, fmt="x", label=words, **style)


def exponent_laws(axes: Axes, hurst: npt.NDArray[np.float64], **style: Any) -> None:
    """Draw the exponents that the thesis expects: 1/(H + 1) up to H = 2, and 1/3 beyond."""
    given: Any = {"color": LAW, "zorder": 2} | style
    x = np.linspace(-0.02, 2, 200)
    axes.plot(x, 1 / (x + 1), label="1/(H + 1)", **given)
    axes.plot([2, hurst[-1] + 0.05], [1 / 3] * 2, label="1/3", **given | {"linestyle": "-."})


def family(
    axes: Axes,
    averages: xarray.Dataset,
    along: str,
    styles: Mapping[str, str],
    words: str,
    *,
    x: str = "force",
    colours: Sequence[str] = COLOURS,
    **given: Any,
) -> None:
    """Draw variables with a colour for each value along a dimension.

    Parameters
    ----------
    axes : Axes
    averages : Dataset
    along : str
        The dimension, or coordinate along one, that colours stand for.
    styles : dict
        Names of variables and how each is drawn, such as ``"o-"``; see `with_errors`.
    words : str
        What the legend says of a value: ``"H = {:g}"``.
    x : str
        The variable that the others are drawn against.
    colours : sequence of str
    **given
        Further keywords of `Axes.errorbar`.
    """
    for value, colour in zip(averages[along].values, colours, strict=False):
        one = averages.sel({along: value})
        names = iter(styles.items())
        name, style = next(names)
        with_errors(axes, one, name, x, fmt=style, color=colour, label=words.format(value), **given)
        for name, style in names:
            with_errors(axes, one, name, x, fmt=style, color=colour, **given)


def hurst_colours(low: float, high: float) -> ScalarMappable:
    """Return what turns Hurst exponents into colours."""
    # The last fifth of viridis is too pale for a line on white.
    span = max(high - low, 1e-9)
    return ScalarMappable(Normalize(low, high + 0.25 * span), "viridis")


def by_hurst(averages: xarray.Dataset) -> Iterator[tuple[float, xarray.Dataset, Any]]:
    """Yield each Hurst exponent with what belongs to it, and its colour."""
    hurst = averages["hurst"].values
    colours = hurst_colours(hurst.min(), hurst.max())
    for each in hurst:
        yield float(each), averages.sel(hurst=each), colours.to_rgba(each)


def colour_key(figure: Figure, axes: Axes, hurst: npt.NDArray[np.float64]) -> None:
    """Put a colour bar of Hurst exponents beside the axes."""
    colours = hurst_colours(hurst.min(), hurst.max())
    bar: Any = figure.colorbar(colours, ax=axes, pad=0.02)
    bar.ax.set_ylim(hurst.min(), hurst.max())
    bar.set_label("Hurst exponent H")
    bar.outline.set_linewidth(0.5)
