"""The active set: guess the contact region, solve inside it, flip what violates (thesis, A.6 to A.8)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy, namespace
from roughcontact.contact.direct import DENSE_LIMIT, press_cells
from roughcontact.contact.drivers import Driver, Plane, driver_on, factorised, first_product
from roughcontact.contact.hard import press_hard
from roughcontact.contact.iterative import press_region
from roughcontact.contact.measure import Measure
from roughcontact.contact.optimality import Judge
from roughcontact.contact.polonsky_keer import PolonskyKeer
from roughcontact.contact.problem import Control, Terms
from roughcontact.contact.start import start_pressure
from roughcontact.contact.state import State, Tangent
from roughcontact.contact.status import Status
from roughcontact.grid import Grid
from roughcontact.halfspace.dense import DenseOperator
from roughcontact.halfspace.operator import Operator, is_semidefinite

__all__ = ["ActiveSet"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]
Mask = npt.NDArray[np.bool_]

LOOSE = 0.2  # of the violation of a guess: how far it is solved to be sifted
SIFTED = 300  # cells: of fewer, a factorisation costs no more than a few products
STUCK = 3  # rounds without progress after which only exact products are trusted


@dataclass(frozen=True, slots=True)
class ActiveSet:
    """Settings of the active set method, the default solver.

    Regions of up to `dense_limit` cells (of a half-space that has tiles 1200 at most) are solved by a factorisation,
    larger ones by conjugate gradients in single precision, on the tiles that they touch where that costs less, just as
    far as the present guess of the region deserves; products in double precision certify. For the half-space the
    influence matrix is an inverse M-matrix and the flipping ends; for others nothing proves it, so that a run without
    progress is handed to Polonsky and Keer's method.
    """

    max_steps: int = 5000
    dense_limit: int = DENSE_LIMIT

    def run(self, operator: Operator, separation: Array, terms: Terms, initial: Array) -> State:
        """Solve for the pressure from an `initial` one, on the given terms.

        With a hardness that the answer would exceed, that answer is where Polonsky and Keer's method starts.
        """
        if terms.hardness < np.inf:
            elastic = self.run(operator, separation, replace(terms, hardness=np.inf), initial)
            if float(namespace(separation).max(elastic.pressure)) <= terms.hardness:
                return elastic
            rest = press_hard(operator, separation, terms, elastic.pressure, self.max_steps)
            return replace(rest, steps=rest.steps + elastic.steps)
        measure = Measure(operator.weights)
        control, tolerance = terms.control, terms.tolerance
        judge = Judge.of(operator, terms)
        own = judge.self_influence
        singular = is_semidefinite(operator)  # with every cell in contact, that is
        xp = namespace(separation)
        # Factorisations are made on the host.
        dense_limit = factorised(operator, self.dense_limit) if is_numpy(separation) else 0
        given = terms.depth
        p = start_pressure(measure, separation, control, initial, own)
        (u, exact), steps = first_product(operator, p), 1
        tangent: Tangent | None = None
        best, idle = np.inf, 0
        driver: Driver | None = None
        guessed = True
        while True:
            d = measure.mean(u + separation, p > 0) if given is None else given
            gap = u + separation - d
            scale = judge.scale(u)
            r = judge.residual(p, u, gap)
            if r <= tolerance and exact:
                return State(p, d, r, steps, Status.CONVERGED, tangent)
            if r <= tolerance:  # the certificate stands on an exact product
                u, exact, steps = operator.apply(p), True, steps + 1
                continue
            idle = 0 if r < 0.9 * best else idle + 1
            best = min(best, r)
            if steps >= self.max_steps or idle > 12:
                break
            region = (p > 0) | (gap < -0.5 * tolerance * scale)
            if guessed:
                # From other cells or another load: keep what a projected step of one cell leaves of it.
                wrong = region & (p * own < gap)
                region &= ~wrong
                if dense_limit and self._worth_sifting(region, wrong, measure):
                    limit = LOOSE * r * scale
                    region = _sifted(operator, separation, control, np.flatnonzero(region), p, limit)
                guessed = False
            count, size = int(xp.count_nonzero(region)), math.prod(region.shape)
            if not count:  # too shallow a depth for this grid
                p, u = xp.zeros_like(p), xp.zeros_like(p)
                continue
            if singular and count == size and given is not None:
                # Up to the mean separation one cell may always go without pressure; with all of them the
                # mean pressure would be free.
                cells = xp.reshape(xp.arange(size, device=region.device), region.shape)
                region, count = cells != xp.argmin(p), size - 1
            if count <= dense_limit and count < size + (not singular):
                try:
                    pressed = press_cells(operator, separation, control, np.flatnonzero(region))
                except np.linalg.LinAlgError:  # not definite to working precision: iterate instead
                    dense_limit = 0
                    continue
                p = _scatter(pressed.cells, pressed.pressure, region.shape)
                tangent = Tangent(_scatter(pressed.cells, pressed.tangent, region.shape), pressed.error)
                steps += 1
            else:
                driver = driver_on(operator, region | (p > 0), driver) if idle < STUCK else Plane(operator)
                pressed_region = press_region(
                    driver,
                    separation,
                    control,
                    region,
                    p,
                    u,
                    limit=scale * max(0.3 * tolerance, driver.gain * r),
                    max_steps=self.max_steps - steps,
                )
                p, tangent, steps = pressed_region.pressure, None, steps + pressed_region.steps + 1
            u, exact = operator.apply(p), True
        rest = PolonskyKeer(max_steps=self.max_steps).run(operator, separation, terms, p)
        return replace(rest, steps=rest.steps + steps)

    def _worth_sifting(self, region: Mask, wrong: Mask, measure: Measure) -> bool:
        """Whether a guess is bad, and its matrix large: one load to the next is a good guess."""
        count = int(region.sum())
        return wrong.sum() > count / 100 and SIFTED < count <= self.dense_limit and not measure.varies


def _sifted(
    operator: Operator, separation: Array, control: Control, cells: Cells, pressure: Array, limit: float
) -> Mask:
    """Return the region of those guessed cells that press when their problem is solved loosely.

    A product with their matrix grows with the square of their number, its factorisation with the third power.
    """
    area = float(operator.weights)  # the same for all: who comes here has asked
    part = Plane(DenseOperator(Grid(len(cells), area), operator.as_matrix(cells)))
    start = pressure.ravel()[cells]
    found = press_region(
        part,
        separation.ravel()[cells],
        control,
        np.ones(len(cells), dtype=bool),
        start,
        part.apply(start),
        limit=limit,
        max_steps=50,
    )
    return _scatter(cells, found.pressure, separation.shape) > 0


def _scatter(cells: npt.NDArray[np.intp], values: Array, shape: tuple[int, ...]) -> Array:
    field = np.zeros(shape)
    field.ravel()[cells] = values
    return field
