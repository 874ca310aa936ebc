"""Conjugate gradients on a given contact region, at given displacement or at given force."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.contact.measure import Measure
from roughcontact.halfspace.operator import Invertible, Operator

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
    operator: Operator,
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
    operator : Operator
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
    measure = Measure(operator.weights)
    target = np.where(region, separation, 0.0)
    p, u = pressure.copy(), displacement.copy()

    def errors() -> tuple[Array, float]:
        gap = np.where(region, u + target, 0.0)
        d = measure.mean(gap, region) if depth is None else depth
        return np.where(region, d - gap, 0.0), d

    precondition = _preconditioner(operator, region, measure, free=depth is None)
    r, d = errors()
    z = precondition(r)
    t = z.copy()
    rho = measure.dot(r, z)
    steps = 0
    while (error := float(np.abs(r).max())) > limit and steps < max_steps and rho > 0:
        v = operator.apply(t)
        q = np.where(region, v, 0.0)
        if depth is None:
            q[region] -= measure.mean(q, region)
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
    operator: Operator, region: Mask, measure: Measure, *, free: bool
) -> Callable[[Array], Array]:
    """Return a map from errors [m] to directions of pressure [Pa] on the region, without resultant if `free`."""
    if not isinstance(operator, Invertible):
        return np.copy
    if not free:
        return lambda r: np.where(region, operator.approximate_inverse(r), 0.0)
    uniform = np.where(region, operator.approximate_inverse(np.where(region, 1.0, 0.0)), 0.0)
    share = 1 / measure.total(uniform)

    def without_resultant(r: Array) -> Array:
        z = np.where(region, operator.approximate_inverse(r), 0.0)
        z -= measure.total(z) * share * uniform
        return z

    return without_resultant
