"""Conjugate gradients on a given contact region, at given displacement or at given force."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.contact.measure import Measure
from roughcontact.halfspace.operator import Invertible, Linear

__all__ = ["Relaxed", "relax"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True, eq=False)
class Relaxed:
    """A pressure on a region, its displacement everywhere, the depth, the largest error inside, and the cost."""

    pressure: Array
    displacement: Array
    depth: float
    error: float
    steps: int


def relax(
    operator: Linear,
    region: Mask,
    separation: Array,
    pressure: Array,
    displacement: Array,
    *,
    depth: float | None,
    limit: float,
    max_steps: int,
) -> Relaxed:
    """Solve ``displacement = depth - separation`` on the `region` (thesis, A.1.3 as corrected).

    Parameters
    ----------
    operator : Linear
    region : bool array
        Cells that carry pressure.
    separation : array
        Undeformed gap [m]; only its values on the region matter.
    pressure, displacement : array
        Where to start [Pa], zero outside the region, and its image under the operator [m].
    depth : float or None
        Given depth [m]; without it the force of the starting pressure is kept and the depth is found.
    limit : float
        Stop when the largest error on the region [m] is no more than this.
    max_steps : int
        Largest number of products.

    Notes
    -----
    At given force the iteration runs in the space of pressures without resultant, where the operator is
    positive definite whatever the boundary condition.
    """
    measure, xp = Measure(operator.weights), namespace(pressure)
    target = xp.where(region, separation, 0.0)
    p, u = xp.asarray(pressure, copy=True), xp.asarray(displacement, copy=True)

    def errors() -> tuple[Array, float]:
        gap = xp.where(region, u + target, 0.0)
        d = measure.mean(gap, region) if depth is None else depth
        return xp.where(region, d - gap, 0.0), d

    ones = xp.where(region, xp.ones_like(p), 0.0) if depth is None else None
    precondition = _preconditioner(operator, region, measure, ones)
    r, d = errors()
    z = precondition(r)
    t = xp.asarray(z, copy=True)
    rho = measure.dot(r, z)
    steps = 0
    while (error := float(xp.max(xp.abs(r)))) > limit and steps < max_steps and rho > 0:
        v = operator.apply(t)
        q = xp.where(region, v, 0.0)
        if depth is None:
            q = xp.where(region, q - measure.mean(q, region), 0.0)
        curvature = measure.dot(t, q)
        if not curvature > 0:  # rounding has eaten the direction
            break
        alpha = rho / curvature
        p += alpha * t
        u += alpha * v
        r -= alpha * q
        z = precondition(r)
        rho, previous = measure.dot(r, z), rho
        t *= rho / previous
        t += z
        steps += 1
    r, d = errors()
    return Relaxed(p, u, d, error, steps)


def _preconditioner(
    operator: Linear, region: Mask, measure: Measure, ones: Array | None
) -> Callable[[Array], Array]:
    """Return a map from errors [m] to directions of pressure [Pa] on the region.

    Given `ones` on the region, the directions have no resultant: at given force.
    """
    xp = namespace(region)
    if not isinstance(operator, Invertible):
        return lambda r: xp.asarray(r, copy=True)
    if ones is None:
        return lambda r: xp.where(region, operator.approximate_inverse(r), 0.0)
    uniform = xp.where(region, operator.approximate_inverse(ones), 0.0)
    share = 1 / measure.total(uniform)

    def without_resultant(r: Array) -> Array:
        z: Array = xp.where(region, operator.approximate_inverse(r), 0.0)
        z -= measure.total(z) * share * uniform
        return z

    return without_resultant
