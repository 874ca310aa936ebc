"""Small contact regions by a dense factorisation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.linalg

from roughcontact.contact.measure import Measure
from roughcontact.contact.problem import Control, Force
from roughcontact.halfspace.operator import Operator

__all__ = ["Pressed", "press_cells", "solve_cells"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class Pressed:
    """A pressure [Pa] on `cells`, nowhere negative, its depth [m], and the pressure per unit depth [Pa/m].

    `error` is the largest deviation from one of the displacement under that last pressure.
    """

    cells: Cells
    pressure: Array
    depth: float
    tangent: Array
    error: float


def press_cells(operator: Operator, separation: Array, control: Control, cells: Cells) -> Pressed:
    """Press on `cells` alone and let go of those that would pull, until none does (thesis, eqs A.6 to A.8).

    Parameters
    ----------
    operator : Operator
    separation : array
        Undeformed gap [m] on the operator's grid.
    control : Force or Depth
        What is prescribed; a depth above the smallest separation of the cells.
    cells : int array
        Flat indices of the cells that may carry pressure.

    Notes
    -----
    With A a = 1 and A b = separation on the cells, the pressure is ``depth * a - b``; the force fixes the
    depth. One matrix serves all rounds.
    """
    measure = Measure(operator.weights)
    matrix = operator.as_matrix(cells)
    heights, weights = separation.ravel()[cells], measure.on(cells)
    keep = np.arange(len(cells))
    while True:
        sub = matrix[np.ix_(keep, keep)]
        right = np.stack([np.ones(len(keep)), heights[keep]], axis=1)
        a, b = _solve(sub, weights[keep] if measure.varies else None, right).T
        w = weights[keep]
        depth = (control.value + w @ b) / (w @ a) if isinstance(control, Force) else control.value
        p = depth * a - b
        pulls = p <= 0
        if not pulls.any() or pulls.all():
            whole = np.zeros(len(cells))
            whole[keep] = a
            error = float(np.abs(matrix @ whole - 1)[keep].max())
            return Pressed(cells[keep], np.maximum(p, 0.0), float(depth), a, error)
        keep = keep[~pulls]


def solve_cells(operator: Operator, cells: Cells, right: Array) -> Array:
    """Return the pressure [Pa] on `cells` that displaces them by `right` [m], shape (n,) or (n, m)."""
    measure = Measure(operator.weights)
    weights = measure.on(cells) if measure.varies else None
    return _solve(operator.as_matrix(cells), weights, right)


def _solve(matrix: Array, weights: Array | None, right: Array) -> Array:
    """Solve a system that is symmetric and positive definite under `weights`; the matrix is not kept."""
    if weights is None:
        return _cholesky(matrix, right)
    root = np.sqrt(weights).reshape((-1,) + (1,) * (right.ndim - 1))
    scaled = matrix * root.reshape(-1, 1) / root.reshape(1, -1)
    return _cholesky(scaled, right * root) / root


def _cholesky(matrix: Array, right: Array) -> Array:
    # The transpose of a symmetric matrix in C order is itself in Fortran order: LAPACK works in place.
    factor = scipy.linalg.cho_factor(matrix.T, lower=True, overwrite_a=True, check_finite=False)
    return np.asarray(scipy.linalg.cho_solve(factor, right, check_finite=False))
