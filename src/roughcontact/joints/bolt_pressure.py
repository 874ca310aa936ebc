"""The pressure under a bolt at the interface of the clamped plates: an annulus of the cone of pressure.

The force of the bolt spreads in the plate as in a cone that begins under the head, at the angle alpha to the axis
(Rötscher, Die Maschinenelemente, 1927). At the depth t of the interface the cone is ``head + 2 t tan(alpha)`` wide.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.joints.pressure_field import PressureField
from roughcontact.labels.engineering_units import written
from roughcontact.validation import numeric, positive_scalar, require

__all__ = ["bolt_pressure"]

_CELLS = 200  # along a side of the square around the cone


@numeric(force="N", head="m", hole="m", thickness="m", half_angle="rad")
def bolt_pressure(
    *,
    force: float,
    head: float,
    hole: float,
    thickness: float,
    half_angle: float = math.pi / 6,
    distribution: Literal["even", "falling"] = "even",
    grid: Grid | None = None,
) -> PressureField:
    """Return the pressure of a bolt on the interface below one of the plates that it clamps.

    The plates are larger than the cone. A cell belongs to the annulus if its centre lies in it, and the sum of pressure
    times area over the cells is the force.

    Parameters
    ----------
    force : float
        Force of the bolt [N].
    head : float
        Diameter of the face of the head, or of its washer, on the plate [m].
    hole : float
        Diameter of the hole [m].
    thickness : float
        Thickness of the plate between the head and the interface [m].
    half_angle : float
        Angle alpha between the cone and the axis [rad].
    distribution : {"even", "falling"}
        The same pressure on the whole annulus, or a pressure that falls linearly to zero from the axis to the rim.
    grid : Grid, optional
        Cells of the face, with the axis of the bolt in the middle. By default 200 x 200 cells around the cone.

    Returns
    -------
    PressureField
        NaN in the hole.

    Raises
    ------
    ValueError
        If the head is not wider than the hole, a number is out of range, or the cone does not fit on the grid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.bolt_pressure(force=17e3, head=13e-3, hole=9e-3, thickness=10e-3)  # M8
    PressureField(200 x 200 cells, 1.7e+04 N, at most 4.147e+07 Pa)
    """
    for name, value in (("force", force), ("head", head), ("hole", hole), ("thickness", thickness)):
        positive_scalar(value, name)
    require(
        0 <= half_angle < math.pi / 2,
        f"the half angle of the cone must be less than 90 degrees, not {math.degrees(half_angle):g} degrees",
        "give one such as 30deg, which is 0.52 rad",
        place="half_angle",
    )
    if distribution not in ("even", "falling"):
        raise about("distribution", f"must be 'even' or 'falling', not {distribution!r}")
    if not head > hole:
        raise InputError(
            f"the head of {written(head, 'm', 6)} is not wider than the hole of {written(hole, 'm', 6)}",
            "give a wider head or washer, or a smaller hole",
            "head, hole",
        )
    width = head + 2 * thickness * math.tan(half_angle)
    if grid is None:
        grid = Grid((_CELLS, _CELLS), size=width)
    elif grid.ndim != 2 or min(grid.lengths) < width * (1 - 1e-9):
        raise InputError(
            f"the cone is {written(width, 'm')} wide at the interface, and does not fit on the grid",
            "give a larger grid, or leave it out",
            "grid",
        )
    y, x = (each - length / 2 for each, length in zip(grid.coordinates, grid.lengths, strict=True))
    radius = np.hypot(y[:, None], x)
    weight = np.ones(grid.shape) if distribution == "even" else width / 2 - radius
    weight[(2 * radius < hole) | (2 * radius >= width)] = 0.0
    require(weight.any(), "no cell lies between the hole and the cone", "give a finer grid", place="grid")
    pressure = weight * (force / (weight.sum() * grid.cell_area))
    pressure[2 * radius < hole] = np.nan
    return PressureField(pressure, grid)
