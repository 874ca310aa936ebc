"""From what a user gives to a law on the cells of a computation."""

from __future__ import annotations

import numpy as np

from roughcontact.adhesion.attraction import Adhesion, Attraction
from roughcontact.adhesion.dugdale_law import DugdaleLaw
from roughcontact.adhesion.elastic_form import ElasticForm
from roughcontact.adhesion.exponential_law import ExponentialLaw
from roughcontact.grid import AnyGrid, RadialGrid
from roughcontact.validation import Array

__all__ = ["law_on"]

# The edge of the zone of attraction is spread over cells as it is by the slope of the undeformed gap on two of them,
# and by that of the displacement on about four: beside the edge of a constant traction s it is 2 s/(pi E*) ln(r/x), the
# integral of which over four cells is 12 s/E* cells for r of eighty. The energy is then smooth on the scale of the
# cells, and no position of the edge is preferred to another.
UNDEFORMED = 2.0
DEFORMED = 12.0


def law_on(adhesion: Adhesion, form: ElasticForm, separation: Array, modulus: float) -> Attraction:
    """Return the law on the cells of a computation.

    Parameters
    ----------
    adhesion : Adhesion
    form : ElasticForm
    separation : array, shape of the grid
        Undeformed gap [m]; infinite where nothing was measured, and nothing attracts.
    modulus : float
        Reduced modulus E* [Pa].
    """
    work = form.extended(np.where(np.isfinite(separation), adhesion.work, 0.0), 0.0)
    if adhesion.law == "exponential":
        return ExponentialLaw(work, adhesion.range)
    grid = form.grid
    widths = np.diff(grid.edges) if isinstance(grid, RadialGrid) else max(grid.spacing)
    spread = UNDEFORMED * _across(grid, separation) + DEFORMED * adhesion.strength / modulus * widths
    spread = np.minimum(spread, 2 * adhesion.range)
    return DugdaleLaw(work, adhesion.range, form.extended(spread, adhesion.range))


def _across(grid: AnyGrid, separation: Array) -> Array:
    """Return by how much the undeformed gap varies across each cell [m]; zero beside what was not measured."""
    if isinstance(grid, RadialGrid):
        changes = [np.gradient(separation, grid.radii) * np.diff(grid.edges)] if grid.size > 1 else []
    else:
        with np.errstate(invalid="ignore"):  # of two infinite gaps
            changes = [np.gradient(separation, axis=k) for k, n in enumerate(grid.shape) if n > 1]
    total = np.sum(np.abs(changes), axis=0) if changes else np.zeros(grid.shape)
    return np.where(np.isfinite(total), total, 0.0)
