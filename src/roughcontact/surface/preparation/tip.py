"""The record of a surface by a tip of finite radius."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from roughcontact.errors import about
from roughcontact.grid import Grid
from roughcontact.surface.in_memory import on_host_only
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, lengths_method, moderate, require

__all__ = ["scanned"]


@on_host_only
@lengths_method
def scanned(surface: Surface, tip_radius: float, tip: Literal["sphere", "paraboloid"] = "sphere") -> Surface:
    """Return the surface as recorded by a tip that follows without force: the heights of its lowest point.

    Peaks become wider and valleys narrower, and the tip does not reach into valleys that are too narrow (thesis,
    section 2.1).

    Parameters
    ----------
    surface : Surface
    tip_radius : float
        Radius of the tip at its apex [m].
    tip : {"sphere", "paraboloid"}

    Returns
    -------
    Surface
        The recorded heights; missing points stay missing.

    Raises
    ------
    ValueError
        If the radius is not positive, or the tip is unknown.

    Notes
    -----
    The record is max over u of h(x + u) - t(u), the dilation of the surface by the tip t(u) = R - sqrt(R^2 - u^2)
    or u^2 / 2R. Only points of the grid touch the tip. Missing points do not touch it and stay missing. Time grows
    with the number of cells below the tip up to the range of the heights, area times 2 pi R range / cell; a paraboloid
    is treated axis by axis.

    Examples
    --------
    >>> import roughcontact as rc
    >>> waves = rc.shapes.wave(rc.Grid((32, 128), 1e-7, periodic=True), 1e-6, wavelength=3.2e-6)
    >>> scanned = waves.scanned(tip_radius=1e-6)
    >>> f"{waves.heights.min() * 1e6:.1f} um deep, {scanned.heights.min() * 1e6:.1f} um to a tip of 1 um"
    '-2.0 um deep, -1.3 um to a tip of 1 um'
    """
    if not (math.isfinite(tip_radius) and tip_radius > 0):
        raise about("tip_radius", f"must be positive and finite [m], not {tip_radius}")
    moderate(tip_radius, "tip_radius [m]")
    require(
        tip in ("sphere", "paraboloid"), f"tip must be 'sphere' or 'paraboloid', not {tip!r}", place="tip"
    )
    heights, grid = surface.heights, surface.grid
    measured = ~np.isnan(heights)
    span = float(heights[measured].max() - heights[measured].min())
    record = np.where(measured, heights, -np.inf)
    if tip == "paraboloid":
        reach = math.sqrt(2 * tip_radius * span)
        for axis in range(grid.ndim):
            record = _dilated(record, grid, reach, tip_radius, tip, (axis,))
    else:
        reach = math.sqrt(span * (2 * tip_radius - span)) if span < tip_radius else tip_radius
        record = _dilated(record, grid, reach, tip_radius, tip, tuple(range(grid.ndim)))
    line = f"scanned by a {tip} of radius {tip_radius:.6g} m"
    return surface.with_heights(np.where(measured, record, np.nan), line)


def _dilated(
    heights: Array, grid: Grid, reach: float, radius: float, tip: str, axes: tuple[int, ...]
) -> Array:
    """Return the largest height less that of the tip over all shifts along `axes` within `reach` [m]."""
    import scipy.ndimage

    # On a free axis no neighbour is further than the other end; on a periodic axis all cells have been visited by
    # then.
    far = [
        min(math.floor(reach / step * (1 + 1e-12)), n - 1) if axis in axes else 0
        for axis, (n, step) in enumerate(zip(heights.shape, grid.spacing, strict=True))
    ]
    shifts = np.meshgrid(
        *(np.arange(-n, n + 1) * step for n, step in zip(far, grid.spacing, strict=True)),
        indexing="ij",
        sparse=True,
    )
    square = np.asarray(sum(shift**2 for shift in shifts))
    drop = (
        square / (2 * radius)
        if tip == "paraboloid"
        else square / (radius + np.sqrt(np.maximum(radius * radius - square, 0)))
    )
    pads = [(n, n) if periodic else (0, 0) for n, periodic in zip(far, grid.periodic, strict=True)]
    record = scipy.ndimage.grey_dilation(  # type: ignore[call-overload]  # its stubs know whole numbers only
        np.pad(heights, pads, mode="wrap"),
        footprint=square <= reach * reach * (1 + 1e-12),
        structure=-drop,
        mode="constant",
        cval=-np.inf,
    )
    inner = tuple(slice(pad, pad + n) for (pad, _), n in zip(pads, heights.shape, strict=True))
    return np.asarray(record[inner])
