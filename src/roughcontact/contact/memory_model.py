"""What is alive at once where a load or a curve takes most memory: bytes a cell, counted array by array.

A plane of numbers in double precision takes 8 bytes a cell, in single precision 4. `benchmarks/memory.py` measures
the peaks, and tests hold the model against those that Python's allocators report.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from roughcontact.grid import Grid
from roughcontact.kernels import loader
from roughcontact.kernels.buffers import LARGE, MOST, SMALL
from roughcontact.solver import tuning

__all__ = ["MemoryModel", "Touch", "share_peak"]

PLANE = 8  # a plane in double precision
# Mask, residual, pressure, correction, direction, masked residual, constraint direction; a group of cells is a number.
VECTORS = 7 * 4 + 1
SINGLE_SUM, DOUBLE_SUM = 4, 8  # the answer of a product; the spectrum, not padded, takes as much
# Of the cells: contact up to which tiles are solved instead of planes.
FEW_ON_PERIOD, FEW_ON_PLANE = 0.025, 0.07
TILES, TILES_AT_MOST = 5, 0.3  # cells of tiles for one in contact; of a plane's
# Of the cells: contact up to which a curve takes no more than its stiffness in full contact, and from which on the mean
# gap cancels and boxes of many shapes are kept.
LIGHT, HEAVY = 0.003, 0.05
MARGIN = 1.3  # of a number of cells that is not known better
# In slabs, measured (benchmarks/slabs.py): for each cell of a process's share beside its heights, of a load, a curve,
# and either without machine code; and while levels are solved that every process has as a whole.
SHARE, CURVE_SHARE, PLAIN_SHARE = 60, 88, 109
LEVELS, BESIDE_LEVELS = 22e6, 34


def share_peak(cells: int, *, curve: bool) -> int:
    """Return the peak of a load, or of a curve, on a process with so many cells of a surface in slabs [bytes]."""
    own = (CURVE_SHARE if curve else SHARE) if loader.is_available() else PLAIN_SHARE
    return round(max(own * cells, LEVELS + BESIDE_LEVELS * cells))


@dataclass(frozen=True, slots=True)
class Touch:
    """How much of a plane a load brings together, of all cells: the most without arguments.

    Attributes
    ----------
    contact : float
        In contact.
    overlap, box : float
        Of which the undeformed bodies overlap, and in the box of these.
    """

    contact: float = 1.0
    overlap: float = 1.0
    box: float = 1.0


@dataclass(frozen=True, slots=True)
class MemoryModel:
    """The peaks of loads on the half-space over a plane of cells.

    Parameters
    ----------
    shape : tuple of int
    periodic : tuple of bool
        Along each axis.
    """

    shape: tuple[int, ...]
    periodic: tuple[bool, ...]

    @classmethod
    def of(cls, grid: Grid) -> MemoryModel:
        """Return the model of a grid of two axes."""
        return cls(grid.shape, grid.periodic)

    def peak(self, touch: Touch, *, curve: bool) -> int:
        """Return the peak of a load, or of a curve up to it [bytes]."""
        return self._curve(touch) if curve else self._press(touch)

    def _press(self, touch: Touch) -> int:
        if self._whole:
            return self._peak(plane=0, box=2 * PLANE, touch=touch, less=PLANE)
        least = 2 * PLANE + 2  # separation, pressure and two masks
        if touch.overlap > tuning.LIST_FILLING * touch.box:
            return max(least * self._cells, self._peak(plane=PLANE + 1, box=PLANE, touch=touch, less=0))
        table, kept = 3 * PLANE, self._separations(self._cells)  # of the box, and the same to both sides
        count, padded = touch.overlap * self._cells, 4 * touch.box * self._cells
        if (count / MARGIN) ** 2 / 4 > tuning.LOOKUPS * padded:
            table += 4 * PLANE  # products on the box: kernel, spectrum, answer
            kept += self._pooled(touch.box * self._cells, 0, PLANE)
        return round(self._cells * (least + touch.box * table) + kept + self._factor(touch))

    def _curve(self, touch: Touch) -> int:
        """Return the peak with the last tangent, the next, and its region."""
        if self._whole:
            return self._peak(plane=0, box=4 * PLANE + 1, touch=touch, less=PLANE, lighter=True)
        # The displacement by reciprocity is kept, and all cells are pressed for the stiffness of full contact. Where
        # the mean gap cancels, it is found by a product more on three planes.
        planes = 6 if touch.contact > HEAVY else 3
        return self._peak(
            plane=planes * PLANE + 2,
            box=0,
            touch=Touch(),
            less=0,
            levels=touch.contact > LIGHT,
            shapes=2 if touch.contact > HEAVY else 1,
        )

    def _peak(
        self,
        *,
        plane: int,
        box: int,
        touch: Touch,
        less: int,
        levels: bool = True,
        shapes: int = 1,
        lighter: bool = False,
    ) -> int:
        """Return the larger of two: inner products in single precision, and the one in double that certifies.

        `plane` and `box` are bytes of fields for each cell of the plane and of the box; `less` those of a pressure
        without its mean; `lighter` says whether lighter loads are found as well.
        """
        along, across = (1 if p else 2 for p in self.periodic)
        boxed = self._cells * (1.0 if self._whole else touch.box)
        table = 0 if self._whole else PLANE
        kernels = (PLANE + 4) * along * across / 4
        held = plane * self._cells + (box + table + kernels) * boxed
        single, double = SINGLE_SUM * (1 + across), DOUBLE_SUM * (1 + across) + less
        own = self._pooled(boxed, 29 + single, 2 * PLANE + double)
        coarser, cells = self._separations(boxed) if levels else 0.0, boxed
        while levels and cells > tuning.COARSEST**2:
            cells /= 16 if cells <= tuning.FACTOR_FOUR**2 else 4
            coarser += self._pooled(cells, 29 + single, 2 * PLANE + double)
        exact = held + double * boxed
        lent = min(own, double * boxed if PLANE * boxed < LARGE else 0.0)
        few = touch.contact <= (FEW_ON_PERIOD if self._whole else FEW_ON_PLANE)
        if few:
            tiles = min(TILES_AT_MOST, TILES * touch.contact) * (VECTORS + 4 * single) * boxed
            factor = self._factor(touch, lighter=lighter)
            kept = coarser / 2 + (lent if factor or not self._whole else 0.0)
            if not factor:  # of the pressure that the load began with
                kept += self._pooled(boxed, 0, PLANE)
            return round(exact + tiles + min(MOST, kept) + factor)
        inner = held + (VECTORS + single) * boxed + min(MOST, coarser)
        return round(max(inner, exact + min(MOST, shapes * own + coarser - lent)))

    def _pooled(self, cells: float, single: float, double: float) -> float:
        """Return what is kept for the next time of planes of so many cells [bytes], see `kernels.buffers`."""
        kept = single * cells if SMALL <= 4 * cells < LARGE else 0.0
        return kept + (double * cells if SMALL <= PLANE * cells < LARGE else 0.0)

    def _separations(self, cells: float) -> float:
        """Return what is kept of the separations of all coarser grids of so many cells [bytes]."""
        halvings = range(1, max(round(math.log2(max(cells, 1) / tuning.COARSEST**2) / 2), 0) + 1)
        return sum(self._pooled(cells / 4**k, 0, PLANE) for k in halvings)

    def _factor(self, touch: Touch, *, lighter: bool = False) -> float:
        """Return what the factorised matrix of a small contact takes, or the largest of lighter loads [bytes]."""
        cells, most = touch.contact * self._cells, tuning.DIRECT_BESIDE_TILES
        return PLANE * min(cells, most) ** 2 if lighter or cells <= most else 0.0

    @property
    def _cells(self) -> int:
        return math.prod(self.shape)

    @property
    def _whole(self) -> bool:
        return all(self.periodic)
