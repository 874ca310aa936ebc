"""The cells of a mask as a list: from fields on the grid to values on the cells, and back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy, namespace

__all__ = ["Selection"]

Mask = npt.NDArray[np.bool_]
Cells = npt.NDArray[np.intp]
Values = npt.NDArray[Any]


@dataclass(frozen=True, slots=True, eq=False)
class Selection:
    """The cells where a mask holds, in flat order.

    Parameters
    ----------
    mask : bool array
        Of any library; values and fields are arrays of the same.
    cells : int array, shape (n,)
        Their flat indices.
    places : int array, shape (number of all cells,), or None
        Where each cell stands in the list, n for one that does not; None on the host, which does without.
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

    def take(self, field: Values) -> Values:
        """Return the values of a field of shape ``(k, *shape of the mask)`` on the cells, shape ``(k, n)``."""
        xp = namespace(field)
        return xp.take(xp.reshape(field, (field.shape[0], -1)), self.cells, axis=1)  # type: ignore[no-any-return]

    def embed(self, values: Values) -> Values:
        """Return the field of shape ``(k, *shape of the mask)`` with these values, shape (k, n), and zero elsewhere."""
        k = values.shape[0]
        if self.places is None:
            field = np.zeros((k, self.mask.size), dtype=values.dtype)
            field[:, self.cells] = values
            return field.reshape(k, *self.mask.shape)
        # No library but a few can write to a list of places, and all can read from one.
        xp = namespace(values)
        nothing = xp.zeros((k, 1), dtype=values.dtype, device=values.device)
        field = xp.take(xp.concat([values, nothing], axis=1), self.places, axis=1)
        return xp.reshape(field, (k, *self.mask.shape))  # type: ignore[no-any-return]
