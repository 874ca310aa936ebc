"""Machine code for sums over near cells where fields lie tile by tile."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import reduce
from typing import Any

from roughcontact.kernels.code import Code
from roughcontact.kernels.constants import REACH, SIDE
from roughcontact.kernels.stencil import sum_near
from roughcontact.kernels.values import Index, Indices

__all__ = ["KINDS", "write"]

KINDS = {
    "list_cells": "index reals indices indices reals",
    "sum_all": "indices index indices indices indices indices reals reals index reals",
    "add_near": "index index indices index indices index index indices indices reals reals reals",
    "near_on_tiles": "index index indices index indices reals reals reals reals",
    "sum_blocks_of_tiles": "index indices index index reals reals",
    "add_blocks_to_tiles": "index indices index index reals reals",
}
WIDE = SIDE * SIDE  # of the kernel of near sums


def write(module: Any, precision: str) -> None:
    """Write all of them."""
    _list_cells(module, precision)
    _sum_all(module, precision)
    _add_near(module, precision)
    _near(module, precision)
    _blocks(module, precision)


def _list_cells(module: Any, precision: str) -> None:
    """List the cells of tiles that are not zero.

    Parameters: how many tiles, the field; where the list of each tile begins, and at last how many cells there are; how
    far back in the kernel each cell is, and its value.
    """
    with Code(module, "list_cells", precision, KINDS["list_cells"]) as code:
        tiles, field, starts, shifts, values = code.arguments
        count = code.variable(code.index(0))
        for tile in code.range(0, tiles):
            starts.put(tile, count.get())
            for y in code.range(0, SIDE):
                first = (tile * SIDE + y) * SIDE
                some = reduce(code.either, [code.any_not_zero(field.take(first + x)) for x in _lanes(code)])
                with code.when(some):
                    for x in code.range(0, SIDE):
                        value = field.take_one(first + x)
                        shifts.put(count.get(), y * WIDE + x)
                        values.put(count.get(), value)
                        count.set(count.get() + code.choose(value.is_not_zero(), 1, 0))
        starts.put(tiles, count.get())


def _sum_all(module: Any, precision: str) -> None:
    """Sum in each tile over the cells of all tiles.

    Parameters: counters for one phase, see `Code.shared`; how many tiles, and where they are, counted in tiles; the
    list of cells that are not zero, as above; the kernel at offsets of rows from zero up, and of columns to both sides
    of its middle; how long its rows are; and the sums.
    """
    with Code(module, "sum_all", precision, KINDS["sum_all"]) as code:
        counters, tiles, rows, columns, starts, shifts, values, kernel, wide, sums = code.arguments
        steps = {sign: [wide * (sign * v) for v in range(SIDE)] for sign in (-1, 1)}
        for tile in code.shared(counters, 0, tiles):
            totals = [[code.variable(code.zero()) for _ in _lanes(code)] for _ in range(SIDE)]
            for source in code.range(0, tiles):
                down = (rows[tile] - rows[source]) * SIDE
                across = wide // 2 + (columns[tile] - columns[source]) * SIDE
                for sign, met in ((-1, down <= -1), (0, down.equals(0)), (1, -down <= -1)):
                    with code.when(met):
                        for k in code.range(starts[source], starts[source + 1]):
                            y, value = shifts[k] // WIDE, values.take_for_all(k)
                            first = across + y * WIDE - shifts[k]
                            start = first + (down - y) * wide * sign
                            for v, row in enumerate(totals):
                                at = start + steps[sign][v] if sign else first + (y - v).size() * wide
                                for total, x in zip(row, _lanes(code), strict=True):
                                    total.set(total.get() + kernel.take(at + x) * value)
            for v, row in enumerate(totals):
                for total, x in zip(row, _lanes(code), strict=True):
                    sums.put((tile * SIDE + v) * SIDE + x, total.get())


def _add_near(module: Any, precision: str) -> None:
    """Add to each tile the sums over the cells of the tiles near it, by a kernel at offsets of cells.

    Parameters: the first tile and the one after the last; the map of tiles, how long its rows are, the place of each
    tile in it, how many tiles there are, and how many to each side are near; the list of cells that are not zero, as
    above; the kernel, in the middle of rows of eight tiles; and the sums.
    """
    with Code(module, "add_near", precision, KINDS["add_near"]) as code:
        begin, end, numbers, across, places, tiles, reach, starts, shifts, values, kernel, sums = (
            code.arguments
        )
        middle = WIDE // 2 * WIDE + WIDE // 2
        for tile in code.range(begin, end):
            rows = [(y, x) for y in range(SIDE) for x in _lanes(code)]
            totals = [code.variable(sums.take((tile * SIDE + y) * SIDE + x)) for y, x in rows]
            for dy in code.range(code.index(0) - reach, reach + 1):
                for dx in code.range(code.index(0) - reach, reach + 1):
                    of = numbers[places[tile] + dy * across + dx]
                    with code.when(of <= tiles - 1):
                        origin = code.index(middle) - (dy * WIDE + dx) * SIDE
                        for k in code.range(starts[of], starts[of + 1]):
                            at, value = origin - shifts[k], values.take_for_all(k)
                            for total, (y, x) in zip(totals, rows, strict=True):
                                total.set(total.get() + kernel.take(at + (y * WIDE + x)) * value)
            for total, (y, x) in zip(totals, rows, strict=True):
                sums.put((tile * SIDE + y) * SIDE + x, total.get())


def _near(module: Any, precision: str) -> None:
    """Sum over the cells near each, as `near` in `roughcontact.kernels.passes` does on a plane.

    Parameters: the first tile and the one after the last; the map of tiles, how long its rows are, and the place of
    each tile in it; the field, the answer, the weights of cells to one side, and room for a tile with its surroundings.
    """
    with Code(module, "near_on_tiles", precision, KINDS["near_on_tiles"]) as code:
        begin, end, numbers, across, tile_places, field, answer, weights, room = code.arguments
        wide = 3 * SIDE
        for tile in code.range(begin, end):
            for k in range(9):
                of, first = numbers[tile_places[tile] + across * (k // 3 - 1) + (k % 3 - 1)], SIDE * (k % 3)
                # Rows of the room: those above, the tile's own, those below.
                begins, ends, top = ((SIDE - REACH, SIDE, 0), (0, SIDE, REACH), (0, REACH, SIDE + REACH))[
                    k // 3
                ]
                for y in code.range(begins, ends):
                    for x in _lanes(code):
                        room.put(
                            (y + (top - begins)) * wide + first + x, field.take((of * SIDE + y) * SIDE + x)
                        )
            for y in code.range(0, SIDE):
                for x in _lanes(code):
                    here = (y + REACH) * wide + SIDE + x
                    total = sum_near(
                        lambda v, u, here=here: room.take(here + v * wide + u),  # type: ignore[misc]
                        lambda k: weights.take_for_all(code.index(k)),
                    )
                    answer.put((tile * SIDE + y) * SIDE + x, total)


def _blocks(module: Any, precision: str) -> None:
    """Write sums over square blocks of each tile, and what adds to each cell what its block has.

    Parameters: how many tiles, where the first block of each is in the plane of blocks, how long a row of that is, the
    side of a block, the field, and the blocks.
    """
    with Code(module, "sum_blocks_of_tiles", precision, KINDS["sum_blocks_of_tiles"]) as code:
        *blocks, field, sums = code.arguments
        for block, cells in _blocks_of(code, *blocks):
            total = code.variable(code.one(0.0))
            for cell in cells():
                total.set(total.get() + field.take_one(cell))
            sums.put(block, total.get())
    with Code(module, "add_blocks_to_tiles", precision, KINDS["add_blocks_to_tiles"]) as code:
        *blocks, field, shares = code.arguments
        for block, cells in _blocks_of(code, *blocks):
            share = shares.take_one(block)
            for cell in cells():
                field.put(cell, field.take_one(cell) + share)


def _blocks_of(
    code: Code, tiles: Index, places: Indices, across: Index, side: Index
) -> Iterator[tuple[Index, Callable[[], Iterator[Index]]]]:
    """Loop over the blocks of tiles: where each is in the plane of blocks, and a loop over its cells."""
    many = code.index(SIDE) // side
    for tile in code.range(0, tiles):
        for down in code.range(0, many):
            for right in code.range(0, many):
                first = (tile * SIDE + down * side) * SIDE + right * side

                def cells(first: Index = first) -> Iterator[Index]:
                    for y in code.range(0, side):
                        for x in code.range(0, side):
                            yield first + y * SIDE + x

                yield places[tile] + down * across + right, cells


def _lanes(code: Code) -> range:
    """Return where lanes begin in a row of a tile."""
    return range(0, SIDE, code.count)
