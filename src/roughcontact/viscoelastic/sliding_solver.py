"""The contact of a material that passes by: a complementarity problem with an unsymmetric operator.

Newton's method on the active set takes a few solves, but it may cycle where the modulus rises steeply with the
frequency. Sweeps of symmetric contact problems with the storage modulus of each wave always converge, by the factor
sin(delta) at most. Both are used in turn (docs/concepts/sliding-hysteresis.md).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres

from roughcontact.contact.press import solve
from roughcontact.contact.problem import ContactProblem
from roughcontact.solver.control import Specification, Status
from roughcontact.solver.optimality import Iterate, Optimality
from roughcontact.validation import Array, Mask
from roughcontact.viscoelastic.wave_operator import WaveOperator, Waves

__all__ = ["SlidingIterate", "solve_sliding"]

IDLE = 3  # solves by Newton's method without a smaller residual, after which it cycles
SWEEPS = 4  # before the second attempt of Newton's method, twice as many before each further one
MAX_SOLVES = 300
FIELDS = 8  # of Anderson's acceleration of the sweeps
DENSE = 700  # cells up to which a matrix is factorised
INNER = 0.1  # of the tolerance: residual of a linear solve, and of the contact problem of a sweep
ROUNDING = 1e-14  # of the largest displacement: a smaller penetration frees no cell


class SlidingIterate(NamedTuple):
    """An iterate.

    Attributes
    ----------
    pressure, displacement : array
        [Pa] and [m].
    depth : float
        Multiplier of the force [m].
    residual : float
        Largest violation of the conditions, relative to the largest displacement.
    solves : int
        Linear solves on an active set, and symmetric contact problems, so far.
    status : Status
    """

    pressure: Array
    displacement: Array
    depth: float
    residual: float
    solves: int
    status: Status


def solve_sliding(
    operator: WaveOperator, separation: Array, spec: Specification, pressure: Array
) -> SlidingIterate:
    """Return the contact under a force from a pressure to start from; without convergence the best iterate."""
    run = _Run(operator, separation, spec)
    run.visit(pressure)
    sweeps = SWEEPS
    while not run.best.status.converged and run.solves < MAX_SOLVES:
        run.newton()
        run.sweep(sweeps)
        sweeps *= 2
    return run.best._replace(solves=run.solves)


@dataclass(slots=True, eq=False)
class _Run:
    """The iteration. Iterates have no negative pressure, and the given force."""

    operator: WaveOperator
    separation: Array
    spec: Specification
    conditions: Optimality = field(init=False)
    storage: WaveOperator = field(init=False)
    solves: int = 0
    last: SlidingIterate = field(init=False)
    best: SlidingIterate = field(init=False)
    swept: list[tuple[Array, Array]] = field(default_factory=list)  # arguments and images of sweeps

    def __post_init__(self) -> None:
        self.conditions = Optimality.of(self.operator, self.spec, self.separation)
        self.storage = WaveOperator(self.operator.grid, lambda grid: _storage(self.operator.symbol(grid)))

    def visit(self, pressure: Array) -> None:
        """Take the positive part of a pressure as the next iterate."""
        p = self.conditions.feasible_start(self.separation, pressure)
        u = self.operator.apply(p)
        found = self.conditions.evaluate(Iterate(p, u, self.separation))
        status = Status.CONVERGED if found.residual <= self.spec.tolerance else Status.STAGNATED
        self.last = SlidingIterate(p, u, found.depth, found.residual, self.solves, status)
        if self.solves == 0 or found.residual < self.best.residual:
            self.best = self.last

    def newton(self) -> None:
        """Solve on the active set of the last iterate, as long as the residual falls."""
        lowest, idle = self.last.residual, 0
        while not self.best.status.converged and idle < IDLE and self.solves < MAX_SOLVES:
            p, u = self.last.pressure, self.last.displacement
            gap = u + self.separation - self.last.depth
            free = (p > 0) | (gap < -ROUNDING * np.abs(u).max())
            solved = self._by_matrix if np.count_nonzero(free) <= DENSE else self._by_products
            self.solves += 1
            self.visit(solved(free))
            idle = 0 if self.last.residual < lowest else idle + 1
            lowest = min(lowest, self.last.residual)

    def sweep(self, count: int) -> None:
        """Solve symmetric problems from the best iterate, accelerated by Anderson's method."""
        p = self.best.pressure
        difference = self.operator.factors - self.storage.factors
        tolerance = max(INNER * self.spec.tolerance, 1e-13)
        for _ in range(count):
            if self.best.status.converged:
                return
            shifted = self.separation + self.operator.filtered(p, difference)
            lowest = float(shifted.min())
            problem = ContactProblem(shifted - lowest, self.storage, self.spec.control, tolerance)
            image = solve(problem, initial=(p, self.last.depth - lowest)).pressure
            self.solves += 1
            self.visit(image)
            self.swept = [*self.swept[1 - FIELDS :], (p, image)]
            p = self.conditions.feasible_start(self.separation, self._accelerated())

    def _accelerated(self) -> Array:
        """Return the combination of the images whose change is smallest in the norm of the storage modulus."""
        root = np.sqrt(self.storage.factors)
        images = np.stack([image for _, image in self.swept])
        changes = np.stack([self.storage.filtered(image - p, root).ravel() for p, image in self.swept])
        parts, *_ = np.linalg.lstsq((changes[:-1] - changes[-1]).T, -changes[-1], rcond=1e-10)
        return np.asarray(np.tensordot([*parts, 1 - parts.sum()], images, 1))

    def _by_matrix(self, free: Mask) -> Array:
        """Return the pressure that closes the gaps of the free cells, by a factorisation."""
        cells = np.flatnonzero(free)
        n, unit = len(cells), self.conditions.self_influence  # so that all entries are of one size
        matrix = np.zeros((n + 1, n + 1))
        matrix[:n, :n] = self.operator.as_matrix(cells) / unit
        matrix[:n, n], matrix[n, :n] = -1, 1
        total = self.spec.control.value / self.operator.weights
        pressure = np.zeros(free.size)
        pressure[cells] = np.linalg.solve(matrix, np.append(-self.separation[free] / unit, total))[:n]
        return pressure.reshape(free.shape)

    def _by_products(self, free: Mask) -> Array:
        """Return the same by GMRES, preconditioned by the inverse of each wave, on pressures without a resultant."""

        def level(part: Array) -> Array:
            return np.asarray(part - part.mean())

        def between(apply: Callable[[Array], Array]) -> LinearOperator:
            def product(part: Array) -> Array:
                whole = np.zeros(free.shape)
                whole[free] = level(part.ravel())
                return level(apply(whole)[free])

            return LinearOperator((count, count), matvec=product, dtype=np.float64)

        count, pressure = np.count_nonzero(free), np.where(free, self.last.pressure, 0.0)
        missing = -level((self.last.displacement + self.separation)[free])
        limit = INNER * self.spec.tolerance * float(np.abs(self.last.displacement).max())
        inverse = between(self.operator.approximate_inverse)
        part, _ = gmres(
            between(self.operator.apply), missing, M=inverse, rtol=0, atol=limit, restart=50, maxiter=4
        )
        pressure[free] += level(part)
        return pressure


def _storage(factors: Waves) -> Waves:
    """Return the factors 2/(abs(q) Re E) for those of a material that passes by, 2/(abs(q) E)."""
    real = factors.real.copy()
    real[0, 0] = 1.0
    return np.asarray(np.abs(factors) ** 2 / real)
