"""Bound-constrained preconditioned conjugate gradients: the inner solve of the active set method.

Labels B1 to B18 are the lines of the algorithm in docs/concepts/method.md, which derives each scalar. Projected
steps on changing free sets are those of More and Toraldo (SIAM J. Optim. 1, 93, 1991) and of Dostal's MPRGP; that
the step is estimated before the product, so that one product serves projection and line search, is this package's
own.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from roughcontact.kernels import buffers
from roughcontact.solver import tuning
from roughcontact.solver.control import Force
from roughcontact.solver.inner_operator import InnerOperator
from roughcontact.solver.optimality import Iterate, Optimality
from roughcontact.solver.rows_operator import on_own_rows
from roughcontact.solver.vectors import Vectors, scaled_vectors
from roughcontact.validation import Array, Mask

__all__ = [
    *("CGResult", "InnerSolution", "InnerSystem", "StepEstimate"),
    *("bound_constrained_cg", "inner_solve", "inner_system"),
]


@dataclass(frozen=True, slots=True)
class StepEstimate:
    """The length of the next step along z + beta s - mu w that is expected to be best; at first 1, a guess."""

    expected: float = 1.0
    known: bool = False

    @property
    def trial(self) -> float:
        """Length of the trial step (B7): somewhat shorter, since a longer one deactivates cells for nothing."""
        return tuning.TRIAL_STEP * self.expected

    def after(self, best: float, *, bounds_matter: bool) -> StepEstimate:
        """Return the estimate after the best step had a length (B13); newly active bounds make it less certain."""
        least, most = tuning.ESTIMATE_AT_BOUNDS if bounds_matter else tuning.ESTIMATE_FREE
        if self.known:
            best = min(max(best, least * self.expected), most * self.expected)
        return StepEstimate(best, known=True)


class CGResult(NamedTuple):
    """The end of one run of bound-constrained conjugate gradients.

    Attributes
    ----------
    residual : float
        Largest size of r on F.
    steps : int
        Products.
    estimate : StepEstimate
        For the next run.
    """

    residual: float
    steps: int
    estimate: StepEstimate


class InnerSolution(NamedTuple):
    """A pressure [Pa] between its bounds, and the products that it took."""

    pressure: Array
    steps: int


class InnerSystem(NamedTuple):
    """The bound-constrained problem of an inner solve, on the cells of its operator and in the unit of its residual.

    Attributes
    ----------
    inner : InnerOperator
    vectors : Vectors
    start : array
        Pressure that is corrected [Pa].
    unit : float
        Of the residual [m] and of the correction [Pa].
    goal : float
        Largest residual on F, in the unit.
    """

    inner: InnerOperator
    vectors: Vectors
    start: Array
    unit: float
    goal: float


def inner_system(
    inner: InnerOperator, iterate: Iterate, conditions: Optimality, free: Mask, *, limit: float
) -> InnerSystem:
    """Return the bound-constrained problem from an iterate and a predicted free set (B1).

    It needs only the pressure of the iterate: the caller may free the rest before the solve.

    Parameters
    ----------
    inner : InnerOperator
        It covers F and all cells under pressure. Only the correction of the pressure passes through it, so that its
        error is only one of the correction.
    iterate : Iterate
        Pressure [Pa] to start from, its displacement [m], and the separation [m].
    conditions : Optimality
        Of the whole problem: its spec, and the displacement of a cell per unit pressure on itself.
    free : bool array
        The predicted free set, one cell at least, none of them missing. Other cells at the hardness keep it; the
        pressure of all others becomes zero.
    limit : float
        Largest residual on F [m].
    """
    pressure, displacement, separation = iterate
    if not conditions.spec.plastic:  # machine code has no hardness
        inner = on_own_rows(inner, pressure)
    # Cells that were not measured never touch, nor does what lies beyond the edge.
    part = Iterate(inner.gather(pressure), inner.gather(displacement), inner.gather(separation, math.inf))
    free = inner.gather(free)
    # B1
    vectors, unit = scaled_vectors(inner, conditions.measure, conditions.spec, free, part, otherwise=limit)
    return InnerSystem(inner, vectors, part.pressure, unit, limit / unit)


def inner_solve(
    system: InnerSystem,
    conditions: Optimality,
    *,
    max_steps: int,
    report: Callable[[float], None] | None = None,
) -> InnerSolution:
    """Solve a bound-constrained problem by algorithm B.

    Cells are deactivated until none has a pressure out of bounds, and only then violated ones are freed: to do both at
    once, as is right where each free set is solved exactly, cycles where it is not.

    Parameters
    ----------
    system : InnerSystem
    conditions : Optimality
        Of the whole problem.
    max_steps : int
        Largest number of products.
    report : function, optional
        Called now and then with the residual on F, as a part of the one to start from.
    """
    (inner, vectors, start, unit, goal), spec = system, conditions.spec
    target, steps, rounds, estimate = max(goal, tuning.INNER_FORCING), 0, 0, StepEstimate()  # B1: the target
    with buffers.keep_large_buffers():
        while steps < max_steps and rounds < tuning.FREEING_ROUNDS:
            residual, done, estimate = bound_constrained_cg(
                inner,
                vectors,
                estimate,
                force_given=spec.depth is None,
                self_influence=conditions.self_influence,
                limit=target,
                max_steps=max_steps - steps,
            )
            steps += done
            if report is not None:
                report(residual)
            worst = vectors.free_violated(0.5 * goal)  # B16
            if worst:
                target = max(goal, tuning.INNER_FORCING * max(residual, worst))  # B17
                rounds += 1
            elif target > goal and residual <= target:
                target = goal
            else:
                break
    p = vectors.pressure(start, unit)  # B18
    if vectors.upper is not None:
        p = conditions.measure.xp.where(vectors.upper, spec.hardness, p)
        return InnerSolution(inner.scatter(p), steps)
    p = inner.scatter(p)
    if isinstance(spec.control, Force):
        total = conditions.measure.total(p)
        if not total > 0:
            return InnerSolution(inner.scatter(start), steps)
        p *= spec.control.value / total
    return InnerSolution(p, steps)


def bound_constrained_cg(
    inner: InnerOperator,
    vectors: Vectors,
    estimate: StepEstimate,
    *,
    force_given: bool,
    self_influence: float,
    limit: float,
    max_steps: int,
) -> CGResult:
    """Correct the pressure until the residual on F is small; deactivate cells whose pressure leaves its bounds.

    Parameters
    ----------
    inner : InnerOperator
    vectors : Vectors
        Of the solve. F only shrinks here.
    estimate : StepEstimate
        From the last run.
    force_given : bool
        Whether the force is prescribed: then corrections have no resultant, and a constant residual does not count.
    self_influence : float
        A_ii: displacement of a cell per unit pressure on itself [m/Pa].
    limit : float
        Stop when the largest residual on F is no more than this.
    max_steps : int
        Largest number of products.

    Notes
    -----
    Where no bound becomes active these are plain conjugate gradients, whatever the estimate: the line search makes up
    for it.
    """
    area, steps = vectors.restart(), 0
    if force_given:
        vectors.remove_mean(tuning.MEAN_RESIDUAL * limit)  # B2
    r_max = vectors.residual_max()
    if force_given and not area > 0:  # no cell to carry the force
        return CGResult(r_max, steps, estimate)
    last, w_sum = None, 1.0
    while steps < max_steps and (  # B3
        r_max > limit or self_influence * vectors.bound_violation() > tuning.BOUND_VIOLATION * limit
    ):
        if last is None:
            w_sum, last = (
                vectors.constraint_direction() if force_given else 1.0,
                vectors.inner_products(vectors.q),
            )  # B4
        rz, zq, z_sum, wq = vectors.precondition()  # B5
        if not rz >= 0:
            break
        sigma = wq / w_sum if force_given else 0.0  # Schur complement of the force: w.q / 1.w
        curvature = last.sq - sigma * last.s_sum
        beta = -(zq - sigma * z_sum) / curvature if curvature > 0 and last.sq > 0 else 0.0  # B6
        mu = (z_sum + beta * last.s_sum) / w_sum if force_given else 0.0
        bound_correction, area, force = vectors.project(beta, mu, estimate.trial)  # B7, B8
        bounds_matter = self_influence * bound_correction > tuning.LIFTED_RESIDUAL * r_max
        if force_given:
            if not area > 0:
                break
            if force:
                vectors.redistribute(force)  # B9
            w_sum = vectors.constraint_direction()  # B4
        last = vectors.inner_products(inner.apply(vectors.s))  # B10, B11: the product of the step
        steps += 1
        if not last.sq > 0:  # the direction is but rounding
            r_max = vectors.residual_max()
            break
        # Few newly active cells say nothing of how far the others should go, unless most of r.s is theirs: a shorter
        # step would only increase that part.
        dominate = abs(last.rs - last.rs_free) > abs(last.rs_free)
        bounds_matter = bounds_matter or (
            bound_correction > 0 and dominate and last.rs_free < tuning.SHORTEST_STEP * last.sq
        )
        alpha = (last.rs if bounds_matter else last.rs_free) / last.sq  # B12
        if alpha > 0:
            estimate = estimate.after(alpha * estimate.trial, bounds_matter=bounds_matter)  # B13
        elif bound_correction:  # no direction to continue with
            last, bounds_matter = last._replace(sq=0.0), True
        else:
            r_max = vectors.residual_max()
            break
        if bounds_matter:
            alpha = min(max(alpha, tuning.SHORTEST_STEP), tuning.LONGEST_STEP)
        mean = (last.q_sum - last.r_sum / alpha) / area if force_given else 0.0
        r_max = vectors.advance(alpha, mean)  # B14: with it the residual on F has no mean
    return CGResult(r_max, steps, estimate)
