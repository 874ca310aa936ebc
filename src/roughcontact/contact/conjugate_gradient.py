"""Conjugate gradients on a given contact region, at given displacement or at given force."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.contact.drivers import Driver
from roughcontact.contact.measure import Measure
from roughcontact.contact.passes import passes_for

__all__ = ["Direction", "Relaxed", "relax"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Direction:
    """The last direction of pressure, and the displacement that it causes."""

    pressure: Array
    displacement: Array


@dataclass(frozen=True, slots=True, eq=False)
class Relaxed:
    """A change of pressure on a region, the lacking displacement that it leaves, its largest inside, and the cost."""

    change: Array
    lacking: Array
    largest: float
    steps: int
    last: Direction | None


def relax(
    driver: Driver,
    inside: Array,
    lacking: Array,
    *,
    conserve: bool,
    limit: float,
    max_steps: int,
    last: Direction | None = None,
) -> Relaxed:
    """Find the change of pressure on a region that gives it the displacement it lacks (thesis, A.1.3 as corrected).

    Parameters
    ----------
    driver : Driver
        It works in the precision of the fields.
    inside : array
        One on the cells of the region, zero elsewhere.
    lacking : array
        Displacement that is lacking [m], finite; outside the region it counts for nothing and is carried on.
    conserve : bool
        Whether the change has no resultant. Then a displacement that is lacking everywhere alike is none.
    limit : float
        Stop when the largest lack on the region [m] is no more than this.
    max_steps : int
        Largest number of products.
    last : Direction, optional
        Where another solve left off, on nearly the same region: what follows leaves it alone.

    Notes
    -----
    Where the force is kept the iteration runs in the space of pressures without resultant, where the operator is
    positive definite whatever the boundary condition. Each direction is made conjugate to the one before by their
    products themselves, so that neither a driver that is none too exact nor a region that has changed a little mislead.
    """
    measure, xp = Measure(driver.weights), namespace(lacking)
    area, steps = measure.total(inside), 0
    r = lacking - measure.dot(inside, lacking) / area if conserve else xp.asarray(lacking, copy=True)
    before = (None, None) if last is None else (last.pressure, last.displacement)
    fields = passes_for(driver, measure, inside, r, *before)
    size = fields.size()
    if not size > limit:
        return Relaxed(fields.change, r, size, steps, last)
    resultant = fields.share() if conserve else 1.0
    curvature, level, _, force = fields.measure(fields.v)
    while size > limit and steps < max_steps:
        mean = level / area if conserve else 0.0
        descent, overlap, total = fields.precondition()
        if not descent > 0:
            break
        beta = -(overlap - mean * total) / curvature if curvature else 0.0
        t = fields.turn(beta, (total + beta * force) / resultant)
        curvature, level, descent, force = fields.measure(driver.apply(t))
        if not curvature > 0:  # rounding has eaten the direction
            break
        size = fields.advance(descent / curvature, level / area if conserve else 0.0)
        steps += 1
    return Relaxed(fields.change, fields.r, size, steps, Direction(fields.t, fields.v) if steps else last)
