"""Conjugate gradients on a given contact region, at given displacement or at given force."""

from __future__ import annotations

from roughcontact.contact.drivers import Driver
from roughcontact.contact.fields import Fields

__all__ = ["relax"]


def relax(
    driver: Driver, fields: Fields, *, conserve: bool, limit: float, max_steps: int
) -> tuple[float, int]:
    """Change the pressure on a region to what gives it the displacement it lacks (thesis, A.1.3 as corrected).

    Parameters
    ----------
    driver : Driver
    fields : Fields
        Of the solve: the change, and what it leaves lacking, are found there. Directions leave alone the last one of
        an earlier run on nearly the same region.
    conserve : bool
        Whether the change has no resultant. Then a displacement that is lacking everywhere alike is none.
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
    Where the force is kept the iteration runs in the space of pressures without resultant, where the operator is
    positive definite whatever the boundary condition. Each direction is made conjugate to the one before by their
    products themselves, so that neither a driver that is none too exact nor a region that has changed a little mislead.
    """
    area = fields.begin(conserve)
    size, steps = fields.size(), 0
    if not size > limit:
        return size, steps
    resultant = fields.share() if conserve else 1.0
    curvature, sum_of_v, _, force = fields.measure(fields.v)
    while size > limit and steps < max_steps:
        mean = sum_of_v / area if conserve else 0.0
        descent, overlap, total = fields.precondition()
        if not descent > 0:
            break
        beta = -(overlap - mean * total) / curvature if curvature > 0 else 0.0
        t = fields.turn(beta, (total + beta * force) / resultant)
        curvature, sum_of_v, descent, force = fields.measure(driver.apply(t))
        if not curvature > 0:  # rounding has eaten the direction
            break
        size = fields.advance(descent / curvature, sum_of_v / area if conserve else 0.0)
        steps += 1
    return size, steps
