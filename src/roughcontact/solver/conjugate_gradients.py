"""Conjugate gradients on a given region at given displacement, whatever the sign of the pressure."""

from __future__ import annotations

from roughcontact.solver.inner_operator import Driver
from roughcontact.solver.vectors import Fields

__all__ = ["relax"]


def relax(driver: Driver, fields: Fields, *, limit: float, max_steps: int) -> tuple[float, int]:
    """Change the pressure on a region to what gives it the displacement it lacks (thesis, A.1.3 as corrected).

    Parameters
    ----------
    driver : Driver
    fields : Fields
        Of the solve: the change, and what it leaves lacking, are found there. Directions leave alone the last one of
        an earlier run.
    limit : float
        Stop when the largest lack on the region [m] is no more than this.
    max_steps : int
        Largest number of products.

    Returns
    -------
    largest : float
        Lack on the region [m].
    steps : int
        Products.

    Notes
    -----
    Each direction is made conjugate to the one before by their products themselves, so that a driver that is none too
    exact does not mislead.
    """
    fields.begin()
    size, steps = fields.size(), 0
    if not size > limit:
        return size, steps
    last = fields.measure(fields.v)
    while size > limit and steps < max_steps:
        found = fields.precondition()
        if not found.descent > 0:
            break
        t = fields.turn(-found.overlap / last.curvature if last.curvature > 0 else 0.0)
        last = fields.measure(driver.apply(t))
        steps += 1
        if not last.curvature > 0:  # rounding has eaten the direction
            break
        size = fields.advance(last.descent / last.curvature, 0.0)
    return size, steps
