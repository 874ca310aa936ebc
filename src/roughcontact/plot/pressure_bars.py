"""The distribution of the pressure as bars, up to a pressure that nearly all cells do not exceed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.plot.drawing.usual_range import usual_range
from roughcontact.validation import Array

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["PressureBars", "fewer", "pressure_bars"]

_PART = 0.75  # of the axis of pressures, for the falling end of the density
_EDGES = 0.1  # of the cells in contact: largest part that may lie along the edges of spots


@dataclass(frozen=True, slots=True, eq=False)
class PressureBars:
    """Bars of the density of the pressure over the nominal area.

    Parameters
    ----------
    density : array, shape (n,)
        [1/Pa]
    edges : array, shape (n + 1,)
        [Pa]
    beyond : float
        Part of the contact area whose pressure lies above the last edge.
    largest : float
        [Pa]
    """

    density: Array
    edges: Array
    beyond: float
    largest: float


def pressure_bars(solution: Solution, bins: int = 60) -> PressureBars:
    """Return the bars of a solution on the host with at least one cell in contact."""
    pressures = solution.pressure[solution.contact]
    largest = float(pressures.max())
    end = (usual_range(np.append(0.0, pressures), _PART, _EDGES) or (0.0, largest))[1]
    grid = solution.problem.grid
    areas = np.broadcast_to(solution.problem.operator.weights, grid.shape)[solution.contact]
    shares, edges = np.histogram(pressures, fewer(bins, pressures), (0.0, end), weights=areas / grid.area)
    beyond = float(areas[pressures > end].sum() / areas.sum())
    return PressureBars(shares / np.diff(edges), edges, beyond, largest)


def fewer(bins: int, values: Array) -> int:
    """Return the number of bars: `bins`, or that of Rice's rule if it is smaller."""
    return min(bins, math.ceil(2 * math.cbrt(values.size)))
