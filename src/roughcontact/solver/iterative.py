"""Large contact regions by conjugate gradients."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.solver.bound_constrained_cg import Stride, descend
from roughcontact.solver.control import Force, Terms
from roughcontact.solver.inner_operator import Driver
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.trial import Trial
from roughcontact.solver.vectors import scaled_fields

__all__ = ["RegionPressed", "press_region"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

DEPTH_OF_SOLVE = 0.2  # of the present violation: how far a region is solved that is but a guess
ROUNDS = 20  # of adding cells, before an exact product has its say


@dataclass(frozen=True, slots=True, eq=False)
class RegionPressed:
    """A pressure [Pa] between zero and the hardness, and the products that it took."""

    pressure: Array
    steps: int


def press_region(
    driver: Driver,
    separation: Array,
    terms: Terms,
    region: Mask,
    pressure: Array,
    displacement: Array,
    *,
    own: float,
    limit: float,
    max_steps: int,
) -> RegionPressed:
    """Press on a region, let go of cells that would pull, hold those that give way, and add those that penetrate.

    Cells are let go of until none pulls before any is added: adding and letting go at once, as is right where each
    region is solved exactly, runs in circles where it is not.

    Parameters
    ----------
    driver : Driver
        It has all cells of the region and all under pressure. Only changes of pressure pass through it: of them alone
        it gets some part wrong.
    separation, terms
        The problem.
    region : bool array
        Cells whose pressure is free, one at least, none of them missing. Of the others those under the hardness keep
        it, the rest carries nothing.
    pressure, displacement : array
        Where to start [Pa], and its image [m].
    own : float
        Displacement of a cell per unit pressure on itself [m/Pa].
    limit : float
        Largest error of the displacement on the cells that are kept [m].
    max_steps : int
        Largest number of products.
    """
    measure, xp = Measure(driver.weights), namespace(pressure)
    conserve, hardness = terms.depth is None, terms.hardness
    start = driver.gather(pressure)
    # What was not measured is never touched; nor is what a driver has beyond the edge.
    trial = Trial(start, driver.gather(displacement), driver.gather(separation, math.inf))
    fields, unit = scaled_fields(driver, measure, terms, driver.gather(region), trial, otherwise=limit)
    goal = limit / unit
    target, steps, rounds, stride = max(goal, DEPTH_OF_SOLVE), 0, 0, Stride()
    while steps < max_steps and rounds < ROUNDS:
        error, done, stride = descend(
            driver, fields, stride, conserve=conserve, own=own, limit=target, max_steps=max_steps - steps
        )
        steps += done
        worst = fields.take_in(0.5 * goal)
        if worst:
            target = max(goal, DEPTH_OF_SOLVE * max(error, worst))
            rounds += 1
        elif target > goal and error <= target:
            target = goal
        else:
            break
    p = fields.pressure(start, unit)
    if fields.held is not None:
        p = xp.where(fields.held, hardness, p)
    elif isinstance(terms.control, Force):
        total = measure.total(p)
        if not total > 0:  # nothing came of it
            return RegionPressed(pressure, steps)
        p *= terms.control.value / total
    return RegionPressed(driver.scatter(p), steps)
