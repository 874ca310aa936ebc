"""The half-space under loads that are symmetric about an axis."""

from __future__ import annotations

import math

import numpy as np

from roughcontact.grid import RadialGrid
from roughcontact.halfspace.dense import DenseOperator
from roughcontact.halfspace.kernels import ring_matrix
from roughcontact.material import Solid, as_modulus

__all__ = ["ring"]

NARROWEST = 1e-4  # of its radius: energies of discs are subtracted twice, which costs the square of this


def ring(grid: RadialGrid, modulus: float | Solid | tuple[Solid, Solid]) -> DenseOperator:
    """Return the half-space under constant pressures on rings, by closed forms.

    Displacements are means over a ring, so that the map is symmetric under the areas of the rings and every
    solver takes it. It holds ``8 n^2`` bytes for n rings.

    Parameters
    ----------
    grid : RadialGrid
        Rings of any widths.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.

    Raises
    ------
    ValueError
        If the grid is not one of rings, or a ring is narrower than a ten-thousandth of its radius: rings are
        differences of discs, and narrower ones lose more than 1e-8 in the subtraction.
    """
    if not isinstance(grid, RadialGrid):
        raise ValueError(f"rings need a RadialGrid, not {type(grid).__name__}")
    narrow = np.diff(grid.edges) / grid.edges[1:]
    if narrow.min() < NARROWEST:
        at = int(np.argmin(narrow))
        raise ValueError(
            f"ring {at} is {narrow[at]:.2g} of its radius wide: make rings at least {NARROWEST:g} of their radius wide"
        )
    value = as_modulus(modulus)
    return DenseOperator(grid, ring_matrix(grid.edges) / (math.pi * value), modulus=value)
