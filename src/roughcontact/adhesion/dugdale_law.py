"""Dugdale's law on the cells of a computation: a constant attraction that may end within a cell.

The gap of a cell is that of its middle; within the cell it varies. The attraction of a cell at the edge of the zone is
proportional to the part of the cell within the range: it falls smoothly with the gap from s to zero over a `spread`,
and its integral is that of the law. With finer cells it converges to the law, with an error of second order. Because
its curvature is finite, equilibria, their stability and their jumps are those of a smooth law; without the spread, the
edge would jump from cell to cell.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.grid import AnyGrid, RadialGrid
from roughcontact.validation import Array

if TYPE_CHECKING:
    from roughcontact.adhesion.elastic_form import ElasticForm

__all__ = ["DugdaleLaw"]

SHORT = 3e-3  # of the spread
# The spread is the change of the gap near the edge of the zone of attraction: that of the undeformed gap over two
# cells, and that of the displacement over about four. Beside the edge of a constant traction s the slope of the
# displacement is 2 s/(pi E*) ln(r/x), whose integral over four cells is 12 s/E* cells for r of eighty. The energy is
# then smooth on the scale of the cells, and no position of the edge is preferred.
UNDEFORMED = 2.0
DEFORMED = 12.0


@dataclass(frozen=True, slots=True, eq=False)
class DugdaleLaw:
    """Attraction w/range up to the gap `range`, around which it falls as ``x - sin(2 pi x)/(2 pi)`` over the spread.

    Parameters
    ----------
    work : float or array
        [J/m^2]
    range : float
        [m]
    spread : array
        Interval of gaps over which the attraction falls, half of it below the range [m]; at most twice the range.
    """

    work: float | Array
    range: float
    spread: Array

    @classmethod
    def on_cells(
        cls, work: Array, length: float, strength: float, form: ElasticForm, separation: Array, modulus: float
    ) -> DugdaleLaw:
        """Return the law on the cells of a computation, with a spread from the change of the gap over a few cells."""
        grid = form.grid
        widths = np.diff(grid.edges) if isinstance(grid, RadialGrid) else max(grid.spacing)
        spread = UNDEFORMED * _across(grid, separation) + DEFORMED * strength / modulus * widths
        spread = np.minimum(spread, 2 * length)
        return cls(work, length, form.extended(spread, length))

    @property
    def strength(self) -> float:
        """Largest attraction [Pa]."""
        return float(np.max(self.work)) / self.range

    @property
    def steepest(self) -> float:
        """Largest curvature [Pa/m]."""
        return float(np.max(self.work / self.range / self.spread)) * 2

    @property
    def start_gap(self) -> float:
        """Gap [m] at which the approach under a prescribed force starts."""
        return 0.5 * self.range

    def on(self, cells: tuple[slice, ...]) -> DugdaleLaw:
        """Return the law on some of the cells."""
        return DugdaleLaw(np.asarray(self.work)[cells], self.range, self.spread[cells])

    def traction(self, gap: Array) -> Array:
        """Return the attraction [Pa], positive, at a gap [m]."""
        return np.asarray(self.work / self.range * self._part(gap))

    def curvature(self, gap: Array) -> Array:
        """Return the decrease of the attraction with the gap [Pa/m], positive."""
        fall = 1 - np.cos(2 * np.pi * self._place(gap))
        return np.asarray(self.work / self.range / self.spread * fall)

    def curvature_between(self, nearest: Array, farthest: Array) -> Array:
        """Return the largest curvature [Pa/m] of the gaps from `nearest` to `farthest`."""
        return self.curvature(np.clip(self.range, nearest, farthest))

    def energy(self, gap: Array) -> Array:
        """Return the energy per area [J/m^2], negative."""
        flat = np.maximum(0.0, self.range - 0.5 * self.spread - gap)
        return np.asarray(-self.work / self.range * (flat + self.spread * self._ramp(gap)))

    def energy_change(self, gap: Array, step: Array) -> Array:
        """Return the change of the energy per area [J/m^2] when the gap grows by `step`, without cancellation."""
        first, last = np.minimum(gap, gap + step), np.maximum(gap, gap + step)
        begin = self.range - 0.5 * self.spread
        flat = np.maximum(0.0, np.minimum(last, begin) - first)
        long = flat + self.spread * (self._ramp(first) - self._ramp(last))
        # The mean over a short step by Simpson's rule, accurate to 1e-10 of it; a difference would lose digits.
        middle = np.where(np.isfinite(first), 0.5 * (first + last), first)
        short = (self._part(first) + 4 * self._part(middle) + self._part(last)) / 6 * np.abs(step)
        change = np.where(np.abs(step) < SHORT * self.spread, short, long)
        return np.asarray(self.work / self.range * np.sign(step) * change)

    def _place(self, gap: Array) -> Array:
        """Return the position of a gap between the end of the fall and its begin."""
        return np.clip(0.5 + (self.range - gap) / self.spread, 0.0, 1.0)

    def _part(self, gap: Array) -> Array:
        """Return the part of a cell that lies within the range."""
        x = self._place(gap)
        return np.asarray(x - np.sin(2 * np.pi * x) / (2 * np.pi))

    def _ramp(self, gap: Array) -> Array:
        """Return the integral of that part."""
        x = self._place(gap)
        return np.asarray(0.5 * x**2 - 0.5 * (np.sin(np.pi * x) / np.pi) ** 2)


def _across(grid: AnyGrid, separation: Array) -> Array:
    """Return the variation of the undeformed gap across each cell [m]; zero beside cells that were not measured."""
    if isinstance(grid, RadialGrid):
        changes = [np.gradient(separation, grid.radii) * np.diff(grid.edges)] if grid.size > 1 else []
    else:
        with np.errstate(invalid="ignore"):  # of two infinite gaps
            changes = [np.gradient(separation, axis=k) for k, n in enumerate(grid.shape) if n > 1]
    total = np.sum(np.abs(changes), axis=0) if changes else np.zeros(grid.shape)
    return np.where(np.isfinite(total), total, 0.0)
