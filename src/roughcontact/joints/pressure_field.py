"""The contact pressure on the face of a joint: a map of nominal pressures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from roughcontact.errors import about, placed
from roughcontact.grid import Grid
from roughcontact.guesses import hinted
from roughcontact.units import in_si
from roughcontact.validation import Array, number, require

__all__ = ["PressureField"]

_PER_DECADE = 10  # loads that a curve of the field gets
_DECADES = 3  # below the largest pressure: the pressure below them carries little of the force


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class PressureField:
    """The nominal contact pressure on the face of a joint.

    Parameters
    ----------
    pressure : array, shape (ny, nx)
        Nominal pressure of each cell [Pa]: 0 where the face is open, NaN where there is no face, as in a hole.
    grid : Grid, float or tuple of float
        Cells of the face, or the size of one [m]: one number or ``(dy, dx)``.

    Raises
    ------
    ValueError
        If a pressure is negative or infinite, none is positive, or the shape does not fit.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> x = rc.Grid((20, 40), 1e-3).coordinates[1]
    >>> field = rc.PressureField(np.broadcast_to(2e6 * x / 0.02, (20, 40)), 1e-3)  # rising along x
    >>> field
    PressureField(20 x 40 cells, 1600 N, at most 3.95e+06 Pa)
    """

    pressure: Array
    grid: Grid

    def __init__(self, pressure: Array, grid: Grid | float | Sequence[float]) -> None:
        p = np.array(number(in_si(pressure, "Pa", "pressure"), "pressure [Pa]"))
        if not isinstance(grid, Grid):
            with placed("grid"):
                grid = Grid(p.shape, in_si(grid, "m", "grid"))
        if p.ndim != 2 or p.shape != grid.shape:
            words = f"of shape {p.shape} does not fit the cells {grid.shape} of a face"
            raise about(
                "pressure", words, "give an array of shape (ny, nx), and its grid or the size of a cell"
            )
        require(
            ~((p < 0) | np.isinf(p)),
            "the pressure on a face must be finite and not negative, because the law of an interface holds no tension",
            "give 0 where the face is open, and NaN where there is no face",
            place="pressure",
            value=p,
        )
        require(
            (p > 0).any(),
            "no cell of the face is under pressure",
            "give a field with a force",
            place="pressure",
        )
        p.flags.writeable = False
        object.__setattr__(self, "pressure", p)
        object.__setattr__(self, "grid", grid)

    @property
    def force(self) -> float:
        """Normal force [N]."""
        return float(np.nansum(self.pressure)) * self.grid.cell_area

    @property
    def face_area(self) -> float:
        """Area of the face, open cells included [m^2]."""
        return int(np.count_nonzero(~np.isnan(self.pressure))) * self.grid.cell_area

    @property
    def loads(self) -> Array:
        """Nominal pressures for a curve from which the law of this face follows [Pa].

        Ten per decade up to the largest pressure, from the lowest on, or from a thousandth of the largest on.
        """
        high = float(np.nanmax(self.pressure))
        low = max(float(self.pressure[self.pressure > 0].min()), high * 10.0**-_DECADES)
        decades = max(np.log10(high / low), 1.0)  # under even pressure a law needs several loads, too
        return np.append(high * 10 ** -np.linspace(decades, 0, 1 + round(_PER_DECADE * decades))[:-1], high)

    def __repr__(self) -> str:
        """Return cells, force and largest pressure."""
        cells = " x ".join(map(str, self.grid.shape))
        return f"PressureField({cells} cells, {self.force:.4g} N, at most {np.nanmax(self.pressure):.4g} Pa)"
