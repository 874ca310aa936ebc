"""The active set: guess the contact region, solve inside it, flip what violates (thesis, A.6 to A.8)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy, namespace
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.halfspace.operators.operator import Operator, is_semidefinite
from roughcontact.solver.control import Terms
from roughcontact.solver.direct import DENSE_LIMIT, press_cells
from roughcontact.solver.inner_operator import Driver, Plane, driver_on, factorised, first_product
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.iterative import press_region
from roughcontact.solver.optimality import Judge
from roughcontact.solver.plastic import press_hard
from roughcontact.solver.polonsky_keer import PolonskyKeer
from roughcontact.solver.projection import elastic_control, within
from roughcontact.solver.start import start_pressure
from roughcontact.solver.state import State, Tangent
from roughcontact.solver.status import Status
from roughcontact.solver.trial import Trial
from roughcontact.solver.verdict import Guess, guess_region, judge_pressure
from roughcontact.validation import require_numbers

__all__ = ["ActiveSet"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]
Mask = npt.NDArray[np.bool_]

LOOSE = 0.2  # of the violation of a guess: how far it is solved to be sifted
SIFTED = 300  # cells: of fewer, a factorisation costs no more than a few products
FLOWING = 0.5  # of the force: where more exceeds the hardness, hardly a cell is left between the bounds
STUCK = 3  # rounds without progress after which only exact products are trusted


@dataclass(frozen=True, slots=True)
class ActiveSet:
    """Settings of the active set method, the default solver.

    Regions of up to `dense_limit` cells (of a half-space that has tiles 1200 at most, 300 where the tolerance is
    loose) are solved by a factorisation, larger ones by conjugate gradients in single precision, on the tiles that
    they touch where that costs less, just as far as the present guess of the region deserves; products in double
    precision certify. For the half-space the influence matrix is an inverse M-matrix and the flipping ends; for
    others nothing proves it, so that a run without progress is handed to Polonsky and Keer's method.
    """

    max_steps: int = 5000
    dense_limit: int = DENSE_LIMIT

    def __post_init__(self) -> None:
        require_numbers(self)

    def run(self, operator: Operator, separation: Array, terms: Terms, initial: Array) -> State:
        """Solve for the pressure from an `initial` one, on the given terms.

        With a hardness that the elastic answer would exceed, that answer is where to start; where there is none at the
        depth that is prescribed, the one at the largest depth.
        """
        measure = Measure(operator.weights)
        if terms.hardness < math.inf:
            control = elastic_control(operator, separation, terms.control)
            body = replace(terms, control=control, hardness=math.inf)
            elastic = self.run(operator, separation, body, initial)
            xp = namespace(separation)
            if control == terms.control and float(xp.max(elastic.pressure)) <= terms.hardness:
                return elastic
            excess = xp.where(elastic.pressure > terms.hardness, elastic.pressure - terms.hardness, 0.0)
            start, steps = within(measure, elastic.pressure, separation, terms), elastic.steps
            if measure.total(excess) < FLOWING * measure.total(elastic.pressure):
                state = self._flip(operator, separation, terms, start)
                if state.status.converged:
                    return replace(state, steps=steps + state.steps)
                start, steps = state.pressure, steps + state.steps
            state = press_hard(operator, separation, terms, start, self.max_steps)
            return replace(state, steps=steps + state.steps)
        own = Judge.of(operator, terms).self_influence
        p = start_pressure(measure, separation, terms.control, initial, own)
        state = self._flip(operator, separation, terms, p)
        if state.status.converged:
            return state
        rest = PolonskyKeer(max_steps=self.max_steps).run(operator, separation, terms, state.pressure)
        return replace(rest, steps=rest.steps + state.steps)

    def _flip(self, operator: Operator, separation: Array, terms: Terms, p: Array) -> State:
        """Return what guessing the region again and again leads to: converged, or stagnated."""
        measure, judge = Measure(operator.weights), Judge.of(operator, terms)
        control, tolerance, given, hardness = terms.control, terms.tolerance, terms.depth, terms.hardness
        singular = is_semidefinite(operator)  # with every cell in contact, that is
        xp = namespace(separation)
        # Factorisations are made on the host, and know no hardness.
        direct = is_numpy(separation) and hardness == math.inf
        dense_limit = factorised(operator, self.dense_limit, tolerance) if direct else 0
        (u, exact), steps = first_product(operator, p), 1
        tangent: Tangent | None = None
        best, idle = np.inf, 0
        driver: Driver | None = None
        guessed = True
        while True:
            trial = Trial(p, u, separation)
            d, r, scale = judge_pressure(judge, measure, terms, trial)
            if r <= tolerance and exact:
                return State(p, d, r, steps, Status.CONVERGED, tangent, u)
            if r <= tolerance:  # the certificate stands on an exact product
                u, exact, steps = operator.apply(p), True, steps + 1
                continue
            idle = 0 if r < 0.9 * best else idle + 1
            best = min(best, r)
            if steps >= self.max_steps or idle > 12:
                return State(p, d, r, steps, Status.STAGNATED)
            allowed = 0.5 * tolerance * scale
            # From other cells or another load: keep what a projected step of one cell leaves of it.
            own = judge.self_influence if guessed else math.inf
            guess = guess_region(terms, trial, depth=d, allowed=allowed, own=own)
            region, count = guess.region, guess.count
            if guessed and _worth_sifting(guess, measure, dense_limit):
                cells = np.flatnonzero(region)
                settings = {"own": judge.self_influence, "limit": LOOSE * r * scale}
                region = _sifted(operator, separation, terms, cells, p, **settings)
                count = int(np.count_nonzero(region))
            guessed, size = False, math.prod(region.shape)
            # Where all give way no region tells the depth.
            if not count and hardness < math.inf and bool(xp.any(p >= hardness)):
                return State(p, d, r, steps, Status.STAGNATED)
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
                driver = driver_on(operator, guess.taken, driver) if idle < STUCK else Plane(operator)
                found = press_region(
                    driver,
                    separation,
                    terms,
                    region,
                    p,
                    u,
                    own=judge.self_influence,
                    limit=scale * max(0.3 * tolerance, driver.gain * r),
                    max_steps=self.max_steps - steps,
                )
                p, tangent, steps = found.pressure, None, steps + found.steps + 1
                if hardness < math.inf:
                    p = within(measure, p, u + separation, terms)
            del u
            u, exact = operator.apply(p), True


def _worth_sifting(guess: Guess, measure: Measure, limit: int) -> bool:
    """Whether a guess is bad, and its matrix large, not too large: one load to the next is a good guess."""
    return guess.wrong > guess.count / 100 and SIFTED < guess.count <= limit and not measure.varies


def _sifted(
    operator: Operator,
    separation: Array,
    terms: Terms,
    cells: Cells,
    pressure: Array,
    *,
    own: float,
    limit: float,
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
        terms,
        np.ones(len(cells), dtype=bool),
        start,
        part.apply(start),
        own=own,
        limit=limit,
        max_steps=50,
    )
    return _scatter(cells, found.pressure, separation.shape) > 0


def _scatter(cells: npt.NDArray[np.intp], values: Array, shape: tuple[int, ...]) -> Array:
    field = np.zeros(shape)
    field.ravel()[cells] = values
    return field
