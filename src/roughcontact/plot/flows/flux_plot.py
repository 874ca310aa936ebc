"""Pictures of the current or heat through a contact: maps, and the resistances of its spots."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes

from roughcontact.evaluation.contact_flux import ContactFlux
from roughcontact.labels.column import CELLS
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.flux_columns import FLUX
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.raster import Window
from roughcontact.plot.drawing.ticks import LABEL, TICK, label_axes
from roughcontact.plot.maps import contact_field
from roughcontact.plot.profile_plot import field_profile

__all__ = ["flux_map", "spot_resistances"]

_AMONG, _ALONE = "#0072b2", "#d55e00"


def flux_map(
    flux: ContactFlux,
    ax: Axes | None = None,
    *,
    field: Literal["share", "density"] = "share",
    window: Window | None = None,
) -> Axes:
    """Draw the share of each spot or the density of each cell in colour over the heights; curves for rings.

    Parameters
    ----------
    flux : ContactFlux
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    field : {"share", "density"}
        The part of the current or heat that flows through each spot, or the density, whose values at the edges of
        spots depend on the grid.
    window : tuple of two slices, optional
        Rows and columns of the part of a map to show.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> axes = rc.plot.flux_map(rc.contact_flux(solution, resistivities=(1.7e-8, 1.7e-8), drop=1e-3))
    >>> axes.get_title()
    '500 mA, at most 500 mA through one spot'
    """
    if field == "share":
        values = np.concatenate([[0.0], 100 * flux.shares])[flux.spots.labels]
        label = "share of the spot", "%"
    else:
        column = FLUX[flux.kind][(CELLS,)][0]
        values, label = flux.density, (column.label, column.unit)
    if values.ndim == 1:
        axes = field_profile(flux.solution, values, label, ax)
    else:
        axes = contact_field(flux.solution, values, label, ax, window)
    unit = "A" if flux.kind == "electrical" else "W"
    words = f"{written(flux.total, unit)}, at most {written(flux.largest, unit)} through one spot"
    axes.set_title(words, fontsize=LABEL)
    return axes


def spot_resistances(flux: ContactFlux, ax: Axes | None = None) -> Axes:
    """Draw the resistance of each spot against its area: among the other spots, by itself, and Holm's.

    Parameters
    ----------
    flux : ContactFlux
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> axes = rc.plot.spot_resistances(rc.contact_flux(solution, conductivities=(400.0, 50.0)))
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('area of a contact spot [µm²]', 'thermal resistance of a contact spot [kK/W]')
    """
    axes, areas = axes_for(ax), flux.spots.areas
    x = scale(float(np.max(areas, initial=0.0)), VARIABLES["spot_area"].unit)
    electrical = flux.kind == "electrical"
    y = scale(float(np.median(flux.resistances)) if areas.size else 0.0, "ohm" if electrical else "K W-1")
    order = np.argsort(areas)
    among: Any = {"marker": "o", "s": 18, "color": _AMONG, "label": "among the other spots", "zorder": 3}
    alone: Any = {"marker": "o", "s": 22, "facecolors": "none", "edgecolors": _ALONE, "label": "alone"}
    holm: Any = {"color": "0.4", "linewidth": 1.0, "label": "Holm, round spot of equal area"}
    axes.scatter(areas * x.factor, flux.resistances * y.factor, **among)
    axes.scatter(areas * x.factor, flux.resistances_alone * y.factor, **alone)
    axes.plot(areas[order] * x.factor, flux.resistances_holm[order] * y.factor, **holm)
    axes.set(xscale="log", yscale="log")
    name = "resistance of a contact spot" if electrical else "thermal resistance of a contact spot"
    label_axes(axes, f"{VARIABLES['spot_area'].long_name} [{x.unit}]", f"{name} [{y.unit}]", grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes
