"""Adhesion of no range: cells in contact are stuck until one lets go."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.validation import Array

__all__ = ["SharpLaw"]


@dataclass(frozen=True, slots=True, eq=False)
class SharpLaw:
    """No attraction across a gap, and the energy -w in contact.

    Parameters
    ----------
    work : array
        [J/m^2]
    """

    work: Array

    @property
    def range(self) -> float:
        """Length of the law [m]."""
        return 0.0

    @property
    def strength(self) -> float:
        """Largest attraction across a gap [Pa]."""
        return 0.0

    @property
    def steepest(self) -> float:
        """Largest curvature [Pa/m]."""
        return 0.0

    @property
    def near(self) -> float:
        """Gap [m] from which bodies under a given force draw near."""
        return 0.0

    def on(self, cells: tuple[slice, ...]) -> SharpLaw:
        """Return the law on some of the cells."""
        return SharpLaw(self.work[cells])

    def traction(self, gap: Array) -> Array:
        """Return the attraction [Pa] at a gap [m]: none."""
        return np.zeros(np.shape(gap))

    def curvature(self, gap: Array) -> Array:
        """Return by how much the attraction falls with the gap [Pa/m]: it does not."""
        return np.zeros(np.shape(gap))

    def curvature_between(self, nearest: Array, farthest: Array) -> Array:
        """Return the largest curvature [Pa/m] of the gaps from `nearest` to `farthest`."""
        return np.zeros(np.shape(nearest))

    def energy(self, gap: Array) -> Array:
        """Return the energy per area [J/m^2]: -w without a gap."""
        return np.where(gap <= 0, -self.work, 0.0)

    def energy_change(self, gap: Array, step: Array) -> Array:
        """Return the change of the energy per area [J/m^2] across gaps: none."""
        return np.zeros(np.shape(gap))
