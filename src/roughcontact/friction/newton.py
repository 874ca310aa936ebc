"""Partial slip by an active-set (semi-smooth Newton) method: predict stick and slip, solve the free part, update."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.arrays import namespace
from roughcontact.friction.descent import descended
from roughcontact.friction.slip_cg import Freedom, corrected
from roughcontact.friction.slip_step import Slipped, SlipState, SlipStep
from roughcontact.solver.control import Status

__all__ = ["SlipNewton"]

REDUCTION = 0.1  # of the error by each linear solve: more is wasted, because the sets change
# Factor below the least residual so far that an iteration must reach, which prevents cycles.
FALL = 0.9
PATIENCE = 20  # descents without a smaller residual or energy after which only rounding is left
ROUNDING = float(np.finfo(np.float64).eps)


@dataclass(frozen=True, slots=True)
class SlipNewton:
    """Settings of the method.

    The conditions of a step hold at the minimum of the energy ``q.Aq/2 - q.(slip + shift)`` over tractions within
    their limits. An iteration solves for the traction of the cells that stick and the direction of that of those that
    slip (Hueeber, Stadler and Wohlmuth, SIAM J. Sci. Comput. 30, 572 (2008)), by conjugate gradients, to a reduction
    of the error by ten; the result is projected onto the limits.

    Where many cells change state at once, the iteration may cycle. Therefore an iteration that does not reduce the
    residual is only used as a direction along which the energy is reduced: see `descended`. A reduction of the
    residual by a fixed factor reaches the tolerance after a finite number of iterations, and descent converges to the
    minimum of the energy: the method converges.
    """

    max_steps: int = 5000

    def run(self, step: SlipStep) -> Slipped:
        """Solve for the traction at the end of a step."""
        state, steps = step.state(step.admitted(step.traction)), 1
        least, lowest, idle = state.residual, math.inf, 0
        while not state.residual <= step.tolerance and steps < self.max_steps and idle <= PATIENCE:
            trial, products = _guessed(step, state, self.max_steps - steps)
            steps += products
            if trial.residual <= step.tolerance:
                trial, steps = _certified(step, trial, steps)
            if trial.residual <= max(step.tolerance, FALL * least):
                state, lowest, idle = trial, math.inf, 0
            else:
                state, steps = _certified(step, state, steps)
                trial, steps = _certified(step, trial, steps)
                state, products = descended(step, state, trial)
                steps += products
                energy = step.energy(state)
                idle = 0 if energy < lowest - ROUNDING * abs(energy) or state.residual < least else idle + 1
                lowest = min(lowest, energy)
            least = min(least, state.residual)
        state, steps = _certified(step, state, steps)
        if state.residual <= step.tolerance:
            status = Status.CONVERGED
        else:
            status = Status.MAX_STEPS if steps >= self.max_steps else Status.STAGNATED
        return Slipped(state.traction, state.displacement, state.shift, state.residual, steps, status)


def _guessed(step: SlipStep, state: SlipState, max_steps: int) -> tuple[SlipState, int]:
    """Return the state that follows from the predicted stick and slip sets of a state, and the number of products."""
    xp, q, interface = namespace(state.traction), state.traction, step.interface
    forward = xp.sum(state.slipped * state.normal, axis=0)
    slips = xp.any(state.normal != 0, axis=0) & (forward <= 0)
    freedom = Freedom(
        normal=xp.where(slips, state.normal, 0.0),
        rotation=xp.where(slips, -forward / step.limit, 0.0),
        held=step.force is not None,
    )
    change = corrected(interface, freedom, -state.slipped, reduction=REDUCTION, max_steps=max_steps)
    aim = q + change.traction
    admitted = step.admitted(aim)
    if bool(xp.all(admitted == aim)):
        return step.state(admitted, state.displacement + change.displacement), change.steps
    return step.state(admitted), change.steps + 1


def _certified(step: SlipStep, state: SlipState, steps: int) -> tuple[SlipState, int]:
    """Return a state whose displacement is a separate exact product, and the products so far."""
    return (state, steps) if state.exact else (step.state(state.traction), steps + 1)
