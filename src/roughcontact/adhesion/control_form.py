"""Prescribed depth, or prescribed force with the depth free, as an energy.

Under a force F the displacement is counted from the flat, v = u - d on the cells of the grid, and the depth is
eliminated: the elastic energy loses its part along a rigid shift, ``K' = K - (K 1)(K 1)^T/(1.K 1)``, and F enters as
the traction ``F K 1/(1.K 1)``. On a periodic grid the mean displacement is always zero, so K' is K and the traction is
uniform.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from roughcontact.adhesion.attraction import Attraction
from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.adhesion.gap_energy import GapEnergy, Point
from roughcontact.validation import Array

__all__ = ["DepthControl", "ForceControl"]


@dataclass(frozen=True, slots=True, eq=False)
class DepthControl:
    """Prescribed depths of a body.

    Parameters
    ----------
    form : ElasticForm
    attraction : Attraction
        On the cells of the computation.
    separation : array, shape of the grid
        [m]
    """

    form: ElasticForm
    attraction: Attraction
    separation: Array

    def energy_at(self, value: float) -> GapEnergy:
        """Return the energy at a depth [m]."""
        return GapEnergy(self.form, self.attraction, self.form.extended(value - self.separation, -np.inf))

    def depth(self, value: float, point: Point) -> float:
        """Return the depth of a point [m]."""
        return value


@dataclass(frozen=True, slots=True, eq=False)
class ForceControl:
    """Prescribed forces on a body; use `of` to make it.

    Parameters
    ----------
    form : ElasticForm
        The form of a body whose depth is free.
    attraction : Attraction
        On the cells of the computation.
    separation : array, shape of the grid
        [m]
    unit : array
        Traction of a unit force [1/m^2].
    rigid : float
        Force per depth of the cells displaced as a whole [N/m]; zero if the mean displacement is always zero.
    """

    form: ElasticForm
    attraction: Attraction
    separation: Array
    unit: Array
    rigid: float

    @classmethod
    def of(cls, control: DepthControl) -> ForceControl:
        """Return the control by force of the same body."""
        form = control.form
        ones = form.extended(np.ones(form.grid.shape), 0.0)
        if form.mean_free:
            free_form = replace(form, mean_free=False)
            return cls(free_form, control.attraction, control.separation, ones / form.grid.area, 0.0)
        image = form.stiffness(ones)
        rigid = form.dot(image, ones)

        def reduced(field: Array) -> Array:
            return form.stiffness(field) - image * (form.dot(image, field) / rigid)

        free_form = replace(form, stiffness=reduced)
        return cls(free_form, control.attraction, control.separation, image / rigid, rigid)

    def energy_at(self, value: float) -> GapEnergy:
        """Return the energy under a force [N]."""
        obstacle = self.form.extended(-self.separation, -np.inf)
        return GapEnergy(self.form, self.attraction, obstacle, value * self.unit)

    def depth(self, value: float, point: Point) -> float:
        """Return the depth of a point [m]."""
        if self.rigid == 0:
            return -float(point.displacement.mean())
        return (value - self.form.dot(self.unit, point.displacement) * self.rigid) / self.rigid
