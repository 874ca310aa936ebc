"""The profile of a body of revolution, as heights on rings."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError, about
from roughcontact.grid import RadialGrid
from roughcontact.guesses import hinted
from roughcontact.surface.height_range import is_elsewhere, own_heights
from roughcontact.units import in_si
from roughcontact.validation import Array

__all__ = ["RadialProfile"]


@hinted
@dataclass(frozen=True, slots=True, eq=False)
class RadialProfile:
    """Heights of a body of revolution, positive toward the other body.

    Parameters
    ----------
    heights : array, shape (n,)
        Heights of the rings [m]: ``-f(grid.radii)`` for a profile f(r) measured upwards from its lowest point. NaN
        marks a missing ring. The depth counts from the touch of the highest ring: for a body with its tip on the axis
        this is the innermost ring, whose middle lies ``f(grid.radii[0])`` lower than the tip.
    grid : RadialGrid
        The rings.
    provenance : tuple of str
        Origin of the heights.

    Raises
    ------
    ValueError
        If the heights do not fit the rings, are infinite, or are all NaN.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(100, radius=1e-4)
    >>> ball = rc.RadialProfile(-rings.radii**2 / (2 * 1e-3), rings)
    >>> solution = rc.press(ball, 1e9, force=1e-2, operator=rc.ring(rings, 1e9))
    >>> f"Hertz: {(0.75 * 1e-2 / 1e9) ** (2 / 3) / 1e-3 ** (1 / 3) * 1e9:.0f} nm, here {solution.depth * 1e9:.0f} nm"
    'Hertz: 383 nm, here 383 nm'
    """

    heights: Array
    grid: RadialGrid
    provenance: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.grid, RadialGrid):
            raise InputError(
                f"a radial profile lies on a RadialGrid, not on a {type(self.grid).__name__}", place="grid"
            )
        if is_elsewhere(self.heights):
            raise about("the heights", "of a radial profile must be a NumPy array", "copy them to the host")
        object.__setattr__(self, "heights", own_heights(in_si(self.heights, "m", "heights"), self.grid.shape))
        object.__setattr__(self, "provenance", tuple(self.provenance))

    @property
    def measured(self) -> npt.NDArray[np.bool_]:
        """Mask of the rings that hold a height, shape (n,)."""
        return ~np.isnan(self.heights)

    @property
    def missing(self) -> int:
        """Number of rings without a height."""
        return int(np.isnan(self.heights).sum())

    @property
    def rms(self) -> float:
        """Root mean square height about the mean over the area of the rings [m]."""
        there, areas = self.measured, self.grid.cell_area
        mean = np.average(self.heights[there], weights=areas[there])
        return math.sqrt(np.average((self.heights[there] - mean) ** 2, weights=areas[there]))
