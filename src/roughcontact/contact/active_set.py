"""The active set: guess the contact region, solve inside it, flip what violates (thesis, A.6 to A.8)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from roughcontact.contact.conjugate_gradient import relax
from roughcontact.contact.direct import press_cells
from roughcontact.contact.measure import Measure
from roughcontact.contact.optimality import displacement_scale, residual
from roughcontact.contact.polonsky_keer import PolonskyKeer
from roughcontact.contact.problem import Control, Force
from roughcontact.contact.start import start_pressure
from roughcontact.contact.state import State, Tangent
from roughcontact.contact.status import Status
from roughcontact.halfspace.operator import Operator

__all__ = ["ActiveSet"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ActiveSet:
    """Settings of the active set method, the default solver.

    Regions of up to `dense_limit` cells are solved by a factorisation, larger ones by conjugate gradients,
    just as far as the present guess of the region deserves. For the half-space the influence matrix is an
    inverse M-matrix and the flipping ends; for others nothing proves it, so that a run without progress is
    handed to Polonsky and Keer's method.
    """

    max_steps: int = 5000
    dense_limit: int = 2000

    def run(
        self, operator: Operator, separation: Array, control: Control, initial: Array, tolerance: float
    ) -> State:
        """Solve for the pressure from an `initial` one, down to a residual of `tolerance`."""
        measure = Measure(operator.weights)
        self_influence = float(operator.as_matrix(np.zeros(1, np.intp))[0, 0])
        singular = all(operator.grid.periodic)  # with every cell in contact, that is
        given = None if isinstance(control, Force) else control.value
        p = start_pressure(measure, separation, control, initial)
        u, fresh, steps = operator.apply(p), True, 1
        tangent: Tangent | None = None
        best, idle = np.inf, 0
        guessed = True
        while True:
            d = measure.mean(u + separation, p > 0) if given is None else given
            gap = u + separation - d
            scale = displacement_scale(p, u, self_influence)
            r = residual(p, gap, scale)
            if r <= tolerance and fresh:
                return State(p, u, d, r, steps, Status.CONVERGED, tangent)
            if r <= tolerance:  # the certificate stands on a product of the returned pressure
                u, fresh, steps = operator.apply(p), True, steps + 1
                continue
            idle = 0 if r < 0.9 * best else idle + 1
            best = min(best, r)
            if steps >= self.max_steps or idle > 12:
                break
            region = (p > 0) | (gap < -0.5 * tolerance * scale)
            if guessed:  # a guess from other cells or loads: what a projected step of one cell leaves of it
                region &= p * self_influence >= gap
                guessed = False
            cells = np.flatnonzero(region)
            if not len(cells):  # too shallow a depth for this grid
                p, u, fresh = np.zeros_like(p), np.zeros_like(p), True
                continue
            if len(cells) <= self.dense_limit and not (singular and region.all()):
                pressed = press_cells(operator, separation, control, cells)
                p = _scatter(pressed.cells, pressed.pressure, region.shape)
                tangent = Tangent(_scatter(pressed.cells, pressed.tangent, region.shape), pressed.error)
                u, fresh, steps = operator.apply(p), True, steps + 1
                continue
            relaxed = relax(
                operator,
                region,
                separation,
                p,
                u,
                depth=given,
                limit=scale * max(0.3 * tolerance, min(0.1 * r, 1e-2)),
                max_steps=self.max_steps - steps,
            )
            p, u, fresh, steps, tangent = (
                relaxed.pressure,
                relaxed.displacement,
                False,
                steps + relaxed.steps,
                None,
            )
            if (p < 0).any():  # these would pull: let go
                p = start_pressure(measure, separation, control, p)
                u, fresh, steps = operator.apply(p), True, steps + 1
        rest = PolonskyKeer(max_steps=self.max_steps).run(operator, separation, control, p, tolerance)
        return replace(rest, steps=rest.steps + steps)


def _scatter(cells: npt.NDArray[np.intp], values: Array, shape: tuple[int, ...]) -> Array:
    field = np.zeros(shape)
    field.ravel()[cells] = values
    return field
