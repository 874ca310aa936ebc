"""Large contact regions by conjugate gradients."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import largest, namespace
from roughcontact.contact.conjugate_gradient import relax
from roughcontact.contact.drivers import Driver
from roughcontact.contact.measure import Measure
from roughcontact.contact.problem import Control, Force

__all__ = ["RegionPressed", "press_region"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

DEPTH_OF_SOLVE = 0.1  # of the present violation: how far a region is solved that is but a guess
ROUNDS = 20  # of adding cells, before an exact product has its say
NEVER = -1e30  # a lack of displacement that brings no cell into contact


@dataclass(frozen=True, slots=True, eq=False)
class RegionPressed:
    """A pressure [Pa], nowhere negative and zero outside its region, and the products that it took."""

    pressure: Array
    steps: int


def press_region(
    driver: Driver,
    separation: Array,
    control: Control,
    region: Mask,
    pressure: Array,
    displacement: Array,
    *,
    limit: float,
    max_steps: int,
) -> RegionPressed:
    """Press on a region alone and let go of cells that would pull, until none does.

    The counterpart of `press_cells`: both end with a pressure that is nowhere negative, so that cells are
    added only to a region whose answer is known. (Adding while letting go, as the method does where each
    region is solved exactly, runs in circles where it is not.)

    Parameters
    ----------
    driver : Driver
        It holds the region and all cells under pressure. Only changes of pressure pass through it: of them alone it
        gets some part wrong.
    separation, control
        The problem.
    region : bool array
        Cells that may carry pressure.
    pressure, displacement : array
        Where to start [Pa], and its exact image [m].
    limit : float
        Largest error of the displacement on the cells that are kept [m].
    max_steps : int
        Largest number of products.
    """
    measure, xp = Measure(driver.weights), namespace(pressure)
    conserve = isinstance(control, Force)
    level = separation + displacement
    depth = measure.mean(level, region) if conserve else control.value
    finite = xp.isfinite(level)
    lacking = xp.where(finite, depth - level, 0.0)
    unit = (
        largest(xp.where(region, lacking, 0.0)) or limit or 1.0
    )  # so that single precision holds all numbers
    lacking /= unit
    lacking = xp.where(driver.gather(finite), driver.gather(lacking), NEVER)
    kept, base = driver.gather(region), driver.gather(pressure / unit)
    force = control.value / unit if conserve else None
    change, p, goal = xp.zeros_like(base), base, limit / unit
    dropped = (base > 0) & ~kept
    target, last, steps, rounds = max(goal, DEPTH_OF_SOLVE), None, 0, 0
    while steps < max_steps and rounds < ROUNDS:
        inside = xp.astype(kept, base.dtype)
        if bool(xp.any(dropped)):
            lost = _without(p, dropped, inside, measure, force)
            change += lost
            lacking -= driver.apply(lost)
            steps += 1
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
        lacking, last, steps = found.lacking, found.last, steps + found.steps
        p = base + change
        dropped = (p < 0) & kept
        if bool(xp.any(dropped)):
            kept = kept & ~dropped
            if not bool(xp.any(kept)):
                break
            continue
        added = (lacking > 0.5 * goal) & ~kept
        if bool(xp.any(added)):
            worst = max(found.largest, float(xp.max(xp.where(added, lacking, 0.0))))
            target = max(goal, DEPTH_OF_SOLVE * worst)
            kept, rounds = kept | added, rounds + 1
        elif target > goal and found.largest <= target:
            target = goal
        else:
            break
    p = pressure + unit * driver.scatter(change)
    p = xp.where(driver.scatter(kept) & (p > 0), p, 0.0)
    if isinstance(control, Force):
        total = measure.total(p)
        if not total > 0:  # nothing came of it
            return RegionPressed(pressure, steps)
        p *= control.value / total
    return RegionPressed(p, steps)


def _without(p: Array, dropped: Mask, inside: Array, measure: Measure, force: float | None) -> Array:
    """Return the change of pressure that takes it from some cells and gives the force, if kept, to the others."""
    xp = namespace(p)
    change: Array = xp.where(dropped, -p, 0.0)
    if force is not None:
        carrying = p * inside
        total = measure.total(carrying)
        # Ratios of small numbers: in single precision the whole is not known as well as its part.
        change += (
            carrying * (-measure.total(change) / total)
            if total > 0
            else inside * (force / measure.total(inside))
        )
    return change
