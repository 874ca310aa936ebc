"""The cells in contact, and how traction on them displaces them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.contact.window import Box, bounding_box
from roughcontact.grid import Grid
from roughcontact.halfspace.shear import ShearOperator
from roughcontact.halfspace.shear_sums import DenseShear

__all__ = ["Interface"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

# Up to so many cells a full matrix is made (32 MB of it) where it holds no more than a few numbers per cell of the
# padded box, so that a product with it costs no more than the transforms.
DENSE_LIMIT = 1000
NUMBERS = 10


@dataclass(frozen=True, slots=True, eq=False)
class Interface:
    """A list of cells under traction along given directions; fields on it have shape ``(k, n)``.

    Parameters
    ----------
    operator : ShearOperator
        On the box that holds the cells, or on the cells alone.
    region : bool array, shape of the operator's grid
        The cells, in flat order.
    basis : array, shape (k, 2)
        Unit vectors (x, y) of the k directions in which traction may act: both axes, or one direction.
    contact : bool array
        The cells on the whole grid.
    floating : bool
        Whether they are all cells of a periodic grid, which a constant traction does not displace.
    self_influence : float
        Displacement of a cell per traction on itself [m/Pa].
    """

    operator: ShearOperator
    region: Mask
    basis: Array
    contact: Mask
    floating: bool
    self_influence: float

    @classmethod
    def of(
        cls, operator: ShearOperator, contact: Mask, along: tuple[float, float] | None = None
    ) -> Interface:
        """Return the interface of the `contact` cells of a grid, at least one; one component `along` a direction."""
        box = bounding_box(contact)
        assert box is not None  # who comes here has asked
        floating = bool(all(operator.grid.periodic) and contact.all())
        basis = np.eye(2) if along is None else np.array([along])
        part, region = operator.restrict(box), contact[box]
        if not floating and _few(region, box):
            matrix = part.as_matrix(np.flatnonzero(region))
            cells = Grid((1, len(matrix) // 2), operator.grid.spacing)
            part, region = DenseShear(cells, matrix), np.ones(cells.shape, dtype=bool)
        own = float(part.as_matrix(np.zeros(1, np.intp))[0, 0])
        return cls(part, region, basis, contact, floating, own)

    @property
    def area(self) -> float:
        """Area of a cell [m^2]."""
        return self.operator.weights

    def apply(self, traction: Array) -> Array:
        """Return the displacement [m] of the cells under a traction [Pa] on them."""
        return self._through(self.operator.apply, traction)

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a traction [Pa] that would cause about this `displacement` [m]; symmetric and definite."""
        return self._through(self.operator.approximate_inverse, displacement)

    def take(self, field: Array) -> Array:
        """Return the components of a field of shape ``(2, ny, nx)`` on the cells."""
        return np.asarray(self.basis @ field[:, self.contact])

    def embed(self, values: Array) -> Array:
        """Return values on the cells as a field of shape ``(2, ny, nx)``, zero outside the contact."""
        field = np.zeros((2, *self.contact.shape))
        field[:, self.contact] = self.basis.T @ values
        return field

    def _through(self, operation: Callable[[Array], Array], values: Array) -> Array:
        field = np.zeros((2, *self.region.shape))
        field[:, self.region] = self.basis.T @ values
        return np.asarray(self.basis @ operation(field)[:, self.region])


def _few(region: Mask, box: Box) -> bool:
    count = int(region.sum())
    padded = 4 * region.size
    return count <= DENSE_LIMIT and count * count <= NUMBERS * padded
