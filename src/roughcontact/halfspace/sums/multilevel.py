"""Sums by multi-level multi-integration: what is far away is smooth, and summed on coarser grids."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.arrays import require_numpy
from roughcontact.errors import about
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.shear_influence import Influences
from roughcontact.halfspace.sums.levels import Kernel, LevelSum
from roughcontact.halfspace.sums.transfer import NodeGrid
from roughcontact.validation import Array

__all__ = ["Multilevel"]


@dataclass(frozen=True, slots=True)
class Multilevel:
    """Sums on ever coarser grids, at a cost that grows as the number of cells (thesis, eqs A.50 to A.58).

    Parameters
    ----------
    order : int
        Coarse nodes that a fine one is interpolated from along an axis; even.
    near : int
        Cells (on coarser grids: nodes) within which pairs are summed exactly; at least ``order - 1``.

    Notes
    -----
    The method of Brandt and Lubrecht (J. Comput. Phys. 90, 348, 1990), in a form that is symmetric to rounding; see
    `roughcontact.halfspace.sums.levels.coarsen`. Order 8 with near 10 errs by some 1e-6 of the largest
    displacement, whether the pressure vanishes at the edges or not, and under a pressure that is nowhere
    negative by less than 5e-5 of every single displacement, however far from the load. Order 6 with near 6
    takes half the time and errs fifty times more; order 10 with near 14 takes half as long again and errs
    forty times less (benchmarks/operators.py).

    The coupling of the two components of a tensor is odd along both axes, and so are its levels. The error is less than
    5e-6 of the largest displacement under tractions whose components are nowhere negative, and some 1e-5 under noise,
    whose displacements cancel. Between any two cells, near or far, no component errs by more than 1.1e-4 of the
    tensor's trace: the remainder of the interpolation ten cells away.

    It may drive an iteration. What it ends with is certified by the exact sum.

    Raises
    ------
    ValueError
        If the order is odd or not from 2 to 16, or `near` is too small.
    """

    order: int = 8
    near: int = 10

    def __post_init__(self) -> None:
        if self.order not in range(2, 17, 2):
            raise about("the order", f"of the interpolation must be even, from 2 to 16, not {self.order}")
        if self.near < self.order - 1:
            raise about(
                "near",
                f"must be at least {self.order - 1}, one less than the order, not {self.near}: "
                "else the stencils of pairs that are not near overlap",
            )

    def __call__(self, influence: Influences, grid: Grid) -> MultilevelSum:
        """Return the sum over the cells of a grid."""
        (ny, nx), (dy, dx) = grid.shape, grid.spacing
        kernels = (Kernel(at, (-1) ** i) for i, at in enumerate(influence.components()))
        nodes = NodeGrid((ny, nx), (dy, dx))
        return MultilevelSum(tuple(LevelSum.of(kernel, nodes, self.order, self.near) for kernel in kernels))


@dataclass(frozen=True, slots=True, eq=False)
class MultilevelSum:
    """The sum of a scalar influence, or of the components xx, xy and yy of a tensor, in this order."""

    components: tuple[LevelSum, ...]

    def apply(self, field: Array) -> Array:
        """Return the displacement [m] under a pressure or traction [Pa]."""
        require_numpy(field, "the multilevel sum")
        fields = np.ascontiguousarray(field, dtype=np.float64).reshape(-1, *field.shape[-2:])
        sums = [  # the component of i and j is number i + j
            sum(self.components[i + j].product(one) for j, one in enumerate(fields))
            for i in range(len(fields))
        ]
        return np.stack(sums).reshape(field.shape)
