"""Partial slip by Newton's method: guess which cells slip and which way, solve what is free, flip what violates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.contact.status import Status
from roughcontact.contact.tangential.coulomb import at_limit, directions
from roughcontact.contact.tangential.free import Freedom, corrected
from roughcontact.contact.tangential.step import Slipped, Step

__all__ = ["SlipNewton"]

REDUCTION = 0.1  # of the error by each linear solve: the next guess is another problem
PATIENCE = 20  # iterations without a smaller residual, after which rounding or a cycle has the better of it


@dataclass(frozen=True, slots=True)
class SlipNewton:
    """Settings of the method.

    The conditions of a step say that the energy ``q.Aq/2 - q.(slip + shift)`` is as low as tractions within their
    limits allow. An iteration solves for the traction of the cells that stick and the direction of that of those that
    slip (Hueeber, Stadler and Wohlmuth, SIAM J. Sci. Comput. 30, 572 (2008)), by conjugate gradients, just as far as
    the guess deserves; its end is projected on the limits. Nothing proves that this ends: a run without progress says
    so.
    """

    max_steps: int = 5000

    def run(self, step: Step) -> Slipped:
        """Solve for the traction at the end of a step."""
        interface, limit = step.interface, step.limit
        q = step.admitted(step.traction)
        u, fresh, steps = interface.apply(q), True, 1
        best, idle = np.inf, 0
        while True:
            held = at_limit(q, limit)
            normal = directions(q, held)
            shift = step.shift_of(u, normal)
            r = step.residual(q, u, shift)
            if r <= step.tolerance and fresh:
                return Slipped(q, u, shift, r, steps, Status.CONVERGED)
            if r <= step.tolerance:  # the certificate stands on a product of the returned traction
                u, fresh, steps = interface.apply(q), True, steps + 1
                continue
            idle = 0 if r < best else idle + 1
            best = min(best, r)
            if steps >= self.max_steps or idle > PATIENCE:
                status = Status.MAX_STEPS if steps >= self.max_steps else Status.STAGNATED
                u = interface.apply(q)
                return Slipped(q, u, shift, step.residual(q, u, shift), steps + 1, status)
            slipped = step.slipped(u, shift)
            forward = (slipped * normal).sum(axis=0)
            slips = held & (forward <= 0)
            freedom = Freedom(
                normal=np.where(slips, normal, 0.0),
                turning=np.where(slips, -forward / limit, 0.0),
                held=step.force is not None,
            )
            change = corrected(
                interface, freedom, -slipped, reduction=REDUCTION, max_steps=self.max_steps - steps
            )
            aim, steps = q + change.traction, steps + change.steps
            q = step.admitted(aim)
            if np.array_equal(q, aim):
                u, fresh = u + change.displacement, False
            else:
                u, fresh, steps = interface.apply(q), True, steps + 1
