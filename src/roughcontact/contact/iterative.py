"""Large contact regions by conjugate gradients."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import largest, namespace
from roughcontact.contact.conjugate_gradient import relax
from roughcontact.contact.drivers import Driver
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
    base, ceiling, held = driver.narrow(start / unit), hardness / unit, (start >= hardness) & ~kept
    goal = limit / unit
    change, p, low, high = xp.zeros_like(base), base, (base > 0) & ~kept & ~held, kept & ~kept
    target, last, steps, rounds = max(goal, DEPTH_OF_SOLVE), None, 0, 0
    while steps < max_steps and rounds < ROUNDS:
        inside, some, error = xp.astype(kept, base.dtype), bool(xp.any(kept)), 0.0
        if conserve and not some:  # none is left to take the force
            break
        if bool(xp.any(low | high)):
            moved = xp.where(low, -p, 0.0)
            if hardness < math.inf:
                moved = xp.where(high, ceiling - p, moved)
            if conserve:
                moved = _shared(moved, p, inside, measure)
            change += moved
            lacking -= driver.apply(moved)
            steps += 1
        if some:
            found = relax(
                driver,
                inside,
                lacking,
                conserve=conserve,
                limit=target,
                max_steps=max_steps - steps,
                last=last,
            )
            change += found.change
            lacking, last, error, steps = found.lacking, found.last, found.largest, steps + found.steps
        p = base + change
        low, high = kept & (p < 0), kept & (p > ceiling)
        if bool(xp.any(low | high)):
            kept, held = kept & ~(low | high), held | high
            continue
        added = ((lacking > 0.5 * goal) & ~kept & ~held) | ((lacking < -0.5 * goal) & held)
        if bool(xp.any(added)):
            worst = max(error, largest(xp.where(added, lacking, 0.0)))
            target = max(goal, DEPTH_OF_SOLVE * worst)
            kept, held, rounds = kept | added, held & ~added, rounds + 1
        elif target > goal and error <= target:
            target = goal
        else:
            break
    p = start + unit * xp.astype(change, xp.float64)
    p = xp.where(kept & (p > 0), p, 0.0)
    if hardness < math.inf:
        p = xp.where(held, hardness, p)
    elif isinstance(terms.control, Force):
        total = measure.total(p)
        if not total > 0:  # nothing came of it
            return RegionPressed(pressure, steps)
        p *= terms.control.value / total
    return RegionPressed(driver.scatter(p), steps)


def _shared(change: Array, p: Array, inside: Array, measure: Measure) -> Array:
    """Return a change of pressure together with what keeps the force, shared by the cells inside."""
    carrying = p * inside
    total = measure.total(carrying)
    if not total > 0:  # new cells only
        carrying, total = inside, measure.total(inside)
    # A ratio of sums of the same size: in single precision a whole is not known as well as its part.
    return change + carrying * (-measure.total(change) / total)
