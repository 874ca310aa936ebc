"""Inner products and means under the weights of an operator."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

__all__ = ["Measure"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Measure:
    """Sums over cells weighted by their area; operators are symmetric under this inner product."""

    weights: float | Array

    def total(self, field: Array | Mask) -> float:
        """Return the weighted sum of a field: the force [N] of a pressure [Pa]."""
        return float((self.weights * field).sum()) if self.varies else float(self.weights * field.sum())

    def dot(self, a: Array, b: Array) -> float:
        """Return the weighted inner product of two fields."""
        first = self.weights * a if self.varies else a
        product = float(np.vdot(first, b))
        return product if self.varies else float(self.weights * product)

    def mean(self, field: Array, mask: Mask) -> float:
        """Return the weighted mean of a field over the cells of `mask`."""
        if isinstance(self.weights, np.ndarray):
            return float(np.average(field[mask], weights=self.weights[mask]))
        return float(field[mask].mean())

    @property
    def varies(self) -> bool:
        """Whether the cells have different weights."""
        return isinstance(self.weights, np.ndarray)

    def on(self, cells: npt.NDArray[np.intp]) -> Array:
        """Return the weights of `cells`, one each."""
        if isinstance(self.weights, np.ndarray):
            return self.weights.ravel()[cells]
        return np.full(len(cells), self.weights)
