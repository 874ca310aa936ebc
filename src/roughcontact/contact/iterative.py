"""Large contact regions by conjugate gradients."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import largest, namespace
from roughcontact.contact.conjugate_gradient import relax
from roughcontact.contact.drivers import Driver
from roughcontact.contact.free_cells import free_cells, shared
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
        Cells whose pressure is free. Of the others those under the hardness keep it, the rest carries nothing.
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
    lacking = xp.where(there, depth - level, 0.0)
    # In this unit single precision holds all numbers.
    unit = largest(xp.where(kept, lacking, 0.0)) or limit or 1.0
    lacking = driver.narrow(xp.where(there, lacking / unit, NEVER))
    base, held = driver.narrow(start / unit), (start >= hardness) & ~kept
    goal = limit / unit
    free = free_cells(kept, held, hardness / unit, measure, base)
    change, left = xp.zeros_like(base), (base > 0) & ~kept & ~held
    moved = xp.where(left, -base, 0.0) if bool(xp.any(left)) else None
    if moved is not None and conserve:
        moved = shared(moved, base, free.inside, measure)
    target, last, steps, rounds = max(goal, DEPTH_OF_SOLVE), None, 0, 0
    while steps < max_steps and rounds < ROUNDS:
        some, error = bool(xp.any(free.inside)), 0.0
        if conserve and not some:  # none is left to take the force
            break
        if moved is not None:
            change += moved
            lacking -= driver.apply(moved)
            steps += 1
        if some:
            found = relax(
                driver,
                free.inside,
                lacking,
                conserve=conserve,
                limit=target,
                max_steps=max_steps - steps,
                last=last,
            )
            change += found.change
            lacking, last, error, steps = found.lacking, found.last, found.largest, steps + found.steps
        moved = free.let_go(base, change, conserve)
        if moved is not None:
            continue
        worst = free.take_in(lacking, 0.5 * goal)
        if worst:
            target = max(goal, DEPTH_OF_SOLVE * max(error, worst))
            rounds += 1
        elif target > goal and error <= target:
            target = goal
        else:
            break
    p = start + unit * xp.astype(change, xp.float64)
    p = xp.where((free.inside > 0) & (p > 0), p, 0.0)
    if free.held is not None:
        p = xp.where(free.held, hardness, p)
    elif isinstance(terms.control, Force):
        total = measure.total(p)
        if not total > 0:  # nothing came of it
            return RegionPressed(pressure, steps)
        p *= terms.control.value / total
    return RegionPressed(driver.scatter(p), steps)
