"""The flexibility of a body between the nodes of a finite-element mesh."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_array, diags_array, sparray, spmatrix

from roughcontact.errors import about
from roughcontact.halfspace.operators.operator import Operator, exact_of, is_semidefinite
from roughcontact.validation import Array, finite, shown

__all__ = ["nodal_flexibility"]


def nodal_flexibility(operator: Operator, interpolation: npt.ArrayLike | sparray | spmatrix) -> Array:
    """Return the flexibility matrix of a body between nodes, to couple it to finite elements.

    Parameters
    ----------
    operator : Operator or ShearOperator
        The body, such as `half_space`: displacement from pressure on the m cells of a grid. With `shear_half_space` the
        fields are tangential and have 2 m values, those along x first.
    interpolation : array or sparse array, shape (m, n), or (2 m, n)
        Shape functions N of the n nodal displacements, averaged over each cell. Rows are cells in flat order. A row
        of zeros keeps the cell free of pressure.

    Returns
    -------
    array, shape (n, n)
        Displacement of each node per force on each [m/N], symmetric and positive definite. Its inverse is the stiffness
        matrix to add to that of the finite elements.

    Raises
    ------
    ValueError
        If a constant pressure does not move the body (a periodic half-space), if the interpolation does not fit the
        cells or is not finite, or if its columns are linearly dependent.

    Notes
    -----
    A pressure p exerts the nodal forces ``f = N^T W p``, with the areas W of the cells: the pressure does the same work
    in any displacement N U of the elements. The pressure ``p = N M^-1 f`` with ``M = N^T W N`` has these forces. Its
    displacement A p has the nodal values ``U = M^-1 N^T W A p``, the least-squares fit of N U to A p. Together,
    ``F = M^-1 (N^T W A N) M^-1``.

    The work f.U is that of pressure and displacement in the cells. Forces and moments of f are those of p, and
    rigid displacements of the cells are rigid displacements of the nodes, if N reproduces them. One product with the
    operator is done for each node.

    Examples
    --------
    A rigid square punch on five by five nodes, with two by two cells in each element:

    >>> import numpy as np
    >>> import roughcontact as rc
    >>> hats = np.maximum(1 - abs(np.arange(0.25, 4, 0.5)[:, None] - np.arange(5)), 0)
    >>> body = rc.half_space(rc.Grid((8, 8), 1e-3 / 8), 1e9)
    >>> flexibility = rc.nodal_flexibility(body, np.kron(hats, hats))
    >>> f"{np.linalg.inv(flexibility).sum() / (1e9 * 1e-3):.2f}, exact: 1.15"
    '1.11, exact: 1.15'
    """
    if not (hasattr(operator, "apply") and hasattr(operator, "grid")):
        raise about(
            "operator", f"must be an operator, such as half_space(grid, modulus), not {shown(operator)}"
        )
    if is_semidefinite(operator):
        raise about(
            "operator",
            "is periodic, and a constant pressure does not move it: the matrix would have no inverse",
            "use half_space on a free grid",
        )
    body, what = exact_of(operator), "the interpolation"
    components = len(body.as_matrix(np.zeros(1, np.intp)))
    rows = components * body.grid.size
    given: Any = interpolation
    if not isinstance(interpolation, sparray | spmatrix):
        given = finite(interpolation, what)
    if given.ndim != 2 or given.shape[0] != rows or not given.shape[1]:
        raise about(what, f"must have the shape ({rows}, nodes), not {given.shape}", "give each cell a row")
    shapes = csc_array(given)
    shapes.data = finite(shapes.data, what)
    areas = np.tile(np.broadcast_to(body.weights, body.grid.shape).ravel(), components)
    weighted = diags_array(areas) @ shapes
    mass = (shapes.T @ weighted).toarray()
    if np.linalg.matrix_rank(mass, hermitian=True) < len(mass):
        problem = "has columns that are linearly dependent: some displacements of nodes move no cell"
        raise about(what, problem, "use smaller cells, at least two along each side of an element")
    fields = body.grid.shape if components == 1 else (components, *body.grid.shape)
    products = np.empty_like(mass)
    for node in range(len(mass)):
        pressure = shapes[:, [node]].toarray().reshape(fields)
        products[:, node] = weighted.T @ body.apply(pressure).ravel()
    flexibility = np.linalg.solve(mass, np.linalg.solve(mass, products).T)
    return (flexibility + flexibility.T) / 2
