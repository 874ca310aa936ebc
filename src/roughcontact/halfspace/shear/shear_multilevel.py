"""Tangential traction by multi-level multi-integration: what is far away is smooth, and summed on coarser grids."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import require_numpy
from roughcontact.cached import cached_property
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.operator import Capabilities
from roughcontact.halfspace.shear.shear_influence import Cerruti
from roughcontact.halfspace.shear.shear_sums import FreeShear
from roughcontact.halfspace.sums.levels import Hierarchy, Kernel
from roughcontact.halfspace.sums.multilevel import check_settings
from roughcontact.halfspace.sums.transfer import Nodes

__all__ = ["MultilevelShear"]

Array = npt.NDArray[np.float64]
Cells = npt.NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class MultilevelShear:
    """Sums on ever coarser grids, one for each component of the tensor, at a cost that grows as the number of cells.

    Parameters
    ----------
    exact : FreeShear
        The same bodies without the error of the interpolation: what certifies.
    order : int
        Coarse nodes that a fine one is interpolated from along an axis; even.
    near : int
        Cells (on coarser grids: nodes) within which pairs are summed exactly; at least ``order - 1``.

    Notes
    -----
    As `roughcontact.halfspace.sums.multilevel.MultilevelOperator` does it for pressure (thesis, eqs A.50 to A.58). The
    coupling of the two components is odd along both axes, and its levels are.

    Order 8 with near 10 errs by less than 5e-6 of the largest displacement under tractions whose components are nowhere
    negative, and by some 1e-5 under noise, whose displacements cancel. Between any two cells, near or far, no
    component errs by more than 1.1e-4 of the tensor's trace: the remainder of the interpolation ten cells away. It
    takes four products where pressure takes one (benchmarks/operators.py).

    It may drive an iteration. What it ends with is certified by `exact`.
    """

    exact: FreeShear
    order: int = 8
    near: int = 10

    def __post_init__(self) -> None:
        check_settings(self.order, self.near)
        if not isinstance(self.exact.influence, Cerruti):
            raise ValueError("the multilevel sum is for free half-spaces, not for a window of periodic ones")

    @property
    def grid(self) -> Grid:
        """The grid it works on."""
        return self.exact.grid

    @property
    def capabilities(self) -> Capabilities:
        """What it can do beyond the protocol."""
        return Capabilities(exact=self.exact)

    @property
    def weights(self) -> float:
        """Area of a cell [m^2]."""
        return self.exact.weights

    @cached_property
    def _hierarchies(self) -> tuple[Hierarchy, ...]:
        """The levels of xx, yy and xy."""
        (ny, nx), (dy, dx), influence = self.grid.shape, self.grid.spacing, self.exact.influence
        assert isinstance(influence, Cerruti)
        kernels = [Kernel(part, sign) for part, sign in zip(influence.parts(), (1, 1, -1), strict=True)]
        return tuple(Hierarchy.of(k, Nodes((ny, nx), (dy, dx)), self.order, self.near) for k in kernels)

    def apply(self, traction: Array) -> Array:
        """Return the displacement [m] under `traction` [Pa]."""
        require_numpy(traction, "the multilevel sum")
        x, y = np.ascontiguousarray(traction, dtype=np.float64)
        xx, yy, xy = self._hierarchies
        return np.stack([xx.product(x) + xy.product(y), xy.product(x) + yy.product(y)])

    def approximate_inverse(self, displacement: Array) -> Array:
        """Return a traction [Pa] that would cause about this `displacement` [m]: every wave by itself."""
        return self.exact.approximate_inverse(displacement)

    def as_matrix(self, cells: Cells | None = None) -> Array:
        """Return the exact matrix [m/Pa] between `cells`, shape ``(2 n, 2 n)``."""
        return self.exact.as_matrix(cells)

    def restrict(self, window: tuple[slice, ...]) -> MultilevelShear:
        """Return the map between the cells of `window`, with no traction outside."""
        part = self.exact.restrict(window)
        return self if part is self.exact else replace(self, exact=part)
