"""What a tip of finite radius makes of a surface."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from roughcontact.validation import moderate, numeric

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["scanned"]

Array = npt.NDArray[np.float64]


@numeric
def scanned(surface: Surface, tip_radius: float, tip: Literal["sphere", "paraboloid"] = "sphere") -> Surface:
    """Return the surface as a tip records it that follows without force: the heights of its lowest point.

    Peaks come out wider, valleys narrower, and those too narrow for the tip are not reached (thesis, section 2.1).

    Parameters
    ----------
    surface : Surface
    tip_radius : float
        Radius of the tip at its apex [m].
    tip : {"sphere", "paraboloid"}

    Raises
    ------
    ValueError
        If the radius is not positive, or no such tip is known.

    Notes
    -----
    The record is max over u of h(x + u) - t(u), the dilation of the surface by the tip t(u) = R - sqrt(R^2 - u^2)
    or u^2 / 2R. Points of the grid alone touch the tip. Missing points touch nothing and stay missing. Time grows
    with the number of cells below the tip up to the range of the heights, area times 2 pi R range / cell; a
    paraboloid is done axis by axis.
    """
    if not (math.isfinite(tip_radius) and tip_radius > 0):
        raise ValueError(f"tip_radius must be positive and finite [m], not {tip_radius}")
    moderate(tip_radius, "tip_radius [m]")
    if tip not in ("sphere", "paraboloid"):
        raise ValueError(f"tip must be 'sphere' or 'paraboloid', not {tip!r}")
    heights, grid = surface.heights, surface.grid
    measured = ~np.isnan(heights)
    solid = np.where(measured, heights, -np.inf)
    span = float(heights[measured].max() - heights[measured].min())
    if tip == "paraboloid":
        record = solid
        for axis in range(grid.ndim):
            reach = math.sqrt(2 * tip_radius * span)
            record = _dilated(record, grid.spacing, grid.periodic, reach, tip_radius, tip, (axis,))
    else:
        reach = math.sqrt(span * (2 * tip_radius - span)) if span < tip_radius else tip_radius
        record = _dilated(solid, grid.spacing, grid.periodic, reach, tip_radius, tip, range(grid.ndim))
    line = f"scanned by a {tip} of radius {tip_radius:.6g} m"
    return replace(
        surface, heights=np.where(measured, record, np.nan), provenance=(*surface.provenance, line)
    )


def _dilated(
    heights: Array,
    spacing: tuple[float, ...],
    periodic: tuple[bool, ...],
    reach: float,
    radius: float,
    tip: str,
    axes: range | tuple[int, ...],
) -> Array:
    """Return the largest height less the tip's over all shifts along `axes` within `reach` [m]."""
    far = [0] * heights.ndim
    for axis in axes:
        most = math.floor(reach / spacing[axis] * (1 + 1e-12))
        # On a free axis no neighbour is farther than the other end; on a periodic one all have been met by then.
        far[axis] = min(most, heights.shape[axis] - 1)
    pads = [(n, n) for n in far]
    wide = heights
    for axis, pad in enumerate(pads):
        around = [pad if k == axis else (0, 0) for k in range(heights.ndim)]
        free = np.pad(wide, around, constant_values=-np.inf)
        wide = np.pad(wide, around, mode="wrap") if periodic[axis] else free
    result = heights.copy()
    scratch = np.empty_like(result)
    for shift in np.ndindex(*(2 * n + 1 for n in far)):
        offset = [k - n for k, n in zip(shift, far, strict=True)]
        square = sum((k * step) ** 2 for k, step in zip(offset, spacing, strict=True))
        if square > reach * reach * (1 + 1e-12):
            continue
        drop = (
            square / (2 * radius)
            if tip == "paraboloid"
            else square / (radius + math.sqrt(max(radius * radius - square, 0)))
        )
        window = tuple(slice(k, k + n) for k, n in zip(shift, heights.shape, strict=True))
        np.subtract(wide[window], drop, out=scratch)
        np.maximum(result, scratch, out=result)
    return result
