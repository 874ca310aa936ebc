"""The cells in contact, and their displacement under traction."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import as_like, is_numpy, namespace
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.operator import capabilities, exact_of, self_influence
from roughcontact.halfspace.shear.shear_operator import ShearOperator, dense_shear
from roughcontact.solver.subdomain import bounding_box
from roughcontact.validation import Array, Mask

__all__ = ["ContactCells", "Selection"]

Cells = npt.NDArray[np.intp]
Values = npt.NDArray[Any]

# Up to this number of cells a full matrix (32 MB) is formed, if it holds at most a few numbers per cell of the padded
# box: then a product with it costs no more than the transforms.
DENSE_LIMIT = 1000
NUMBERS = 10


@dataclass(frozen=True, slots=True, eq=False)
class Selection:
    """The cells where a mask holds, in flat order.

    Parameters
    ----------
    mask : bool array
        Array of any library; values and fields are arrays of the same library.
    cells : int array, shape (n,)
        Their flat indices.
    places : int array, shape (number of all cells,), or None
        Position of each cell in the list, n for cells that are not in it; None on the host, where it is not needed.
    """

    mask: Mask
    cells: Cells
    places: Cells | None

    @classmethod
    def of(cls, mask: Mask) -> Selection:
        """Return the cells of a mask."""
        if is_numpy(mask):
            return cls(mask, np.flatnonzero(mask), None)
        xp = namespace(mask)
        flat = xp.reshape(mask, (-1,))
        cells = xp.nonzero(flat)[0]
        every = xp.arange(flat.shape[0], dtype=cells.dtype, device=mask.device)
        return cls(mask, cells, xp.where(flat, xp.searchsorted(cells, every), cells.shape[0]))

    @property
    def count(self) -> int:
        """Number of cells."""
        return int(self.cells.shape[0])

    def restrict(self, field: Values) -> Values:
        """Return the values of a field of shape ``(k, *shape of the mask)`` on the cells, shape ``(k, n)``."""
        xp = namespace(field)
        return xp.take(xp.reshape(field, (field.shape[0], -1)), self.cells, axis=1)  # type: ignore[no-any-return]

    def prolong(self, values: Values) -> Values:
        """Return the field of shape ``(k, *shape of the mask)`` with these values, shape (k, n), and zero elsewhere."""
        k = values.shape[0]
        if self.places is None:
            field = np.zeros((k, self.mask.size), dtype=values.dtype)
            field[:, self.cells] = values
            return field.reshape(k, *self.mask.shape)
        # Only a few libraries can write to a list of places, but all can read from one.
        xp = namespace(values)
        nothing = xp.zeros((k, 1), dtype=values.dtype, device=values.device)
        field = xp.take(xp.concat([values, nothing], axis=1), self.places, axis=1)
        return xp.reshape(field, (k, *self.mask.shape))  # type: ignore[no-any-return]


@dataclass(frozen=True, slots=True, eq=False)
class ContactCells:
    """A list of cells under traction along given directions; fields on it have shape ``(k, n)``.

    Parameters
    ----------
    operator : ShearOperator
        On the box around the cells, or only on the cells.
    exact : ShearOperator
        The same operator without the error of its sum, for the certificate. Most sums are exact.
    region : Selection
        The cells on the operator's grid.
    basis : array, shape (k, 2)
        Unit vectors (x, y) of the k directions in which traction may act: both axes, or one direction.
    chosen : Selection
        The cells on the whole grid.
    floating : bool
        Whether they are all cells of a periodic grid, which a constant traction does not displace.
    self_influence : float
        Displacement of a cell per traction on itself [m/Pa].
    """

    operator: ShearOperator
    exact: ShearOperator
    region: Selection
    basis: Array
    chosen: Selection
    floating: bool
    self_influence: float

    @classmethod
    def of(
        cls, operator: ShearOperator, contact: Mask, along: tuple[float, float] | None = None
    ) -> ContactCells:
        """Return the interface of the `contact` cells of a grid, at least one; one component `along` a direction."""
        floating = bool(all(operator.grid.periodic) and namespace(contact).all(contact))
        basis = np.eye(2) if along is None else np.array([along])
        part, region = operator, contact
        if is_numpy(contact):  # elsewhere each side of the box would cost a transfer
            box = bounding_box(contact)
            assert box is not None  # the callers have checked this
            part, region = operator.restrict(box), contact[box]
            if not floating and _few(region):
                matrix = part.as_matrix(np.flatnonzero(region))
                cells = Grid((1, len(matrix) // 2), operator.grid.spacing)
                part, region = dense_shear(cells, matrix), np.ones(cells.shape, dtype=bool)
        own = self_influence(part)
        return cls(part, exact_of(part), Selection.of(region), basis, Selection.of(contact), floating, own)

    @property
    def contact(self) -> Mask:
        """The cells on the whole grid, as a mask."""
        return self.chosen.mask

    @property
    def area(self) -> float:
        """Area of a cell [m^2]."""
        return self.operator.weights

    def apply(self, traction: Array) -> Array:
        """Return the displacement [m] of the cells under a traction [Pa] on them."""
        return self._through(self.exact.apply, traction)

    def estimate(self, traction: Array) -> Array:
        """Return the displacement by a sum that may be inexact: accurate enough for a correction."""
        return self._through(self.operator.apply, traction)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a traction [Pa] that would cause about this `displacement` [m]; symmetric and definite."""
        inverse = capabilities(self.operator).approximate_inverse
        if inverse is not None:
            return self._through(inverse, displacement)
        # The traction that each cell would need without the others; a single cell per period never moves.
        return displacement / (self.self_influence if self.self_influence > 0 else 1.0)

    def zeros(self) -> Array:
        """Return zero in every cell."""
        xp, mask = namespace(self.contact), self.contact
        shape = (len(self.basis), self.chosen.count)
        return xp.zeros(shape, dtype=xp.float64, device=mask.device)  # type: ignore[no-any-return]

    def units(self) -> list[Array]:
        """Return a unit vector in each direction, the same in every cell."""
        return [self.zeros() + as_like(unit[:, None], self.zeros()) for unit in np.eye(len(self.basis))]

    def restrict(self, field: Array) -> Array:
        """Return the components of a field of shape ``(2, ny, nx)`` on the cells."""
        return self._components(self.chosen.restrict(field))

    def prolong(self, values: Array) -> Array:
        """Return values on the cells as a field of shape ``(2, ny, nx)``, zero outside the contact."""
        return self.chosen.prolong(self._vectors(values))

    def _through(self, operation: Callable[[Array], Array], values: Array) -> Array:
        field = operation(self.region.prolong(self._vectors(values)))
        return self._components(self.region.restrict(field))

    def _vectors(self, values: Array) -> Array:
        """Return components as vectors (x, y)."""
        if len(self.basis) == 2:
            return values
        (x, y), xp = self.basis[0], namespace(values)
        return xp.concat([float(x) * values, float(y) * values])  # type: ignore[no-any-return]

    def _components(self, vectors: Array) -> Array:
        """Return the components of vectors (x, y)."""
        if len(self.basis) == 2:
            return vectors
        x, y = self.basis[0]
        return float(x) * vectors[:1, :] + float(y) * vectors[1:, :]


def _few(region: Mask) -> bool:
    count = int(region.sum())
    padded = 4 * region.size
    return count <= DENSE_LIMIT and count * count <= NUMBERS * padded
