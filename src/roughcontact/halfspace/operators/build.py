"""The one place that turns a grid and a modulus into an operator."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Literal

from roughcontact.errors import InputError, about
from roughcontact.grid import AnyGrid, Grid, RadialGrid
from roughcontact.halfspace.influence.love_singly_periodic import SinglyPeriodicLove
from roughcontact.halfspace.influence.ring_influence import ring_matrix
from roughcontact.halfspace.influence.tables import FIRST_TABLE, Love, Periodic, Tables
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.halfspace.operators.influence_operator import InfluenceOperator, Sum
from roughcontact.halfspace.operators.operator import Operator, capabilities
from roughcontact.materials import Modulus, as_modulus
from roughcontact.validation import numeric, shown

__all__ = ["body_on", "half_space", "ring", "singly_periodic"]


@numeric(modulus="Pa")
def half_space(
    grid: Grid,
    modulus: Modulus,
    *,
    method: Literal["dense"] | Sum = "fft",
) -> Operator:
    """Return the elastic half-space on a grid of two axes.

    Parameters
    ----------
    grid : Grid
        Free, periodic, or periodic along one axis (see `singly_periodic` for what its depths count from).
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.
    method : {"fft", "dense", "moving-grid", "multilevel"}
        How the sum over the n cells is done. By fast Fourier transforms; with the full matrix (8 n^2 bytes); and on a
        free grid by shifting the influence function from cell to cell (the time of the matrix without its memory),
        or on ever coarser grids (time and memory grow as n; inexact by some 1e-6, see ``Multilevel``).

    Returns
    -------
    Operator
        Displacement [m] from pressure [Pa] on the cells of the grid.

    Raises
    ------
    ValueError
        If the grid has one axis, or the method is not for it.

    Notes
    -----
    Free: cells of constant pressure and displacements in their middles, by Love's influence function
    (``roughcontact.halfspace.influence.love``). Periodic: each wave of wavenumber q is answered by 2/(E* q), mean
    displacement zero.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((33, 33), 1e-6)
    >>> body = rc.half_space(grid, 1e9)
    >>> f"{body.apply(np.full(grid.shape, 1e6))[16, 16] / 33e-9:.4f} = 4/pi ln(1 + sqrt 2)"
    '1.1222 = 4/pi ln(1 + sqrt 2)'
    """
    value = as_modulus(modulus)
    if not isinstance(grid, Grid) or grid.ndim != 2:
        raise InputError(
            "a half-space needs a grid of two axes",
            "rings have ring(grid, modulus), and a line must name its own "
            "operator: operator=line(grid, modulus), or foundation(grid, modulus)",
        )
    operator = (_small_body if grid.size <= FIRST_TABLE**2 else _body)(grid, value)
    if method == "dense":
        return DenseOperator(grid, operator.as_matrix(), operator.positive, value)
    return operator.summed(method)


def _body(grid: Grid, modulus: float) -> InfluenceOperator:
    if all(grid.periodic):
        return InfluenceOperator(grid, Tables(Periodic(grid, modulus), grid.shape), positive=False)
    if any(grid.periodic):
        return singly_periodic(grid, modulus)
    return InfluenceOperator(grid, Tables(Love(grid.spacing, modulus), grid.shape))


@lru_cache(maxsize=8)
def _small_body(grid: Grid, modulus: float) -> InfluenceOperator:
    """Return one operator whenever it is asked for: to press a small surface takes as long as to make its operator.

    The whole table is made at once, so that what it gives does not depend on what it did before.
    """
    body = _body(grid, modulus)
    body.influence.table(grid.shape)
    return body


@numeric(modulus="Pa", reference_length="m")
def singly_periodic(
    grid: Grid, modulus: Modulus, *, reference_length: float | None = None
) -> InfluenceOperator:
    """Return the half-space under loads that repeat themselves along one axis and not along the other.

    Parameters
    ----------
    grid : Grid
        Grid of two axes, periodic along one of them.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.
    reference_length : float, optional
        Distance from the row of loads at which its mean displacement vanishes [m]; by default the longest
        distance on the grid, half a period and the whole of the other axis. Depths depend on it, by
        ``2 F ln(L2/L1)/(pi E* period)``: a row of loads sinks without bound into an endless body. Pressures at given
        force do not.

    Returns
    -------
    Operator
        Displacement [m] from pressure [Pa] on the cells of the grid.

    Raises
    ------
    ValueError
        If the grid is not periodic along one axis, or the reference length is shorter than the longest distance.

    Notes
    -----
    Forces are those on one period. Cells under constant pressure and displacements in their middles, as on a free
    grid, and all images of them (``roughcontact.halfspace.influence.love_singly_periodic``). A constant
    pressure is no exception: it presses the body down.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((16, 16), 1e-6, periodic=(True, False))
    >>> displacement = rc.singly_periodic(grid, 1e9).apply(np.ones(grid.shape))
    >>> bool(np.allclose(displacement, displacement[:1], rtol=1e-9, atol=0))  # every row alike
    True
    """
    value = as_modulus(modulus)
    if not isinstance(grid, Grid) or grid.ndim != 2 or sum(grid.periodic) != 1:
        raise InputError(
            "a row of contacts needs a grid of two axes that is periodic along one of them",
            "use Grid((ny, nx), spacing, periodic=(True, False))",
        )
    longest = math.hypot(*(n / 2 if p else n for n, p in zip(grid.lengths, grid.periodic, strict=True)))
    reference = longest if reference_length is None else float(reference_length)
    if not (math.isfinite(reference) and reference >= longest * (1 - 1e-9)):
        raise InputError(
            f"the reference length must be finite and at least the longest distance on the grid, {longest:.10g} m, not "
            f"{reference:g}: with a shorter one a load would lift cells far away"
        )
    return InfluenceOperator(grid, Tables(SinglyPeriodicLove(grid, value, reference), grid.shape))


@numeric(modulus="Pa")
def ring(grid: RadialGrid, modulus: Modulus) -> DenseOperator:
    """Return the half-space under constant pressures on rings, wide or narrow, to twelve digits.

    Displacements are means over a ring, so that the map is symmetric under the areas of the rings and every
    solver takes it. It holds ``8 n^2`` bytes for n rings.

    Parameters
    ----------
    grid : RadialGrid
        Rings of any widths.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or what it follows from.

    Returns
    -------
    DenseOperator
        Mean displacement of each ring [m] from the pressures on the rings [Pa].

    Raises
    ------
    ValueError
        If the grid is not one of rings.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(50, radius=1e-5)
    >>> body = rc.ring(rings, 1e9)
    >>> body.as_matrix().shape
    (50, 50)
    """
    if not isinstance(grid, RadialGrid):
        raise InputError(f"rings need a RadialGrid, not {type(grid).__name__}", place="grid")
    value = as_modulus(modulus)
    return DenseOperator(grid, ring_matrix(grid.edges) / (math.pi * value), modulus=value)


def body_on(grid: AnyGrid, modulus: Modulus, operator: Operator | None = None) -> Operator:
    """Return `operator`, which must lie on `grid`; without one the half-space that the grid suggests.

    Raises
    ------
    ValueError
        If this is not an operator, it lies on another grid or has another modulus, or is not given and the grid is a
        line.
    """
    if operator is None:
        return ring(grid, modulus) if isinstance(grid, RadialGrid) else half_space(grid, modulus)
    # Not `isinstance`, which from Python 3.12 on misses members that `__getattr__` finds.
    if not all(hasattr(operator, name) for name in ("grid", "weights", "apply", "as_matrix", "restrict")):
        raise InputError(
            f"an operator is wanted, such as half_space(grid, modulus), not {shown(operator)}",
            place="operator",
        )
    if operator.grid != grid:
        raise InputError(
            f"the operator's grid {operator.grid} is not the surface's {grid}",
            "make the operator on that of the surface",
        )
    own, value = capabilities(operator).modulus, as_modulus(modulus)
    if own is not None and not math.isclose(own, value, rel_tol=1e-9):
        raise about(
            "the operator",
            f"has a reduced modulus of {own:.6g} Pa, and {value:.6g} Pa is asked for",
            "give both the same",
        )
    return operator
