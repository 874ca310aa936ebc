"""The exponential law on the cells of a computation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.validation import Array

if TYPE_CHECKING:
    from roughcontact.adhesion.elastic_form import ElasticForm

__all__ = ["ExponentialLaw"]


@dataclass(frozen=True, slots=True, eq=False)
class ExponentialLaw:
    """Attraction ``(w/range) exp(-gap/range)``; without a wall the gap is infinite and the attraction zero.

    Parameters
    ----------
    work : float or array
        [J/m^2]
    range : float
        [m]
    """

    work: float | Array
    range: float

    @classmethod
    def on_cells(
        cls, work: Array, length: float, strength: float, form: ElasticForm, separation: Array, modulus: float
    ) -> ExponentialLaw:
        """Return the law on the cells of a computation, evaluated at the gap of each cell."""
        return cls(work, length)

    @property
    def strength(self) -> float:
        """Largest attraction [Pa]."""
        return float(np.max(self.work)) / self.range

    @property
    def steepest(self) -> float:
        """Largest curvature [Pa/m]."""
        return float(np.max(self.work)) / self.range**2

    @property
    def start_gap(self) -> float:
        """Gap [m] at which the approach under a prescribed force starts."""
        return 10.0 * self.range

    def on(self, cells: tuple[slice, ...]) -> ExponentialLaw:
        """Return the law on some of the cells."""
        return ExponentialLaw(np.asarray(self.work)[cells], self.range)

    def traction(self, gap: Array) -> Array:
        """Return the attraction [Pa], positive, at a gap [m]."""
        return np.asarray(self.work / self.range * np.exp(-gap / self.range))

    def curvature(self, gap: Array) -> Array:
        """Return the decrease of the attraction with the gap [Pa/m], positive."""
        return np.asarray(self.work / self.range**2 * np.exp(-gap / self.range))

    def curvature_between(self, nearest: Array, farthest: Array) -> Array:
        """Return the largest curvature [Pa/m] of the gaps from `nearest` to `farthest`."""
        return self.curvature(nearest)

    def energy(self, gap: Array) -> Array:
        """Return the energy per area [J/m^2], negative."""
        return np.asarray(-self.work * np.exp(-gap / self.range))

    def energy_change(self, gap: Array, step: Array) -> Array:
        """Return the change of the energy per area [J/m^2] when the gap grows by `step`, without cancellation."""
        # Use the smaller gap: the exponential of the larger may underflow, and the ratio would be infinite.
        nearer = np.exp(-np.minimum(gap, gap + step) / self.range)
        return np.asarray(self.work * nearer * np.sign(step) * -np.expm1(-np.abs(step) / self.range))
