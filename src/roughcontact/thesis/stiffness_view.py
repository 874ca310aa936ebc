"""Axes of dimensionless stiffness against dimensionless force, and a colour for each Hurst exponent."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.plot.raster import LABEL, TICK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

__all__ = ["FORCE_LABEL", "colour_key", "exponent_axes", "hurst_colours", "quiet", "stiffness_axes"]

FORCE_LABEL = r"dimensionless force $F\,/\,(E^* h L)$"


def stiffness_axes(axes: Axes) -> None:
    """Label both axes, logarithmic."""
    axes.set(xscale="log", yscale="log")
    axes.set_xlabel(FORCE_LABEL, fontsize=LABEL)
    axes.set_ylabel(r"dimensionless stiffness $k\,/\,(E^* L)$", fontsize=LABEL)
    quiet(axes)


def exponent_axes(axes: Axes, label: str) -> None:
    """Label axes of something that depends on the Hurst exponent."""
    axes.set_xlabel("Hurst exponent H", fontsize=LABEL)
    axes.set_ylabel(label, fontsize=LABEL)
    quiet(axes)


def quiet(axes: Axes) -> None:
    """Give axes small ticks and a faint grid."""
    axes.tick_params(labelsize=TICK, which="both")
    axes.grid(True, which="major", color="0.92", linewidth=0.8)
    axes.set_axisbelow(True)


def hurst_colours(low: float, high: float) -> ScalarMappable:
    """Return what turns Hurst exponents into colours."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    # The last of viridis is too pale for a line on white.
    span = max(high - low, 1e-9)
    return ScalarMappable(Normalize(low, high + 0.12 * span), "viridis")


def colour_key(figure: Figure, axes: Axes, colours: ScalarMappable, highest: float) -> None:
    """Put a colour bar of Hurst exponents beside the axes."""
    bar: Any = figure.colorbar(colours, ax=axes, pad=0.02)
    bar.ax.set_ylim(colours.norm.vmin, highest)
    bar.set_label("Hurst exponent H", fontsize=LABEL)
    bar.ax.tick_params(labelsize=TICK)
    bar.outline.set_linewidth(0.5)
