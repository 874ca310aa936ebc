"""The operator of an influence function that depends only on the offset, for each way of summation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal, Protocol, get_args

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace, require_floating, require_no_unit, subtract
from roughcontact.cached import cached_property
from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.shear_influence import Influences
from roughcontact.halfspace.influence.tables import Love, Periodic, Strip, Tables
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.halfspace.sums.fourier_sum import fourier_sum, inverse_sum
from roughcontact.halfspace.sums.local_inverse import LocalInverse, local_inverse
from roughcontact.halfspace.sums.moving_grid import MovingGrid
from roughcontact.halfspace.sums.multilevel import Multilevel
from roughcontact.halfspace.sums.particle_mesh import ParticleMesh, particle_mesh_on
from roughcontact.validation import Array

__all__ = ["InfluenceOperator", "Sum"]

Cells = npt.NDArray[np.intp]
Sum = Literal["fft", "moving-grid", "multilevel"]


class CellSum(Protocol):
    """A sum over all cells of a grid."""

    def apply(self, field: Array) -> Array:
        """Return the influence times the field, summed at every cell."""


@dataclass(frozen=True, eq=False)
class InfluenceOperator:
    """The map from pressure to displacement by an influence function, or from traction by a tensor of them.

    Parameters
    ----------
    grid : Grid
        Grid of two axes.
    influence : Tables or TensorTables
        Influence on cells of the grid's size.
    positive : bool
        Whether the influence is nowhere negative.
    constant : float
        On a grid that is periodic along both axes: displacement per unit pressure on all cells [m/Pa].
    summation : function
        Takes the influence and the grid and returns the way to do the sum: `fourier_sum`, `MovingGrid` or a
        ``Multilevel``.
    """

    grid: Grid
    influence: Influences
    positive: bool = True
    constant: float = 0.0
    summation: Callable[[Any, Grid], CellSum] = fourier_sum

    def summed(self, method: str) -> InfluenceOperator:
        """Return the same body with its sum done by another method: "fft", "moving-grid" or "multilevel".

        Raises
        ------
        ValueError
            If there is no such method, or the body is periodic and the method needs a free one.
        """
        if method not in get_args(Sum):
            names = ", ".join(map(repr, get_args(Sum)))
            raise about("method", f"must be one of {names}, or 'dense' on a plane, not {method!r}")
        if method == "fft":
            return self
        if any(self.grid.periodic):
            raise InputError(
                f"the method {method!r} is for free grids; a periodic one is summed by 'fft'", place="method"
            )
        return replace(self, summation=MovingGrid if method == "moving-grid" else Multilevel())

    @property
    def exact(self) -> InfluenceOperator | None:
        """The same body without the error of its sum; None if its sum is exact."""
        return self._by_transforms if isinstance(self.summation, Multilevel) else None

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        fourier, periodic = self.summation is fourier_sum, self._periodic
        return Capabilities(
            exact=self.exact,
            modulus=self.influence.modulus,
            positive=self.positive,
            semidefinite=periodic and self.constant == 0,
            single_precision=fourier,
            # A mean that moves next to nothing does no harm in the steps of a solve.
            single_convolution=(lambda field: self._sum.apply(field)) if fourier and periodic else None,
            submatrix=self.submatrix if isinstance(self.influence, Tables) else None,
            coarsened=self.coarsened,
            approximate_inverse=self.approximate_inverse,
            local_inverse=lambda: self.local_inverse,
            particle_mesh=lambda: self.particle_mesh,
        )

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        require_no_unit(pressure)
        if not self._periodic:
            return self._sum.apply(pressure)
        require_floating(pressure)
        # The mean apart: where it moves nothing, its rounding moves nothing either.
        xp, plane = namespace(pressure), {"axis": (-2, -1), "keepdims": True}
        mean = xp.mean(pressure, **plane)
        displacement = self._sum.apply(subtract(pressure, mean))
        if self.constant:
            displacement += self.constant * mean
        return displacement

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]: every wave by itself."""
        return self._inverse.apply(displacement)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        some = np.arange(self.grid.size) if cells is None else cells
        return self.influence.matrix(*np.divmod(some, self.grid.shape[1]))

    def restrict(self, window: tuple[slice, ...]) -> InfluenceOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        part = self.grid.window(window)
        if part.shape == self.grid.shape:
            return self  # the whole keeps its period
        if any(self.grid.periodic) and not self._periodic:  # a window may hold the whole of the one period
            sides = zip(self.grid.periodic, self.grid.shape, part.shape, strict=True)
            part = Grid(part.shape, part.spacing, [periodic and n == m for periodic, n, m in sides])
        return replace(self, grid=part)

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the exact map between a list of cells (flat indices), with no pressure elsewhere."""
        assert isinstance(self.influence, Tables)  # of tensors it is not stated
        plane = None
        if not any(self.grid.periodic):
            plane = self if self.summation is fourier_sum else self._by_transforms
        return CellsOperator.of(self.grid, self.influence, cells, self.positive, plane)

    def coarsened(self, grid: Grid) -> InfluenceOperator | None:
        """Return the same body on `grid`, whose cells are larger; None for a window of a periodic one."""
        coarse = self.influence.coarsened(grid)
        return None if coarse is None else replace(self, grid=grid, influence=coarse)

    @cached_property
    def local_inverse(self) -> LocalInverse | None:
        """What preconditions in machine code; None for another body than a half-space, or another sum."""
        kernel = self.influence.influence
        if self.summation is not fourier_sum or not isinstance(kernel, Love | Strip | Periodic):
            return None
        return local_inverse(kernel.modulus, self.grid)

    @cached_property
    def particle_mesh(self) -> ParticleMesh | None:
        """What works on the tiles of a region of a half-space; None for another body, or where they do not fit."""
        kernel = self.influence.influence
        if isinstance(kernel, Love) or (isinstance(kernel, Periodic) and self._periodic):
            return particle_mesh_on(kernel, self.grid, self.local_inverse)
        return None

    @property
    def _periodic(self) -> bool:
        return all(self.grid.periodic)

    @cached_property
    def _by_transforms(self) -> InfluenceOperator:
        return replace(self, summation=fourier_sum)

    @cached_property
    def _sum(self) -> CellSum:
        return self.summation(self.influence, self.grid)

    @cached_property
    def _inverse(self) -> CellSum:
        return inverse_sum(self.influence, self.grid)
