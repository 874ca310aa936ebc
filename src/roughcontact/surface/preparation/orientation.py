"""Mirrored and rotated surfaces."""

from __future__ import annotations

from typing import Literal

import numpy as np

from roughcontact.grid import Grid
from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.surface import Surface
from roughcontact.validation import numeric_method, require

__all__ = ["flipped", "rotated", "transposed"]


@on_host_only
def transposed(surface: Surface) -> Surface:
    """Return the surface with rows and columns exchanged: mirrored about the diagonal of the picture.

    Parameters
    ----------
    surface : Surface

    Returns
    -------
    Surface
        On the grid with its axes exchanged.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rc.Surface(np.array([[0.0, 1e-6, 2e-6]]), rc.Grid((1, 3), (2e-6, 1e-6))).transposed().grid
    Grid(shape=(3, 1), spacing=(1e-06, 2e-06), periodic=(False, False))
    """
    return surface.with_heights(surface.heights.T, "transposed", _exchanged(surface.grid))


@on_host_only
def flipped(surface: Surface, axis: Literal["y", "x"]) -> Surface:
    """Return the surface mirrored along one axis.

    Parameters
    ----------
    surface : Surface
    axis : {"y", "x"}
        "y" exchanges top and bottom, "x" left and right. A line only has "x".

    Returns
    -------
    Surface
        On the same grid.

    Raises
    ------
    ValueError
        If the grid has no such axis.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rc.Surface(np.array([[0.0, 1e-6], [2e-6, 3e-6]]), rc.Grid((2, 2), 1e-6)).flipped("y").heights
    array([[2.e-06, 3.e-06],
           [0.e+00, 1.e-06]])
    """
    axes = {"x": -1} | ({"y": 0} if surface.grid.ndim == 2 else {})
    require(axis in axes, f"axis must be one of {', '.join(axes)}, not {axis!r}", place="axis")
    return surface.with_heights(np.flip(surface.heights, axes[axis]), f"flipped along {axis}")


@on_host_only
@numeric_method
def rotated(surface: Surface, quarters: int = 1) -> Surface:
    """Return the surface turned counter-clockwise, as the picture shows it.

    Parameters
    ----------
    surface : Surface
        On a grid of two axes.
    quarters : int
        Number of quarter turns, from -4 to 4; negative ones turn clockwise.

    Returns
    -------
    Surface
        After an odd number of quarters its grid has the axes exchanged.

    Raises
    ------
    ValueError
        If the surface is a line, or `quarters` is not a whole number from -4 to 4, such as an angle in degrees.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> rc.Surface(np.array([[0.0, 1e-6, 2e-6]]), rc.Grid((1, 3), (2e-6, 1e-6))).rotated().grid
    Grid(shape=(3, 1), spacing=(1e-06, 2e-06), periodic=(False, False))
    """
    require(surface.grid.ndim == 2, "only a surface of two axes can be turned", "flip a line")
    require(
        abs(quarters) <= 4,
        "quarters counts quarter turns, not degrees",
        f"give 1 for 90 degrees, not {quarters}",
        place="quarters",
    )
    grid = _exchanged(surface.grid) if quarters % 2 else surface.grid
    line = f"rotated by {90 * (quarters % 4)} degrees counter-clockwise"
    return surface.with_heights(np.rot90(surface.heights, quarters), line, grid)


def _exchanged(grid: Grid) -> Grid:
    return Grid(grid.shape[::-1], grid.spacing[::-1], grid.periodic[::-1])
