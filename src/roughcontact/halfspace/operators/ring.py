"""The half-space under loads that are symmetric about an axis."""

from __future__ import annotations

import math

from roughcontact.grid import RadialGrid
from roughcontact.halfspace.influence.ring_influence import ring_matrix
from roughcontact.halfspace.operators.dense import DenseOperator
from roughcontact.material import Solid, as_modulus

__all__ = ["ring"]


def ring(grid: RadialGrid, modulus: float | Solid | tuple[Solid, Solid]) -> DenseOperator:
    """Return the half-space under constant pressures on rings, wide or narrow, to twelve digits.

    Displacements are means over a ring, so that the map is symmetric under the areas of the rings and every
    solver takes it. It holds ``8 n^2`` bytes for n rings.

    Parameters
    ----------
    grid : RadialGrid
        Rings of any widths.
    modulus : float, Solid or pair of Solids
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
        raise ValueError(f"rings need a RadialGrid, not {type(grid).__name__}")
    value = as_modulus(modulus)
    return DenseOperator(grid, ring_matrix(grid.edges) / (math.pi * value), modulus=value)
