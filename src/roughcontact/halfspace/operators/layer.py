"""An elastic layer on a base: a coating, a rubber mat, a sheet on a foundation."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.halfspace.influence.layer_bases import Base, Bonded, Frictionless, OnHalfSpace
from roughcontact.halfspace.influence.layer_influence import LayerCells, LayerWaves, Stack, kernel_for
from roughcontact.halfspace.influence.tables import Tables
from roughcontact.halfspace.operators.influence_operator import InfluenceOperator
from roughcontact.material import Solid
from roughcontact.materials import as_modulus
from roughcontact.validation import moderate, numeric

__all__ = ["layer"]

ROUNDING = 1e-9  # of a half-space's answer: a layer's that is smaller may have either sign


@numeric(modulus="Pa", thickness="m")
def layer(
    grid: Grid,
    modulus: float | Solid,
    thickness: float,
    *,
    base: Literal["rigid-frictionless", "bonded"] | Solid,
    against: Solid | None = None,
) -> InfluenceOperator:
    """Return an elastic layer on a base, its upper face without friction.

    Parameters
    ----------
    grid : Grid
        Free or periodic along both axes.
    modulus : float or Solid
        Of the layer: its Solid, or on a frictionless base its reduced modulus E* [Pa].
    thickness : float
        Of the layer [m].
    base : {"rigid-frictionless", "bonded"} or Solid
        A rigid base on which the layer slides or to which it is bonded, or an elastic half-space to which it is
        bonded.
    against : Solid, optional
        The other body, an elastic half-space; by default it is rigid.

    Returns
    -------
    Operator
        On a free grid the layer is endless, and loaded only on the grid's cells; displacements vanish far away. On
        a periodic one a constant pressure on a rigid base compresses the layer, so that depths are absolute; on an
        elastic base the mean displacement is zero, as on a half-space.

    Raises
    ------
    ValueError
        If the grid has one axis or is periodic along one only, a number stands where a Solid is needed, or the
        thickness is not positive and finite.

    Notes
    -----
    A wave of pressure of wavenumber q is answered by ``2/(E* q) M(q thickness)``; the functions M and their limits
    stand in ``roughcontact.halfspace.influence.layer_bases``. On free grids the influence of a cell is Love's
    integral plus the integral of the difference of both bodies, a Hankel transform tabulated to 1e-13 of
    Love's. A layer may rise beside a load, so that contact need not lie where the bodies overlap: only layers
    that do not on this grid are `positive`.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((16, 16), 1e-6, periodic=True)
    >>> thin = rc.layer(grid, 1e9, thickness=1e-6, base="rigid-frictionless")
    >>> f"{thin.apply(np.full(grid.shape, 1e6)).mean() * 1e9:.3f} nm"  # p thickness / E*
    '1.000 nm'
    """
    if not isinstance(modulus, Solid) and np.ndim(modulus) != 0:
        raise InputError(
            "a pair of Solids does not say which is the layer", "give the layer, and the other as against="
        )
    value = as_modulus(modulus)
    if not isinstance(grid, Grid) or grid.ndim != 2:
        raise InputError("a layer needs a grid of two axes", "use Grid((ny, nx), spacing)")
    if any(grid.periodic) != all(grid.periodic):
        raise InputError("a layer is free or periodic along both axes; one periodic axis is not offered")
    if not (math.isfinite(thickness) and thickness > 0):
        raise about("the thickness", f"must be positive and finite [m], not {thickness}")
    moderate(thickness, "the thickness [m]")
    partner = 0.0 if against is None else 1 / as_modulus(against)
    stack = Stack(value, float(thickness), _base(modulus, base), partner)
    if all(grid.periodic):
        waves = Tables(LayerWaves(grid, stack), grid.shape)
        return InfluenceOperator(grid, waves, positive=False, constant=stack.mean)
    kernel = kernel_for(grid, stack)
    positive = kernel.least + value * partner > ROUNDING
    return InfluenceOperator(grid, Tables(LayerCells(grid.spacing, stack, kernel), grid.shape), positive)


def _base(modulus: float | Solid, base: str | Solid) -> Base:
    if base == "rigid-frictionless":
        return Frictionless()
    if base != "bonded" and not isinstance(base, Solid):
        raise about("base", f"must be 'rigid-frictionless', 'bonded' or a Solid, not {base!r}")
    if not isinstance(modulus, Solid):
        raise InputError(
            "a bonded layer answers by its Poisson's ratio too",
            "give Solid(young_modulus, poisson_ratio) for it",
        )
    if isinstance(base, Solid) and math.isfinite(base.young_modulus):
        return OnHalfSpace(modulus, base)
    return Bonded(modulus.poisson_ratio)
