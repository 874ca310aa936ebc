"""The projected conjugate gradients of Polonsky and Keer (Wear 231, 206, 1999)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from roughcontact.halfspace.operators.operator import Operator, is_semidefinite
from roughcontact.progress.events import decades, solving
from roughcontact.solver import tuning
from roughcontact.solver.control import Specification, State, Status
from roughcontact.solver.optimality import Optimality
from roughcontact.solver.projection import force_multiplier, project
from roughcontact.validation import Array, require_numbers, whole

__all__ = ["PolonskyKeer"]


@dataclass(frozen=True, slots=True)
class PolonskyKeer:
    """Settings of the projected method of Polonsky and Keer (Wear 231, 206, 1999).

    Robust, and the reference for the other solver.

    Parameters
    ----------
    max_steps : int
        Largest number of products with the operator.
    patience : int
        Largest number of iterations without a smaller residual.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> depths = [rc.press(ball, 1e9, force=1e-3, solver=solver).depth for solver in (None, rc.PolonskyKeer())]
    >>> f"{depths[1] / depths[0]:.6f}"
    '1.000000'
    """

    max_steps: int = 20000
    patience: int = tuning.PATIENCE

    def __post_init__(self) -> None:
        require_numbers(self)
        whole(self.max_steps, "max_steps")
        whole(self.patience, "patience")

    def run(self, operator: Operator, separation: Array, spec: Specification, initial: Array) -> State:
        """Solve for the pressure.

        Differs from the paper: any control, a stop by the conditions of contact instead of the step, and,
        where a step leaves too large a force, the projection on the pressures of the right one instead of a
        common factor, with which the method can cycle between two iterates. A hardness bounds the pressure from above
        as zero does from below.

        Parameters
        ----------
        operator : Operator
            Displacement [m] from pressure [Pa].
        separation : array, shape ``operator.grid.shape``
            Undeformed gap at first touch [m], infinite where nothing was measured.
        spec : Specification
            Prescribed force or depth, tolerance and hardness.
        initial : array, shape ``operator.grid.shape``
            Pressure to start from [Pa]; zeros will do.

        Returns
        -------
        State
            Pressure, depth, status, residual and number of products.

        Examples
        --------
        >>> import numpy as np
        >>> import roughcontact as rc
        >>> grid = rc.Grid((32, 32), 1e-6)
        >>> gap = -rc.shapes.paraboloid(grid, radius=1e-4).heights
        >>> problem = rc.ContactProblem(gap - gap.min(), rc.half_space(grid, 1e9), rc.Force(1e-3))
        >>> state = rc.PolonskyKeer().run(problem.operator, problem.separation, problem.spec, np.zeros(grid.shape))
        >>> state.status.converged, f"{state.depth * 1e9:.0f} nm"
        (True, '175 nm')
        """
        optimality = Optimality.of(operator, spec, separation)
        measure, xp = optimality.measure, optimality.measure.xp
        self_influence, hardness, given = optimality.self_influence, spec.hardness, spec.depth
        if not spec.plastic:
            p = optimality.feasible_start(separation, initial)
        else:  # projected, not scaled: cells at the hardness stay there
            p = xp.where(xp.isfinite(separation) & (initial > 0), initial, 0.0)
            p = project(measure, p, separation, spec)
        s, before = xp.zeros_like(p), p > 0
        singular = given is not None and is_semidefinite(operator)
        d = 0.0 if given is None else given
        delta, norm_old = 0.0, 1.0
        best, idle, steps = np.inf, 0, 0
        with solving(spec.tolerance, p.shape) as task:
            while True:
                u = operator.apply(p)
                steps += 1
                free = (p > 0) & (p < hardness)
                g = u + (
                    separation - d
                )  # in this order: where much is plastic, u may be far smaller than both
                if given is None:
                    shift = force_multiplier(measure, g, p, free)
                    g -= shift
                    d += shift
                elif singular and bool(xp.all(free)):
                    p = _to_bound(p, spec, float(xp.mean(g)), xp)
                    free = (p > 0) & (p < hardness)
                rho = optimality.residual(p, u, g)
                idle = 0 if rho < best else idle + 1
                best = min(best, rho)
                if task is not None:
                    task.reached(decades(rho))
                if rho <= spec.tolerance:
                    return State(p, d, rho, steps, Status.CONVERGED, displacement=u)
                if steps >= self.max_steps:
                    return State(p, d, rho, steps, Status.MAX_STEPS)
                if idle > self.patience or not bool(xp.all(xp.isfinite(p))):
                    return State(p, d, rho, steps, Status.STAGNATED)
                wrong = ((p == 0) & (g < 0)) | ((p == hardness) & (g > 0))
                some_wrong, between = bool(xp.any(wrong)), free
                # Too long a step for those that were wrong: one that suits them too. On the same cells as before
                # the residual of conjugate gradients may leap.
                if (some_wrong and idle > tuning.CYCLING) or (
                    rho > tuning.LEAP * best and bool(xp.any(between != before))
                ):
                    free, delta = free | wrong, 0.0
                g_free = xp.where(free, g, 0.0)
                norm = measure.dot(g_free, g_free)
                alpha = (
                    1 / self_influence
                )  # the step of a single cell, which at given force has no error to reduce
                if norm > 0 and norm_old > 0:
                    s = xp.where(free, g + delta * (norm / norm_old) * s, 0.0)
                    q = operator.apply(s)
                    steps += 1
                    if given is None:
                        q -= measure.mean(q, free)
                    curvature = measure.dot(q, s)
                    if curvature > 0:
                        alpha = measure.dot(g_free, s) / curvature
                else:
                    s = xp.zeros_like(p)
                norm_old = norm if norm > 0 else 1.0
                p = xp.where(free, xp.clip(p - alpha * s, 0.0, hardness), p)
                p = xp.where(wrong, xp.clip(p - alpha * g, 0.0, hardness), p)
                delta, before = 0.0 if some_wrong else 1.0, between
                if given is None and 0 < measure.total(p) < np.inf:
                    p = project(measure, p, g, spec)


def _to_bound(pressure: Array, spec: Specification, gap: float, xp: Any) -> Array:
    """Return a pressure off its bounds, with a constant added that takes one cell to zero or to the hardness.

    At a given depth a periodic body in full contact has no equilibrium between the bounds: its mean `gap` is what the
    depth leaves, whatever the pressure, and a constant pressure moves nothing.
    """
    if gap > 0 or not spec.plastic:
        return pressure - xp.min(pressure)  # type: ignore[no-any-return]
    most = spec.largest_hardness
    level = pressure - (
        spec.hardness - most
    )  # of all cells as far below the largest hardness as below their own
    nearest = xp.max(level)
    return xp.where(level == nearest, spec.hardness, pressure + (most - nearest))  # type: ignore[no-any-return]
