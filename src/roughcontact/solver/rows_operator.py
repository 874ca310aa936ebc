"""The inner operator on the rows of one process: vectors in machine code take these as if they were a whole field.

Products and the preconditioner are those of the plane in slabs, and totals are those of all processes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from roughcontact.halfspace.sums.local_inverse import BLOCK, LocalInverse
from roughcontact.kernels.active_cells import (
    ActiveCells,
    add_blocks,
    fill_margins,
    looked_at,
    sum_blocks,
    sum_stencil,
)
from roughcontact.kernels.planes import Combine
from roughcontact.slabs.array_functions import SlabFunctions
from roughcontact.slabs.levels_of_slabs import divides
from roughcontact.slabs.passes import passes_over
from roughcontact.slabs.rows import Edges
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.solver.inner_operator import InnerOperator
from roughcontact.validation import Array

__all__ = ["RowsInverse", "RowsOperator", "on_own_rows"]


def on_own_rows(inner: InnerOperator, field: Any) -> InnerOperator:
    """Return an inner operator on the rows of this process, if a field is in slabs and all have machine code for it."""
    if not isinstance(field, SlabArray) or passes_over(field) is None:
        return inner
    return RowsOperator(inner, field.edges, field.functions, _on_rows(inner.local_inverse, field))


def _on_rows(inverse: Any, field: SlabArray) -> RowsInverse | None:
    """Return a truncated inverse for fields in slabs: all blocks must lie on one process each, and none beside them."""
    if not isinstance(inverse, LocalInverse):
        return None
    blocks = tuple(-(-n // BLOCK) for n in field.shape)
    fits = inverse.far is None or (divides(field, (BLOCK,)) and inverse.far.lengths == blocks)
    return RowsInverse(inverse, field.edges, field.functions) if fits else None


@dataclass(frozen=True, slots=True, eq=False)
class RowsInverse:
    """A truncated inverse that takes the rows beside those of this process from its neighbours."""

    plane: LocalInverse
    edges: Edges
    functions: SlabFunctions

    def on(self, region: ActiveCells, field: Array) -> Array:
        """Return the pressure [Pa] on a region under a displacement [m] that is zero elsewhere, and has margins."""
        whole = SlabArray(field, self.edges, self.functions)
        fill_margins(field, *self.functions.beyond(whole, looked_at(field.shape[-1])))
        pressure = sum_stencil(region, field, self.plane.near.astype(field.dtype))
        if self.plane.far is not None:
            blocks: Any = whole.in_blocks(sum_blocks(region, field, BLOCK), BLOCK)
            moved: Any = self.plane.far.apply(blocks)
            add_blocks(region, pressure, moved.local, BLOCK)
        return pressure


@dataclass(frozen=True, slots=True, eq=False)
class RowsOperator:
    """An inner operator for planes in slabs, on the rows of this process.

    Attributes
    ----------
    plane : InnerOperator
        That of the whole plane.
    edges : tuple of int
        Where the rows of each process begin, and where the last ones end.
    functions : SlabFunctions
    local_inverse : RowsInverse, optional
    """

    plane: InnerOperator
    edges: Edges
    functions: SlabFunctions
    local_inverse: RowsInverse | None

    @property
    def weights(self) -> float | Array:
        """Force of a unit pressure on each cell [m^2]."""
        return self.plane.weights

    @property
    def contraction(self) -> float:
        """That of the plane."""
        return self.plane.contraction

    @property
    def diagonal_correction(self) -> float:
        """The correction for truncating the inverse."""
        return 0.0 if self.local_inverse is None else self.plane.diagonal_correction

    @property
    def combine(self) -> Combine:
        """What makes totals of all processes from those of this one."""
        return self.functions.combined

    def gather(self, field: Any, beyond: float = 0.0) -> Any:
        """Return the rows of this process."""
        return field.local

    def scatter(self, values: Any) -> Any:
        """Return the field in slabs."""
        return SlabArray(values, self.edges, self.functions)

    def scaled(self, values: Any, unit: float = 1.0) -> Any:
        """Return numbers over a unit, in the precision of the products."""
        return self.plane.scaled(values, unit)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        displacement: Any = self.plane.apply(self.scatter(pressure))
        return displacement.local  # type: ignore[no-any-return]

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]."""
        pressure: Any = self.plane.approximate_inverse(self.scatter(displacement))
        return pressure.local  # type: ignore[no-any-return]
