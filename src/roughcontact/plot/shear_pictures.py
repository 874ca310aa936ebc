"""The law of an interface under shear: backbones with a cycle, loss per cycle against amplitude, heat of a cycle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure

from roughcontact.joints.shear_dataset import shear_dataset
from roughcontact.joints.shear_law import ShearLaw
from roughcontact.labels.engineering_units import scale, written
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.ticks import TICK, label_axes, readable_ticks
from roughcontact.plot.maps import contact_field
from roughcontact.validation import numeric

if TYPE_CHECKING:
    import xarray

    from roughcontact.joints.slip_cycle import SlipCycle

__all__ = ["shear_figure"]

_POINTS, _AMPLITUDES = 200, 40  # of a line
_MOST = 8  # pressures
_END = 0.999  # of mu p: at gross slip, the loss of a free map is not known
_MARK: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": 4, "zorder": 3}


@numeric
def shear_figure(law: ShearLaw, table: xarray.Dataset, cycles: Sequence[SlipCycle] = ()) -> Figure:
    """Return the backbones beside the loss per cycle against the displacement amplitude, and the heat of a cycle.

    Of more than eight pressures, eight are drawn. The area is the last cycle of the table. Lines of the loss begin
    where more than single cells slip, and end at gross slip; dots are the cycles of the table. Crosses are computed
    cycles, and the map is the heat of the last one.

    Parameters
    ----------
    law : ShearLaw
    table : Dataset
        Its cycles, as `shear_dataset` returns them.
    cycles : sequence of SlipCycle, optional
        Computed cycles.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import roughcontact as rc
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), ("steel", "steel"), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> law = rc.shear_law(curve, ("steel", "steel"), friction=0.2)
    >>> figure = rc.plot.shear_figure(law, rc.shear_dataset(law, [3e7, 5e7], [0.5]))
    >>> [axes.get_ylabel() for axes in figure.axes]
    ['nominal tangential traction [MPa]', 'loss per cycle [mJ/m²]']
    """
    figure = Figure(figsize=(14.4 if cycles else 9.6, 4.2), layout="constrained")
    backbones, losses, *maps = figure.subplots(1, 3 if cycles else 2)
    column = {name: values.to_numpy() for name, values in table.items()}
    every = np.unique(column["nominal_pressure"])
    pressures = every[np.unique(np.linspace(0, len(every) - 1, _MOST).round().astype(int))]
    colours = colormaps["viridis"](np.linspace(0.85, 0.1, len(pressures)))
    lowest, last = law.normal.lowest, float(pressures[-1])
    most = float(law.displacement(law.friction * (last - lowest), last))
    x, y = scale(most, "m"), scale(law.friction * last, "Pa")
    loss = scale(float(np.nanmax(column["cycle_loss"], initial=0.0)), VARIABLES["cycle_loss"].unit)
    for pressure, colour in zip(pressures.tolist(), colours, strict=True):
        traction = law.friction * (pressure - lowest) * (1 - np.linspace(1, 0, _POINTS) ** 2)
        style: Any = {"color": colour, "linewidth": 1.2, "label": written(pressure, "Pa")}
        backbones.plot(law.displacement(traction, pressure) * x.factor, traction * y.factor, **style)
        end = min(1 - lowest / pressure, _END)
        shares = np.geomspace(min(law.smallest_share(pressure), end), end, _AMPLITUDES)
        line, here = shear_dataset(law, [pressure], shares), column["nominal_pressure"] == pressure
        for each, form in ((line, style), ({name: v[here] for name, v in column.items() if v.ndim}, _MARK)):
            places = (each["displacement_amplitude"] * x.factor, each["cycle_loss"] * loss.factor)
            losses.loglog(*places, **{"color": colour} | form)
    share = float(column["traction_share"][-1])
    if share >= law.smallest_share(last):
        loop = law.cycle(last, traction=share * law.friction * last)
        area: Any = {"color": "0.85", "zorder": 0, "label": f"cycle to {share:g} mu p"}
        backbones.fill(loop.displacement * x.factor, loop.traction * y.factor, **area)
    cross: Any = _MARK | {"color": "#d55e00", "marker": "x", "label": "by partial slip"}
    for cycle in cycles:
        losses.plot(cycle.loop.displacement[0] * x.factor, cycle.loop.loss * loss.factor, **cross)
    if cycles:
        loop = cycles[-1].loop
        backbones.plot(loop.displacement * x.factor, loop.traction * y.factor, **cross)
        [axes], pressed = maps, cycles[-1].reversal.problem.pressed.on_host()
        contact_field(pressed, cycles[-1].heat, ("heat of a cycle", VARIABLES["heat"].unit), axes)
    label_axes(
        backbones, f"tangential displacement [{x.unit}]", f"nominal tangential traction [{y.unit}]", grid=True
    )
    words = f"{VARIABLES['displacement_amplitude'].label} [{x.unit}]"
    label_axes(losses, words, f"{VARIABLES['cycle_loss'].label} [{loss.unit}]", grid=True)
    for axis, (low, high) in ((losses.xaxis, losses.get_xlim()), (losses.yaxis, losses.get_ylim())):
        readable_ticks(axis, high / low)
    title = VARIABLES["nominal_pressure"].label
    backbones.legend(fontsize=TICK, frameon=False, title=title, title_fontsize=TICK)
    return figure
