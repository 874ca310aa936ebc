"""The pressure on the face of a joint, and the stiffness per area that follows from it."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from roughcontact.joints.whole_joint import Joint
from roughcontact.labels.engineering_units import scale
from roughcontact.labels.variables import VARIABLES
from roughcontact.plot.drawing.raster import colour_bar, length_scale, part, show

__all__ = ["joint_figure"]

_CENTRE = "#d6006c"


def joint_figure(joint: Joint) -> Figure:
    """Return the pressure field beside the stiffness per area, with the centre of stiffness; no face is white.

    Parameters
    ----------
    joint : Joint

    Returns
    -------
    Figure

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.examples.surface("ground")
    >>> law = rc.normal_law(rc.loading_curve(surface, 1e11, pressures=[1e7, 3e7, 1e8]))
    >>> figure = rc.plot.joint_figure(rc.joint(law, rc.PressureField(np.full((2, 3), 5e7), 1e-3)))
    >>> [axes.get_xlabel() for axes in figure.axes]
    ['x [mm]', 'x [mm]']
    """
    grid = joint.field.grid
    height, width = grid.lengths
    beside = width <= 1.8 * height
    figure = Figure(
        figsize=(9.0, 4.2) if beside else (7.0, 1.8 + 11.0 * height / width), layout="constrained"
    )
    panels = figure.subplots(1, 2) if beside else figure.subplots(2, 1)
    maps = {
        "nominal_pressure": joint.field.pressure,
        "interfacial_stiffness_per_area": joint.stiffness_per_area,
    }
    unit = length_scale(grid).factor
    for axes, (name, values) in zip(panels, maps.items(), strict=True):
        largest, column = float(np.nanmax(values)), VARIABLES[name]
        chosen = scale(largest, column.unit)
        limits = (0.0, largest * chosen.factor)
        image = show(axes, values * chosen.factor, grid, part(grid, None), "viridis", limits)
        axes.plot(*(each * unit for each in joint.centre), "+", color=_CENTRE, markersize=9)
        colour_bar(axes, image, f"{column.label} [{chosen.unit}]")
    return figure
