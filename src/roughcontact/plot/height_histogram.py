"""The distribution of heights, drawn on axes that the caller owns."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.engineering_units import scale, written
from roughcontact.plot.raster import LABEL, TICK
from roughcontact.surface.analysis.histogram import height_histogram

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from roughcontact.surface.surface import Surface

__all__ = ["height_distribution"]

_BARS, _NORMAL = "#0072b2", "#d55e00"


def height_distribution(axes: Axes, surface: Surface, bins: int = 60) -> None:
    """Draw the density of the heights above their mean, and the normal one of the same rms; missing points count not.

    A flat surface has no normal distribution; it is drawn without one.
    """
    found = height_histogram(surface, bins=bins)
    reach = float(np.abs(found.edges).max())
    z = scale(reach, VARIABLES["heights"].unit)
    edges = found.edges * z.factor
    axes.stairs(found.density / z.factor, edges, fill=True, color=_BARS, alpha=0.45, label="heights")
    if found.rms > 0:
        points = np.linspace(found.edges[0], found.edges[-1], 400)
        label = f"normal, rms {written(found.rms, 'm')}"
        axes.plot(
            points * z.factor, found.gaussian(points) / z.factor, color=_NORMAL, linewidth=1.5, label=label
        )
    axes.set_xlim(float(edges[0]), float(edges[-1]))
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel(f"{VARIABLES['heights'].label} above the mean [{z.unit}]", fontsize=LABEL)
    axes.set_ylabel(f"probability density [1/{z.unit}]", fontsize=LABEL)
    axes.tick_params(labelsize=TICK)
    axes.legend(fontsize=TICK, frameon=False)
