"""The projected conjugate gradients of Polonsky and Keer (Wear 231, 206, 1999)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.contact.measure import Measure
from roughcontact.contact.optimality import Judge
from roughcontact.contact.problem import Control, Force
from roughcontact.contact.start import start_pressure
from roughcontact.contact.state import State
from roughcontact.contact.status import Status
from roughcontact.halfspace.operator import Operator

__all__ = ["PolonskyKeer"]

Array = npt.NDArray[np.float64]

PATIENCE = 500  # iterations without a smaller residual, after which rounding or a cycle has the better of it


@dataclass(frozen=True, slots=True)
class PolonskyKeer:
    """Settings of the projected method: robust, and the reference for the other solver."""

    max_steps: int = 20000

    def run(
        self, operator: Operator, separation: Array, control: Control, initial: Array, tolerance: float
    ) -> State:
        """Solve for the pressure from an `initial` one, down to a residual of `tolerance`.

        Differs from the paper: any control, a stop by the conditions of contact instead of the step, and,
        where a step leaves too large a force, the projection on the pressures of the right one instead of a
        common factor, with which the method can run in circles of two.
        """
        measure = Measure(operator.weights)
        judge = Judge.of(operator, control)
        own = judge.self_influence
        forced = isinstance(control, Force)
        p = start_pressure(measure, separation, control, initial, own)
        t = np.zeros_like(p)
        delta, norm_old = 0.0, 1.0
        best, idle, steps = np.inf, 0, 0
        while True:
            u = operator.apply(p)
            steps += 1
            inside = p > 0
            g = u + separation
            d = measure.mean(g, inside) if forced else control.value
            g -= d
            r = judge.residual(p, u, g)
            idle = 0 if r < best else idle + 1
            best = min(best, r)
            if r <= tolerance:
                return State(p, d, r, steps, Status.CONVERGED)
            if steps >= self.max_steps:
                return State(p, d, r, steps, Status.MAX_STEPS)
            if idle > PATIENCE or not np.isfinite(p).all():
                return State(p, d, r, steps, Status.STAGNATED)
            errors = np.where(inside, g, 0.0)
            norm = measure.dot(errors, errors)
            tau = 1 / own  # what a single cell needs, which at given force has no error to shrink
            if norm > 0 and norm_old > 0:
                t = np.where(inside, g + delta * (norm / norm_old) * t, 0.0)
                v = operator.apply(t)
                steps += 1
                if forced:
                    v -= measure.mean(v, inside)
                curvature = measure.dot(v, t)
                if curvature > 0:
                    tau = measure.dot(errors, t) / curvature
            else:
                t[:] = 0.0
            norm_old = norm if norm > 0 else 1.0
            p = np.where(inside, np.maximum(p - tau * t, 0.0), 0.0)
            overlap = (p == 0) & (g < 0)
            p[overlap] = -tau * g[overlap]
            delta = 0.0 if overlap.any() else 1.0
            if forced and 0 < measure.total(p) < np.inf:
                p = _under_force(measure, p, control.value)


def _under_force(measure: Measure, pressure: Array, force: float) -> Array:
    """Return the pressure under the right force: the nearest one below, or the same enlarged.

    The nearest is ``max(pressure - shift, 0)``; each pass finds the shift for the cells that are left.
    """
    if measure.total(pressure) > force:
        left = pressure > 0
        while True:
            shift = (measure.total(np.where(left, pressure, 0.0)) - force) / measure.total(left)
            fewer = left & (pressure > shift)
            if (fewer == left).all():
                break
            left = fewer
        pressure = np.where(left, pressure - shift, 0.0)
    return pressure * (force / measure.total(pressure))
