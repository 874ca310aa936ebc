"""The half-space by multi-level multi-integration: what is far away is smooth, and summed on coarser grids."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import require_numpy
from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.cell_list import CellsOperator
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.halfspace.sums.levels import Hierarchy, Kernel
from roughcontact.halfspace.sums.spectral import FreeOperator
from roughcontact.halfspace.sums.transfer import Nodes

__all__ = ["MultilevelOperator", "check_settings"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class MultilevelOperator:
    """A sum on ever coarser grids, at a cost that grows as the number of cells (thesis, eqs A.50 to A.58).

    Parameters
    ----------
    exact : FreeOperator
        The same body without the error of the interpolation: what certifies.
    order : int
        Coarse nodes that a fine one is interpolated from along an axis; even.
    near : int
        Cells (on coarser grids: nodes) within which pairs are summed exactly; at least ``order - 1``.

    Notes
    -----
    The method of Brandt and Lubrecht (J. Comput. Phys. 90, 348, 1990), in a form that is symmetric to rounding; see
    `roughcontact.halfspace.sums.levels.descend`. Order 8 with near 10 errs by some 1e-6 of the largest
    displacement, whether the pressure vanishes at the edges or not, and under a pressure that is nowhere
    negative by less than 5e-5 of every single displacement, however far from the load. Order 6 with near 6
    takes half the time and errs fifty times more; order 10 with near 14 takes half as long again and errs
    forty times less (benchmarks/operators.py).

    It may drive an iteration. What it ends with is certified by `exact`.
    """

    exact: FreeOperator
    order: int = 8
    near: int = 10

    def __post_init__(self) -> None:
        check_settings(self.order, self.near)

    @property
    def grid(self) -> Grid:
        """The grid it works on."""
        return self.exact.grid

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(
            exact=self.exact,
            modulus=self.exact.modulus,
            positive=self.exact.positive,
            submatrix=self.submatrix,
            coarsened=self.coarsened,
            approximate_inverse=self.approximate_inverse,
        )

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.exact.weights

    @cached_property
    def _hierarchy(self) -> Hierarchy:
        (ny, nx), (dy, dx) = self.grid.shape, self.grid.spacing
        kernel = Kernel(self.exact.influence.influence.at)
        return Hierarchy.of(kernel, Nodes((ny, nx), (dy, dx)), self.order, self.near)

    def apply(self, pressure: Array) -> Array:
        """Return the displacement [m] under `pressure` [Pa]."""
        require_numpy(pressure, "the multilevel sum")
        return self._hierarchy.product(np.ascontiguousarray(pressure, dtype=np.float64))

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a pressure [Pa] that would cause about this `displacement` [m]: every wave by E* q/2."""
        return self.exact.approximate_inverse(displacement)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the exact matrix [m/Pa] between `cells` (flat indices; all cells without)."""
        return self.exact.as_matrix(cells)

    def restrict(self, window: tuple[slice, ...]) -> MultilevelOperator:
        """Return the map between the cells of `window`, with no pressure outside."""
        return replace(self, exact=self.exact.restrict(window))

    def submatrix(self, cells: Cells) -> CellsOperator:
        """Return the exact map between a list of cells (flat indices), with no pressure elsewhere."""
        return self.exact.submatrix(cells)

    def coarsened(self, grid: Grid) -> MultilevelOperator | None:
        """Return the same body on `grid`, whose cells are larger; None for a window of a periodic one."""
        coarse = self.exact.coarsened(grid)
        return None if coarse is None else replace(self, exact=coarse)


def check_settings(order: int, near: int) -> None:
    """Raise a ValueError for an order of interpolation, or a range of exact sums, that will not do."""
    if order not in range(2, 17, 2):
        raise ValueError(f"the order of the interpolation must be even, from 2 to 16, not {order}")
    if near < order - 1:
        raise ValueError(
            f"near must be at least {order - 1}, one less than the order, not {near}: "
            "else the stencils of pairs that are not near overlap"
        )
