"""Kernels on the cells of a region: work follows these, not the field."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.buffers import empty, zeros
from roughcontact.kernels.calls import Operand
from roughcontact.kernels.constants import REACH, WIDTH
from roughcontact.kernels.loader import code_for
from roughcontact.kernels.planes import CELLS, Combine, run_on_plane
from roughcontact.threads import threads

__all__ = [
    "ActiveCells",
    "add_blocks",
    "fill_margins",
    "looked_at",
    "mask_above",
    "subtract_shifted",
    "sum_blocks",
    "sum_stencil",
    "with_margins",
    "zeros_with_margins",
]

Field = npt.NDArray[Any]  # of single or double precision

PART = 2**10  # groups of cells that are taken at once; sums are added up part by part, whatever the threads
SUMS = 8  # that a function finds at most
SEVERAL = 4  # parts from which on a second thread comes in time
FEW = 0.25  # of a plane: cells of a region up to which blocks are found group by group (benchmarks/pairs.py)


class ActiveCells:
    """The cells of a field that count.

    Attributes
    ----------
    inside : array
        One on these cells, zero elsewhere.

    Parameters
    ----------
    inside : array
    pressed : pair of arrays, optional
        A pressure and its change: cells where their sum is not zero are listed as well.
    combine : function, optional
        Makes totals of all processes from those of this one, where others hold the rest of the field.
    """

    def __init__(
        self, inside: Field, pressed: tuple[Field, Field] | None = None, combine: Combine | None = None
    ) -> None:
        self.inside, self._combine = inside, combine
        self._code = code_for("vector_kernels", inside)
        lanes = WIDTH // inside.itemsize
        groups, found = np.empty(inside.size // lanes + 1, np.int64), np.empty(1, np.int64)
        self._code["list_groups"](inside.size, inside, *(pressed or (inside, inside)), groups, found)
        self._count = int(found[0])
        self._groups = Operand(groups[: self._count].copy())
        parts = max(-(-self._count // PART), 1)
        self._workers = threads() if parts >= SEVERAL else 1
        self._given = self._groups, self._count, PART, inside.size // lanes * lanes, inside.size
        self._totals = Operand(np.empty(parts * SUMS))

    def run(
        self,
        name: str,
        count: int,
        *arguments: Operand | Field | float,
        largest: bool = False,
        weight: float = 1.0,
    ) -> list[float]:
        """Run a kernel over these cells, and return `count` weighted sums, or the largest, of what it finds."""
        if not count:
            self._code[name](*self._given, *arguments, workers=self._workers)
            return []
        self._code[name](*self._given, *arguments, self._totals, workers=self._workers)
        totals: list[float] = (weight * self._totals.field[:count]).tolist()
        return self._combine(totals, count if largest else 0) if self._combine else totals

    def finds_blocks(self, side: int) -> bool:
        """Whether groups of its cells are pieces of blocks of `side` by `side` cells, and few enough."""
        columns, lanes = self.inside.shape[-1], WIDTH // self.inside.itemsize
        return not (columns % lanes or lanes % side) and self._count * lanes <= FEW * self.inside.size

    def run_on_blocks(self, name: str, field: Field, blocks: Field, side: int) -> None:
        """Run a kernel on the blocks that these cells are of, on some whole rows of blocks at once."""
        columns, across = field.shape[-1], blocks.shape[1]
        step = max(CELLS // (side * columns), 1) * side * columns
        edges = np.searchsorted(self._groups.field, np.arange(0, field.size + step, step))
        parts = len(edges) - 1
        given = self._groups, edges, parts, columns, side, across, field, blocks
        code_for("block_kernels", field)[name](*given, workers=self._workers)


def subtract_shifted(r: Field, v: Field, alpha: float, mean: float) -> None:
    """Take ``alpha (v - mean)`` off a whole field."""
    run_on_plane(code_for("vector_kernels", r)["subtract_shifted"], 0, 0, r, v, alpha, mean)


def mask_above(mask: Field, r: Field, least: float, combine: Combine | None = None) -> float:
    """Set a mask to one where r is above `least`, and above zero; return the largest r where it was not, or 0."""
    run = code_for("vector_kernels", mask)["mask_above"]
    r = np.ascontiguousarray(r, dtype=mask.dtype)
    return run_on_plane(run, 1, 1, mask, r, least, combine=combine)[0]


def with_margins(field: Field, precision: npt.DTypeLike | None = None) -> Field:
    """Return a copy of a plane with as much zero before and behind it as a sum over near cells looks at."""
    copy = zeros_with_margins(field, precision or field.dtype)
    copy[...] = field
    return copy


def zeros_with_margins(like: Field, precision: npt.DTypeLike) -> Field:
    """Return a plane of zeros with such margins, of the shape of another."""
    dtype = np.dtype(precision)
    margin = looked_at(like.shape[-1] if like.ndim > 1 else 0) + WIDTH // dtype.itemsize
    memory = zeros((like.size + 2 * margin,), dtype)
    return memory[margin : margin + like.size].reshape(like.shape)


def sum_stencil(region: ActiveCells, field: Field, weights: Field) -> Field:
    """Return the weighted sum over the cells near each of a region, of a field with margins.

    The row after each row is taken for what lies beyond its end: the sum is symmetric and definite all the same.
    """
    answer = empty(field.shape, field.dtype)
    region.run("sum_stencil", 0, field.shape[-1], field, answer, weights)
    return answer


def looked_at(row: int) -> int:
    """Return how many cells before the first, and after the last, a sum over near cells looks at."""
    return REACH * (row + 1)


def fill_margins(field: Field, before: Field, behind: Field) -> None:
    """Write what comes before the first number of a field with margins, and after its last."""
    memory = field.base
    assert memory is not None  # that of `zeros_with_margins`
    first = (memory.size - field.size) // 2
    last = first + field.size
    memory[first - before.size : first], memory[last : last + behind.size] = before, behind


def sum_blocks(region: ActiveCells, field: Field, side: int) -> Field:
    """Return the sums over square blocks of a plane that is zero outside a region, those at its far edges cut off."""
    ny, nx = field.shape
    blocks = np.zeros((-(-ny // side), -(-nx // side)), dtype=field.dtype)
    if region.finds_blocks(side):
        region.run_on_blocks("sum_listed_blocks", field, blocks, side)
    else:
        _blocks("sum_blocks", field, blocks, side)
    return blocks


def add_blocks(region: ActiveCells, field: Field, blocks: Field, side: int) -> None:
    """Add to each cell of a region what its block has; what others get means nothing."""
    if region.finds_blocks(side):
        region.run_on_blocks("add_listed_blocks", field, blocks, side)
    else:
        _blocks("add_blocks", field, blocks, side)


def _blocks(name: str, field: Field, blocks: Field, side: int) -> None:
    workers = threads() if field.size >= SEVERAL * CELLS else 1
    rows = np.empty((workers, blocks.shape[1] * side + WIDTH), dtype=field.dtype)
    run = code_for("block_kernels", field)[name]
    run(*field.shape, side, field, blocks, rows, rows.shape[1], workers=workers)
