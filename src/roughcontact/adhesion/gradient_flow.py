"""Where a body jumps to: the gradient flow of the energy in the gap.

Steps of the implicit Euler method, each the minimum of the energy with springs to where it starts. Springs as stiff as
the attraction can bend make every step convex. They soften as long as no step meets an indefinite Hessian, and the flow
ends in an equilibrium when the energy is convex between the last step and it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughcontact.adhesion.gap_energy import GapEnergy, Point
from roughcontact.adhesion.truncated_newton import TOLERANCE, Counter, Equilibrium, minimise
from roughcontact.validation import Array

__all__ = ["Landing", "flow", "released"]

STEPS = 400
LOOSE = 5e-1  # residual of a step on the way, relative to that at its start
ROUGH = 1e-5  # residual of an equilibrium that may be the end
STIFFEST = 4.0  # relative to the largest curvature of the attraction: every step is convex
REACH = 40.0  # ranges of the attraction, beyond which it is below the rounding of its largest value
SOFTEST = 1e-4  # springs, relative to the largest curvature of the attraction


@dataclass(frozen=True, slots=True, eq=False)
class Landing:
    """Where a flow ended.

    Attributes
    ----------
    equilibrium : Equilibrium
    lost : float
        By how much the energy fell in all [J].
    """

    equilibrium: Equilibrium
    lost: float


Convex = Callable[[GapEnergy, Point, Point], bool]


def flow(
    energy: GapEnergy,
    start: Array,
    convex: Convex,
    counter: Counter,
    *,
    first: float = 1.0,
    growth: float = 0.5,
) -> Landing:
    """Follow the gradient flow from `start` to an equilibrium.

    Parameters
    ----------
    energy : GapEnergy
    start : array
        Displacement [m].
    convex : function
        Whether the energy is convex between two points.
    counter : Counter
        Counts products.
    first, growth : float
        Stiffness of the first springs relative to the largest curvature of the attraction, and by what it changes from
        step to step.
    """
    largest = energy.attraction.steepest
    spring, lost = first, 0.0
    displacement = energy.feasible(start)
    point = energy.at(displacement)
    end: Equilibrium | None = None
    age, renewed = 0, 1
    for _ in range(STEPS):
        step = minimise(
            energy,
            displacement,
            counter,
            tolerance=max(TOLERANCE, LOOSE * energy.residual(point) / energy.scale(point)),
            proximal=spring * largest,
            iterations=60,
            convex_only=spring < STIFFEST,
        )
        if not step.converged and spring < STIFFEST:
            spring *= 4
            continue
        lost -= energy.change(point, step.point)
        point, displacement = step.point, step.point.displacement
        if released(energy, point):
            return Landing(step, lost)
        spring = max(SOFTEST, growth * spring)
        age += 1
        if end is None or age >= renewed:
            found = minimise(energy, displacement, counter, tolerance=ROUGH, convex_only=True)
            end, age, renewed = (found if found.converged else None), 0, min(2 * renewed, 8)
        # An equilibrium that was found from an earlier point is as good, if nothing lies between it and this one.
        if end is not None and convex(energy, point, end.point):
            end = minimise(energy, end.point.displacement, counter, convex_only=True)
            if end.converged:
                return Landing(end, lost - energy.change(point, end.point))
            end = None
    end = minimise(energy, displacement, counter)
    return Landing(end, lost + end.lost)


def released(energy: GapEnergy, point: Point) -> bool:
    """Whether a prescribed tension has pulled the body out of reach of the attraction: nothing stops it."""
    pulled = float(np.sum(energy.load * np.ones(energy.form.shape))) < 0
    return pulled and float(point.gap.min()) > REACH * energy.attraction.range
