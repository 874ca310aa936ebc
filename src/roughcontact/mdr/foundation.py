"""The Winkler foundation of the method of dimensionality reduction."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.materials import Modulus, as_modulus
from roughcontact.validation import Array

__all__ = ["Foundation", "foundation"]

Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Foundation:
    """A Winkler foundation: independent springs of stiffness E* times their width (thesis, eq. A.60).

    Its pressure is a force per length [N/m]: E* times the depth to which a spring is pressed.

    Parameters
    ----------
    grid : Grid
        Of one axis: a spring for each cell.
    modulus : float
        Reduced modulus E* [Pa].

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> springs = rc.foundation(rc.Grid(4, 1e-6), 1e9)
    >>> springs.apply(np.array([0.0, 1.0, 2.0, 0.0])).tolist(), springs.as_matrix().diagonal().tolist()
    ([0.0, 1e-09, 2e-09, 0.0], [1e-09, 1e-09, 1e-09, 1e-09])
    >>> springs.restrict((slice(0, 3),)).grid.shape, springs.submatrix(np.array([0, 3])).grid.shape
    ((3,), (2,))
    """

    grid: Grid
    modulus: float

    @property
    def capabilities(self) -> Capabilities:
        """Its capabilities beyond the protocol."""
        return Capabilities(
            geometry=Geometry.FOUNDATION,
            modulus=self.modulus,
            positive=True,
            semidefinite=False,  # it sinks under a constant pressure, whether or not the line is periodic
            submatrix=self.submatrix,
        )

    @property
    def weights(self) -> float:
        """Width of a spring [m]."""
        return self.grid.cell_area

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under a force per length [N/m].

        Parameters
        ----------
        pressure : array, shape ``grid.shape``
            Force per length of each spring [N/m].

        Returns
        -------
        array
            Displacement [m], of the same shape.
        """
        return pressure / self.modulus

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the diagonal matrix [m^2/N] between `cells`, by default all.

        Parameters
        ----------
        cells : int array, shape (n,), optional
            Flat indices of springs; by default all.

        Returns
        -------
        array
            Diagonal matrix [m^2/N], shape (n, n).
        """
        return np.eye(self.grid.size if cells is None else len(cells)) / self.modulus

    def restrict(self, window: tuple[slice, ...]) -> Foundation:
        """Return the springs of `window`.

        Parameters
        ----------
        window : tuple of slice
            A slice of the line.

        Returns
        -------
        Foundation
        """
        if self.grid.window(window).shape == self.grid.shape:
            return self
        return Foundation(self.grid.window(window), self.modulus)

    def submatrix(self, cells: Cells) -> Foundation:
        """Return the springs of a list.

        Parameters
        ----------
        cells : int array, shape (n,)
            Flat indices of springs.

        Returns
        -------
        Foundation
        """
        return Foundation(Grid(max(1, len(cells)), self.grid.spacing), self.modulus)


def foundation(grid: Grid, modulus: Modulus) -> Foundation:
    """Return the Winkler foundation of the method of dimensionality reduction.

    Parameters
    ----------
    grid : Grid
        Of one axis; the springs are adjacent. Periodicity makes no difference.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.

    Returns
    -------
    Foundation

    Raises
    ------
    ValueError
        If the grid has two axes, or rings.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> springs = rc.foundation(rc.Grid(4, 1e-6), 1e9)
    >>> springs.apply(np.array([0.0, 1.0, 2.0, 0.0])).tolist()  # each by its own load over E*
    [0.0, 1e-09, 2e-09, 0.0]
    """
    if not isinstance(grid, Grid) or grid.ndim != 1:
        raise InputError("a Winkler foundation carries a line", "give a grid of one axis, Grid(n, spacing)")
    return Foundation(grid, as_modulus(modulus))
