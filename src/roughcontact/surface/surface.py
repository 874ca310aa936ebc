"""Heights on a grid."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from textwrap import shorten
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from roughcontact import methods
from roughcontact.arrays import is_numpy, namespace, on_host
from roughcontact.errors import InputError, placed
from roughcontact.grid import Grid, RadialGrid
from roughcontact.guesses import hinted
from roughcontact.late import static
from roughcontact.surface.height_range import own_heights
from roughcontact.units import in_si
from roughcontact.validation import Array, require, shown

__all__ = ["Surface"]

ORIGIN = 80  # characters of the provenance in a line


@hinted
@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A topography: heights above a mean plane, positive toward the other body.

    Parameters
    ----------
    heights : array, shape ``grid.shape``
        Heights [m]. The first row is the top of the picture. NaN marks a point that was not measured. Arrays of other
        libraries (CuPy, PyTorch, ...) stay on their device and are pressed there in double precision. Analyses copy
        them into NumPy's memory. Prepare a surface in NumPy before you move its heights to a device.
    grid : Grid, float or tuple of float
        Positions of the cells and periodicity. The size of a cell [m], one number or ``(dy, dx)``, means
        ``Grid(heights.shape, spacing)``, the grid of a surface that is not periodic.
    provenance : tuple of str
        Origin of the heights and the steps of their preparation, oldest first.

    Raises
    ------
    ValueError
        If the heights do not fit the grid, are infinite, hold no measured point, or have a range below 1e-50 m (except
        0) or above 1e50 m, where products lose digits.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> surface = rc.Surface(np.array([[0.0, 1e-9, np.nan], [2e-9, 3e-9, 4e-9]]), 1e-6)
    >>> surface.shape, surface.missing, f"{surface.rms:.3g} m"
    ((2, 3), 1, '1.41e-09 m')
    >>> surface.levelled("mean").provenance
    ('mean height removed',)
    """

    heights: Array
    grid: Grid
    provenance: tuple[str, ...] = ()

    # NumPy's numbers then leave a product with a surface to the surface.
    __array_ufunc__: ClassVar[None] = None

    def __init__(
        self, heights: Array, grid: Grid | float | Sequence[float], provenance: Sequence[str] = ()
    ) -> None:
        if not isinstance(grid, Grid):
            wanted = f"grid must be a Grid, or the size of a cell [m] such as 1e-6, not {shown(grid)}"
            require(not isinstance(grid, RadialGrid | None), wanted, place="grid")
            shape = np.shape(heights)
            found = f"heights must be an array of one or two axes [m], not {shown(heights)}"
            require(len(shape) in (1, 2), found, place="heights")
            with placed("grid"):
                grid = Grid(shape, in_si(grid, "m", "grid"))
        object.__setattr__(self, "grid", grid)
        object.__setattr__(self, "heights", own_heights(in_si(heights, "m", "heights"), grid.shape))
        object.__setattr__(self, "provenance", tuple(provenance))

    def __repr__(self) -> str:
        """Return grid and origin of the heights in one line, without the heights."""
        origin = shorten("; ".join(self.provenance) or "heights as given", ORIGIN, placeholder=" ...")
        return f"Surface({self.grid}, {origin})"

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        """Return a copy of the heights [m] for `numpy.asarray`; with ``copy=False`` the heights of the surface."""
        return np.array(on_host(self.heights), dtype, copy=True if copy is None else copy)

    def __add__(self, other: Surface) -> Surface:
        """Return the sum of the heights of two surfaces on one grid; missing where either is missing."""
        return self._joined(other, 1) if isinstance(other, Surface) else NotImplemented

    def __sub__(self, other: Surface) -> Surface:
        """Return the difference of the heights of two surfaces on one grid; missing where either is missing."""
        return self._joined(other, -1) if isinstance(other, Surface) else NotImplemented

    def __mul__(self, factor: float) -> Surface:
        """Return the surface with its heights times a number."""
        factor = in_si(factor, None, "factor")
        if not isinstance(factor, int | float | np.integer | np.floating):
            return NotImplemented
        require(
            math.isfinite(factor),
            f"heights can be multiplied by a finite number, not by {factor}",
            place="heights",
        )
        return self.with_heights(self.heights * float(factor), f"heights times {factor:g}")

    __rmul__ = __mul__

    def _joined(self, other: Surface, sign: int) -> Surface:
        if is_numpy(self.heights) != is_numpy(other.heights):
            raise InputError(
                "two surfaces can only be added in one array library: the heights of only one are a NumPy array"
            )
        mine, theirs = self.grid, other.grid
        # Spacings that were computed in different ways may differ in their last digits.
        if (mine.shape, mine.periodic) != (theirs.shape, theirs.periodic) or not np.allclose(
            mine.spacing, theirs.spacing, rtol=1e-9, atol=0
        ):
            raise InputError(
                f"surfaces can only be added on one grid, not {mine} and {theirs}",
                "bring one onto the other by resampled()",
            )
        line = ("plus: " if sign > 0 else "minus: ") + ("; ".join(other.provenance) or "a surface")
        return self.with_heights(self.heights + sign * other.heights, line)

    def with_heights(self, heights: Array, line: str, grid: Grid | None = None) -> Surface:
        """Return a surface that was derived from this one, with a further line in its provenance.

        Parameters
        ----------
        heights : array, shape of the grid
            Its heights [m], NaN where not measured.
        line : str
            Description of the step.
        grid : Grid, optional
            Its grid, if it differs from that of this surface.

        Returns
        -------
        Surface

        Raises
        ------
        ValueError
            If the heights do not fit the grid, or are not those of a surface.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
        >>> ball.with_heights(np.maximum(ball.heights, -1e-6), "valleys filled to 1 um").provenance
        ('paraboloid, radius 0.0001 m', 'valleys filled to 1 um')
        """
        return replace(self, heights=heights, grid=grid or self.grid, provenance=(*self.provenance, line))

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of cells along each axis, that of the grid."""
        return self.grid.shape

    @property
    def measured(self) -> npt.NDArray[np.bool_]:
        """Mask of the points that hold a height, shape ``grid.shape``."""
        return ~namespace(self.heights).isnan(self.heights)  # type: ignore[no-any-return]

    @property
    def missing(self) -> int:
        """Number of points without a height."""
        xp = namespace(self.heights)
        return int(xp.count_nonzero(xp.isnan(self.heights)))

    @property
    def rms(self) -> float:
        """Root mean square height about the mean, over the measured points [m] (thesis, eq. 4.12)."""
        if is_numpy(self.heights):
            return float(np.nanstd(self.heights))
        xp, there = namespace(self.heights), self.measured
        heights = xp.astype(self.heights, xp.float64)  # squares of micrometres underflow in half precision
        count = int(xp.count_nonzero(there))
        deviation = xp.where(there, heights - xp.sum(xp.where(there, heights, 0.0)) / count, 0.0)
        return math.sqrt(float(xp.sum(deviation**2)) / count)

    # Functions of a surface have separate files; each step of preparation returns a new surface, with a further line
    # in the provenance.
    despiked = methods.despiked
    masked = methods.masked
    aligned = methods.aligned
    levelled = methods.levelled
    without_form = methods.without_form
    filtered = methods.filtered
    cropped = methods.cropped
    downsampled = methods.downsampled
    averaged = methods.averaged
    filled = methods.filled
    tapered = methods.tapered
    scanned = methods.scanned
    transposed = methods.transposed
    flipped = methods.flipped
    rotated = methods.rotated

    plot = methods.plot_surface
    to_dataset = methods.surface_dataset
    from_dataarray = static(methods.surface_of)
    _repr_html_ = methods.surface_html
