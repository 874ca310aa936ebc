"""Heights on a grid, and how to level them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from roughcontact.grid import Grid

__all__ = ["Surface"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A topography: heights above a mean plane, positive toward the other body.

    Parameters
    ----------
    heights : array, shape ``grid.shape``
        Heights [m]. The first row is the top of the picture. NaN marks a point that was not measured.
    grid : Grid
        Where the cells are and whether the surface repeats itself.
    provenance : tuple of str
        Where the heights come from and what was done to them, oldest first.

    Raises
    ------
    ValueError
        If the heights do not fit the grid, are infinite, or hold no measured point.
    """

    heights: Array
    grid: Grid
    provenance: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        given = np.asarray(self.heights)
        if given.dtype.kind not in "fiu":
            raise ValueError(f"heights must be real numbers [m], not of type {given.dtype}")
        heights = np.array(given, dtype=np.float64)  # a copy: a surface never changes
        if heights.shape != self.grid.shape:
            raise ValueError(
                f"heights of shape {heights.shape} do not fit the grid of shape {self.grid.shape}"
            )
        if np.isinf(heights).any():
            raise ValueError(
                f"{int(np.isinf(heights).sum())} heights are infinite; mark points without a measurement by NaN"
            )
        if np.isnan(heights).all():
            raise ValueError("all heights are NaN: the surface holds no measured point")
        heights.flags.writeable = False
        object.__setattr__(self, "heights", heights)
        object.__setattr__(self, "provenance", tuple(self.provenance))

    @property
    def measured(self) -> npt.NDArray[np.bool_]:
        """Mask of the points that hold a height, shape ``grid.shape``."""
        return ~np.isnan(self.heights)

    @property
    def missing(self) -> int:
        """Number of points without a height."""
        return int(np.isnan(self.heights).sum())

    @property
    def rms(self) -> float:
        """Root mean square height about the mean, over the measured points [m] (thesis, eq. 4.12)."""
        return float(np.nanstd(self.heights))

    def levelled(self, kind: Literal["mean", "plane"] = "plane") -> Surface:
        """Return the surface less its mean height or its least-squares plane; missing points are ignored."""
        if kind == "mean":
            trend: Any = np.nanmean(self.heights)
        elif kind == "plane":
            trend = _plane(self.heights)
        else:
            raise ValueError(f"levelling must be 'mean' or 'plane', not {kind!r}")
        return replace(
            self, heights=self.heights - trend, provenance=(*self.provenance, f"levelled by its {kind}")
        )


def _plane(heights: Array) -> Array:
    """Return the least-squares plane (on a line: the straight line) through the measured heights."""
    # Centred coordinates in [-1, 1] keep the normal equations well conditioned at any size and unit.
    axes = [np.linspace(-1, 1, n) if n > 1 else np.zeros(1) for n in heights.shape]
    basis = [np.ones(heights.shape), *np.broadcast_arrays(*np.meshgrid(*axes, indexing="ij"))]
    measured = ~np.isnan(heights)
    matrix = np.stack([b[measured] for b in basis], axis=1)
    # The offset is taken out first, so that heights far from zero keep their digits.
    offset = heights[measured].mean()
    coefficients = np.linalg.lstsq(matrix, heights[measured] - offset, rcond=None)[0]
    plane: Array = offset + sum(c * b for c, b in zip(coefficients, basis, strict=True))
    return plane
