"""The primal-dual active set method (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13, 865, 2002; thesis, eqs (A.6-8)).

Labels A1 to A10 are the lines of the algorithm in docs/method.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from roughcontact.grid import Grid
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.halfspace.operators.operator import Operator, capabilities, is_semidefinite
from roughcontact.kernels import loader
from roughcontact.solver import tuning
from roughcontact.solver.bound_constrained_cg import inner_solve, inner_system
from roughcontact.solver.control import State, Status, Tangent, Terms
from roughcontact.solver.direct import press_cells
from roughcontact.solver.inner_operator import (
    FullGrid,
    InnerOperator,
    factorisation_pays,
    first_product,
    inner_operator_on,
)
from roughcontact.solver.inner_product import Measure
from roughcontact.solver.optimality import Iterate, Optimality, PredictedSet
from roughcontact.solver.plastic import press_plastic
from roughcontact.solver.polonsky_keer import PolonskyKeer
from roughcontact.solver.projection import elastic_control, project
from roughcontact.solver.subdomain import prolong
from roughcontact.validation import Array, Mask, require_numbers, whole

__all__ = ["ActiveSet"]


@dataclass(frozen=True, slots=True)
class ActiveSet:
    """Settings of the active set method, the default solver.

    Free sets of up to `dense_limit` cells (of a half-space that has tiles 700 at most, 300 where the tolerance is
    loose) are solved by a factorisation, larger ones by bound-constrained conjugate gradients in single precision, on
    the tiles that they touch where that costs less, and to a forcing term; products in double precision certify. The
    influence matrix of the half-space is close to an inverse M-matrix, for which the method is finite at given depth;
    nothing proves that for other operators, so that a run without progress is continued by Polonsky and Keer's method.

    Parameters
    ----------
    max_steps : int
        Largest number of products with the operator.
    dense_limit : int
        Free sets of up to so many cells are factorised.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> solution = rc.press(ball, 1e9, force=1e-3, solver=rc.ActiveSet(dense_limit=0))
    >>> solution.status.value
    'converged'
    """

    max_steps: int = 5000
    dense_limit: int = tuning.DIRECT_CELLS

    def __post_init__(self) -> None:
        require_numbers(self)
        whole(self.max_steps, "max_steps")

    def run(self, operator: Operator, separation: Array, terms: Terms, initial: Array) -> State:
        """Solve for the pressure.

        Parameters
        ----------
        operator : Operator
            Displacement [m] from pressure [Pa].
        separation : array, shape ``operator.grid.shape``
            Undeformed gap at first touch [m], infinite where nothing was measured.
        terms : Terms
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
        >>> state = rc.ActiveSet().run(problem.operator, problem.separation, problem.terms, np.zeros(grid.shape))
        >>> state.status.converged, f"{state.depth * 1e9:.0f} nm"
        (True, '175 nm')
        """
        if terms.plastic:
            return self._run_plastic(operator, separation, terms, initial)
        conditions = Optimality.of(operator, terms, separation)
        start = [conditions.feasible_start(separation, initial)]  # A1
        del initial  # planes are large: each is held by the one who needs it
        state = self._iterate(operator, separation, conditions, start.pop())
        if state.status.converged:
            return state
        rest = PolonskyKeer(max_steps=self.max_steps).run(operator, separation, terms, state.pressure)
        return replace(rest, steps=rest.steps + state.steps)

    def _run_plastic(self, operator: Operator, separation: Array, terms: Terms, initial: Array) -> State:
        """Solve under a hardness, from the elastic answer.

        Where there is none at the depth that is prescribed, from the one at the largest depth.
        """
        conditions = Optimality.of(operator, terms, separation)
        measure, xp = conditions.measure, conditions.measure.xp
        control = elastic_control(operator, separation, terms.control, xp)
        unlimited = replace(terms, control=control, hardness=math.inf)
        elastic = self.run(operator, separation, unlimited, initial)
        if control == terms.control and bool(xp.all(elastic.pressure <= terms.hardness)):
            return elastic
        excess = xp.where(elastic.pressure > terms.hardness, elastic.pressure - terms.hardness, 0.0)
        start, steps = project(measure, elastic.pressure, separation, terms), elastic.steps
        alike = isinstance(terms.hardness, int | float)  # the inner solves know one upper bound for all cells
        if alike and measure.total(excess) < tuning.PLASTIC_FORCE * measure.total(elastic.pressure):
            state = self._iterate(operator, separation, conditions, start)
            if state.status.converged:
                return replace(state, steps=steps + state.steps)
            start, steps = state.pressure, steps + state.steps
        state = press_plastic(operator, separation, terms, start, self.max_steps)
        return replace(state, steps=steps + state.steps)

    def _iterate(self, operator: Operator, separation: Array, conditions: Optimality, p: Array) -> State:
        """Iterate A2 to A10 from a feasible pressure: converged, or stagnated."""
        terms, measure, xp = conditions.terms, conditions.measure, conditions.measure.xp
        tolerance, hardness = terms.tolerance, terms.hardness
        singular = is_semidefinite(operator)  # with every cell in contact, that is
        # Factorisations are made on the host, and know no hardness.
        dense_limit = self.dense_limit if measure.on_host and not terms.plastic else 0
        (u, exact), steps = first_product(operator, p), 1  # A2
        tangent: Tangent | None = None
        inner: InnerOperator | None = None
        best, idle, first = np.inf, 0, True
        while True:
            iterate = Iterate(p, u, separation)
            d, residual, scale, seen = conditions.evaluate(iterate)  # A3, A4
            if residual <= tolerance and exact:
                return State(p, d, residual, steps, Status.CONVERGED, tangent, u, seen)
            if residual <= tolerance:  # A5: the certificate needs an exact product
                u, exact, steps = operator.apply(p), True, steps + 1
                continue
            idle = 0 if residual < tuning.PROGRESS * best else idle + 1
            best = min(best, residual)
            if steps >= self.max_steps or idle > tuning.ROUNDS_AT_ALL:
                return State(p, d, residual, steps, Status.STAGNATED)
            allowed = 0.5 * tolerance * scale
            # A6: from another grid or load, only cells on which a projected step leaves a pressure.
            set_ = conditions.predict_free_set(iterate, depth=d, allowed=allowed, projected=first)
            free, count = set_.free, set_.count
            bad = first and _worth_screening(set_, measure)
            # A first set that is but a guess is solved roughly, by steps that cost little: the next has fewer cells.
            guessed = first and not (singular and terms.depth is not None) and _is_guess(set_, p, measure)
            guessed = guessed and _steps_cost_little(operator)
            if guessed:
                dense_limit = min(dense_limit, tuning.DIRECT_ROUGHLY)
            direct = not guessed and factorisation_pays(operator, count, dense_limit, tolerance)
            if bad and direct:
                free = _screened(
                    operator, iterate, conditions, free, tuning.SCREENING_RESIDUAL * residual * scale
                )
                count = int(np.count_nonzero(free))
            first, size = False, math.prod(free.shape)
            # With all cells at the hardness no free one determines the depth.
            if not count and terms.plastic and bool(xp.any(p >= hardness)):
                return State(p, d, residual, steps, Status.STAGNATED)
            if not count:  # too shallow a depth for this grid
                p, u = xp.zeros_like(p), xp.zeros_like(p)
                continue
            if singular and count == size and terms.depth is not None:
                # Up to the mean separation one cell may always go without pressure; with all of them the
                # mean pressure would be undetermined.
                cells = xp.reshape(xp.arange(size, device=free.device), free.shape)
                free, count = cells != xp.argmin(p), size - 1
            whole = singular and count == size  # of which the matrix is singular
            if direct and not whole:  # A8
                try:
                    solved = press_cells(operator, separation, terms.control, np.flatnonzero(free))
                except np.linalg.LinAlgError:  # not definite to working precision: iterate instead
                    dense_limit = 0
                    continue
                del u, iterate
                p = prolong(solved.pressure, solved.cells, free.shape)
                tangent = Tangent(prolong(solved.tangent, solved.cells, free.shape), solved.error)
                steps += 1
            else:  # A9
                stuck = idle >= tuning.ROUNDS_IN_SINGLE
                inner = FullGrid(operator) if stuck else inner_operator_on(operator, set_.support, inner)
                target = max(tuning.SCREENING_RESIDUAL if guessed else 0.0, inner.contraction)
                limit = scale * max(tuning.INNER_TOLERANCE * tolerance, target * residual)
                system = inner_system(inner, iterate, conditions, free, limit=limit)
                gap = u + separation if terms.plastic else None
                del u, iterate, set_, free  # it has what it needs of them
                p, done = inner_solve(system, conditions, max_steps=self.max_steps - steps)
                del system
                tangent, steps = None, steps + done + 1
                if gap is not None:
                    p = project(measure, p, gap, terms)
            u, exact = operator.apply(p), True  # A10


def _worth_screening(predicted: PredictedSet, measure: Measure) -> bool:
    """Whether a prediction is bad and its factorisation costs much: from one load to the next it is good."""
    bad = predicted.dropped > predicted.count / 100
    return bad and predicted.count > tuning.SCREENING_CELLS and not measure.varies


def _is_guess(predicted: PredictedSet, pressure: Array, measure: Measure) -> bool:
    """Whether many cells are predicted from the pressure of few, as of summits, or the prediction is bad."""
    few = measure.on_host and 2 * int(np.count_nonzero(pressure)) < predicted.count
    return _worth_screening(predicted, measure) or (few and predicted.count > tuning.SCREENING_CELLS)


def _steps_cost_little(operator: Operator) -> bool:
    """Whether some tens of steps in machine code cost less than a matrix of many cells and its factorisation."""
    few = operator.grid.size <= tuning.SCREENING_GRID and loader.is_available()
    return few and capabilities(operator).local_inverse() is not None


def _screened(operator: Operator, iterate: Iterate, conditions: Optimality, free: Mask, limit: float) -> Mask:
    """Return the cells of a predicted free set that have pressure when their problem is solved roughly (A7).

    A product with their matrix grows with the square of their number, its factorisation with the third power.
    """
    cells = np.flatnonzero(free)
    area = float(operator.weights)  # the same for all, see `_worth_screening`
    part = FullGrid(DenseOperator(Grid(len(cells), area), operator.as_matrix(cells)))
    p, separation = iterate.pressure.ravel()[cells], iterate.separation.ravel()[cells]
    begun, all_free = Iterate(p, part.apply(p), separation), np.ones(len(cells), dtype=bool)
    found = inner_solve(
        inner_system(part, begun, conditions, all_free, limit=limit), conditions, max_steps=50
    )
    return prolong(found.pressure, cells, free.shape) > 0
