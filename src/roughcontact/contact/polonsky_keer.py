"""The projected conjugate gradients of Polonsky and Keer (Wear 231, 206, 1999)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import namespace
from roughcontact.contact.measure import Measure
from roughcontact.contact.optimality import Judge
from roughcontact.contact.problem import Force, Terms
from roughcontact.contact.start import start_pressure
from roughcontact.contact.state import State
from roughcontact.contact.status import Status
from roughcontact.halfspace.operator import Operator

__all__ = ["PolonskyKeer", "depth_of"]

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

PASSES = (
    50  # in which a force is shared out between cells; what is left then is shared out in the next iteration
)
ROUNDING = 1e-14  # of a force: a sum over many cells is no better
PATIENCE = 500  # iterations without a smaller residual, after which rounding or a cycle has the better of it


@dataclass(frozen=True, slots=True)
class PolonskyKeer:
    """Settings of the projected method: robust, and the reference for the other solver."""

    max_steps: int = 20000

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
            p = _within(measure, p, separation, terms)
        t = xp.zeros_like(p)
        delta, norm_old = 0.0, 1.0
        best, idle, steps = np.inf, 0, 0
        while True:
            u = operator.apply(p)
            steps += 1
            inside = (p > 0) & (p < hardness)
            g = u + separation
            d = depth_of(measure, g, p, inside) if given is None else given
            g -= d
            r = judge.residual(p, u, g)
            idle = 0 if r < best else idle + 1
            best = min(best, r)
            if r <= terms.tolerance:
                return State(p, d, r, steps, Status.CONVERGED)
            if steps >= self.max_steps:
                return State(p, d, r, steps, Status.MAX_STEPS)
            if idle > PATIENCE or not bool(xp.all(xp.isfinite(p))):
                return State(p, d, r, steps, Status.STAGNATED)
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
            wrong = ((p == 0) & (g < 0)) | ((p == hardness) & (g > 0))
            p = xp.where(inside, xp.clip(p - tau * t, 0.0, hardness), p)
            p = xp.where(wrong, xp.clip(p - tau * g, 0.0, hardness), p)
            delta = 0.0 if bool(xp.any(wrong)) else 1.0
            if given is None and 0 < measure.total(p) < np.inf:
                p = _within(measure, p, g, terms)


def depth_of(measure: Measure, level: Array, pressure: Array, inside: Mask) -> float:
    """Return the depth that leaves no gap on the mean of the cells between the bounds.

    Without any it is the least at which no cell under the hardness would be pulled.
    """
    xp = namespace(level)
    if bool(xp.any(inside)):
        return measure.mean(level, inside)
    return float(xp.max(xp.where(pressure > 0, level, -np.inf)))


def _within(measure: Measure, pressure: Array, gap: Array, terms: Terms) -> Array:
    """Return the pressure between zero and the hardness, under the force that is prescribed, if one is."""
    hardness, xp = terms.hardness, namespace(pressure)
    if not isinstance(terms.control, Force):
        return xp.clip(pressure, 0.0, hardness)  # type: ignore[no-any-return]
    force = terms.control.value
    if hardness == np.inf:
        return _under_force(measure, pressure, force)
    pressure = xp.clip(pressure, 0.0, hardness)
    # What exceeds the hardness, or lacks, is shared by the cells that can take it. Each pass takes at least one cell
    # to a bound, or is the last but for rounding.
    for _ in range(PASSES):
        lacking = force - measure.total(pressure)
        if abs(lacking) <= ROUNDING * force:
            break
        free = (pressure > 0) & (pressure < hardness)
        if not bool(xp.any(free)):  # all at the bounds: the next cells to touch help, or all give
            free = _nearest(measure, gap, pressure, lacking / hardness) if lacking > 0 else pressure > 0
        pressure = xp.where(free, xp.clip(pressure + lacking / measure.total(free), 0.0, hardness), pressure)
    return pressure


def _nearest(measure: Measure, gap: Array, pressure: Array, area: float) -> Mask:
    """Return the cells without pressure that stand nearest, as many as have twice the `area`."""
    xp = namespace(gap)
    free = (pressure == 0) & xp.isfinite(gap)
    # The gap up to which the cells are enough, by halving: cells are many, halvings are few.
    low, high = float(xp.min(xp.where(free, gap, np.inf))), float(xp.max(xp.where(free, gap, -np.inf)))
    for _ in range(60):
        middle = (low + high) / 2
        if measure.total(free & (gap <= middle)) < 2 * area:
            low = middle
        else:
            high = middle
    return free & (gap <= high)  # type: ignore[no-any-return]


def _under_force(measure: Measure, pressure: Array, force: float) -> Array:
    """Return the pressure under the right force: the nearest one below, or the same enlarged.

    The nearest is ``max(pressure - shift, 0)``; each pass finds the shift for the cells that are left.
    """
    if measure.total(pressure) > force:
        xp = namespace(pressure)
        left = pressure > 0
        while True:
            shift = (measure.total(xp.where(left, pressure, 0.0)) - force) / measure.total(left)
            fewer = left & (pressure > shift)
            if bool(xp.all(fewer == left)):
                break
            left = fewer
        pressure = xp.where(left, pressure - shift, 0.0)
    return pressure * (force / measure.total(pressure))
