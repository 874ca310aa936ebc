"""The loop of an interface under shear: nominal tangential traction against displacement."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from roughcontact.labels.engineering_units import scale
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import TICK, label_axes
from roughcontact.validation import Array

if TYPE_CHECKING:
    from roughcontact.joints.slip_cycle import SlipCycle

__all__ = ["shear_loop"]

_COLOURS = ("0.55", "#0072b2", "#d55e00")


def shear_loop(cycle: SlipCycle, ax: Axes | None = None) -> Axes:
    """Draw first loading and the loop of a cycle, beside the loop of the law from the normal curve.

    Parameters
    ----------
    cycle : SlipCycle
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> pressed = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3), rubber, force=1e-3)
    >>> axes = rc.shear_cycle(pressed, rubber, friction=0.5, traction=2e3, steps=2).plot()
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('tangential displacement [nm]', 'nominal tangential traction [kPa]')
    """
    axes, loop = axes_for(ax), cycle.loop
    x, y = (
        scale(float(np.abs(values).max()), unit)
        for values, unit in ((loop.displacement, "m"), (loop.traction, "Pa"))
    )
    drawn: list[tuple[str, Array, Array, str]] = [
        ("first loading", cycle.first_displacement, cycle.first_traction, ".-"),
        ("cycle by partial slip", loop.displacement, loop.traction, ".-"),
    ]
    if (law := cycle.estimate) is not None:
        drawn.append(("law from the normal curve", law.displacement, law.traction, "--"))
    for (label, displacement, traction, style), colour in zip(drawn, _COLOURS, strict=False):
        axes.plot(
            displacement * x.factor, traction * y.factor, style, color=colour, linewidth=1.1, label=label
        )
    names = (VARIABLES[f"loop_{name}"].label for name in ("displacement", "traction"))
    label_axes(axes, *(f"{name} [{by.unit}]" for name, by in zip(names, (x, y), strict=True)), grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes
