"""Small free sets by a dense factorisation: the inner solve of the active set method on few cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.linalg import blas, lapack

from roughcontact.halfspace.operators.operator import Operator
from roughcontact.kernels.constants import WIDTH
from roughcontact.kernels.loader import functions, is_available
from roughcontact.solver import tuning
from roughcontact.solver.control import Control, Force
from roughcontact.solver.inner_product import Measure
from roughcontact.validation import Array

__all__ = ["Cells", "DirectSolution", "press_cells", "solve_cells"]

Cells = npt.NDArray[np.intp]
LANES = WIDTH // 8  # numbers of double precision that are taken at a time


@dataclass(frozen=True, slots=True, eq=False)
class DirectSolution:
    """A pressure [Pa] on `cells`, nowhere negative, its depth [m], and the pressure per unit depth [Pa/m].

    `error` is the largest deviation from one of the displacement under that last pressure.
    """

    cells: Cells
    pressure: Array
    depth: float
    tangent: Array
    error: float


def press_cells(operator: Operator, separation: Array, control: Control, cells: Cells) -> DirectSolution:
    """Solve only on `cells` and deactivate those with tensile pressure, until none has any (thesis, (A.6-8)).

    Parameters
    ----------
    operator : Operator
    separation : array
        Undeformed gap [m] on the operator's grid.
    control : Force or Depth
        What is prescribed.
    cells : int array
        Flat indices of the cells that may carry pressure.

    Notes
    -----
    With A a = 1 and A b = f on the cells the pressure is ``p = d a - b`` (A8); the force P fixes the depth
    ``d = (P + 1.b) / 1.a``.
    """
    heights = np.asarray(separation.ravel()[cells], np.float64)
    if len(cells) <= tuning.COMPILED_CELLS and isinstance(operator.weights, float) and is_available():
        return _press_compiled(operator.as_matrix(cells), heights, control, operator.weights, cells)
    weights = Measure(operator.weights).on(cells)
    system = _System(operator.as_matrix(cells), weights, np.stack([np.ones(len(cells)), heights], axis=1))
    while True:
        a, b = system.solution.T  # zero on the deactivated cells
        depth = (control.value + weights @ b) / (weights @ a) if isinstance(control, Force) else control.value
        p = depth * a - b
        tensile = system.kept & (p <= 0)
        if not tensile.any() or (tensile == system.kept).all():
            kept = system.kept
            error = float(np.abs(system.product(a) - 1.0)[kept].max())
            return DirectSolution(cells[kept], np.maximum(p[kept], 0.0), float(depth), a[kept], error)
        system.deactivate(tensile)


def _press_compiled(
    matrix: Array, heights: Array, control: Control, area: float, cells: Cells
) -> DirectSolution:
    """Do what `press_cells` does in one call of machine code, with a new elimination for every round."""
    n, stride = len(cells), -(-(len(cells) + 2) // LANES) * LANES
    kept, memory = np.arange(n + 1), np.empty((n + 6, stride))
    matrix = np.ascontiguousarray(matrix, np.float64)
    given = area if isinstance(control, Force) else 0.0, control.value
    functions("dense_kernels", "float64")["press_cells"](n, matrix, heights, kept, memory, stride, *given)
    _, _, tangent, _, pressure, found = memory[n:]
    depth, error, definite = map(float, found[:3])
    if not definite:
        raise np.linalg.LinAlgError("not definite to working precision")
    left = int(kept[n])
    kept, p = kept[:left], np.maximum(pressure[:left], 0.0)
    return DirectSolution(cells[kept], p, depth, tangent[:left].copy(), error)


def solve_cells(operator: Operator, cells: Cells, right: Array) -> tuple[Array, Array]:
    """Return the pressure [Pa] on `cells` that displaces them by `right` [m], shape (n,), and what it does displace."""
    weights = Measure(operator.weights).on(cells)
    system = _System(operator.as_matrix(cells), weights, right[:, None])
    pressure = system.solution[:, 0]
    return pressure, system.product(pressure)


class _System:
    """A symmetric positive definite system whose unknowns are deactivated, some at a time.

    The influence matrix is symmetric under the weights; scaled by their roots it is so under none. Its first
    factor overwrites the upper triangle, so that no copy is made (a fresh page costs more than its numbers);
    the lower triangle and a copy of the diagonal keep the matrix.
    """

    def __init__(self, matrix: Array, weights: Array, right: Array) -> None:
        matrix = np.require(matrix, np.float64, ["C", "W"])  # a copy of what must not be written to
        root = np.sqrt(weights / weights[0])[:, None]
        self._root = None if (root == 1).all() else root
        if self._root is not None:
            matrix *= root
            matrix /= root.T
            right = right * root
        self._matrix, self._right, self._diagonal = matrix, right, matrix.diagonal().copy()
        self.kept = np.ones(len(right), dtype=bool)
        self._base: Cells
        self._gone: Cells
        self._free: Array
        self._columns: Array
        # LAPACK needs Fortran order, so it gets the transpose: its "lower" triangle is the upper one here.
        self._factor = _factor(matrix.T, lower=True)
        self._restart(np.arange(len(right)))

    @property
    def solution(self) -> Array:
        """Solution for every right side on the kept unknowns, zero elsewhere, shape (n, m)."""
        x = self._free
        if self._gone.size:
            # The rows of the others hold with these at zero (a Schur complement of the inverse).
            x = x - self._columns @ np.linalg.solve(self._columns[self._gone], x[self._gone])
            x[self._gone] = 0.0
        whole = np.zeros(self._right.shape)
        whole[self._base] = x
        return whole if self._root is None else whole / self._root

    def deactivate(self, unknowns: npt.NDArray[np.bool_]) -> None:
        """Fix `unknowns` at zero: a few by their columns of the inverse, many by a new factorisation."""
        self.kept = self.kept & ~unknowns
        gone = np.flatnonzero(~self.kept[self._base])
        if len(gone) > tuning.DOWNDATED * len(self._base):
            self._refactorise()
            return
        new = np.setdiff1d(gone, self._gone)
        unit = np.zeros((len(self._base), len(new)))
        unit[new, np.arange(len(new))] = 1.0
        self._columns = np.concatenate([self._columns, self._solve(unit)], axis=1)
        self._gone = np.concatenate([self._gone, new])

    def product(self, x: Array) -> Array:
        """Return the product of the matrix with `x`."""
        scaled = x if self._root is None else x * self._root[:, 0]
        # The matrix gets its diagonal back meanwhile: taken off the product instead, the factor's would leave rounding.
        factor = self._matrix.diagonal().copy()
        np.fill_diagonal(self._matrix, self._diagonal)
        product = blas.dsymv(1.0, self._matrix.T, scaled, lower=0)
        np.fill_diagonal(self._matrix, factor)
        return np.asarray(product if self._root is None else product / self._root[:, 0])

    def _refactorise(self) -> None:
        base = np.flatnonzero(self.kept)
        matrix = self._matrix[np.ix_(base, base)]
        np.fill_diagonal(matrix, self._diagonal[base])
        self._factor = _factor(matrix.T, lower=False)
        self._restart(base)

    def _restart(self, base: Cells) -> None:
        self._base, self._gone = base, np.zeros(0, np.intp)
        self._free, self._columns = self._solve(self._right[base]), np.zeros((len(base), 0))

    def _solve(self, right: Array) -> Array:
        factor, lower = self._factor
        return np.asarray(lapack.dpotrs(factor, right, lower=lower)[0])


def _factor(matrix: Array, *, lower: bool) -> tuple[Array, bool]:
    """Return Cholesky's factor, which overwrites a triangle of the matrix; SciPy's own way there costs small ones much.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the matrix is not definite to working precision.
    """
    factor, failed = lapack.dpotrf(matrix, lower=lower, clean=False, overwrite_a=True)
    if failed:
        raise np.linalg.LinAlgError("not definite to working precision")
    return factor, lower
