"""The sums over an influence tensor: by Fourier transforms, free or periodic, and as a full matrix."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import Placed, namespace
from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.shear.shear_influence import ShearInfluence, ShearWaves
from roughcontact.halfspace.shear.shear_transform import convolve_pair, tensor_multiplier
from roughcontact.halfspace.subsurface.field_transform import padded_lengths
from roughcontact.transforms import fast_even_length

__all__ = ["DenseShear", "FreeShear", "PeriodicShear"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class FreeShear:
    """A zero-padded convolution: exact on a free grid of any shape.

    Parameters
    ----------
    grid : Grid
        Grid of two axes; its boundary condition is not looked at.
    influence : ShearInfluence
        Influence tensor on cells of the grid's size.
    """

    grid: Grid
    influence: ShearInfluence

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @cached_property
    def _padded(self) -> tuple[int, int]:
        return padded_lengths(self.grid.shape)

    @cached_property
    def _multiplier(self) -> Placed:
        return Placed(tensor_multiplier(self.influence.table(self.grid.shape), self._padded))

    @cached_property
    def _inverse(self) -> tuple[Placed, tuple[int, int]]:
        box = (fast_even_length(self.grid.shape[0]), fast_even_length(self.grid.shape[1]))
        return Placed(self.influence.inverse(box)), box

    def apply(self, traction: Array) -> Array:
        """Return the displacement [m] under `traction` [Pa]."""
        return convolve_pair(traction, self._multiplier, self._padded)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a traction [Pa] that would cause about this `displacement` [m]: every wave by itself."""
        return convolve_pair(displacement, *self._inverse)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells`, shape ``(2 n, 2 n)``."""
        return _matrix(self.grid, self.influence, cells)

    def restrict(self, window: tuple[slice, ...]) -> FreeShear:
        """Return the map between the cells of `window`, with no traction outside."""
        part = self.grid.window(window)
        return self if part.shape == self.grid.shape else FreeShear(part, self.influence)


@dataclass(frozen=True, eq=False)
class PeriodicShear:
    """Periodic half-spaces: a product in Fourier space, mean displacement zero.

    Parameters
    ----------
    grid : Grid
        Periodic grid of two axes.
    influence : ShearWaves
        Its multiplier.
    """

    grid: Grid
    influence: ShearWaves

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @cached_property
    def _multiplier(self) -> Placed:
        return Placed(self.influence.multiplier())

    @property
    def _lengths(self) -> tuple[int, int]:
        ny, nx = self.grid.shape
        return ny, nx

    @cached_property
    def _inverse(self) -> Placed:
        return Placed(self.influence.inverse(self._lengths))

    def apply(self, traction: Array) -> Array:
        """Return the displacement [m] under `traction` [Pa]."""
        # The mean moves nothing; taken out first, its rounding moves nothing either.
        xp, multiplier = namespace(traction), self._multiplier.beside(traction)
        varying = traction - xp.mean(traction, axis=(1, 2), keepdims=True)
        displacement = convolve_pair(varying, multiplier, self._lengths)
        displacement -= xp.mean(displacement, axis=(1, 2), keepdims=True)
        return displacement

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return the traction [Pa] that causes this `displacement` [m], but for its mean."""
        return convolve_pair(displacement, self._inverse, self._lengths)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells`, shape ``(2 n, 2 n)``."""
        return _matrix(self.grid, self.influence, cells)

    def restrict(self, window: tuple[slice, ...]) -> FreeShear | PeriodicShear:
        """Return the map between the cells of `window`, with no traction outside."""
        part = self.grid.window(window)
        return self if part.shape == self.grid.shape else FreeShear(part, self.influence)


@dataclass(frozen=True, slots=True, eq=False)
class DenseShear:
    """A full matrix: the slow truth that every other sum is held against.

    Parameters
    ----------
    grid : Grid
        Grid of two axes.
    matrix : array, shape (2 n, 2 n)
        Displacement per traction [m/Pa] between the n cells in flat order: all x components, then all y.
    """

    grid: Grid
    matrix: Array
    _placed: Placed = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_placed", Placed(self.matrix))

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    def apply(self, traction: Array) -> Array:
        """Return the displacement [m] under `traction` [Pa]."""
        xp = namespace(traction)
        product = self._placed.beside(traction) @ xp.reshape(traction, (-1,))
        return xp.reshape(product, traction.shape)  # type: ignore[no-any-return]

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return the traction [Pa] that each cell alone would need for this `displacement` [m]."""
        own = float(self.matrix[0, 0])
        return displacement / (own if own > 0 else 1.0)  # the one cell of a period never moves

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells`, shape ``(2 n, 2 n)``."""
        if cells is None:
            return self.matrix.copy()
        both = np.concatenate([cells, cells + self.grid.size])
        return np.asarray(self.matrix[np.ix_(both, both)])

    def restrict(self, window: tuple[slice, ...]) -> DenseShear:
        """Return the map between the cells of `window`, with no traction outside."""
        part = self.grid.window(window)
        if part.shape == self.grid.shape:
            return self  # the whole keeps its period
        cells = np.arange(self.grid.size).reshape(self.grid.shape)[window].ravel()
        return DenseShear(part, self.as_matrix(cells))


def _matrix(grid: Grid, influence: ShearInfluence, cells: Cells | None) -> Array:
    """Return the matrix between `cells` of a grid: entries of the table at their offsets."""
    rows, columns = np.divmod(np.arange(grid.size) if cells is None else cells, grid.shape[1])
    down, right = rows[:, None] - rows, columns[:, None] - columns
    reach = (int(down.max(initial=0)) + 1, int(right.max(initial=0)) + 1)
    xx, yy, xy = influence.table(reach)[:, np.abs(down), np.abs(right)]
    xy *= np.sign(down) * np.sign(right)
    return np.block([[xx, xy], [xy, yy]])
