"""Slopes of the triangles between neighbouring points."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roughcontact.surface.surface import Surface

__all__ = ["gradient_and_area"]

Array = npt.NDArray[np.float64]


def gradient_and_area(surface: Surface) -> tuple[float, float]:
    """Return the root mean square gradient and the relative excess of area of the surface through its points.

    Sdq and Sdr (ISO 25178-2:2021, 4.4.2 and 4.4.3). Between four points the surface is cut into triangles along both
    diagonals, and the two ways averaged. Triangles with a missing corner are left out. Along a periodic axis the last
    points are joined to the first.

    Raises
    ------
    ValueError
        If no triangle is complete.
    """
    z, (dy, dx) = surface.heights, surface.grid.spacing
    z = np.pad(z, [(0, 1) if periodic else (0, 0) for periodic in surface.grid.periodic], mode="wrap")
    along_x, along_y = np.diff(z, axis=1) / dx, np.diff(z, axis=0) / dy
    squares = area = 0.0
    number = 0
    # Each triangle has one edge along x, above or below, and one along y, left or right.
    for x in (along_x[:-1], along_x[1:]):
        for y in (along_y[:, :-1], along_y[:, 1:]):
            steepness = x**2 + y**2
            steepness = steepness[~np.isnan(steepness)]
            number += steepness.size
            squares += float(steepness.sum())
            # sqrt(1 + s) - 1 without loss for small slopes.
            area += float((steepness / (np.sqrt(1 + steepness) + 1)).sum())
    if not number:
        raise ValueError("no three neighbouring points are measured: there is no gradient")
    return float(np.sqrt(squares / number)), area / number
