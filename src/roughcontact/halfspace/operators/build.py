"""The one place that turns a grid and a modulus into an operator."""

from __future__ import annotations

import math
from typing import Literal

from roughcontact.grid import AnyGrid, Grid, RadialGrid
from roughcontact.halfspace.influence.tables import Love, Periodic, Tables
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.halfspace.operators.operator import Operator, capabilities
from roughcontact.halfspace.operators.ring import ring
from roughcontact.halfspace.operators.singly_periodic import SinglyPeriodicOperator, singly_periodic
from roughcontact.halfspace.sums.methods import Sum, summed
from roughcontact.halfspace.sums.spectral import FreeOperator, PeriodicOperator
from roughcontact.material import Solid, as_modulus

__all__ = ["body_on", "half_space"]


def half_space(
    grid: Grid,
    modulus: float | Solid | tuple[Solid, Solid],
    *,
    method: Literal["dense"] | Sum = "fft",
) -> Operator:
    """Return the elastic half-space on a grid of two axes.

    Parameters
    ----------
    grid : Grid
        Free, periodic, or periodic along one axis (see `singly_periodic` for what its depths count from).
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    method : {"fft", "dense", "moving-grid", "multilevel"}
        How the sum over the n cells is done. By fast Fourier transforms; with the full matrix (8 n^2 bytes); and on a
        free grid by shifting the influence function from cell to cell (the time of the matrix without its memory),
        or on ever coarser grids (time and memory grow as n; inexact by some 1e-6, see `MultilevelOperator`, and
        fastest with Numba: ``pip install 'roughcontact[compiled]'``).

    Raises
    ------
    ValueError
        If the grid has one axis, or the method is not for it.
    """
    value = as_modulus(modulus)
    if not isinstance(grid, Grid) or grid.ndim != 2:
        raise ValueError(
            "a half-space needs a grid of two axes; rings have ring(grid, modulus), and a line must name its own "
            "operator: operator=line(grid, modulus), or foundation(grid, modulus)"
        )
    operator: FreeOperator | PeriodicOperator | SinglyPeriodicOperator
    if all(grid.periodic):
        operator = PeriodicOperator(grid, Periodic(grid, value))
    elif any(grid.periodic):
        operator = singly_periodic(grid, value)
    else:
        operator = FreeOperator(grid, Tables(Love(grid.spacing, value), grid.shape))
    if method == "dense":
        return DenseOperator(grid, operator.as_matrix(), operator.positive, value)
    return summed(operator, method)


def body_on(
    grid: AnyGrid, modulus: float | Solid | tuple[Solid, Solid], operator: Operator | None = None
) -> Operator:
    """Return `operator`, which must lie on `grid`; without one the half-space that the grid suggests.

    Raises
    ------
    ValueError
        If the operator is none, lies on another grid or has another modulus, or is not given and the grid is a line.
    """
    if operator is None:
        return ring(grid, modulus) if isinstance(grid, RadialGrid) else half_space(grid, modulus)
    # Not `isinstance`, which from Python 3.12 on misses members that `__getattr__` finds.
    if not all(hasattr(operator, name) for name in ("grid", "weights", "apply", "as_matrix", "restrict")):
        raise ValueError(f"an operator is wanted, such as half_space(grid, modulus), not {operator!r}")
    if operator.grid != grid:
        raise ValueError(f"the operator's grid {operator.grid} is not the surface's {grid}")
    own, value = capabilities(operator).modulus, as_modulus(modulus)
    if own is not None and not math.isclose(own, value, rel_tol=1e-9):
        raise ValueError(
            f"the operator has a reduced modulus of {own:.6g} Pa, and {value:.6g} Pa is asked for: make both one"
        )
    return operator
