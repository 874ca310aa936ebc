"""Two bodies under tangential traction: what their operators can do, and the one place that builds them."""

from __future__ import annotations

from typing import Literal, Protocol, cast, runtime_checkable

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.grid import AnyGrid, Grid
from roughcontact.halfspace.influence.shear_influence import (
    Cerruti,
    ShearCompliance,
    ShearWaves,
    TensorTables,
)
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.halfspace.operators.influence_operator import InfluenceOperator, Sum
from roughcontact.material import Bodies, Solid, pair_of
from roughcontact.materials import reduced_modulus
from roughcontact.validation import Array

__all__ = ["ShearOperator", "dense_shear", "dundurs_parameter", "shear_compliance", "shear_half_space"]

Cells = npt.NDArray[np.intp]


@runtime_checkable
class ShearOperator(Protocol):
    """A linear map from tangential traction [Pa] to the tangential displacement of body 1 against body 2 [m].

    Fields have shape ``(2, ny, nx)``: the component along x, then that along y. Traction is what body 2 exerts on
    body 1. The map is symmetric; on a free grid positive definite, on a periodic one semidefinite, since a constant
    traction moves nothing. One whose sum is not
    exact states the exact one in its `Capabilities`, by which answers are certified.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> bodies = rc.shear_half_space(rc.Grid((8, 8), 1e-6), rc.Solid(1e9, 0.3))
    >>> isinstance(bodies, rc.ShearOperator), bodies.restrict((slice(0, 4), slice(0, 4))).grid.shape
    (True, (4, 4))
    >>> traction = np.zeros((2, 8, 8))
    >>> traction[0] = 1e6  # along x
    >>> along, across = bodies.apply(traction)
    >>> f"{along.mean() * 1e9:.0f} nm along, {abs(across).max() * 1e9:.1f} nm across", bodies.as_matrix().shape
    ('8 nm along, 0.5 nm across', (128, 128))
    """

    @property
    def grid(self) -> Grid:
        """The grid it works on."""

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]: force of a unit traction."""

    def apply(self, traction: Array) -> Array:
        """Return the displacement under a traction.

        Parameters
        ----------
        traction : array, shape (2, ny, nx)
            [Pa]

        Returns
        -------
        array, shape (2, ny, nx)
            [m]
        """

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the matrix between cells.

        Parameters
        ----------
        cells : array of int, shape (n,), optional
            Flat indices of cells; by default all.

        Returns
        -------
        array, shape (2 n, 2 n)
            [m/Pa]. The x components of all cells come first, then the y components.
        """

    def restrict(self, window: tuple[slice, ...]) -> ShearOperator:
        """Return the map between the cells of a window, with no traction outside.

        Parameters
        ----------
        window : tuple of slice
            A box of cells, one slice of step 1 for each axis.

        Returns
        -------
        ShearOperator
            On the window's grid.
        """


def shear_half_space(
    grid: AnyGrid,
    bodies: Bodies,
    *,
    method: Literal["dense"] | Sum = "fft",
) -> ShearOperator:
    """Return two elastic half-spaces under tangential traction (Cerruti's problem) on a grid of two axes.

    Both components of the traction, and their coupling through Poisson's ratio, are in it. That between normal and
    tangential displacement is not: it vanishes for equal bodies and where both are incompressible, and for others
    `dundurs_parameter` measures how strong it is.

    Parameters
    ----------
    grid : Grid
        Free or periodic along both axes.
    bodies : Solid or pair of Solids
        One solid: against a rigid body.
    method : {"fft", "dense", "moving-grid", "multilevel"}
        How the sum over the n cells is done, as for `half_space`: by fast Fourier transforms; with the full matrix (32
        n^2 bytes); and on a free grid by shifting the influence functions from cell to cell, or on ever coarser grids
        (inexact by some 1e-6, see ``Multilevel``; what drives with it is certified by the exact sum).

    Returns
    -------
    ShearOperator
        Tangential displacement of body 1 against body 2 [m] from the traction [Pa].

    Raises
    ------
    ValueError
        If the grid has one axis, is one of rings, or periodic along one axis only; if the method is not for it; if both
        bodies are rigid.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((16, 16), 1e-6)
    >>> operator = rc.shear_half_space(grid, rc.Solid(1e9, 0.3))
    >>> operator.apply(np.ones((2, 16, 16))).shape
    (2, 16, 16)
    """
    if not isinstance(grid, Grid) or grid.ndim != 2:
        raise InputError("tangential traction needs a grid of two axes; lines and rings are not offered")
    if any(grid.periodic) != all(grid.periodic):
        raise InputError("a half-space is free or periodic along both axes; one periodic axis is not offered")
    compliance = shear_compliance(*pair_of(bodies))
    tensor = ShearWaves(grid, compliance) if all(grid.periodic) else Cerruti(grid.spacing, compliance)
    operator = InfluenceOperator(grid, TensorTables(tensor), positive=False)
    if method == "dense":
        return dense_shear(grid, operator.as_matrix())
    return operator.summed(method)


def dense_shear(grid: Grid, matrix: Array) -> ShearOperator:
    """Return the operator of a full matrix [m/Pa] between n cells of a grid of two axes, shape ``(2 n, 2 n)``."""
    return cast(ShearOperator, DenseOperator(grid, matrix, positive=False))  # whose other grids are of rings


def shear_compliance(first: Solid, second: Solid | None = None) -> ShearCompliance:
    """Return what two bodies yield to tangential traction; without a `second` its partner is rigid."""
    along = 1 / reduced_modulus(first, second)  # which refuses what is no pair of bodies
    bodies = (first,) if second is None else (first, second)
    return ShearCompliance(along, sum(1 / (2 * body.shear_modulus) for body in bodies))


def dundurs_parameter(first: Solid, second: Solid | None = None) -> float:
    """Return Dundurs's second parameter, beta: how much normal and tangential displacements couple, -1/2 to 1/2.

    It is zero for equal bodies and where both are incompressible; without a `second` body the partner is rigid.
    """
    compliance = 1 / reduced_modulus(first, second)
    signs = zip((first,) if second is None else (first, second), (1, -1), strict=False)
    differing = sum(sign * (1 - 2 * body.poisson_ratio) / body.shear_modulus for body, sign in signs)
    return differing / (4 * compliance)
