"""The primal-dual active set method (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13, 865, 2002; thesis, eqs (A.6-8)).

Labels A1 to A10 are the lines of the algorithm in docs/concepts/method.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from roughcontact.grid import Grid
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.halfspace.operators.operator import Operator, capabilities, is_semidefinite
from roughcontact.kernels import loader
from roughcontact.progress.events import RunningTask, decades, solving
from roughcontact.solver import tuning
from roughcontact.solver.bound_constrained_cg import InnerSystem, inner_solve, inner_system
from roughcontact.solver.control import Specification, State, Status, Tangent
from roughcontact.solver.direct import Cells, press_cells
from roughcontact.solver.inner_operator import (
    FullGrid,
    InnerOperator,
    factorisation_pays,
    first_product,
    inner_operator_on,
)
from roughcontact.solver.optimality import Evaluation, Iterate, Optimality, PredictedSet, Quality
from roughcontact.solver.plastic import press_plastic
from roughcontact.solver.polonsky_keer import PolonskyKeer
from roughcontact.solver.projection import elastic_control, project
from roughcontact.solver.subdomain import prolong
from roughcontact.validation import Array, require_numbers, whole

__all__ = ["ActiveSet"]


@dataclass(frozen=True, slots=True)
class ActiveSet:
    """Settings of the active set method, the default solver.

    Free sets of up to `dense_limit` cells are solved by a factorisation (of an operator that has tiles 700 at most, 300
    where the tolerance is 1e-5 or more), larger ones by bound-constrained conjugate gradients in single precision, on
    the tiles that they touch where that costs less, and to a forcing term; products in double precision certify. The
    influence matrix of the half-space is close to an inverse M-matrix, for which the method is finite at given depth;
    nothing proves that for other operators, so that a run without progress is continued by Polonsky and Keer's method.

    Parameters
    ----------
    max_steps : int
        Largest number of products with the operator.
    dense_limit : int
        Free sets of up to this number of cells are factorised.

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

    def run(self, operator: Operator, separation: Array, spec: Specification, initial: Array) -> State:
        """Solve for the pressure.

        Parameters
        ----------
        operator : Operator
            Displacement [m] from pressure [Pa].
        separation : array, shape ``operator.grid.shape``
            Undeformed gap at first touch [m], infinite where nothing was measured.
        spec : Specification
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
        >>> state = rc.ActiveSet().run(problem.operator, problem.separation, problem.spec, np.zeros(grid.shape))
        >>> state.status.converged, f"{state.depth * 1e9:.0f} nm"
        (True, '175 nm')
        """
        if spec.plastic:
            return self._run_plastic(operator, separation, spec, initial)
        conditions = Optimality.of(operator, spec, separation)
        start = conditions.feasible_start(separation, initial)  # A1
        outer = self._outer(operator, separation, conditions, start)
        del initial, start  # fields are large: only the outer iteration holds its pressure
        state = outer.run()
        if state.status.converged:
            return state
        rest = PolonskyKeer(max_steps=self.max_steps).run(operator, separation, spec, state.pressure)
        return replace(rest, steps=rest.steps + state.steps)

    def _run_plastic(
        self, operator: Operator, separation: Array, spec: Specification, initial: Array
    ) -> State:
        """Solve under a hardness, from the elastic answer.

        Where there is none at the depth that is prescribed, from the one at the largest depth.
        """
        conditions = Optimality.of(operator, spec, separation)
        measure, xp = conditions.measure, conditions.measure.xp
        control = elastic_control(operator, separation, spec.control, xp)
        unlimited = replace(spec, control=control, hardness=math.inf)
        elastic = self.run(operator, separation, unlimited, initial)
        if control == spec.control and bool(xp.all(elastic.pressure <= spec.hardness)):
            return elastic
        excess = xp.where(elastic.pressure > spec.hardness, elastic.pressure - spec.hardness, 0.0)
        start, steps = project(measure, elastic.pressure, separation, spec), elastic.steps
        uniform = isinstance(spec.hardness, int | float)  # inner solves take one upper bound for all cells
        if uniform and measure.total(excess) < tuning.PLASTIC_FORCE * measure.total(elastic.pressure):
            state = self._outer(operator, separation, conditions, start).run()
            if state.status.converged:
                return replace(state, steps=steps + state.steps)
            start, steps = state.pressure, steps + state.steps
        state = press_plastic(operator, separation, spec, start, self.max_steps)
        return replace(state, steps=steps + state.steps)

    def _outer(self, operator: Operator, separation: Array, conditions: Optimality, p: Array) -> _Outer:
        # Factorisations are made on the host, and know no hardness.
        direct = conditions.measure.on_host and not conditions.spec.plastic
        dense_limit = self.dense_limit if direct else 0
        return _Outer(operator, separation, conditions, self.max_steps, dense_limit, p)


@dataclass(slots=True, eq=False)
class _Outer:
    """The outer iteration from a feasible pressure. Only it holds the large fields of its iterate.

    Attributes
    ----------
    pressure, displacement : array
        The iterate: p [Pa] and u [m]; no displacement is held between the solve for p and the next product.
    exact : bool
        Whether u is of an exact product.
    dense_limit : int
        Free sets of up to this number of cells are factorised.
    steps : int
        Products so far.
    first : bool
        Whether the next prediction of F is the first.
    best, idle : float, int
        Smallest residual so far, and rounds without progress.
    inner : InnerOperator, optional
        Of the last inner solve.
    tangent : Tangent, optional
        Of the pressure, where the last solve was direct.
    task : RunningTask, optional
        Where the residual is reported.
    """

    operator: Operator
    separation: Array
    conditions: Optimality
    max_steps: int
    dense_limit: int
    pressure: Array
    displacement: Any = None
    exact: bool = False
    steps: int = 0
    first: bool = True
    best: float = math.inf
    idle: int = 0
    inner: InnerOperator | None = None
    tangent: Tangent | None = None
    task: RunningTask | None = None

    def run(self) -> State:
        """Iterate A2 to A10: converged, or stagnated."""
        with solving(self.conditions.spec.tolerance, self.pressure.shape) as self.task:
            return self._iterate()

    def _iterate(self) -> State:
        tolerance = self.conditions.spec.tolerance
        self.displacement, self.exact = first_product(self.operator, self.pressure)  # A2
        self.steps = 1
        while True:
            # A3, A4
            found = self.conditions.evaluate(Iterate(self.pressure, self.displacement, self.separation))
            self._report(found.residual)
            if found.residual <= tolerance:  # A5
                if self.exact:
                    return self._state(found, Status.CONVERGED)
                self.displacement = None  # the certificate needs an exact product
            elif self._stagnates(found.residual) or not self._correct(found):
                return self._state(found, Status.STAGNATED)
            if self.displacement is None:  # A10, after A5 too
                self.displacement, self.exact = self.operator.apply(self.pressure), True
                self.steps += 1

    def _stagnates(self, residual: float) -> bool:
        """Take note of a residual; return whether there are no steps left, or no progress for too long."""
        self.idle = 0 if residual < tuning.PROGRESS * self.best else self.idle + 1
        self.best = min(self.best, residual)
        return self.steps >= self.max_steps or self.idle > tuning.ROUNDS_AT_ALL

    def _correct(self, found: Evaluation) -> bool:
        """Solve on the predicted free set (A6 to A9); return False if no cell is free and the cells at H give no depth.

        The prediction and its system are gone when this returns, and before the projection: fields are large.
        """
        spec = self.conditions.spec
        solved = self._solve(self._reduced(found), found.residual)
        if solved and spec.plastic:
            gap = self.displacement + self.separation
            self.pressure, self.displacement = (
                project(self.conditions.measure, self.pressure, gap, spec),
                None,
            )
        return solved

    def _reduced(self, found: Evaluation) -> Cells | InnerSystem:
        """Return the problem on the predicted free set: its cells, if they are solved directly, or a system for B."""
        operator, conditions, spec = self.operator, self.conditions, self.conditions.spec
        iterate = Iterate(self.pressure, self.displacement, self.separation)
        allowed = 0.5 * spec.tolerance * found.scale
        predicted = conditions.predict_free_set(  # A6
            iterate, depth=found.depth, allowed=allowed, first=self.first
        )
        self.first = False
        # A7: roughly by B where its steps cost little, and then with fewer cells.
        rough = predicted.quality is not Quality.GOOD and self._rough_steps_pay()
        if rough:
            self.dense_limit = min(self.dense_limit, tuning.DIRECT_ROUGHLY)
        pays = factorisation_pays(operator, predicted.count, self.dense_limit, spec.tolerance)
        direct = pays and not rough
        if direct and predicted.quality is Quality.BAD:  # A7: else by B on the matrix of F
            limit = tuning.SCREENING_RESIDUAL * found.residual * found.scale
            predicted = _screened(operator, iterate, conditions, predicted, limit)
        if predicted.count == math.prod(predicted.free.shape) and is_semidefinite(operator):
            if spec.depth is None:
                direct = False  # the matrix is singular
            else:
                predicted = _all_but_one(predicted, self.pressure, conditions.measure.xp)
        if not predicted.count:
            return np.empty(0, np.intp)
        if direct:
            return np.flatnonzero(predicted.free)
        stuck = self.idle >= tuning.ROUNDS_IN_SINGLE
        self.inner = inner = (
            FullGrid(operator) if stuck else inner_operator_on(operator, predicted.support, self.inner)
        )
        # A9: the residual to which B goes
        factor = max(inner.contraction, tuning.SCREENING_RESIDUAL if rough else 0.0)
        limit = found.scale * max(tuning.INNER_TOLERANCE * spec.tolerance, factor * found.residual)
        return inner_system(inner, iterate, conditions, predicted.free, limit=limit)

    def _solve(self, reduced: Cells | InnerSystem, residual: float) -> bool:
        """Solve a reduced problem from a residual: few cells directly (A8), more by B (A9), none by zero pressure."""
        conditions, spec, shape = self.conditions, self.conditions.spec, self.pressure.shape
        if isinstance(reduced, InnerSystem):
            if not spec.plastic:
                self.displacement = None  # the system has what it needs of it
            left = self.max_steps - self.steps
            report = None if self.task is None else lambda part: self._report(part * residual)
            self.pressure, steps = inner_solve(reduced, conditions, max_steps=left, report=report)  # A9
            self.tangent, self.steps = None, self.steps + steps
        elif len(reduced):
            try:
                solved = press_cells(self.operator, self.separation, spec.control, reduced)  # A8
            except np.linalg.LinAlgError:  # not definite to working precision: the next round iterates
                self.dense_limit = 0
                return True
            self.displacement = None
            self.pressure = prolong(solved.pressure, solved.cells, shape)
            self.tangent = Tangent(prolong(solved.tangent, solved.cells, shape), solved.error)
        else:
            xp = self.conditions.measure.xp
            if spec.plastic and bool(xp.any(self.pressure >= spec.hardness)):
                return False
            # The depth is too small for this grid.
            self.pressure, self.displacement = xp.zeros_like(self.pressure), xp.zeros_like(self.pressure)
        return True

    def _report(self, residual: float) -> None:
        if self.task is not None:
            self.task.reached(decades(residual))

    def _rough_steps_pay(self) -> bool:
        """Whether some tens of steps in machine code cost less than a matrix of many cells and its factorisation."""
        operator, depth = self.operator, self.conditions.spec.depth
        few = operator.grid.size <= tuning.SCREENING_GRID and loader.is_available()
        if not few or (depth is not None and is_semidefinite(operator)):
            return False
        return capabilities(operator).local_inverse() is not None

    def _state(self, found: Evaluation, status: Status) -> State:
        p, d, residual, steps = self.pressure, found.depth, found.residual, self.steps
        if not status.converged:
            return State(p, d, residual, steps, status)
        return State(p, d, residual, steps, status, self.tangent, self.displacement, found.extremes)


def _all_but_one(predicted: PredictedSet, pressure: Array, xp: Any) -> PredictedSet:
    """Return the prediction of all cells without that of the least pressure.

    Up to the mean separation one cell of a periodic surface may always go without pressure; with all of them the mean
    pressure would be undetermined.
    """
    free = predicted.free
    cells = xp.reshape(xp.arange(predicted.count, device=free.device), free.shape)
    return replace(predicted, free=cells != xp.argmin(pressure), count=predicted.count - 1)


def _screened(
    operator: Operator, iterate: Iterate, conditions: Optimality, predicted: PredictedSet, limit: float
) -> PredictedSet:
    """Return the prediction without the cells that have no pressure when it is solved roughly, on its matrix (A7).

    A product with the matrix grows with the square of the number of cells, its factorisation with the third power.
    """
    cells = np.flatnonzero(predicted.free)
    area = float(operator.weights)  # one for all cells, see `Optimality.predict_free_set`
    part = FullGrid(DenseOperator(Grid(len(cells), area), operator.as_matrix(cells)))
    p, separation = iterate.pressure.ravel()[cells], iterate.separation.ravel()[cells]
    begun, all_free = Iterate(p, part.apply(p), separation), np.ones(len(cells), dtype=bool)
    found = inner_solve(
        inner_system(part, begun, conditions, all_free, limit=limit), conditions, max_steps=50
    )
    free = prolong(found.pressure, cells, predicted.free.shape) > 0
    return replace(predicted, free=free, count=int(np.count_nonzero(free)))
