"""Large contact regions by conjugate gradients."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import largest, namespace
from roughcontact.contact.conjugate_gradient import relax
from roughcontact.contact.drivers import Driver
from roughcontact.contact.fields import fields_on, shared
from roughcontact.contact.measure import Measure
from roughcontact.contact.problem import Force, Terms

__all__ = ["RegionPressed", "press_region"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

DEPTH_OF_SOLVE = 0.1  # of the present violation: how far a region is solved that is but a guess
ROUNDS = 20  # of adding cells, before an exact product has its say
NEVER = -1e30  # a lack of displacement that brings no cell into contact


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
    limit : float
        Largest error of the displacement on the cells that are kept [m].
    max_steps : int
        Largest number of products.
    """
    measure, xp = Measure(driver.weights), namespace(pressure)
    conserve, hardness = terms.depth is None, terms.hardness
    kept, start = driver.gather(region), driver.gather(pressure)
    level = driver.gather(separation) + driver.gather(displacement)
    depth = measure.mean(level, kept) if terms.depth is None else terms.depth
    # What was not measured is never touched; nor is what a driver has beyond the edge.
    there = driver.gather(xp.isfinite(separation))
    whole = bool(xp.all(there))
    lacking = depth - (level if whole else xp.where(there, level, math.inf))
    # In this unit single precision holds all numbers.
    unit = largest(lacking[kept]) or limit or 1.0
    lacking = driver.narrow(lacking / unit)
    if not whole:
        lacking = xp.where(there, lacking, NEVER)
    base, held = driver.narrow(start / unit), (start >= hardness) & ~kept
    goal = limit / unit
    fields = fields_on(driver, measure, kept, lacking, base, held, hardness / unit)
    left = (base > 0) & ~kept & ~held
    moved = xp.where(left, -base, 0.0) if bool(xp.any(left)) else None
    if moved is not None:
        moved = shared(moved, base, fields.inside, measure) if conserve else moved
        fields.change += moved
    target, steps, rounds = max(goal, DEPTH_OF_SOLVE), 0, 0
    while steps < max_steps and rounds < ROUNDS:
        some, error = not fields.is_empty(), 0.0
        if conserve and not some:  # none is left to take the force
            break
        if moved is not None:
            fields.follow(driver.apply(moved))
            steps += 1
        if some:
            error, done = relax(driver, fields, conserve=conserve, limit=target, max_steps=max_steps - steps)
            steps += done
        moved = fields.let_go(conserve)
        if moved is not None:
            continue
        worst = fields.take_in(0.5 * goal)
        if worst:
            target = max(goal, DEPTH_OF_SOLVE * max(error, worst))
            rounds += 1
        elif target > goal and error <= target:
            target = goal
        else:
            break
    # In place: planes are large.
    p = xp.astype(fields.change, xp.float64)
    p *= unit
    p += start
    p = xp.where(p > 0, p, 0.0)
    p *= fields.inside
    if fields.held is not None:
        p = xp.where(fields.held, hardness, p)
    elif isinstance(terms.control, Force):
        total = measure.total(p)
        if not total > 0:  # nothing came of it
            return RegionPressed(pressure, steps)
        p *= terms.control.value / total
    return RegionPressed(driver.scatter(p), steps)
