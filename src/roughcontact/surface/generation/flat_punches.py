"""Flat punches as surfaces: 0 where the body is, NaN around it; see `roughcontact.surface.generation.shapes`."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.errors import about
from roughcontact.grid import Grid
from roughcontact.surface.generation.about_centre import RIM, Centre, placed, plane, positive
from roughcontact.surface.surface import Surface
from roughcontact.validation import numeric

__all__ = ["flat_disc", "flat_ring", "flat_square", "flat_triangle"]


@numeric(radius="m", centre="m")
def flat_disc(grid: Grid, radius: float, centre: Centre = None) -> Surface:
    """Return a flat round punch: 0 in the cells whose centre lies in the disc, absent elsewhere.

    Parameters
    ----------
    grid : Grid
        Of two axes.
    radius : float
        Radius [m].
    centre : tuple of float, optional
        Its centre ``(y, x)`` [m]; by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `radius` is not positive, the grid has one axis, or no cell centre lies in the punch.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6)
    >>> punch = rc.press(rc.shapes.flat_disc(grid, radius=2e-5), 1e9, depth=1e-8)
    >>> f"{punch.stiffness / (2 * 1e9 * 2e-5):.2f}"  # over 2 E* a
    '1.00'
    """
    return flat_ring(grid, 0.0, radius, centre)


@numeric(inner="m", outer="m", centre="m")
def flat_ring(grid: Grid, inner: float, outer: float, centre: Centre = None) -> Surface:
    """Return a flat ring punch: 0 in the cells whose centre lies between two radii, absent elsewhere.

    Parameters
    ----------
    grid : Grid
        Of two axes.
    inner, outer : float
        Radii, ``0 <= inner < outer`` [m].
    centre : tuple of float, optional
        Its centre ``(y, x)`` [m]; by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If the radii are out of order, the grid has one axis, or no cell centre lies in the punch.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ring = rc.shapes.flat_ring(rc.Grid((64, 64), 1e-6), inner=1e-5, outer=2e-5)
    >>> f"{ring.measured.sum()} cells"  # pi (20^2 - 10^2) = 942
    '948 cells'
    """
    positive(outer=outer)
    if not 0 <= inner < outer:
        raise about("the inner", f"radius must lie between 0 and the outer one {outer} m, not {inner}")
    y, x = plane(grid, centre)
    squared = y**2 + x**2
    inside = (squared >= inner * inner * (1 - RIM)) & (squared <= outer * outer * (1 + RIM))
    name = f"flat ring, radii {inner:g} m and {outer:g} m" if inner else f"flat disc, radius {outer:g} m"
    return placed(np.where(inside, 0.0, np.nan), grid, name)


@numeric(side="m", centre="m")
def flat_square(grid: Grid, side: float, centre: Centre = None) -> Surface:
    """Return a flat square punch with sides along x and y: 0 in the cells whose centre lies in it, absent elsewhere.

    If two opposite sides pass through cell centres, only the cells on the first one belong to the punch: a side of n
    cells covers n cells.

    Parameters
    ----------
    grid : Grid
        Of two axes.
    side : float
        Length of a side [m].
    centre : tuple of float, optional
        Its centre ``(y, x)`` [m]; by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `side` is not positive, the grid has one axis, or no cell centre lies in the punch.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.shapes.flat_square(rc.Grid((64, 64), 1e-6), side=2e-5).measured.sum().item()  # cells
    400
    """
    positive(side=side)
    y, x = (part + RIM * step for part, step in zip(plane(grid, centre), grid.spacing, strict=True))
    inside = (y >= -side / 2) & (y < side / 2) & (x >= -side / 2) & (x < side / 2)
    return placed(np.where(inside, 0.0, np.nan), grid, f"flat square, side {side:g} m")


@numeric(side="m", centre="m")
def flat_triangle(grid: Grid, side: float, centre: Centre = None) -> Surface:
    """Return a flat equilateral punch: 0 in the cells whose centre lies in the triangle, absent elsewhere.

    One side lies along x; the corner across from it points to the first row.

    Parameters
    ----------
    grid : Grid
        Of two axes.
    side : float
        Length of a side [m].
    centre : tuple of float, optional
        Its centroid ``(y, x)`` [m]; by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `side` is not positive, the grid has one axis, or no cell centre lies in the punch.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.shapes.flat_triangle(rc.Grid((64, 64), 1e-6), side=4e-5).measured.sum().item()  # sqrt(3)/4 40^2 = 693
    710
    """
    positive(side=side)
    y, x = plane(grid, centre)
    # The three sides are equally far from the centroid.
    inradius = side / (2 * math.sqrt(3)) * (1 + RIM)
    inside = (y <= inradius) & (np.abs(x) * math.sqrt(3) / 2 - y / 2 <= inradius)
    return placed(np.where(inside, 0.0, np.nan), grid, f"flat equilateral triangle, side {side:g} m")
