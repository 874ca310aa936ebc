r"""Detachment of stuck surfaces: cells let go one by one, each when its tension is too large.

On a plane the criterion is that of Pohrt and Popov (Facta Universitatis, Mech. Eng. 13, 3 (2015)): a single cell under
the tension s releases ``s^2 c/2`` per area as it relaxes, where c is the mean displacement of the cell by a unit
pressure on it. It lets go when this energy equals w:

    s_c = sqrt(2 w/c)      c = I/(pi E* a b)
    I = 2 (a^2 b arsinh(b/a) + a b^2 arsinh(a/b)) + 2/3 (a^3 + b^3 - (a^2 + b^2)^(3/2))

for sides a and b; for a square c is 0.946402 a/E*. Rings and lines have no such constant. There c is that of the cell
with all others held, the inverse of the diagonal of the inverse of the influence matrix of the contact: ``s^2 c/2`` is
then the energy released when the cell at the edge lets go.

Between two events the pressure is linear in the depth, so the depth of every event is exact and does not depend on
steps.

Labels E37 to E39 are the lines of the algorithm in docs/concepts/method-adhesion.md.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass

import numpy as np

from roughcontact.errors import InputError
from roughcontact.grid import AnyGrid, RadialGrid
from roughcontact.halfspace.operators.operator import Operator, exact_of
from roughcontact.progress.events import task
from roughcontact.validation import Array, Mask

__all__ = ["Detachment", "StuckContact", "mean_compliance"]

LARGEST = 6000  # cells of a matrix
ROWS = 64  # rows of it that are changed at a time


@dataclass(frozen=True, slots=True)
class Detachment:
    """Cells that let go together: one whose tension was too large, and the cells that could not hold after it.

    Attributes
    ----------
    depth, depth_after : float
        [m]; NaN if a force pulled the body off.
    force_before, force_after : float
        [N]
    cells : int
        Number of cells that let go.
    lost : float
        Released elastic energy minus the work of adhesion [J]; infinite if a force pulled the body off. With the
        criterion of a single cell it may be negative, because the cells beside it hold back part of the energy.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> start, pull_off, off = rc.detachment_path(rc.press(ball, 1e8, depth=2e-8), 10e-3)
    >>> first = pull_off.detachments[0]
    >>> f"{first.cells} ring lets go at {first.depth * 1e9:.1f} nm", bool(off.contact.any())
    ('1 ring lets go at 3.0 nm', False)
    """

    depth: float
    depth_after: float
    force_before: float
    force_after: float
    cells: int
    lost: float


def mean_compliance(grid: AnyGrid, modulus: float) -> float | None:
    """Return the mean displacement of a cell of a plane by a unit pressure on it [m/Pa]; None on rings and lines.

    Parameters
    ----------
    grid : Grid or RadialGrid
    modulus : float
        Reduced modulus E* [Pa].
    """
    if isinstance(grid, RadialGrid) or grid.ndim == 1 or min(grid.shape) == 1:
        return None
    a, b = grid.spacing
    mutual = 2 * a * b * (a * math.asinh(b / a) + b * math.asinh(a / b))
    mutual += 2 / 3 * (a**3 + b**3 - math.hypot(a, b) ** 3)
    return mutual / (math.pi * modulus * a * b)


class StuckContact:
    """Stuck cells and their adhesion; cells can leave, and none joins.

    Parameters
    ----------
    operator : Operator
    separation : array, shape of the grid
        [m]
    contact : array of bool
        The stuck cells.
    work : array
        Work of adhesion [J/m^2].
    compliance : float, optional
        See `mean_compliance`.

    Raises
    ------
    ValueError
        If there are too many cells for a matrix.
    """

    def __init__(
        self, operator: Operator, separation: Array, contact: Mask, work: Array, compliance: float | None
    ) -> None:
        self.cells = np.flatnonzero(contact)
        if len(self.cells) > LARGEST:
            raise InputError(
                f"detachment needs the matrix of the cells in contact, and {len(self.cells)} are too many (at most "
                f"{LARGEST})",
                "press by less, or average cells (surface.averaged)",
            )
        weights = np.broadcast_to(np.asarray(operator.weights, float), separation.shape)
        self.areas, self.work = weights.ravel()[self.cells], np.ravel(work)[self.cells]
        self.compliance, self.shape = compliance, separation.shape
        self.inverse = np.linalg.inv(exact_of(operator).as_matrix(self.cells))  # E37
        self.rigidity = np.diagonal(self.inverse).copy()
        self.base = -self.inverse @ separation.ravel()[self.cells]
        self.unit = self.inverse.sum(axis=1)

    @property
    def area(self) -> float:
        """Area of the remaining cells [m^2]."""
        return float(self.areas.sum())

    @property
    def stiffness(self) -> float:
        """Force per depth [N/m]."""
        return float(self.unit @ self.areas)

    def force(self, depth: float) -> float:
        """Return the force at a depth [N]."""
        return float((self.base + depth * self.unit) @ self.areas)

    def depth(self, force: float) -> float:
        """Return the depth under a force [m]."""
        return (force - float(self.base @ self.areas)) / self.stiffness if len(self.cells) else -math.inf

    def pressure(self, depth: float) -> tuple[Array, Mask]:
        """Return the pressure [Pa] and the contact on the grid."""
        pressure = np.zeros(math.prod(self.shape))
        contact = np.zeros(pressure.shape, bool)
        contact[self.cells] = True
        if len(self.cells):
            pressure[self.cells] = self.base + depth * self.unit
        return pressure.reshape(self.shape), contact.reshape(self.shape)

    def snapshot(self) -> StuckContact:
        """Return the present contact, without the matrix that further events would need."""
        now = copy(self)  # no other array is changed in place
        del now.inverse
        return now

    def drawn_back(self, here: float, target: float, by_force: bool) -> Iterator[Detachment]:
        """Let cells go from a depth (or force) down to another; yield the events, and report the cells as progress."""
        total = len(self.cells) if math.isinf(target) else None
        with task("Letting cells go", total, "cells") as letting:
            while len(self.cells):
                index, depth = self._next()
                value = self.force(depth) if by_force else depth
                if value < target:
                    return
                value = min(here, value)
                here = value
                start = self.depth(value) if by_force else value
                before, lost, count, end = self.force(start), 0.0, 0, start
                while count == 0 or (len(self.cells) and depth >= end):
                    lost += self._let_go(index, end, by_force)
                    count += 1
                    if letting is not None:
                        letting.advance()
                    if len(self.cells):
                        end = self.depth(value) if by_force else value
                        index, depth = self._next()
                after = self.force(end) if len(self.cells) else 0.0
                end = end if len(self.cells) or not by_force else math.nan
                yield Detachment(start, end, before, after, count, lost)

    @property
    def strength(self) -> float:
        """Largest tension at which one of the cells would let go [Pa]."""
        return float(self._tensions().max())

    def _tensions(self) -> Array:
        """Return the tension at which each cell lets go [Pa]."""
        compliance = 1 / self.rigidity if self.compliance is None else self.compliance
        return np.asarray(np.sqrt(2 * self.work / compliance))

    def _next(self) -> tuple[int, float]:
        """Return the cell that lets go next, and the depth of this event."""
        # A cell whose pressure does not fall on the retreat never lets go.
        depths = np.full(len(self.cells), -np.inf)
        np.divide(-self._tensions() - self.base, self.unit, out=depths, where=self.unit > 0)
        index = int(np.argmax(depths))  # E38
        return index, float(depths[index])

    def _let_go(self, index: int, depth: float, by_force: bool) -> float:
        """Free a cell; return the lost energy."""
        area, tension = self.areas[index], self.base[index] + depth * self.unit[index]
        rigidity = self.rigidity[index]
        rest = rigidity - area * self.unit[index] ** 2 / self.stiffness if by_force else rigidity
        last = by_force and len(self.cells) == 1
        lost = math.inf if last else (0.5 * tension**2 / rest - self.work[index]) * area
        column = self.inverse[:, index] / rigidity  # E39
        self.base = self.base - column * self.base[index]
        self.unit = self.unit - column * self.unit[index]
        for name in ("cells", "areas", "work", "base", "unit"):
            setattr(self, name, np.delete(getattr(self, name), index))
        self._take_out(index, column)
        self.rigidity = np.diagonal(self.inverse).copy()
        return float(lost)

    def _take_out(self, index: int, column: Array) -> None:
        """Remove the row and the column of a cell from the inverse, in place, a few rows at a time."""
        inverse, row = self.inverse, self.inverse[index].copy()
        kept, left = np.delete(np.arange(len(row)), index), len(row) - 1
        for start in range(0, left, ROWS):
            rows = kept[start : start + ROWS]
            changed, into = inverse[rows] - np.outer(column[rows], row), inverse[start : start + len(rows)]
            into[:, :index], into[:, index:left] = changed[:, :index], changed[:, index + 1 :]
        self.inverse = inverse[:left, :left]
