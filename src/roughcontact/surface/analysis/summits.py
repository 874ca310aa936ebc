"""Summits of a surface: their positions and curvatures."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, require

__all__ = ["MeasuredSummits", "find_summits"]

_Heights = Callable[[int, int], Array]


@dataclass(frozen=True, slots=True, eq=False)
class MeasuredSummits:
    """The points of a surface that stand above their eight neighbours.

    Attributes
    ----------
    rows, columns : array of int, shape (n,)
        Positions in cells.
    height : array, shape (n,)
        Height above the mean of the surface [m].
    curvature : array, shape (n, 2)
        Principal curvatures [1/m], the larger one first; positive on a dome.
    area : float
        Area of the points that were examined [m^2].
    """

    rows: npt.NDArray[np.int64]
    columns: npt.NDArray[np.int64]
    height: Array
    curvature: Array
    area: float

    @property
    def count(self) -> int:
        """Number of summits."""
        return self.height.size

    @property
    def density(self) -> float:
        """Summits per area [1/m^2]."""
        return self.count / self.area

    @property
    def mean_curvature(self) -> Array:
        """Mean of the two principal curvatures of each summit [1/m], shape (n,)."""
        return np.asarray(self.curvature.mean(axis=1))

    @property
    def radius(self) -> Array:
        """Radius of the sphere with the same Gaussian curvature, ``1/sqrt(k1 k2)`` [m], shape (n,)."""
        return np.asarray(1 / np.sqrt(self.curvature.prod(axis=1)))


@numeric
@analysed_on_host
def find_summits(surface: Surface) -> MeasuredSummits:
    """Return the summits of a surface: points higher than all eight neighbours.

    Parameters
    ----------
    surface : Surface
        Along free axes the outermost points are not examined, nor are points with a missing neighbour.

    Returns
    -------
    MeasuredSummits
        With curvatures from central differences. The few points whose smaller curvature is not positive by these
        differences (saddles between grid lines) are left out.

    Raises
    ------
    ValueError
        If the surface is a line, smaller than 3 x 3, or no point has eight measured neighbours.

    Notes
    -----
    Number and curvature depend on the spacing D of the points. They are properties of the surface only if its shortest
    waves are well resolved (q D below about pi/8); on a fractal they depend on the instrument.

    Examples
    --------
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> summits = rc.find_summits(rc.shapes.wave(grid, 1e-6, wavelength=32e-6, axis="both", centre=(0.5e-6, 0.5e-6)))
    >>> summits.count, f"{summits.density * grid.area:.0f}"
    (4, '4')
    """
    grid = surface.grid
    if grid.ndim != 2 or min(grid.shape) < 3:
        raise InputError(f"summits need a surface of at least 3 x 3 points, not shape {grid.shape}")
    z = np.pad(
        surface.heights, [(1, 1) if p else (0, 0) for p in grid.periodic], mode="wrap"
    )  # on a free axis the rim takes the place of the periodic copies
    ny, nx = z.shape[0] - 2, z.shape[1] - 2

    def at(row: int, column: int) -> Array:
        return z[1 + row : 1 + row + ny, 1 + column : 1 + column + nx]

    centre = at(0, 0)
    around = [at(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
    complete = ~np.isnan(centre)
    highest = np.ones(centre.shape, dtype=bool)
    for neighbour in around:
        complete &= ~np.isnan(neighbour)
        highest &= centre > neighbour  # false if either is missing
    require(complete.any(), "no point has eight measured neighbours")

    rows, columns = np.nonzero(highest & complete)
    curvature = _principal(lambda i, j: at(i, j)[rows, columns], grid.spacing)
    dome = curvature[:, 1] > 0
    shift = [0 if p else 1 for p in grid.periodic]
    return MeasuredSummits(
        rows=rows[dome] + shift[0],
        columns=columns[dome] + shift[1],
        height=centre[rows, columns][dome] - float(np.nanmean(surface.heights)),
        curvature=curvature[dome],
        area=int(complete.sum()) * grid.cell_area,
    )


def _principal(at: _Heights, spacing: tuple[float, ...]) -> Array:
    """Return the principal curvatures from heights `at` the neighbours, the larger first, shape (n, 2)."""
    dy, dx = spacing
    zxx = (at(0, 1) - 2 * at(0, 0) + at(0, -1)) / dx**2
    zyy = (at(1, 0) - 2 * at(0, 0) + at(-1, 0)) / dy**2
    zxy = (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * dx * dy)
    mean, half = -(zxx + zyy) / 2, np.hypot((zxx - zyy) / 2, zxy)
    return np.stack([mean + half, mean - half], axis=1)
