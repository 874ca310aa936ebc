"""The half-space summed directly: the slow truth that every other method is held against."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import DeviceTable, namespace
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.validation import Array

__all__ = ["DenseOperator"]

Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class DenseOperator:
    """A full matrix over the cells of a grid (thesis, eq. A.6), or over both components of traction on them.

    Parameters
    ----------
    grid : Grid or RadialGrid
        The grid, of any number of axes.
    matrix : array, shape (n, n), or (2 n, 2 n)
        Displacement per pressure [m/Pa] between the n cells in flat order; of traction first all x components, then y.
    positive : bool
        Whether no entry is negative.
    modulus : float, optional
        Reduced modulus E* of the body [Pa], where it has one.
    """

    grid: AnyGrid
    matrix: Array
    positive: bool = True
    modulus: float | None = None
    _table: DeviceTable = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_table", DeviceTable(self.matrix))

    @property
    def weights(self) -> float | Array:
        """Area of a cell [m^2], of each where they differ."""
        return self.grid.cell_area

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            modulus=self.modulus,
            positive=self.positive,
            self_influences=lambda: (
                np.diagonal(self.matrix)[: self.grid.size].reshape(self.grid.shape).copy()
            ),
        )

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        xp = namespace(pressure)
        product = self._table.as_like(pressure) @ xp.reshape(pressure, (-1,))
        return xp.reshape(product, pressure.shape)  # type: ignore[no-any-return]

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        if cells is None:
            return self.matrix.copy()
        some = np.concatenate([cells + first for first in range(0, len(self.matrix), self.grid.size)])
        return np.asarray(self.matrix[np.ix_(some, some)])

    def restrict(self, window: tuple[slice, ...]) -> DenseOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        if self.grid.window(window).shape == self.grid.shape:
            return self  # the whole keeps its period
        cells = np.arange(self.grid.size).reshape(self.grid.shape)[window].ravel()
        return DenseOperator(self.grid.window(window), self.as_matrix(cells), self.positive, self.modulus)
