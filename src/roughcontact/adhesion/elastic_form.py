"""The elastic body in terms of displacements: pressure from displacement on the cells of a computation.

On a periodic grid each wave of displacement has its pressure. On a free grid the influence function, even and given up
to half a period, is a circulant matrix on twice the cells along each axis. Its symbol is positive, so that it can be
inverted wave by wave; cells beyond the grid are free of traction and of any bound. Minimisation over them amounts to
the Schur complement, which on the cells of the grid is the exact inverse of the influence matrix
(docs/concepts/method-adhesion.md, section 2).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from roughcontact.errors import InputError
from roughcontact.grid import AnyGrid, Grid
from roughcontact.halfspace.influence.tables import Love
from roughcontact.halfspace.operators.influence_operator import InfluenceOperator
from roughcontact.halfspace.operators.line_contact import LineOperator
from roughcontact.halfspace.operators.operator import Operator, exact_of
from roughcontact.transforms import Convolution, even_multiplier, padded_length
from roughcontact.validation import Array

__all__ = ["ElasticForm", "elastic_form"]

LARGEST_MATRIX = 6000  # cells of a body that has only a matrix


@dataclass(frozen=True, slots=True, eq=False)
class ElasticForm:
    """The elastic energy ``1/2 u.K u`` per area, and the compliance that preconditions it.

    Parameters
    ----------
    grid : Grid or RadialGrid
        The cells of the surface: the first ones along each axis of `shape`.
    shape : tuple of int
        Cells of the computation; those beyond the grid are free of traction.
    stiffness : function
        Pressure K u [Pa] from displacement [m], on `shape`.
    compliance : function
        Displacement from pressure, symmetric and definite: the inverse of K if it exists.
    weights : float or array
        Area of the cells [m^2].
    mean_free : bool
        Whether the mean displacement is zero under any pressure.
    reference : float
        Displacement of a cell per unit pressure on itself [m/Pa].
    """

    grid: AnyGrid
    shape: tuple[int, ...]
    stiffness: Callable[[Array], Array]
    compliance: Callable[[Array], Array]
    weights: float | Array
    mean_free: bool
    reference: float

    @property
    def inside(self) -> tuple[slice, ...]:
        """The position of the grid in the computation."""
        return tuple(slice(0, n) for n in self.grid.shape)

    def extended(self, field: Array, beyond: float) -> Array:
        """Return a field on the grid extended to all cells."""
        whole = np.full(self.shape, beyond)
        whole[self.inside] = field
        return whole

    def dot(self, first: Array, second: Array) -> float:
        """Return the integral of a product."""
        if isinstance(self.weights, float):
            return float(np.vdot(first, second)) * self.weights
        return float(np.vdot(first * self.weights, second))

    def dots(self, first: Array, second: Array) -> Array:
        """Return the integrals of the products of each field of `first` with each of `second`."""
        count, scalar = len(first), isinstance(self.weights, float)
        weighted = (first if scalar else first * self.weights).reshape(count, -1)
        matrix = weighted @ second.reshape(len(second), -1).T
        return np.asarray(matrix * self.weights if scalar else matrix)


def elastic_form(operator: Operator) -> ElasticForm:
    """Return the elastic form of a half-space: periodic, free, on rings or on a line.

    Raises
    ------
    ValueError
        If the operator is that of another body, or has too many cells for its matrix.
    """
    body = exact_of(operator)
    plane = body.plane if isinstance(body, LineOperator) else body
    if isinstance(plane, InfluenceOperator):
        if all(plane.grid.periodic) and plane.constant == 0:
            return _periodic(body, plane)
        if isinstance(getattr(plane.influence, "influence", None), Love):
            return _free(plane)
    return _dense(body)


def _periodic(body: Operator, plane: InfluenceOperator) -> ElasticForm:
    transfer = np.array(plane.influence.transfer_function())
    stiffness = np.divide(1.0, transfer, out=np.zeros_like(transfer), where=transfer > 0)
    transfer.flat[0] = 2 * transfer.max()  # the mean, to be definite
    pair = (plane.grid.shape[0], plane.grid.shape[1])
    forward, back = Convolution(stiffness, pair), Convolution(transfer, pair)
    shape = body.grid.shape
    return ElasticForm(
        body.grid,
        shape,
        lambda field: forward.apply(field.reshape(pair)).reshape(shape),
        lambda field: back.apply(field.reshape(pair)).reshape(shape),
        float(plane.weights),
        True,
        float(plane.as_matrix(np.zeros(1, np.intp))[0, 0]),
    )


def _free(plane: InfluenceOperator) -> ElasticForm:
    grid: Grid = plane.grid
    lengths = (max(2, padded_length(grid.shape[0])), max(2, padded_length(grid.shape[1])))
    # The influence function up to half the period: if it ended at the grid, its symbol would not be positive.
    table = plane.influence.influence.table((lengths[0] // 2 + 1, lengths[1] // 2 + 1))
    symbol = even_multiplier(table, lengths)
    if not symbol.min() > 0:
        raise InputError(
            f"the influence function on cells of {grid.spacing} m cannot be inverted by waves",
            "use cells whose sides differ less",
        )
    forward, back = Convolution(1 / symbol, lengths), Convolution(symbol, lengths)
    return ElasticForm(
        grid, lengths, forward.apply, back.apply, float(plane.weights), False, float(table[0, 0])
    )


def _dense(body: Operator) -> ElasticForm:
    grid = body.grid
    if grid.size > LARGEST_MATRIX:
        raise InputError(
            f"adhesion on this body needs its matrix, and {grid.size} cells are too many (at most {LARGEST_MATRIX})",
            "use a half-space on a plane, periodic or free, or fewer cells",
        )
    matrix = body.as_matrix()
    weights = np.broadcast_to(np.asarray(body.weights, float), grid.shape)
    # Symmetric under the weights: a W-symmetric matrix is inverted by Cholesky's factors of W A.
    symmetric = weights.reshape(-1, 1) * matrix
    try:
        factor = scipy.linalg.cho_factor((symmetric + symmetric.T) / 2)
    except np.linalg.LinAlgError as error:
        raise InputError(
            "adhesion needs a positive definite influence matrix, and that of this body is not",
            "on a free line give a longer reference_length",
        ) from error
    inverse = scipy.linalg.cho_solve(factor, np.diag(weights.ravel()))
    return ElasticForm(
        grid,
        grid.shape,
        lambda field: (inverse @ field.ravel()).reshape(grid.shape),
        lambda field: (matrix @ field.ravel()).reshape(grid.shape),
        np.array(weights),
        False,
        float(matrix[0, 0]),
    )
