"""Machine code for sums over near cells where fields lie tile by tile."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import Any

from roughcontact.machine.code import Code
from roughcontact.machine.layout import REACH, SIDE
from roughcontact.machine.values import Number

__all__ = ["KINDS", "write"]

KINDS = {
    "list_cells": "index index index reals indices indices reals indices",
    "add_near": "index index indices index indices index index indices indices reals reals reals",
    "near_on_tiles": "index index indices index indices index reals reals reals reals",
    "sum_blocks_of_tiles": "index index indices index index index reals reals reals",
    "add_blocks_to_tiles": "index index indices index index index reals reals reals",
}


def write(module: Any, precision: str) -> None:
    """Write all of them."""
    _list_cells(module, precision)
    _add_near(module, precision)
    _near(module, precision)
    _blocks(module, precision, "sum_blocks_of_tiles", to_blocks=True)
    _blocks(module, precision, "add_blocks_to_tiles", to_blocks=False)


def _list_cells(module: Any, precision: str) -> None:
    """List the cells of tiles that are not zero.

    Parameters: how many tiles, their side, how long a row of the kernel is, the field; where the list of each tile
    begins, how far back in the kernel each cell is, its value, and how many cells there are.
    """
    with Code(module, "list_cells", precision, KINDS["list_cells"]) as code:
        tiles, side, wide, field, starts, shifts, values, found = code.arguments
        count = code.variable(code.index(0))
        for tile in code.range(0, tiles):
            starts.put(tile, count.get())
            for y in code.range(0, side):
                first = (tile * side + y) * side
                some = reduce(code.either, [code.any_not_zero(field.take(first + x)) for x in _lanes(code)])
                with code.when(some):
                    for x in code.range(0, side):
                        value = field.take_one(first + x)
                        shifts.put(count.get(), y * wide + x)
                        values.put(count.get(), value)
                        count.set(count.get() + code.choose(value.is_not_zero(), 1, 0))
        starts.put(tiles, count.get())
        found.put(code.index(0), count.get())


def _add_near(module: Any, precision: str) -> None:
    """Add to each tile the sums over the cells of the tiles near it, by a kernel at offsets of cells.

    Parameters: the first tile and the one after the last; the map of tiles, how long its rows are, the place of each
    tile in it, how many tiles there are, and how many to each side are near; the list of cells that are not zero, as
    above; the kernel, in the middle of rows of eight tiles; and the sums. Tiles are 8 cells wide.
    """
    with Code(module, "add_near", precision, KINDS["add_near"]) as code:
        begin, end, numbers, across, places, tiles, reach, starts, shifts, values, kernel, sums = (
            code.arguments
        )
        wide = SIDE * SIDE
        middle = wide // 2 * wide + wide // 2
        for tile in code.range(begin, end):
            rows = [(y, x) for y in range(SIDE) for x in _lanes(code)]
            totals = [code.variable(sums.take((tile * SIDE + y) * SIDE + x)) for y, x in rows]
            for dy in code.range(code.index(0) - reach, reach + 1):
                for dx in code.range(code.index(0) - reach, reach + 1):
                    of = numbers[places[tile] + dy * across + dx]
                    with code.when(of <= tiles - 1):
                        origin = code.index(middle) - (dy * wide + dx) * SIDE
                        for k in code.range(starts[of], starts[of + 1]):
                            at, value = origin - shifts[k], values.take_for_all(k)
                            for total, (y, x) in zip(totals, rows, strict=True):
                                total.set(total.get() + kernel.take(at + (y * wide + x)) * value)
            for total, (y, x) in zip(totals, rows, strict=True):
                sums.put((tile * SIDE + y) * SIDE + x, total.get())


def _near(module: Any, precision: str) -> None:
    """Sum over the cells near each, as `near` in `roughcontact.machine.passes` does on a plane.

    Parameters: the first tile and the one after the last; the map of tiles, how long its rows are, and the place of
    each tile in it; the side of a tile, the field, the answer, the weights of cells to one side, and room for a tile
    with its surroundings.
    """
    with Code(module, "near_on_tiles", precision, KINDS["near_on_tiles"]) as code:
        begin, end, numbers, across, tile_places, side, field, answer, weights, room = code.arguments
        wide = side * 3
        for tile in code.range(begin, end):
            for k in range(9):
                of, first = numbers[tile_places[tile] + across * (k // 3 - 1) + (k % 3 - 1)], side * (k % 3)
                rows = (
                    (side - REACH, side) if k < 3 else (code.index(0), side if k < 6 else code.index(REACH))
                )
                # Rows of the room: those above, the tile's own, those below.
                top = (code.index(0), code.index(REACH), side + REACH)[k // 3]
                for y in code.range(*rows):
                    for x in code.range(0, side, code.count):
                        room.put(
                            (top + y - rows[0]) * wide + first + x, field.take((of * side + y) * side + x)
                        )
            for y in code.range(0, side):
                for x in code.range(0, side, code.count):
                    total: Number | None = None
                    for dy in range(REACH + 1):
                        for dx in range(REACH + 1):
                            rows_, columns = sorted({dy, -dy}), sorted({dx, -dx})
                            places = [(y + (REACH + v)) * wide + side + x + u for v in rows_ for u in columns]
                            cells = reduce(add, [room.take(place) for place in places])
                            weight = weights.take_for_all(code.index(dy * (REACH + 1) + dx))
                            total = cells * weight if total is None else total + cells * weight
                    assert total is not None
                    answer.put((tile * side + y) * side + x, total)


def _lanes(code: Code) -> range:
    """Return where lanes begin in a row of a tile."""
    return range(0, SIDE, code.count)


def _blocks(module: Any, precision: str, name: str, to_blocks: bool) -> None:
    """Sum over square blocks of each tile, or add to each cell what its block has.

    Parameters: the first tile and the one after the last, where the first block of each is in the plane of blocks, how
    long a row of that is, the sides of a tile and of a block, the field, the blocks, and room for a row of a tile.
    """
    with Code(module, name, precision, KINDS[name]) as code:
        begin, end, places, across, side, block, field, blocks, row = code.arguments
        many = side // block
        for tile in code.range(begin, end):
            for down in code.range(0, many):
                place = places[tile] + down * across
                if to_blocks:
                    for x in code.range(0, side, code.count):
                        row.put(x, code.zero())
                else:
                    for b in code.range(0, many):
                        for x in code.range(b * block, b * block + block):
                            row.put(x, blocks.take_one(place + b))
                for y in code.range(down * block, down * block + block):
                    for x in code.range(0, side, code.count):
                        at = (tile * side + y) * side + x
                        if to_blocks:
                            row.put(x, row.take(x) + field.take(at))
                        else:
                            field.put(at, field.take(at) + row.take(x))
                if to_blocks:
                    for b in code.range(0, many):
                        total = code.variable(code.one(0.0))
                        for x in code.range(b * block, b * block + block):
                            total.set(total.get() + row.take_one(x))
                        blocks.put(place + b, total.get())
