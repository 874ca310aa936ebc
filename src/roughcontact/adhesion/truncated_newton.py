"""Bounded truncated Newton: from a displacement to an equilibrium of lower energy.

Projected steps on the free cells (Bertsekas, SIAM J. Control Optim. 20, 221 (1982)), whose linear systems are solved by
conjugate gradients (Steihaug, SIAM J. Numer. Anal. 20, 626 (1983)), preconditioned by the compliance. If the Hessian is
not positive definite, it is shifted by a multiple of the identity: the step is then one of the implicit gradient flow
in the gap.

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

TOLERANCE = 1e-10  # of the residual: a hundredth of the default tolerance, for errors of the exact product
ITERATIONS = 400
INNER = 300
HALVINGS = 12
ARMIJO = 1e-4
SHIFT = 0.05  # first shift of an indefinite Hessian, relative to the largest curvature of the attraction
STIFFEST = 100.0  # relative shift beyond which a step that does not lower the energy ends the minimisation
FORCING = 0.1
ENOUGH = 0.1  # of the tolerance: precision of the last linear system


@dataclass(slots=True)
class Counter:
    """The number of products with the stiffness or the compliance so far."""

    products: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Equilibrium:
    """The end of a minimisation.

    Attributes
    ----------
    point : Point
    residual : float
        Relative to the scale of tractions.
    converged : bool
    lost : float
        Decrease of the energy [J].
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
        Largest number of iterations.
    convex_only : bool
        Whether to stop if the Hessian is not positive definite.
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
                # Rounding: even a step that the shift makes short does not lower the energy.
                if shift > STIFFEST * most:
                    break
                shift = max(4 * shift, SHIFT * most)
                continue
            point, gained = found  # E9
            lost -= gained
            shift = 0.0 if shift < 1e-3 * most else 0.25 * shift
    return Equilibrium(point, residual, False, lost)


def line_search(energy: GapEnergy, point: Point, step: Array, counter: Counter) -> tuple[Point, float] | None:
    """Return the first point along the projected step whose energy is lower, and the change of the energy [J] (E8)."""
    length = 1.0
    for _ in range(HALVINGS):
        trial = energy.feasible(point.displacement + length * step)
        counter.products += 1
        new = energy.at(trial)  # E2, of the trial, for the next iteration
        change = energy.change(point, new)
        slope = energy.form.dot(point.reaction, trial - point.displacement)
        if slope < 0 and change <= ARMIJO * slope:
            return new, change
        length *= 0.5
    return None


def conjugate_gradients(
    form: ElasticForm, free: Mask, diagonal: Array, load: Array, forcing: float, counter: Counter
) -> tuple[Array, bool]:
    """Solve ``(K - diagonal) x = load`` on the free cells; return whether a direction of negative curvature was met.

    The diagonal is D - sigma, or D - theta W in the flow. If the mean displacement is prescribed, the mean of x is
    zero.
    """
    mask = free.astype(np.float64)
    number = max(1.0, float(mask.sum()))
    constrained = form.mean_free
    scratch = np.empty(mask.shape)

    def precondition(r: Array) -> Array:
        counter.products += 1
        z = form.compliance(r)
        z *= mask
        if constrained:
            z -= np.multiply(along, z.sum() / total, out=scratch)
            # Rounding must not change the mean, along which the Hessian is not positive.
            z -= np.multiply(mask, z.sum() / number, out=scratch)
        return z

    along, total = load, 1.0
    if constrained:
        counter.products += 1
        along = form.compliance(mask) * mask
        total = float(along.sum())
    # E10
    r = np.where(free, load, 0.0)
    x = np.zeros_like(r)
    z = precondition(r)
    direction, rz = z, form.dot(r, z)
    if rz <= 0:
        return x, False
    goal = rz * forcing**2
    free_diagonal = diagonal * mask
    for _ in range(INNER):
        counter.products += 1
        image = form.stiffness(direction)  # E11
        image *= mask
        image -= np.multiply(free_diagonal, direction, out=scratch)
        curvature = form.dot(direction, image)
        if curvature <= 0:  # E12
            return x, True
        alpha = rz / curvature  # E13
        x += np.multiply(direction, alpha, out=scratch)
        r -= np.multiply(image, alpha, out=scratch)
        if constrained:
            r -= np.multiply(mask, r.sum() / number, out=scratch)
        z = precondition(r)  # E14
        new = form.dot(r, z)
        if new <= goal:  # E15
            break
        direction *= new / rz  # E16
        direction += z
        rz = new
    return x, False
