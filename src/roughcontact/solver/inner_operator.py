"""The inner operator: what an inner solve applies. It may be inexact, since exact products check each outer iterate.

That is mixed-precision iterative refinement: most products in single precision, on the tiles that the region touches
where that costs less, residuals of the outer iteration in double precision on the whole.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, ClassVar, Protocol

from roughcontact.arrays import divide, is_numpy, max_abs, multiply
from roughcontact.halfspace.operators.operator import (
    Capabilities,
    Linear,
    Operator,
    capabilities,
    self_influence,
)
from roughcontact.halfspace.sums.local_inverse import DIAGONAL_CORRECTION, LocalInverse
from roughcontact.halfspace.sums.particle_mesh import TileOperator
from roughcontact.halfspace.sums.tiles import Tiles
from roughcontact.kernels.active_cells import ActiveCells
from roughcontact.kernels.planes import Combine
from roughcontact.solver import tuning
from roughcontact.validation import Array, Mask

__all__ = [
    "FullGrid",
    "InnerOperator",
    "factorisation_pays",
    "first_product",
    "inner_operator_on",
]


# Influences between this and its inverse, and squares of displacements, are numbers of single precision.
SINGLE_RANGE = 1e-25


class TruncatedInverse(Protocol):
    """M0^-1 in machine code, on the free cells of a whole grid."""

    def on(self, region: ActiveCells, field: Any, /) -> Any:
        """Return the pressure [Pa] on a region under a displacement [m] that is zero elsewhere, and has margins."""
        ...


class InnerOperator(Linear, Protocol):
    """A symmetric map between some cells, in some precision, its preconditioner, and the way there and back."""

    @property
    def contraction(self) -> float:
        """Factor by which one sweep of refinement can reduce the residual; 0 where products are exact."""
        ...

    @property
    def diagonal_correction(self) -> float:
        """theta: part of M0^-1 1 that is subtracted from the diagonal of M0^-1 (the Schur correction)."""
        ...

    @property
    def local_inverse(self) -> TruncatedInverse | None:
        """M0^-1 in machine code; None where `approximate_inverse` does it."""
        ...

    @property
    def combine(self) -> Combine | None:
        """What makes totals of all processes from those of this one, where others hold cells too."""
        ...

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return M0^-1 of a displacement [m]: a pressure [Pa] that would cause about this; symmetric and definite."""
        ...

    def gather(self, field: Any, beyond: float = 0.0) -> Any:
        """Return a field of the grid on the cells of the inner operator, another value beyond its edge."""
        ...

    def scatter(self, values: Any) -> Any:
        """Return the field of the grid that has `values` on these cells and is zero elsewhere."""
        ...

    def scaled(self, values: Any, unit: float = 1.0) -> Any:
        """Return numbers over a unit, in the precision of the inner operator."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class FullGrid:
    """All cells of an operator, in double precision or, if `single`, in single precision."""

    operator: Operator
    single: bool = False
    combine: ClassVar[None] = None
    _can: Capabilities = field(init=False, repr=False)  # asked for once: each step of a solve uses it

    def __post_init__(self) -> None:
        object.__setattr__(self, "_can", capabilities(self.operator))

    @property
    def contraction(self) -> float:
        """Of seven digits a product loses one or two."""
        return 1e-4 if self.single else 0.0

    @property
    def weights(self) -> float | Array:
        """Force of a unit pressure on each cell [m^2]."""
        return self.operator.weights

    @property
    def local_inverse(self) -> LocalInverse | None:
        """The truncated inverse that preconditions in machine code, if there is one."""
        return self._can.local_inverse()

    @property
    def diagonal_correction(self) -> float:
        """The correction for truncating the inverse."""
        return 0.0 if self.local_inverse is None else DIAGONAL_CORRECTION

    def gather(self, field: Any, beyond: float = 0.0) -> Any:
        """Return the field."""
        return field

    def scatter(self, values: Any) -> Any:
        """Return the field."""
        return values

    def scaled(self, values: Any, unit: float = 1.0) -> Any:
        """Return the field over a unit, in the precision of the products."""
        if self.single:
            return divide(values, unit, "float32")
        return values if unit == 1 else divide(values, unit, "float64")

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        convolution = self._can.single_convolution if self.single else None
        return self.operator.apply(pressure) if convolution is None else convolution(pressure)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m].

        Without an approximate inverse it is the displacement over roughly the influence of all cells on one: a
        pressure in any unit, and no step along it is much too long.
        """
        inverse = self._can.approximate_inverse
        if inverse is not None:
            return inverse(displacement)
        return displacement / (math.prod(displacement.shape) * self_influence(self.operator))


def inner_operator_on(
    operator: Operator, support: Mask, previous: InnerOperator | None = None
) -> InnerOperator:
    """Return the inner operator of least cost on some cells, the previous one if it still covers them."""
    if isinstance(previous, TileOperator) and previous.tiles.hold(support):
        return previous
    if not _fits_single(operator):
        return FullGrid(operator)
    tiles = _tiles_of(operator, support)
    if tiles is not None:
        mesh = capabilities(operator).particle_mesh()
        assert mesh is not None  # the tiles are its own
        return mesh.on(tiles)
    return previous if isinstance(previous, FullGrid) else _full_grid(operator)


def first_product(
    operator: Operator, pressure: Array, inner: InnerOperator | None = None
) -> tuple[Array, bool]:
    """Return the displacement [m] under a first pressure [Pa], and whether it is exact (A2).

    An inner operator that covers all cells under pressure gives it only on its own cells.
    """
    if inner is None:
        inner = _full_grid(operator)
        # Where tiles will be used, no transfer function of single precision is made for the grid.
        if inner.contraction and _tiles_of(operator, pressure > 0) is not None:
            inner = FullGrid(operator)
    size = max_abs(pressure) if inner.contraction else 0.0
    if not size > 0:
        return operator.apply(pressure), True
    part = inner.scaled(inner.gather(pressure), size)
    return multiply(inner.scatter(inner.apply(part)), size), False


def factorisation_pays(operator: Operator, count: int, limit: int, tolerance: float = 0.0) -> bool:
    """Whether `count` cells are better factorised: up to `limit`, and fewer where tiles compete (A8)."""
    if count <= tuning.DIRECT_ROUGHLY or count > limit:
        return count <= limit
    few = count <= tuning.DIRECT_BESIDE_TILES and tolerance < tuning.ROUGH_TOLERANCE
    return few or capabilities(operator).particle_mesh() is None


def _tiles_of(operator: Operator, region: Mask) -> Tiles | None:
    """Return the tiles of a region; None where the whole grid costs less."""
    mesh = capabilities(operator).particle_mesh() if is_numpy(region) else None
    return None if mesh is None else mesh.tiles(region)


def _fits_single(operator: Operator) -> bool:
    """Whether its influences are in the range of single precision."""
    return SINGLE_RANGE < self_influence(operator) < 1 / SINGLE_RANGE


def _full_grid(operator: Operator) -> FullGrid:
    large = math.prod(operator.grid.shape) >= tuning.SINGLE_CELLS
    single = large and capabilities(operator).single_precision and _fits_single(operator)
    return FullGrid(operator, single)
