"""The energy of the gap: elastic energy of the displacement, and attraction across the gap, above a hard wall.

See docs/concepts/method-adhesion.md, section 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.adhesion.attraction import Attraction
from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.validation import Array, Mask

__all__ = ["GapEnergy", "Point"]


@dataclass(frozen=True, slots=True, eq=False)
class Point:
    """A displacement, its pressure and the gradient of the energy there.

    Attributes
    ----------
    displacement, pressure : array
        [m] and [Pa], on all cells of the computation.
    gap : array
        [m]; infinite without a wall.
    reaction : array
        Pressure and attraction: the gradient of the energy per area [Pa]. In equilibrium the reaction of the wall.
    mean_pressure : float
        Multiplier of a prescribed mean displacement [Pa], part of pressure and reaction; 0 if it is not prescribed.
    """

    displacement: Array
    pressure: Array
    gap: Array
    reaction: Array
    mean_pressure: float

    @property
    def free(self) -> Mask:
        """Cells that are free to move: away from the wall, or pulled away from it."""
        return np.asarray((self.gap > 0) | (self.reaction <= 0))


@dataclass(frozen=True, slots=True, eq=False)
class GapEnergy:
    """``E(u) = 1/2 u.K u + sum_i a_i phi(gap_i)`` with ``gap = u - obstacle >= 0``.

    Parameters
    ----------
    form : ElasticForm
    attraction : Attraction
        On the cells of the computation.
    obstacle : array, shape ``form.shape``
        Displacement at which a cell touches the wall [m]: depth minus separation; minus infinity without a wall.
    load : float or array
        Traction of a prescribed force [Pa], part of the pressure; the energy includes its work.
    """

    form: ElasticForm
    attraction: Attraction
    obstacle: Array
    load: float | Array = 0.0

    def at(self, displacement: Array) -> Point:
        """Return the point of a displacement."""
        elastic = self.form.stiffness(displacement) + self.load
        gap = displacement - self.obstacle
        reaction = elastic + self.attraction.traction(gap)
        mean = 0.0
        if self.form.mean_free:
            # The multiplier: the reaction of the free cells must vanish, and the set of free cells depends on it.
            mean = _balance(reaction, gap > 0)
            elastic = elastic + mean
            reaction += mean
        return Point(displacement, elastic, gap, reaction, mean)

    def feasible(self, trial: Array) -> Array:
        """Return the nearest displacement above the obstacle, of zero mean if the form requires that."""
        projected = np.maximum(trial, self.obstacle)
        if not self.form.mean_free:
            return projected
        shift = 0.0
        for _ in range(60):  # piecewise linear and convex: Newton's method ends
            mean = float(projected.mean())
            above = projected > self.obstacle
            count = int(np.count_nonzero(above))
            if count == 0 or abs(mean) <= 1e-16 * float(np.abs(projected).max()):
                break
            shift += mean * projected.size / count
            projected = np.maximum(trial - shift, self.obstacle)
        return projected

    def at_depth(self, point: Point) -> Point:
        """Return a point of another depth moved to this depth: cells stay at the wall, or keep their displacement."""
        touching = point.gap <= 0
        moved = np.where(touching, self.obstacle, point.displacement)
        if self.form.mean_free and not touching.all():
            moved -= np.where(touching, 0.0, moved.sum() / np.count_nonzero(~touching))
        return self.at(self.feasible(moved))

    def change(self, old: Point, new: Point) -> float:
        """Return the change of the energy [J] from one point to another, without cancellation."""
        step = new.displacement - old.displacement
        bounded = np.isfinite(old.gap)
        adhesive = self.attraction.energy_change(old.gap, np.where(bounded, step, 0.0))
        elastic = 0.5 * (old.pressure - old.mean_pressure + new.pressure - new.mean_pressure)
        weights = self.form.weights
        return float(np.sum((elastic * step + adhesive) * weights))

    def force(self, point: Point) -> float:
        """Return the force on the cells of the grid [N]."""
        inside = self.form.inside
        weights = self.form.weights if isinstance(self.form.weights, float) else self.form.weights[inside]
        return float(np.sum(point.pressure[inside] * weights))

    def residual(self, point: Point) -> float:
        """Return the largest violation of the conditions of equilibrium [Pa]: a gap counts by the cell's stiffness."""
        violation = np.minimum(point.gap / self.form.reference, point.reaction)
        return float(np.abs(violation).max())

    def scale(self, point: Point) -> float:
        """Return the traction to which residuals are relative [Pa]."""
        return max(self.attraction.strength, float(np.abs(point.pressure).max()))


def _balance(reaction: Array, apart: Mask) -> float:
    """Return the constant whose sum with the reaction has zero mean over the cells that are then free."""
    touching = reaction[~apart]
    count = int(np.count_nonzero(apart))
    total = float(reaction[apart].sum())
    if count == 0:
        return -float(touching.min()) if touching.size else 0.0
    mean = -total / count
    for _ in range(60):  # cells at the wall that would be pulled off are free as well
        pulled = touching[touching + mean < 0]
        new = -(total + float(pulled.sum())) / (count + pulled.size)
        if abs(new - mean) <= 1e-15 * abs(mean):
            break
        mean = new
    return mean
