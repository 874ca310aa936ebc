"""Bounded truncated Newton: from a displacement to an equilibrium of lower energy.

Projected steps on the free cells (Bertsekas, SIAM J. Control Optim. 20, 221 (1982)), whose linear systems are solved by
conjugate gradients (Steihaug, SIAM J. Numer. Anal. 20, 626 (1983)) that the compliance preconditions. Where they find
the Hessian not positive definite, it is shifted by a multiple of the identity: the step is then one of the implicit
gradient flow in the gap.

Labels E1 to E16 are the lines of the algorithms in docs/concepts/method-adhesion.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.adhesion.gap_energy import GapEnergy, Point
from roughcontact.progress.events import decades, solving
from roughcontact.validation import Array, Mask

__all__ = ["Counter", "Equilibrium", "conjugate_gradients", "line_search", "minimise"]

TOLERANCE = 1e-10  # of the residual: a hundredth of what is promised, for the product that certifies
ITERATIONS = 400
INNER = 300
HALVINGS = 12
ARMIJO = 1e-4
SHIFT = 0.05  # the first shift of an indefinite Hessian, of the largest curvature of the attraction
STIFFEST = 100.0  # shift, of the same, beyond which a step that lowers no energy ends the minimisation
FORCING = 0.1
ENOUGH = 0.1  # of the tolerance, to which the last linear system is solved


@dataclass(slots=True)
class Counter:
    """Products with the stiffness or the compliance so far."""

    products: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Equilibrium:
    """Where a minimisation ended.

    Attributes
    ----------
    point : Point
    residual : float
        Relative to the scale of tractions.
    converged : bool
    lost : float
        By how much the energy fell [J].
    """

    point: Point
    residual: float
    converged: bool
    lost: float


def minimise(
    energy: GapEnergy,
    start: Array,
    counter: Counter,
    *,
    tolerance: float = TOLERANCE,
    iterations: int = ITERATIONS,
    convex_only: bool = False,
) -> Equilibrium:
    """Return an equilibrium below `start`.

    Parameters
    ----------
    energy : GapEnergy
    start : array
        Displacement [m], above the obstacle.
    counter : Counter
        Counts products.
    tolerance : float
        Relative residual.
    iterations : int
        At most.
    convex_only : bool
        Whether to give up where the Hessian is not positive definite.
    """
    counter.products += 1
    point = energy.at(energy.feasible(start))  # E1, E2
    shift, lost = 0.0, 0.0
    residual = math.inf
    with solving(tolerance, start.shape) as task:
        for _ in range(iterations):
            residual = energy.residual(point) / energy.scale(point)  # E3
            if task is not None:
                task.reached(decades(residual))
            if residual <= tolerance:
                return Equilibrium(point, residual, True, lost)
            free = point.free  # E4
            curvature = np.where(free, energy.attraction.curvature(point.gap), 0.0)
            most = float(np.max(curvature))
            # E5: the last system need not be solved beyond the tolerance.
            forcing = min(FORCING, max(math.sqrt(residual), ENOUGH * tolerance / residual))
            step, negative = conjugate_gradients(  # E6
                energy.form, free, curvature - shift, -point.reaction, forcing, counter
            )
            if negative:  # E7
                if convex_only:
                    break
                shift = max(2 * shift, SHIFT * most)
                continue
            found = line_search(energy, point, step, counter)  # E8
            if found is None:
                # Not even a step that the shift makes short lowers the energy: rounding.
                if shift > STIFFEST * most:
                    break
                shift = max(4 * shift, SHIFT * most)
                continue
            point, gained = found  # E9
            lost -= gained
            shift = 0.0 if shift < 1e-3 * most else 0.25 * shift
    return Equilibrium(point, residual, False, lost)


def line_search(energy: GapEnergy, point: Point, step: Array, counter: Counter) -> tuple[Point, float] | None:
    """Return the first point along the projected step whose energy is lower, and by how much it changed [J] (E8)."""
    length = 1.0
    for _ in range(HALVINGS):
        trial = energy.feasible(point.displacement + length * step)
        counter.products += 1
        new = energy.at(trial)  # E2, of the trial: the next iteration has it at hand
        change = energy.change(point, new)
        slope = energy.form.dot(point.reaction, trial - point.displacement)
        if slope < 0 and change <= ARMIJO * slope:
            return new, change
        length *= 0.5
    return None


def conjugate_gradients(
    form: ElasticForm, free: Mask, diagonal: Array, load: Array, forcing: float, counter: Counter
) -> tuple[Array, bool]:
    """Solve ``(K - diagonal) x = load`` on the free cells; say whether a direction of negative curvature was met.

    The diagonal is D - sigma, or D - theta W in the flow. Where the mean of a displacement is prescribed, that of x is
    zero.
    """
    mask = free.astype(np.float64)
    number = max(1.0, float(mask.sum()))
    constrained = form.mean_free

    def precondition(r: Array) -> Array:
        counter.products += 1
        z = form.compliance(r) * mask
        if constrained:
            z -= along * (z.sum() / total)
            z -= mask * (
                z.sum() / number
            )  # rounding must not feed the mean, along which no Hessian is positive
        return z

    along, total = load, 1.0
    if constrained:
        counter.products += 1
        along = form.compliance(mask) * mask
        total = float(along.sum())
    # E10
    r = np.where(free, load, 0.0)
    if constrained:
        r -= mask * (r.sum() / number)
    x = np.zeros_like(r)
    z = precondition(r)
    direction, rz = z, form.dot(r, z)
    if rz <= 0:
        return x, False
    goal = rz * forcing**2
    free_diagonal = diagonal * mask
    for _ in range(INNER):
        counter.products += 1
        image = form.stiffness(direction) * mask  # E11
        image -= free_diagonal * direction
        curvature = form.dot(direction, image)
        if curvature <= 0:  # E12
            return x, True
        alpha = rz / curvature  # E13
        x += alpha * direction
        r -= alpha * image
        if constrained:
            r -= mask * (r.sum() / number)
        z = precondition(r)  # E14
        new = form.dot(r, z)
        if new <= goal:  # E15
            break
        direction = z + (new / rz) * direction  # E16
        rz = new
    return x, False
