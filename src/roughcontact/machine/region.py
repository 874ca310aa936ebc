"""Regions of a field for machine code: work follows the cells inside."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.machine.layout import REACH, WIDTH
from roughcontact.machine.loader import address, functions
from roughcontact.threads import spread

__all__ = ["Region", "add_blocks", "lower", "near", "sum_blocks", "take_in", "with_margins"]

Field = npt.NDArray[Any]  # of single or double precision
Array = npt.NDArray[np.float64]

PART = 2**15  # groups of cells that are taken at once; sums are added up part by part, whatever the threads
FEW = 0.25  # of a plane: cells of a region up to which blocks are found group by group (tried by hand)
SEVERAL = 4  # parts from which on threads are worth waking


class Region:
    """The cells of a field that count.

    Attributes
    ----------
    inside : array
        One on these cells, zero elsewhere.
    """

    def __init__(self, inside: Field) -> None:
        self.inside = inside
        self._code = functions("passes", inside.dtype.name)
        lanes = WIDTH // inside.itemsize
        self._whole = inside.size // lanes * lanes
        groups, found = np.empty(inside.size // lanes + 1, np.int64), np.empty(1, np.int64)
        self._code["list_groups"](inside.size, address(inside), address(groups), address(found))
        self._groups = groups[: int(found[0])].copy()

    def is_empty(self) -> bool:
        """Whether there is none."""
        return not (len(self._groups) or self.inside.ravel()[self._whole :].any())

    def run(self, name: str, count: int, *arguments: Field | float) -> Array:
        """Run a function over these cells, and return so many sums for each part of them."""
        run, size = self._code[name], len(self._groups)
        parts = max(1, -(-size // PART))
        sums, groups = np.zeros((parts, count)), self._groups

        def part(k: int) -> None:
            # With arrays, not their addresses: they live as long as anyone works on them.
            given = [address(a) if isinstance(a, np.ndarray) else a for a in arguments]
            last = k == parts - 1
            ends = k * PART, min((k + 1) * PART, size), self._whole, self.inside.size if last else self._whole
            run(address(groups), *ends, *given, *((address(sums[k]),) if count else ()))

        _all(part, range(parts))
        return sums

    def finds_blocks(self, side: int) -> bool:
        """Whether groups of its cells are pieces of blocks of so many cells to a side, and few enough."""
        columns, lanes = self.inside.shape[-1], WIDTH // self.inside.itemsize
        return not (columns % lanes or lanes % side) and len(self._groups) * lanes <= FEW * self.inside.size

    def run_on_blocks(self, name: str, field: Field, blocks: Field, side: int) -> None:
        """Run a function on the blocks that these cells are of."""
        plan = 0, len(self._groups), self._whole, self.inside.size, field.shape[-1], side, blocks.shape[1]
        self._code[name](address(self._groups), *plan, address(field), address(blocks))


def lower(r: Field, v: Field, alpha: float, mean: float) -> None:
    """Take ``alpha (v - mean)`` off a whole field."""
    run, lanes = functions("passes", r.dtype.name)["lower"], WIDTH // r.itemsize
    size = PART * lanes

    def part(start: int) -> None:
        offset = start * r.itemsize
        run(min(size, r.size - start), address(r) + offset, address(v) + offset, alpha, mean)

    _all(part, range(0, r.size, size))


def _all(part: Callable[[int], None], starts: Sequence[int]) -> None:
    """Do all parts, on several threads if they are many."""
    if len(starts) < SEVERAL:
        for start in starts:
            part(start)
    else:
        spread(part, starts)


def take_in(inside: Field, lacking: Field, least: float) -> float:
    """Count as inside what lacks more than `least`, and than nothing; return the largest lack of what was not, or 0."""
    worst, given = np.zeros(1), np.ascontiguousarray(lacking, dtype=inside.dtype)
    run = functions("passes", inside.dtype.name)["take_in"]
    run(inside.size, address(inside), address(given), least, address(worst))
    return float(worst[0])


def with_margins(field: Field, precision: npt.DTypeLike | None = None) -> Field:
    """Return a copy of a plane with as much zero before and behind it as a sum over near cells looks at."""
    row, dtype = field.shape[-1] if field.ndim > 1 else 0, np.dtype(precision or field.dtype)
    margin = REACH * (row + 1) + WIDTH // dtype.itemsize
    room = np.zeros(field.size + 2 * margin, dtype=dtype)
    room[margin : margin + field.size] = field.ravel()
    return room[margin : margin + field.size].reshape(field.shape)


def near(region: Region, field: Field, weights: Field) -> Field:
    """Return the weighted sum over the cells near each of a region, of a field with margins.

    The row after each row is taken for what lies beyond its end: the sum is symmetric and definite all the same.
    """
    answer = np.empty_like(field)
    region.run("near", 0, field.shape[-1], field, answer, weights)
    return answer


def sum_blocks(region: Region, field: Field, side: int) -> Field:
    """Return the sums over square blocks of a plane that is zero outside a region, those at its far edges cut off."""
    ny, nx = field.shape
    blocks = np.zeros((-(-ny // side), -(-nx // side)), dtype=field.dtype)
    if region.finds_blocks(side):
        region.run_on_blocks("sum_blocks_on", field, blocks, side)
    else:
        _blocks("sum_blocks", field, blocks, side)
    return blocks


def add_blocks(region: Region, field: Field, blocks: Field, side: int) -> None:
    """Add to each cell of a region what its block has; what others get means nothing."""
    if region.finds_blocks(side):
        region.run_on_blocks("add_blocks_on", field, blocks, side)
    else:
        _blocks("add_blocks", field, blocks, side)


def _blocks(name: str, field: Field, blocks: Field, side: int) -> None:
    row = np.empty(blocks.shape[1] * side + WIDTH, dtype=field.dtype)
    code = functions("passes", field.dtype.name)[name]
    code(*field.shape, side, address(field), address(blocks), address(row))
