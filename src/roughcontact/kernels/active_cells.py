"""Kernels on the cells of a region: work follows these, not the field."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.buffers import empty, zeros
from roughcontact.kernels.calls import Operand
from roughcontact.kernels.constants import REACH, WIDTH
from roughcontact.kernels.loader import code_for
from roughcontact.kernels.planes import run_on_plane
from roughcontact.threads import spread

__all__ = [
    "ActiveCells",
    "add_blocks",
    "mask_above",
    "subtract_shifted",
    "sum_blocks",
    "sum_stencil",
    "with_margins",
    "zeros_with_margins",
]

Field = npt.NDArray[Any]  # of single or double precision

PART = 2**13  # groups of cells that are taken at once; sums are added up part by part, whatever the threads
SUMS = 8  # that a function finds at most
SEVERAL = 4  # parts from which on threads are worth waking
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
    """

    def __init__(self, inside: Field, pressed: tuple[Field, Field] | None = None) -> None:
        self.inside = inside
        self._code = code_for("vector_kernels", inside)
        lanes = WIDTH // inside.itemsize
        self._whole = inside.size // lanes * lanes
        groups, found = np.empty(inside.size // lanes + 1, np.int64), np.empty(1, np.int64)
        base, change = pressed or (inside, inside)
        self._code["list_groups"](inside.size, inside, base, change, groups, found)
        self._count = int(found[0])
        self._groups = Operand(groups[: self._count].copy())
        self._sums = Operand(np.empty(SUMS))

    def run(
        self, name: str, count: int, *arguments: Operand | Field | float, largest: bool = False
    ) -> list[float]:
        """Run a kernel over these cells, and return so many sums, or the largest, of what it finds."""
        run, size, whole, end = self._code[name], self._count, self._whole, self.inside.size
        if size <= PART:
            run(self._groups, 0, size, whole, end, *arguments, *((self._sums,) if count else ()))
            few: list[float] = self._sums.field[:count].tolist()
            return few
        parts = -(-size // PART)
        totals = np.zeros((parts, count))

        def part(k: int) -> None:
            last = (k + 1) * PART, whole, whole
            ends = last if k < parts - 1 else (size, whole, end)
            run(self._groups, k * PART, *ends, *arguments, *((totals[k],) if count else ()))

        spread(part, range(parts), SEVERAL)
        found: list[float] = (totals.max(axis=0) if largest else totals.sum(axis=0)).tolist()
        return found

    def finds_blocks(self, side: int) -> bool:
        """Whether groups of its cells are pieces of blocks of so many cells to a side, and few enough."""
        columns, lanes = self.inside.shape[-1], WIDTH // self.inside.itemsize
        return not (columns % lanes or lanes % side) and self._count * lanes <= FEW * self.inside.size

    def run_on_blocks(self, name: str, field: Field, blocks: Field, side: int) -> None:
        """Run a kernel on the blocks that these cells are of."""
        plan = 0, self._count, self._whole, self.inside.size, field.shape[-1], side, blocks.shape[1]
        code_for("block_kernels", field)[name](self._groups, *plan, field, blocks)


def subtract_shifted(r: Field, v: Field, alpha: float, mean: float) -> None:
    """Take ``alpha (v - mean)`` off a whole field."""
    run_on_plane(code_for("vector_kernels", r)["subtract_shifted"], 0, 0, r, v, alpha, mean)


def mask_above(mask: Field, r: Field, least: float) -> float:
    """Set a mask to one where r is above `least`, and above zero; return the largest r where it was not, or 0."""
    run = code_for("vector_kernels", mask)["mask_above"]
    return run_on_plane(run, 1, 1, mask, np.ascontiguousarray(r, dtype=mask.dtype), least)[0]


def with_margins(field: Field, precision: npt.DTypeLike | None = None) -> Field:
    """Return a copy of a plane with as much zero before and behind it as a sum over near cells looks at."""
    copy = zeros_with_margins(field.shape, precision or field.dtype)
    copy[...] = field
    return copy


def zeros_with_margins(shape: tuple[int, ...], precision: npt.DTypeLike) -> Field:
    """Return a plane of zeros with such margins."""
    row, dtype, size = shape[-1] if len(shape) > 1 else 0, np.dtype(precision), math.prod(shape)
    margin = REACH * (row + 1) + WIDTH // dtype.itemsize
    return zeros((size + 2 * margin,), dtype)[margin : margin + size].reshape(shape)


def sum_stencil(region: ActiveCells, field: Field, weights: Field) -> Field:
    """Return the weighted sum over the cells near each of a region, of a field with margins.

    The row after each row is taken for what lies beyond its end: the sum is symmetric and definite all the same.
    """
    answer = empty(field.shape, field.dtype)
    region.run("sum_stencil", 0, field.shape[-1], field, answer, weights)
    return answer


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
    row = np.empty(blocks.shape[1] * side + WIDTH, dtype=field.dtype)
    code_for("block_kernels", field)[name](*field.shape, side, field, blocks, row)
