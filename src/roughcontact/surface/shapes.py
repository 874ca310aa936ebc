"""Smooth shapes and flat punches as surfaces.

The apex has height 0 and is the highest point; all else lies below. ``NaN`` marks cells where the body is absent:
beyond a sphere's equator and around a flat punch. They never touch. Coordinates are those of the grid: the centre
of cell i lies at ``(i + 1/2) * spacing`` from the first edge, y down the rows. A cell holds
the height at its centre, so on an even number of cells the default apex, the middle of the grid, lies between
cells and the highest cell a little below 0. Along a periodic axis distances are those to the nearest
image of the centre. On a grid of one axis a shape is its profile.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np

from roughcontact.grid import Grid
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, moderate, number, numeric, require

__all__ = [
    "cone",
    "cylinder",
    "flat_disc",
    "flat_ring",
    "flat_square",
    "flat_triangle",
    "paraboloid",
    "power_law",
    "sphere",
    "wave",
]

# Rounding must not decide on which side of a rim a cell lies.
_RIM = 1e-9

Centre = Sequence[float] | float | None


@numeric
def paraboloid(grid: Grid, radius: float, centre: Centre = None) -> Surface:
    """Return ``z = -r^2 / (2 R)``.

    Parameters
    ----------
    grid : Grid
    radius : float
        Radius of curvature R at the apex [m].
    centre : tuple of float, optional
        Place ``(y, x)`` of the apex [m] (on a line ``(x,)``); by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `radius` is not positive or `centre` does not fit the grid.
    """
    _positive(radius=radius)
    return Surface(-_squared(grid, centre) / (2 * radius), grid, (f"paraboloid, radius {radius:g} m",))


@numeric
def sphere(grid: Grid, radius: float, centre: Centre = None) -> Surface:
    """Return ``z = sqrt(R^2 - r^2) - R``, absent beyond the equator.

    Parameters
    ----------
    grid : Grid
    radius : float
        Radius R [m].
    centre : tuple of float, optional
        Place ``(y, x)`` of the apex [m] (on a line ``(x,)``); by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `radius` is not positive, `centre` does not fit the grid, or no cell holds a part of the sphere.
    """
    _positive(radius=radius)
    return _placed(_round(_squared(grid, centre), radius), grid, f"sphere, radius {radius:g} m")


@numeric
def cylinder(grid: Grid, radius: float, axis: Literal["x", "y"] = "x", centre: Centre = None) -> Surface:
    """Return a lying circular cylinder, ``z = sqrt(R^2 - s^2) - R`` at the distance s from its crest.

    Parameters
    ----------
    grid : Grid
        Of two axes.
    radius : float
        Radius R [m].
    axis : {"x", "y"}
        Direction along which the cylinder lies.
    centre : tuple of float, optional
        A point ``(y, x)`` of its crest [m]; by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `radius` is not positive, the grid has one axis, or no cell holds a part of the cylinder.
    """
    _positive(radius=radius)
    y, x = _plane(grid, centre)
    across = {"x": y, "y": x}.get(axis)
    if across is None:
        raise ValueError(f"axis must be 'x' or 'y', not {axis!r}")
    heights = np.broadcast_to(_round(across**2, radius), grid.shape)
    return _placed(heights, grid, f"cylinder along {axis}, radius {radius:g} m")


@numeric
def cone(grid: Grid, slope: float, centre: Centre = None) -> Surface:
    """Return ``z = -slope * r``.

    Parameters
    ----------
    grid : Grid
    slope : float
        Tangent of the angle between the flank and the ground, which is the cotangent of half the apex angle [-].
    centre : tuple of float, optional
        Place ``(y, x)`` of the apex [m] (on a line ``(x,)``); by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `slope` is not positive or `centre` does not fit the grid.
    """
    _positive(slope=slope)
    return Surface(-slope * np.sqrt(_squared(grid, centre)), grid, (f"cone, slope {slope:g}",))


@numeric
def power_law(grid: Grid, exponent: float, coefficient: float, centre: Centre = None) -> Surface:
    """Return ``z = -Q r^n`` (thesis, section 5.1).

    Parameters
    ----------
    grid : Grid
    exponent : float
        Exponent n > 0 [-].
    coefficient : float
        Coefficient Q > 0 [m^(1-n)].
    centre : tuple of float, optional
        Place ``(y, x)`` of the apex [m] (on a line ``(x,)``); by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `exponent` or `coefficient` is not positive or `centre` does not fit the grid.
    """
    _positive(exponent=exponent, coefficient=coefficient)
    heights = -coefficient * _squared(grid, centre) ** (exponent / 2)
    line = f"power law, exponent {exponent:g}, coefficient {coefficient:g} m^(1-n)"
    return Surface(heights, grid, (line,))


@numeric
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
    """
    return flat_ring(grid, 0.0, radius, centre)


@numeric
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
    """
    _positive(outer=outer)
    if not 0 <= inner < outer:
        raise ValueError(f"the inner radius must lie between 0 and the outer one {outer} m, not {inner}")
    y, x = _plane(grid, centre)
    squared = y**2 + x**2
    inside = (squared >= inner * inner * (1 - _RIM)) & (squared <= outer * outer * (1 + _RIM))
    name = f"flat ring, radii {inner:g} m and {outer:g} m" if inner else f"flat disc, radius {outer:g} m"
    return _placed(np.where(inside, 0.0, np.nan), grid, name)


@numeric
def flat_square(grid: Grid, side: float, centre: Centre = None) -> Surface:
    """Return a flat square punch with sides along x and y: 0 in the cells whose centre lies in it, absent elsewhere.

    Of two sides that run through cell centres the first one counts, so that a side of n cells covers n cells.

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
    """
    _positive(side=side)
    y, x = (part + _RIM * step for part, step in zip(_plane(grid, centre), grid.spacing, strict=True))
    inside = (y >= -side / 2) & (y < side / 2) & (x >= -side / 2) & (x < side / 2)
    return _placed(np.where(inside, 0.0, np.nan), grid, f"flat square, side {side:g} m")


@numeric
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
    """
    _positive(side=side)
    y, x = _plane(grid, centre)
    # The three sides are equally far from the centroid.
    inradius = side / (2 * math.sqrt(3)) * (1 + _RIM)
    inside = (y <= inradius) & (np.abs(x) * math.sqrt(3) / 2 - y / 2 <= inradius)
    return _placed(np.where(inside, 0.0, np.nan), grid, f"flat equilateral triangle, side {side:g} m")


@numeric
def wave(
    grid: Grid,
    amplitude: float,
    wavelength: float,
    axis: Literal["x", "y", "both"] = "x",
    centre: Centre = None,
) -> Surface:
    """Return ``z = h (cos(2 pi x / l) - 1)``, or the sum of two such waves along x and y (thesis, eq. 4.32).

    Parameters
    ----------
    grid : Grid
        On a periodic axis a whole number of waves must fit its length.
    amplitude : float
        Amplitude h of a wave [m]: half the height from trough to crest.
    wavelength : float
        Wavelength l [m].
    axis : {"x", "y", "both"}
        Direction along which the height changes. A line has its own only, "x".
    centre : tuple of float, optional
        Place ``(y, x)`` of a crest [m] (on a line ``(x,)``); by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `amplitude` or `wavelength` is not positive, or the waves do not fit a periodic grid.
    """
    _positive(amplitude=amplitude, wavelength=moderate(wavelength, "wavelength [m]"))
    wanted = {"x": (-1,), "y": (-2,), "both": (-2, -1)}.get(axis)
    if wanted is None or (grid.ndim == 1 and axis != "x"):
        raise ValueError(f"axis must be 'x', 'y' or 'both', on a line 'x', not {axis!r}")
    parts, heights = _from_centre(grid, centre), np.zeros(grid.shape)
    for which in wanted:
        waves = grid.lengths[which] / wavelength
        if grid.periodic[which] and abs(waves - round(waves)) > 1e-9 * waves:
            raise ValueError(
                f"{waves:g} waves do not fit a periodic length of {grid.lengths[which]:g} m: take a whole number"
            )
        # 1 - cos without its cancellation at the crest
        heights -= 2 * amplitude * np.sin(np.pi * parts[which] / wavelength) ** 2
    line = f"wave along {axis}, amplitude {amplitude:g} m, wavelength {wavelength:g} m"
    return Surface(heights, grid, (line,))


def _from_centre(grid: Grid, centre: Centre) -> tuple[Array, ...]:
    """Return the coordinates of the cells less those of the centre [m], an open mesh ``(y, x)`` or ``(x,)``."""
    if centre is None:
        centre = [length / 2 for length in grid.lengths]
    given = np.atleast_1d(number(centre, "centre [m]"))
    if given.shape != (grid.ndim,) or not np.isfinite(given).all():
        raise ValueError(f"centre needs {grid.ndim} finite coordinates [m], not {centre}")
    parts = []
    for n, step, c, periodic in zip(grid.shape, grid.spacing, given, grid.periodic, strict=True):
        part = (np.arange(n) + 0.5) * step - c
        if periodic:
            part -= n * step * np.round(part / (n * step))
        parts.append(part)
    return tuple(np.meshgrid(*parts, indexing="ij", sparse=True))


def _plane(grid: Grid, centre: Centre) -> tuple[Array, Array]:
    """Return the coordinates ``(y, x)`` on a grid of two axes."""
    require(grid.ndim == 2, "this shape needs a grid of two axes, not a line")
    y, x = _from_centre(grid, centre)
    return y, x


def _squared(grid: Grid, centre: Centre) -> Array:
    """Return the squared distance from the centre [m^2], shape ``grid.shape``."""
    total = np.zeros(grid.shape)
    for part in _from_centre(grid, centre):
        total += part**2
    return total


def _round(squared: Array, radius: float) -> Array:
    """Return sqrt(R^2 - r^2) - R without its cancellation at the apex; NaN beyond R."""
    square = radius * radius  # infinite where a power would overflow
    inside = np.where(squared <= square * (1 + _RIM), np.minimum(squared, square), np.nan)
    return np.asarray(-inside / (radius + np.sqrt(square - inside)))


def _placed(heights: Array, grid: Grid, name: str) -> Surface:
    if np.isnan(heights).all():
        raise ValueError(f"no cell centre lies in the {name}: refine the grid or move the centre")
    return Surface(heights, grid, (name,))


def _positive(**values: float) -> None:
    for name, value in values.items():
        require(math.isfinite(value) and value > 0, f"{name} must be positive and finite, not {value}")
