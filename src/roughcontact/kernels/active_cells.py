"""Regions of a field for machine code: work follows the cells inside."""

from __future__ import annotations

import math
from typing import Any, NamedTuple, Self

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.buffers import empty, zeros
from roughcontact.kernels.constants import REACH, WIDTH
from roughcontact.kernels.loader import address, code_for
from roughcontact.threads import spread

__all__ = [
    "Located",
    "Region",
    "add_blocks",
    "lower",
    "near",
    "sum_blocks",
    "take_in",
    "with_margins",
    "zeros_with_margins",
]

Field = npt.NDArray[Any]  # of single or double precision

PART = 2**15  # groups of cells that are taken at once; sums are added up part by part, whatever the threads
SUMS = 8  # that a function finds at most
SEVERAL = 4  # parts from which on threads are worth waking
FEW = 0.25  # of a plane: cells of a region up to which blocks are found group by group (tried by hand)


class Located(NamedTuple):
    """A field, and where it begins: machine code asks for that again and again."""

    field: Field
    at: int

    @classmethod
    def of(cls, field: Field) -> Self:
        """Return a field with its place."""
        return cls(field, address(field))


class Region:
    """The cells of a field that count.

    Attributes
    ----------
    inside : array
        One on these cells, zero elsewhere.

    Parameters
    ----------
    inside : array
    pressed : pair of arrays, optional
        A pressure and its change: cells that carry something are gone through as well.
    """

    def __init__(self, inside: Field, pressed: tuple[Field, Field] | None = None) -> None:
        self.inside = inside
        self._code = code_for("passes", inside)
        lanes = WIDTH // inside.itemsize
        self._whole = inside.size // lanes * lanes
        groups, found = np.empty(inside.size // lanes + 1, np.int64), np.empty(1, np.int64)
        fields = [address(f) for f in (inside, *(pressed or (inside, inside)))]
        self._code["list_groups"](inside.size, *fields, address(groups), address(found))
        self._groups = groups[: int(found[0])].copy()
        self._sums = Located.of(np.empty(SUMS))
        self._ends = address(self._groups), len(self._groups), self._whole, inside.size

    def run(
        self, name: str, count: int, *arguments: Located | Field | float, largest: bool = False
    ) -> list[float]:
        """Run a function over these cells, and return so many sums, or the largest, of what it finds."""
        run, (groups, size, whole, end) = self._code[name], self._ends
        given = [
            a.at if isinstance(a, Located) else address(a) if isinstance(a, np.ndarray) else a
            for a in arguments
        ]
        if size <= PART:
            sums, at = self._sums
            run(groups, 0, size, whole, end, *given, *((at,) if count else ()))
            few: list[float] = sums[:count].tolist()
            return few
        parts = -(-size // PART)
        totals = np.zeros((parts, count))
        first, step = address(totals) if count else 0, count * totals.itemsize

        # With the fields themselves: they live as long as anyone works on them.
        def part(k: int, _: object = (self, totals, arguments)) -> None:
            last = (k + 1) * PART, whole, whole
            ends = last if k < parts - 1 else (size, whole, end)
            run(groups, k * PART, *ends, *given, *((first + k * step,) if count else ()))

        spread(part, range(parts), SEVERAL)
        found: list[float] = (totals.max(axis=0) if largest else totals.sum(axis=0)).tolist()
        return found

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
    run, lanes = code_for("passes", r)["lower"], WIDTH // r.itemsize
    size = PART * lanes
    if r.size <= size:
        run(r.size, address(r), address(v), alpha, mean)
        return

    def part(start: int) -> None:
        offset = start * r.itemsize
        run(min(size, r.size - start), address(r) + offset, address(v) + offset, alpha, mean)

    spread(part, range(0, r.size, size), SEVERAL)


def take_in(inside: Field, lacking: Field, least: float) -> float:
    """Count as inside what lacks more than `least`, and than nothing; return the largest lack of what was not, or 0."""
    worst, given = np.zeros(1), np.ascontiguousarray(lacking, dtype=inside.dtype)
    run = code_for("passes", inside)["take_in"]
    run(inside.size, address(inside), address(given), least, address(worst))
    return float(worst[0])


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


def near(region: Region, field: Field, weights: Field) -> Field:
    """Return the weighted sum over the cells near each of a region, of a field with margins.

    The row after each row is taken for what lies beyond its end: the sum is symmetric and definite all the same.
    """
    answer = empty(field.shape, field.dtype)
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
    code = code_for("passes", field)[name]
    code(*field.shape, side, address(field), address(blocks), address(row))
