"""Inner products under the weights of an operator, and those that a step of conjugate gradients takes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import DeviceTable
from roughcontact.validation import Array, Mask

__all__ = ["Measure", "Preconditioned", "Products", "Projected"]


@dataclass(frozen=True, slots=True, eq=False)
class Measure:
    """Sums over cells weighted by their area; operators are symmetric under this inner product.

    It is made once per solve, and carries the array library of the fields.

    Parameters
    ----------
    weights : float or array
        Of an operator [m^2], on the host.
    xp : module
        The functions for the fields, by the names of the array API standard.

    Attributes
    ----------
    on_host : bool
        Whether the fields are NumPy's, which SciPy and machine code can work on.
    varies : bool
        Whether the cells have different weights.
    """

    weights: float | Array
    xp: Any = np
    on_host: bool = field(init=False, repr=False)
    varies: bool = field(init=False, repr=False)
    _table: DeviceTable | None = field(init=False, repr=False)

    def __post_init__(self) -> None:
        table = DeviceTable(self.weights) if isinstance(self.weights, np.ndarray) else None
        object.__setattr__(self, "_table", table)
        object.__setattr__(self, "varies", table is not None)
        object.__setattr__(self, "on_host", self.xp is np)

    def total(self, field: Array | Mask) -> float:
        """Return the weighted sum of a field: the force [N] of a pressure [Pa]."""
        numbers = self._number(field)
        if self._table is not None:
            return float(self.xp.sum(self._table.as_like(numbers) * numbers))
        return float(self.weights * float(self.xp.sum(numbers)))

    def dot(self, a: Array, b: Array) -> float:
        """Return the weighted inner product of two fields."""
        first = a if self._table is None else self._table.as_like(a) * a
        product = float(np.vdot(first, b)) if self.on_host else float(self.xp.sum(first * b))
        return product if self.varies else float(self.weights * product)

    def mean(self, field: Array, mask: Mask) -> float:
        """Return the weighted mean of a field over the cells of `mask`."""
        if not self.on_host:
            return self.total(self.xp.where(mask, field, 0.0)) / self.total(mask)
        if isinstance(self.weights, np.ndarray):
            return float(np.average(field[mask], weights=self.weights[mask]))
        return float(field[mask].mean())

    def on(self, cells: npt.NDArray[np.intp]) -> Array:
        """Return the weights of `cells`, one each."""
        if isinstance(self.weights, np.ndarray):
            return self.weights.ravel()[cells]
        return np.full(len(cells), self.weights)

    def _number(self, field: Any) -> Any:
        """Return truth values as numbers, which other libraries than NumPy do not sum."""
        if self.on_host or not self.xp.isdtype(field.dtype, "bool"):
            return field
        return self.xp.astype(field, self.xp.float64)


class Preconditioned(NamedTuple):
    """Inner products of the preconditioned residual z = M^-1 r, over the free set.

    Attributes
    ----------
    rz : float
        r.z.
    zq : float
        z.q, with q = A s of the last direction.
    z_sum : float
        1.z.
    wq : float
        w.q, if a constraint direction w is used.
    """

    rz: float
    zq: float
    z_sum: float
    wq: float


class Products(NamedTuple):
    """Inner products of a search direction s, its image q = A s, and the residual r.

    Attributes
    ----------
    sq : float
        s.q, the curvature, over all cells.
    q_sum : float
        1.q over the free set.
    rs : float
        r.s over all cells.
    rs_free : float
        r.s over the free set.
    s_sum : float
        1.s over the free set.
    r_sum : float
        1.r over the free set.
    """

    sq: float
    q_sum: float
    rs: float
    rs_free: float
    s_sum: float
    r_sum: float


class Projected(NamedTuple):
    """What the projection onto the bounds has made of a trial step.

    Attributes
    ----------
    bound_correction : float
        Sum of the sizes by which pressures are taken to their bounds [Pa].
    area : float
        Of the free set that is left.
    force : float
        What the projection has added to 1.s.
    """

    bound_correction: float
    area: float
    force: float
