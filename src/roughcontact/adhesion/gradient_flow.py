"""The end of a jump: the gradient flow of the energy down to an equilibrium.

Pseudo-transient continuation (Kelley and Keyes, SIAM J. Numer. Anal. 35, 508 (1998)): damped Newton steps, which are
those of a linearly implicit Euler method. The damping of a cell is a multiple of the curvature of its attraction, or,
for all cells alike, of the largest curvature. From a certain multiple on, the damped Hessian is positive definite. The
damping decreases as long as no step meets an indefinite Hessian or goes too far. The flow ends in an equilibrium if the
energy is convex between it and the last step. If no damping by cell makes the Hessian definite, because a body under
tension is held only by cells of constant attraction, all cells get the same damping.

If the inverse of the damped Hessian has no negative entry, as on a free plane, steps of any length that start above all
equilibria stay above them: the attraction grows ever faster as the gap closes, and the part that a step neglects pulls
further.

Labels E17 to E23 are the lines of the algorithm in docs/concepts/method-adhesion.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from roughcontact.adhesion.attraction import REACH
from roughcontact.adhesion.gap_energy import GapEnergy, Point
from roughcontact.adhesion.truncated_newton import (
    FORCING,
    TOLERANCE,
    Counter,
    Equilibrium,
    conjugate_gradients,
    line_search,
    minimise,
)
from roughcontact.validation import Array

__all__ = ["FlowResult", "detached", "flow"]

STEPS = 400
FIRST = 2.0  # damping, relative to the curvature of the attraction
FULL = 1.0  # the largest damping that is needed after a step that went too far
LEAST = 0.02  # smallest damping while the residual is large
SOFTEST = 1e-5  # smallest damping
MOST = 100.0  # damping at which a step that does not lower the energy is due to rounding
UNDER = 0.05  # damping if the undamped Hessian is indefinite
CLOSE = 1e-2  # residual below which an equilibrium is searched
RISEN = 10.0  # times the residual: the next one at most while the flow leaves the end of a branch
FALLEN = 0.1  # of the largest residual so far: below it a flow that has risen has left
COARSE = 1e-5  # residual of a coarse equilibrium near the end
TRIALS = 15  # Newton steps toward an equilibrium
WAIT = 3  # steps between two such trials
NOTHING = math.exp(-REACH)  # of the largest attraction: smaller values are negligible


@dataclass(frozen=True, slots=True, eq=False)
class FlowResult:
    """The end of a flow.

    Attributes
    ----------
    equilibrium : Equilibrium
    lost : float
        Total decrease of the energy [J].
    """

    equilibrium: Equilibrium
    lost: float


Convex = Callable[[GapEnergy, Point, Point], bool]


def flow(
    energy: GapEnergy, start: Array, convex: Convex, counter: Counter, *, uniform: bool = False
) -> FlowResult:
    """Follow the gradient flow from `start` to an equilibrium.

    Parameters
    ----------
    energy : GapEnergy
    start : array
        Displacement [m].
    convex : function
        Whether the energy is convex between two points.
    counter : Counter
        Counts products.
    uniform : bool
        Whether all cells have the same damping: this is then the gradient flow in the gap.
    """
    counter.products += 1
    # E17
    point = energy.at(energy.feasible(start))
    lost, wait = 0.0, 0
    # A jump begins close to the end of a branch, where the flow is slow, and linear along one direction: the damping
    # only has to keep the Hessian definite.
    first = largest = energy.residual(point)
    leaving = first <= CLOSE * energy.scale(point)
    damping = LEAST if leaving else FIRST
    for _ in range(STEPS):
        residual, scale = energy.residual(point), energy.scale(point)
        # E18: at rest; the Hessian may still be indefinite where the reaction of the wall on a cell is almost zero.
        if residual <= TOLERANCE * scale:
            return FlowResult(Equilibrium(point, residual / scale, True, lost), lost)
        close = residual <= CLOSE * scale
        largest = max(largest, residual)
        leaving = leaving and close and (largest <= RISEN * first or residual > FALLEN * largest)
        if close and damping < LEAST and not leaving:  # E19
            if wait == 0:
                end = _end(energy, point, convex, counter)
                if end is not None:
                    return FlowResult(end, lost - energy.change(point, end.point))
                wait = WAIT
            wait -= 1
        free = point.free
        curvature = np.where(free, energy.attraction.curvature(point.gap), 0.0)
        weights = energy.attraction.steepest if uniform else curvature
        step, negative = conjugate_gradients(  # E20
            energy.form, free, curvature - damping * weights, -point.reaction, FORCING, counter
        )
        found = None if negative else line_search(energy, point, step, counter)
        if found is None or (leaving and energy.residual(found[0]) > RISEN * residual):  # E21
            if damping <= MOST:
                damping = max(4 * damping, SOFTEST if leaving else UNDER)
            elif not uniform:
                uniform, damping = True, UNDER
            else:
                break
            continue
        new, change = found
        lost -= change
        too_far = not leaving and _pushed_back(point, new) > residual
        point = new
        if detached(energy, point):  # E22
            return FlowResult(Equilibrium(point, 0.0, True, lost), lost)
        # E23
        damping = min(FULL, 2 * damping) if too_far else max(damping / 2, SOFTEST if close else LEAST)
    end = minimise(energy, point.displacement, counter)
    return FlowResult(end, lost + end.lost)


def _end(energy: GapEnergy, point: Point, convex: Convex, counter: Counter) -> Equilibrium | None:
    """Return the equilibrium near a point if the energy is convex between them."""
    coarse = minimise(
        energy, point.displacement, counter, tolerance=COARSE, iterations=TRIALS, convex_only=True
    )
    if not (coarse.converged and convex(energy, point, coarse.point)):
        return None
    end = minimise(energy, coarse.point.displacement, counter, convex_only=True)
    return end if end.converged else None


def _pushed_back(old: Point, new: Point) -> float:
    """Return the largest traction [Pa] against the motion of a cell; it is 0 if no cell has gone too far."""
    moved = new.displacement - old.displacement
    return float(np.max(new.reaction * np.sign(np.where(new.free, moved, 0.0))))


def detached(energy: GapEnergy, point: Point) -> bool:
    """Whether a prescribed tension has pulled the body beyond the attraction, so that nothing stops it."""
    pulled = float(np.sum(energy.load * np.ones(energy.form.shape))) < 0
    if not (pulled and point.gap.min() > 0):
        return False
    law = energy.attraction
    return float(np.max(law.traction(point.gap))) <= NOTHING * law.strength
