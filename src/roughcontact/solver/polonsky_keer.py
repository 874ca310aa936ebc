"""The projected conjugate gradients of Polonsky and Keer (Wear 231, 206, 1999)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.halfspace.operators.operator import Operator, is_semidefinite
from roughcontact.solver.control import Terms
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import Judge
from roughcontact.solver.projection import depth_of, within
from roughcontact.solver.start import start_pressure
from roughcontact.solver.state import State
from roughcontact.solver.status import Status
from roughcontact.validation import require_numbers

__all__ = ["PolonskyKeer"]

Array = npt.NDArray[np.float64]

LEAP = 4.0  # times the least residual so far
CIRCLING = 10  # iterations without a smaller residual, after which cells that are wrong may run in circles
PATIENCE = 500  # iterations without a smaller residual, after which rounding or a cycle has the better of it


@dataclass(frozen=True, slots=True)
class PolonskyKeer:
    """Settings of the projected method: robust, and the reference for the other solver."""

    max_steps: int = 20000

    def __post_init__(self) -> None:
        require_numbers(self)

    def run(self, operator: Operator, separation: Array, terms: Terms, initial: Array) -> State:
        """Solve for the pressure from an `initial` one, on the given terms.

        Differs from the paper: any control, a stop by the conditions of contact instead of the step, and,
        where a step leaves too large a force, the projection on the pressures of the right one instead of a
        common factor, with which the method can run in circles of two. A hardness bounds the pressure from above
        as zero does from below.
        """
        measure = Measure(operator.weights)
        judge = Judge.of(operator, terms)
        own, hardness, given = judge.self_influence, terms.hardness, terms.depth
        xp = namespace(separation)
        if hardness == np.inf:
            p = start_pressure(measure, separation, terms.control, initial, own)
        else:  # not scaled to the force: what is under the hardness is to stay there
            p = xp.where(xp.isfinite(separation) & (initial > 0), initial, 0.0)
            p = within(measure, p, separation, terms)
        t, before = xp.zeros_like(p), p > 0
        singular = given is not None and is_semidefinite(operator)
        d = 0.0 if given is None else given
        delta, norm_old = 0.0, 1.0
        best, idle, steps = np.inf, 0, 0
        while True:
            u = operator.apply(p)
            steps += 1
            inside = (p > 0) & (p < hardness)
            g = u + (separation - d)  # in this order: where much flows, u may be far smaller than both
            if given is None:
                shift = depth_of(measure, g, p, inside)
                g -= shift
                d += shift
            elif singular and bool(xp.all(inside)):
                p = _to_bound(p, hardness, float(xp.mean(g)))
                inside = (p > 0) & (p < hardness)
            r = judge.residual(p, u, g)
            idle = 0 if r < best else idle + 1
            best = min(best, r)
            if r <= terms.tolerance:
                return State(p, d, r, steps, Status.CONVERGED, displacement=u)
            if steps >= self.max_steps:
                return State(p, d, r, steps, Status.MAX_STEPS)
            if idle > PATIENCE or not bool(xp.all(xp.isfinite(p))):
                return State(p, d, r, steps, Status.STAGNATED)
            wrong = ((p == 0) & (g < 0)) | ((p == hardness) & (g > 0))
            some_wrong, free = bool(xp.any(wrong)), inside
            # Too long a step for those that were wrong: one that suits them too. On the same cells as before
            # the residual of conjugate gradients may leap.
            if (some_wrong and idle > CIRCLING) or (r > LEAP * best and bool(xp.any(free != before))):
                inside, delta = inside | wrong, 0.0
            errors = xp.where(inside, g, 0.0)
            norm = measure.dot(errors, errors)
            tau = 1 / own  # what a single cell needs, which at given force has no error to shrink
            if norm > 0 and norm_old > 0:
                t = xp.where(inside, g + delta * (norm / norm_old) * t, 0.0)
                v = operator.apply(t)
                steps += 1
                if given is None:
                    v -= measure.mean(v, inside)
                curvature = measure.dot(v, t)
                if curvature > 0:
                    tau = measure.dot(errors, t) / curvature
            else:
                t = xp.zeros_like(p)
            norm_old = norm if norm > 0 else 1.0
            p = xp.where(inside, xp.clip(p - tau * t, 0.0, hardness), p)
            p = xp.where(wrong, xp.clip(p - tau * g, 0.0, hardness), p)
            delta, before = 0.0 if some_wrong else 1.0, free
            if given is None and 0 < measure.total(p) < np.inf:
                p = within(measure, p, g, terms)


def _to_bound(pressure: Array, hardness: float, gap: float) -> Array:
    """Return a pressure that nothing bounds, with a constant added that takes one cell to zero or to the hardness.

    At a given depth a periodic body in full contact has no equilibrium between the bounds: on the mean its `gap` is
    what the depth leaves, whatever the pressure, and a constant moves nothing.
    """
    xp = namespace(pressure)
    if gap > 0 or hardness == np.inf:
        return pressure - xp.min(pressure)  # type: ignore[no-any-return]
    strongest = xp.max(pressure)
    return xp.where(pressure == strongest, hardness, pressure + (hardness - strongest))  # type: ignore[no-any-return]
