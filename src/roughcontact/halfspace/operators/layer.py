"""An elastic layer on a base: a coating, a rubber mat, a sheet on a foundation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from roughcontact.cached import cached_property
from roughcontact.convolution import Convolution
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.layer_bases import Base, Bonded, Frictionless, OnHalfSpace
from roughcontact.halfspace.influence.layer_influence import LayerCells, LayerWaves, Stack, kernel_for
from roughcontact.halfspace.influence.tables import Tables
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.halfspace.sums.spectral import FreeOperator
from roughcontact.material import Solid, as_modulus
from roughcontact.validation import moderate, numeric

__all__ = ["LayerOperator", "layer"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]

ROUNDING = 1e-9  # of a half-space's answer: a layer's that is smaller may have either sign


@dataclass(frozen=True, eq=False)
class LayerOperator:
    """The periodic layer: a product in Fourier space, the mean with them.

    Parameters
    ----------
    grid : Grid
        Periodic grid of two axes.
    influence : LayerWaves
        Its multiplier.
    """

    grid: Grid
    influence: LayerWaves
    positive: bool = False

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            positive=self.positive,
            # A constant pressure moves nothing on an endless base, nor through an incompressible bonded layer.
            semidefinite=self.influence.stack.mean == 0,
            submatrix=self.submatrix,
            coarsened=self.coarsened,
            approximate_inverse=self.approximate_inverse,
        )

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.grid.cell_area

    @cached_property
    def _tables(self) -> Tables:
        return Tables(self.influence, self.grid.shape)

    @cached_property
    def _product(self) -> Convolution:
        return Convolution(self.influence.multiplier(), (self.grid.shape[0], self.grid.shape[1]))

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        # The mean apart: where it moves nothing, its rounding moves nothing either.
        mean = float(pressure.mean())
        displacement = self._product.apply(pressure - mean)
        displacement += self.influence.stack.mean * mean - displacement.mean()
        return displacement

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

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the map between a list of cells (flat indices), with no pressure elsewhere."""
        return CellsOperator.of(self.grid, self._tables, cells, self.positive)

    def restrict(self, window: tuple[slice, ...]) -> FreeOperator | LayerOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        part = self.grid.window(window)
        return self if part.shape == self.grid.shape else FreeOperator(part, self._tables, self.positive)

    def coarsened(self, grid: Grid) -> LayerOperator:
        """Return the same body on `grid`, whose cells are larger."""
        return LayerOperator(grid, LayerWaves(grid, self.influence.stack))


@numeric
def layer(
    grid: Grid,
    modulus: float | Solid,
    thickness: float,
    *,
    base: Literal["rigid-frictionless", "bonded"] | Solid,
    against: Solid | None = None,
) -> FreeOperator | LayerOperator:
    """Return an elastic layer on a base, its upper face without friction.

    Parameters
    ----------
    grid : Grid
        Free or periodic along both axes.
    modulus : float or Solid
        Of the layer: its Solid, or on a frictionless base its reduced modulus E* [Pa].
    thickness : float
        Of the layer [m].
    base : {"rigid-frictionless", "bonded"} or Solid
        A rigid base on which the layer slides or to which it is bonded, or an elastic half-space to which it is
        bonded.
    against : Solid, optional
        The other body, an elastic half-space; without, it is rigid.

    Returns
    -------
    Operator
        On a free grid the layer is endless, and loaded on the grid's cells alone; displacements vanish far away. On
        a periodic one a constant pressure on a rigid base compresses the layer, so that depths are absolute; on an
        elastic base the mean displacement is zero, as on a half-space.

    Raises
    ------
    ValueError
        If the grid has one axis or is periodic along one only, a number stands where a Solid is needed, or the
        thickness is not positive and finite.

    Notes
    -----
    A wave of pressure of wavenumber q is answered by ``2/(E* q) M(q thickness)``; the multipliers M and their limits
    stand in `roughcontact.halfspace.influence.layer_bases`. On free grids the influence of a cell is Love's
    integral plus the integral of the difference of both bodies, a Hankel transform tabulated to 1e-13 of
    Love's. A layer may rise beside a load, so that contact need not lie where the bodies overlap: only layers
    that do not on this grid are `positive`.
    """
    if not isinstance(modulus, Solid) and np.ndim(modulus) != 0:
        raise ValueError(
            "a pair of Solids does not say which is the layer: give the layer, and the other as against="
        )
    value = as_modulus(modulus)
    if not isinstance(grid, Grid) or grid.ndim != 2:
        raise ValueError("a layer needs a grid of two axes: Grid((ny, nx), spacing)")
    if any(grid.periodic) != all(grid.periodic):
        raise ValueError("a layer is free or periodic along both axes; one periodic axis is not offered")
    if not (math.isfinite(thickness) and thickness > 0):
        raise ValueError(f"the thickness must be positive and finite [m], not {thickness}")
    moderate(thickness, "the thickness [m]")
    partner = 0.0 if against is None else 1 / as_modulus(against)
    stack = Stack(value, float(thickness), _base(modulus, base), partner)
    if all(grid.periodic):
        return LayerOperator(grid, LayerWaves(grid, stack))
    kernel = kernel_for(grid, stack)
    positive = kernel.least + value * partner > ROUNDING
    return FreeOperator(grid, Tables(LayerCells(grid.spacing, stack, kernel), grid.shape), positive)


def _base(modulus: float | Solid, base: str | Solid) -> Base:
    if base == "rigid-frictionless":
        return Frictionless()
    if base != "bonded" and not isinstance(base, Solid):
        raise ValueError(f"base must be 'rigid-frictionless', 'bonded' or a Solid, not {base!r}")
    if not isinstance(modulus, Solid):
        raise ValueError(
            "a bonded layer answers by its Poisson's ratio too: give Solid(young_modulus, poisson_ratio) for it"
        )
    if isinstance(base, Solid) and math.isfinite(base.young_modulus):
        return OnHalfSpace(modulus, base)
    return Bonded(modulus.poisson_ratio)
