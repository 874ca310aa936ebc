"""The projected conjugate gradients of Polonsky and Keer (Wear 231, 206, 1999)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.contact.measure import Measure
from roughcontact.contact.optimality import displacement_scale, residual
from roughcontact.contact.problem import Control, Force
from roughcontact.contact.start import start_pressure
from roughcontact.contact.state import State
from roughcontact.contact.status import Status
from roughcontact.halfspace.operator import Operator

__all__ = ["PolonskyKeer"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PolonskyKeer:
    """Settings of the projected method: robust, and the reference for the other solver."""

    max_steps: int = 20000

    def run(
        self, operator: Operator, separation: Array, control: Control, initial: Array, tolerance: float
    ) -> State:
        """Solve for the pressure from an `initial` one, down to a residual of `tolerance`.

        Differs from the paper: any control, and a stop by the conditions of contact instead of the step.
        """
        measure = Measure(operator.weights)
        self_influence = float(operator.as_matrix(np.zeros(1, np.intp))[0, 0])
        forced = isinstance(control, Force)
        p = start_pressure(measure, separation, control, initial)
        t = np.zeros_like(p)
        delta, norm_old = 0.0, 1.0
        best, idle, steps = np.inf, 0, 0
        while True:
            u = operator.apply(p)
            steps += 1
            inside = p > 0
            g = u + separation
            d = measure.mean(g, inside) if forced and inside.any() else control.value
            g -= d
            r = residual(p, g, displacement_scale(p, u, self_influence))
            idle = 0 if r < best else idle + 1
            best = min(best, r)
            if r <= tolerance:
                return State(p, u, d, r, steps, Status.CONVERGED)
            if steps >= self.max_steps:
                return State(p, u, d, r, steps, Status.MAX_STEPS)
            if idle > 500:
                return State(p, u, d, r, steps, Status.STAGNATED)
            norm = measure.dot(np.where(inside, g, 0.0), np.where(inside, g, 0.0))
            if norm > 0:
                t = np.where(inside, g + delta * (norm / norm_old) * t, 0.0)
                v = operator.apply(t)
                steps += 1
                if forced:
                    v -= measure.mean(v, inside)
                curvature = measure.dot(v, t)
                tau = (
                    measure.dot(np.where(inside, g, 0.0), t) / curvature
                    if curvature > 0
                    else 1 / self_influence
                )
            else:  # a single cell at given force has no error to shrink, but others may overlap
                t[:] = 0.0
                tau = 1 / self_influence
            norm_old = norm if norm > 0 else 1.0
            p = np.where(inside, np.maximum(p - tau * t, 0.0), 0.0)
            overlap = (p == 0) & (g < 0)
            p[overlap] = -tau * g[overlap]
            delta = 0.0 if overlap.any() else 1.0
            if forced:
                p *= control.value / measure.total(p)
