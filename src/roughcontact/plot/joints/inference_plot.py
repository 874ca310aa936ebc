"""A measured joint in the band of joints like it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from roughcontact.labels.engineering_units import Scale, pretty, scale
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.ticks import TICK, label_axes, readable_ticks

if TYPE_CHECKING:
    from roughcontact.measurement.joint_inference import JointInference

__all__ = ["joint_inference"]

_COLOUR, _DATA = "#0072b2", "#d55e00"
_SHADES = (0.45, 0.2)  # of the bands
_SMOOTH = 30  # points of a band


def joint_inference(
    inference: JointInference, ax: Axes | None = None, *, units: Mapping[str, Scale] | None = None
) -> Axes:
    """Draw the measurement with its errors in the band of other joints of the posterior, of 50 and of 90 %.

    Parameters
    ----------
    inference : JointInference
        K/A0 is drawn against nominal pressure, or the closure since the first load.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    units : mapping of str to Scale, optional
        Units of the axes, by ``"nominal_pressure"`` and ``"interfacial_stiffness_per_area"`` or ``"closure"``.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> p = np.array([7e6, 15e6, 30e6, 65e6, 140e6])
    >>> data = rc.JointStiffness(p, 1.9e7 * p**0.88, errors=0.05)
    >>> found = rc.infer_joint(data, modulus=115e9, modulus_error=0.02, area=2.5e-6, branch="loading")
    >>> axes = found.plot(units={"nominal_pressure": rc.plot.Scale(1e-5, "bar")})
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('nominal pressure [bar]', 'interfacial stiffness per area K/A0 [N/µm/mm²]')
    """
    from roughcontact.measurement.inference_dataset import LEVELS, measured_points

    axes, points = axes_for(ax), measured_points(inference)
    x, y = (
        scale(float(values.max()), unit)
        if (given := (units or {}).get(name)) is None
        else Scale(given.factor, pretty(given.unit))
        for name, values, unit in (
            ("nominal_pressure", points.pressures, "Pa"),
            (points.name, points.values, points.unit),
        )
    )
    smooth = np.geomspace(points.pressures.min(), points.pressures.max(), _SMOOTH)
    for level, shade, (low, median, high) in zip(
        LEVELS, _SHADES, points.bands(inference, smooth), strict=True
    ):
        ends = (smooth * x.factor, low * y.factor, high * y.factor)
        axes.fill_between(*ends, color=_COLOUR, alpha=shade, linewidth=0, label=f"{level:.0%} of such joints")
        line = axes.plot(smooth * x.factor, median * y.factor, color=_COLOUR, linewidth=1.0)
    line[0].set_label("median")
    axes.errorbar(
        points.pressures * x.factor,
        points.values * y.factor,
        yerr=points.errors * y.factor,
        fmt="o",
        color=_DATA,
        markersize=4,
        capsize=3,
        label="measured",
    )
    axes.set_xscale("log")
    readable_ticks(axes.xaxis, float(points.pressures.max() / points.pressures.min()))
    if points.name != "closure":
        axes.set_yscale("log")
        readable_ticks(axes.yaxis, float(points.values.max() / points.values.min()))
    label_axes(axes, f"nominal pressure [{x.unit}]", f"{points.words} [{y.unit}]", grid=True)
    axes.legend(fontsize=TICK, frameon=False)
    return axes
