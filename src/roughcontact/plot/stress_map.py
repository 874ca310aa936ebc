"""The stress below a line of cells."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.evaluation.below import half_space_grid, loaded_part, ratio_of
from roughcontact.halfspace.subsurface.fields_below import stress
from roughcontact.labels.engineering_units import scale, written
from roughcontact.material import Solid
from roughcontact.plot.drawing.axes_for import axes_for
from roughcontact.plot.drawing.raster import colour_bar, length_scale
from roughcontact.plot.drawing.ticks import LABEL, label_axes
from roughcontact.validation import numeric

__all__ = ["von_mises_section"]

DEPTHS = 40


@numeric(deepest="m")
def von_mises_section(
    solution: Solution,
    solid: Solid | float,
    ax: Axes | None = None,
    *,
    row: int | None = None,
    deepest: float | None = None,
) -> Axes:
    """Draw the equivalent stress of von Mises below a row of cells, and mark its maximum.

    A line along the top shows which cells are in contact.

    Parameters
    ----------
    solution : Solution
        The solution for a half-space under a surface, with at least one cell in contact.
    solid : Solid or float
        The body below the surface, or its Poisson's ratio.
    ax : Axes, optional
        Axes to draw on; by default those of a new figure.
    row : int, optional
        Index of the row; by default the row of the largest pressure.
    deepest : float, optional
        Depth at which the picture ends [m]; by default the extent of the contact.

    Returns
    -------
    Axes

    Raises
    ------
    ValueError
        If the solution is not that of a half-space under a surface, if nothing is in contact, or if there is no such
        row.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4), 1e9, force=1e-2)
    >>> axes = rc.plot.von_mises_section(solution, 0.3, row=32, deepest=2e-5)
    >>> axes.get_xlabel(), axes.get_ylabel()
    ('x [µm]', 'depth [µm]')
    """
    solution = solution.on_host()
    grid, nu = half_space_grid(solution), ratio_of(solid)
    pressure, part, first = loaded_part(solution.pressure, grid)
    if row is None:
        row = int(np.argmax(solution.pressure.max(axis=1)))
    if not first[0] <= row < first[0] + part.shape[0]:
        raise InputError(
            f"row {row} lies beside the contact",
            f"choose one from {first[0]} to {first[0] + part.shape[0] - 1}",
            place="row",
        )
    loaded = np.flatnonzero(pressure.any(axis=0)), np.flatnonzero(pressure.any(axis=1))
    extent = max(step * (np.ptp(cells) + 1) for step, cells in zip(part.spacing[::-1], loaded, strict=True))
    bottom = float(extent) if deepest is None else float(deepest)
    if not (np.isfinite(bottom) and bottom > 0):
        raise InputError(
            f"the picture must end at a positive, finite depth [m], not {deepest}", place="deepest"
        )
    depths = (np.arange(DEPTHS) + 0.5) * bottom / DEPTHS
    here = row - first[0]
    values = np.stack([stress(pressure, part, depth, nu).von_mises[here] for depth in depths])

    axes = axes_for(ax, (6.4, 3.6))
    unit, length = scale(float(values.max()), "Pa"), length_scale(grid)
    left = first[1] * grid.spacing[1] * length.factor
    right = left + part.lengths[1] * length.factor
    edges = (left, right, bottom * length.factor, 0.0)
    image = axes.imshow(
        values * unit.factor, "inferno", vmin=0.0, interpolation="nearest", origin="upper", extent=edges
    )
    x = np.linspace(left, right, part.shape[1] + 1)
    touching = np.flatnonzero(pressure[here] > 0)
    axes.hlines(0 * touching, x[touching], x[touching + 1], color="#0072b2", linewidth=4, clip_on=False)
    deep, across = np.unravel_index(int(values.argmax()), values.shape)
    place = (x[across] + x[across + 1]) / 2, depths[deep] * length.factor
    axes.plot(*place, "+", color="black", markersize=9, markeredgewidth=1.5)
    largest, below = written(float(values.max()), "Pa"), written(float(depths[deep]), "m")
    axes.set_title(f"largest in this section {largest}, {below} deep", fontsize=LABEL)
    label_axes(axes, f"x [{length.unit}]", f"depth [{length.unit}]")
    colour_bar(axes, image, f"von Mises stress [{unit.unit}]")
    return axes
