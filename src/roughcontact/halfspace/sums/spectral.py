"""The half-space by fast Fourier transforms, free or periodic."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import even_multiplier, fast_even_length, less, namespace, require_floating
from roughcontact.cached import cached_property
from roughcontact.convolution import Convolution, padded_length
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.tables import Love, Periodic, Strip, Tables
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.halfspace.sums.local_inverse import LocalInverse, local_inverse
from roughcontact.halfspace.sums.particle_mesh import Patches, patches_of

__all__ = ["FreeOperator", "PeriodicOperator"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class FreeOperator:
    """A zero-padded convolution: exact on a free grid of any shape (thesis, eq. A.59 as corrected).

    Parameters
    ----------
    grid : Grid
        Grid of two axes; its boundary condition is not looked at.
    influence : Tables
        Influence function on cells of the grid's size.
    positive : bool
        Whether the influence function is nowhere negative.
    """

    grid: Grid
    influence: Tables
    positive: bool = True

    @property
    def modulus(self) -> float | None:
        """Reduced modulus E* [Pa] of a half-space; None of another body."""
        kernel = self.influence.influence
        return kernel.modulus if isinstance(kernel, Love | Strip | Periodic) else None

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            modulus=self.modulus,
            positive=self.positive,
            single_precision=True,
            submatrix=self.submatrix,
            coarsened=self.coarsened,
            approximate_inverse=self.approximate_inverse,
            local_inverse=lambda: self.local_inverse,
            particle_mesh=lambda: self.particle_mesh,
        )

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @cached_property
    def _product(self) -> Convolution:
        padded = padded_length(self.grid.shape[0]), padded_length(self.grid.shape[1])
        multiplier = even_multiplier(self.influence.table(self.grid.shape), padded)
        return Convolution(multiplier, padded)

    @cached_property
    def particle_mesh(self) -> Patches | None:
        """What works on the tiles of a region of this half-space; None for another body."""
        kernel = self.influence.influence
        return patches_of(kernel, self.grid, self.local_inverse) if isinstance(kernel, Love) else None

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        return self._product.apply(pressure)

    @cached_property
    def local_inverse(self) -> LocalInverse | None:
        """What preconditions in machine code; None for another body than a half-space."""
        return None if self.modulus is None else local_inverse(self.modulus, self.grid)

    @cached_property
    def _inverse(self) -> Convolution:
        box = (fast_even_length(self.grid.shape[0]), fast_even_length(self.grid.shape[1]))
        return Convolution(self.influence.inverse(box), box)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]: every wave by E* q/2."""
        return self._inverse.apply(displacement)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        return CellsOperator.of(self.grid, self.influence, cells, self.positive).as_matrix()

    def restrict(self, window: tuple[slice, ...]) -> FreeOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        return FreeOperator(self.grid.window(window), self.influence, self.positive)

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the map between a list of cells (flat indices), with no pressure elsewhere."""
        return CellsOperator.of(self.grid, self.influence, cells, self.positive, self)

    def coarsened(self, grid: Grid) -> FreeOperator | None:
        """Return the same body on `grid`, whose cells are larger; None for a window of a periodic one."""
        coarse = self.influence.coarsened(grid)
        return None if coarse is None else FreeOperator(grid, coarse, self.positive)


@dataclass(frozen=True, eq=False)
class PeriodicOperator:
    """The periodic half-space: a product in Fourier space, mean displacement zero.

    Parameters
    ----------
    grid : Grid
        Periodic grid of two axes.
    influence : Periodic
        Its multiplier.
    """

    grid: Grid
    influence: Periodic
    positive: bool = False

    @property
    def modulus(self) -> float | None:
        """Reduced modulus E* [Pa] of a half-space; None of another body."""
        return self.influence.modulus if isinstance(self.influence, Periodic) else None

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            modulus=self.modulus,
            positive=self.positive,
            single_precision=True,
            # A mean that moves next to nothing does no harm in the steps of a solve.
            single_convolution=lambda pressure: self._product.apply(pressure),
            submatrix=self.submatrix,
            coarsened=self.coarsened,
            approximate_inverse=self.approximate_inverse,
            local_inverse=lambda: self.local_inverse,
            particle_mesh=lambda: self.particle_mesh,
        )

    @cached_property
    def particle_mesh(self) -> Patches | None:
        """What works on the tiles of a region; None where they do not fit the period."""
        return patches_of(self.influence, self.grid, self.local_inverse)

    @cached_property
    def _tables(self) -> Tables:
        return Tables(self.influence, self.grid.shape)

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @cached_property
    def _product(self) -> Convolution:
        return Convolution(self.influence.multiplier(), (self.grid.shape[0], self.grid.shape[1]))

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        require_floating(pressure)
        # The mean moves nothing; taken out first, its rounding moves nothing either.
        xp = namespace(pressure)
        displacement = self._product.apply(less(pressure, xp.mean(pressure)))
        displacement -= xp.mean(displacement)
        return displacement

    @cached_property
    def local_inverse(self) -> LocalInverse | None:
        """What preconditions in machine code; None for another body than a half-space."""
        return None if self.modulus is None else local_inverse(self.modulus, self.grid)

    @cached_property
    def _inverse(self) -> Convolution:
        lengths = self.grid.shape[0], self.grid.shape[1]
        return Convolution(self.influence.inverse(lengths), lengths)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return the pressure [Pa] that causes this `displacement` [m], but for its mean."""
        return self._inverse.apply(displacement)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        return self.submatrix(np.arange(self.grid.size) if cells is None else cells).as_matrix()

    def restrict(self, window: tuple[slice, ...]) -> FreeOperator | PeriodicOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        if self.grid.window(window).shape == self.grid.shape:
            return self  # the whole keeps its period
        return FreeOperator(self.grid.window(window), self._tables, self.positive)

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the map between a list of cells (flat indices), with no pressure elsewhere."""
        return CellsOperator.of(self.grid, self._tables, cells, self.positive)

    def coarsened(self, grid: Grid) -> PeriodicOperator:
        """Return the same body on `grid`, whose cells are larger."""
        return PeriodicOperator(grid, Periodic(grid, self.influence.modulus))
