"""Smooth shapes and flat punches as surfaces.

The apex has height 0 and is the highest point. ``NaN`` marks cells where the body is absent:
beyond a sphere's equator and around a flat punch. They never touch. Coordinates are those of the grid: the centre
of cell i lies at ``(i + 1/2) * spacing`` from the first edge, y down the rows. A cell holds
the height at its centre, so on an even number of cells the default apex, the middle of the grid, lies between cells,
and the highest cell lies slightly below 0. Along a periodic axis distances are those to the nearest image of the
centre. On a grid of one axis a shape is its profile.
"""

from __future__ import annotations

from typing import Literal

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.surface.generation.about_centre import (
    RIM,
    Centre,
    from_centre,
    placed,
    plane,
    positive,
    squared,
)
from roughcontact.surface.generation.flat_punches import flat_disc, flat_ring, flat_square, flat_triangle
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, moderate, numeric

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


@numeric(radius="m", centre="m")
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

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=1e-4)
    >>> f"{rc.press(ball, 1e9, force=1e-2).contact_area * 1e12:.0f} um^2"  # Hertz: 260
    '260 um^2'
    """
    positive(radius=radius)
    return Surface(-squared(grid, centre) / (2 * radius), grid, (f"paraboloid, radius {radius:g} m",))


@numeric(radius="m", centre="m")
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

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.sphere(rc.Grid((64, 64), 1e-6), radius=3e-5)
    >>> ball.missing, f"{ball.heights[32, 60] * 1e6:.1f} um"  # beyond the equator there is none
    (1268, '-20.6 um')
    """
    positive(radius=radius)
    return placed(_round(squared(grid, centre), radius), grid, f"sphere, radius {radius:g} m")


@numeric(radius="m", centre="m")
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

    Examples
    --------
    >>> import roughcontact as rc
    >>> bar = rc.shapes.cylinder(rc.Grid((32, 32), 1e-6), radius=1e-4, axis="x")
    >>> f"{bar.heights[0, 0] * 1e6:.2f} um at the edge", bool((bar.heights[0] == bar.heights[0, 0]).all())
    ('-1.21 um at the edge', True)
    """
    positive(radius=radius)
    y, x = plane(grid, centre)
    across = {"x": y, "y": x}.get(axis)
    if across is None:
        raise about("axis", f"must be 'x' or 'y', not {axis!r}")
    heights = np.broadcast_to(_round(across**2, radius), grid.shape)
    return placed(heights, grid, f"cylinder along {axis}, radius {radius:g} m")


@numeric(centre="m")
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

    Examples
    --------
    >>> import roughcontact as rc
    >>> f"{rc.shapes.cone(rc.Grid((32, 32), 1e-6), slope=0.1).heights[16, 0] * 1e6:.2f} um"
    '-1.55 um'
    """
    positive(slope=slope)
    return Surface(-slope * np.sqrt(squared(grid, centre)), grid, (f"cone, slope {slope:g}",))


@numeric(centre="m")
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

    Examples
    --------
    >>> import roughcontact as rc
    >>> body = rc.shapes.power_law(rc.Grid((32, 32), 1e-6), exponent=4, coefficient=1e12)
    >>> f"{body.heights[16, 0] * 1e6:.2f} um"
    '-0.06 um'
    """
    positive(exponent=exponent, coefficient=coefficient)
    heights = -coefficient * squared(grid, centre) ** (exponent / 2)
    line = f"power law, exponent {exponent:g}, coefficient {coefficient:g} m^(1-n)"
    return Surface(heights, grid, (line,))


@numeric(amplitude="m", wavelength="m", centre="m")
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
        Direction along which the height changes; on a line only "x".
    centre : tuple of float, optional
        Place ``(y, x)`` of a crest [m] (on a line ``(x,)``); by default the middle of the grid.

    Returns
    -------
    Surface

    Raises
    ------
    ValueError
        If `amplitude` or `wavelength` is not positive, or the waves do not fit a periodic grid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> waves = rc.shapes.wave(rc.Grid((64, 64), 1e-6, periodic=True), amplitude=1e-7, wavelength=3.2e-5)
    >>> f"{waves.rms * 1e9:.1f} nm"  # amplitude over sqrt(2)
    '70.7 nm'
    """
    positive(amplitude=amplitude, wavelength=moderate(wavelength, "wavelength [m]"))
    wanted = {"x": (-1,), "y": (-2,), "both": (-2, -1)}.get(axis)
    if wanted is None or (grid.ndim == 1 and axis != "x"):
        raise about("axis", f"must be 'x', 'y' or 'both', on a line 'x', not {axis!r}")
    parts, heights = from_centre(grid, centre), np.zeros(grid.shape)
    for which in wanted:
        waves = grid.lengths[which] / wavelength
        if grid.periodic[which] and abs(waves - round(waves)) > 1e-9 * waves:
            raise InputError(
                f"{waves:g} waves do not fit a periodic length of {grid.lengths[which]:g} m",
                "take a whole number",
            )
        # 1 - cos without its cancellation at the crest
        heights -= 2 * amplitude * np.sin(np.pi * parts[which] / wavelength) ** 2
    line = f"wave along {axis}, amplitude {amplitude:g} m, wavelength {wavelength:g} m"
    return Surface(heights, grid, (line,))


def _round(squared: Array, radius: float) -> Array:
    """Return sqrt(R^2 - r^2) - R without its cancellation at the apex; NaN beyond R."""
    square = radius * radius  # becomes infinite, where a power would raise OverflowError
    inside = np.where(squared <= square * (1 + RIM), np.minimum(squared, square), np.nan)
    return np.asarray(-inside / (radius + np.sqrt(square - inside)))
