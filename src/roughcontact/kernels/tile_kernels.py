"""Sums over near cells where fields lie tile by tile: cell y, x of tile t has the number ``(t SIDE + y) SIDE + x``."""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce
from operator import or_
from typing import NamedTuple

from roughcontact.kernels.code import Code, Local
from roughcontact.kernels.constants import NEAR_ROWS, REACH, SIDE
from roughcontact.kernels.signature import Indices, Vector, kernel
from roughcontact.kernels.totals import sum_near
from roughcontact.kernels.values import Index, Number, where

WIDE = SIDE * SIDE  # of the influence of near sums, and so of an offset of one row
TOGETHER = 16  # tiles that a thread takes at once


class Sources(NamedTuple):
    """The cells of tiles that are not zero.

    Where the list of each tile begins, and at last how many cells there are; how far back in the influence each cell
    is; and its value.
    """

    starts: Indices
    shifts: Indices
    values: Vector

    def of(self, code: Code, tile: Index) -> Iterator[tuple[Index, Number]]:
        """Loop over the cells of a tile: their shifts and values."""
        for k in code.range(self.starts[tile], self.starts[tile + 1]):
            yield self.shifts[k], code.lanes(self.values[k])


class TilePlaces(NamedTuple):
    """The number of the tile at each place of a plane of tiles, how long its rows are, and the place of each tile."""

    numbers: Indices
    across: Index
    places: Indices


class Blocks(NamedTuple):
    """How many tiles, where the first block of each is in the plane of blocks, its columns, and the side of a block."""

    tiles: Index
    places: Indices
    across: Index
    side: Index


@kernel
def list_nonzero(code: Code, tiles: Index, x: Vector, sources: Sources) -> None:
    """List the cells of so many tiles that are not zero."""
    count = code.variable(code.index(0))
    for tile in code.range(0, tiles):
        sources.starts[tile] = count.get()
        for y in code.range(0, SIDE):
            first = (tile * SIDE + y) * SIDE
            some = [code.any(x[(first + k).lanes].is_nonzero()) for k in _lanes(code)]
            with code.when(reduce(or_, some)):
                for k in code.range(0, SIDE):
                    value = x[first + k]
                    sources.shifts[count.get()] = y * WIDE + k
                    sources.values[count.get()] = value
                    count.set(count.get() + where(value.is_nonzero(), code.index(1), 0))
    sources.starts[tiles] = count.get()


@kernel
def sum_pairs(
    code: Code,
    tiles: Index,
    rows: Indices,
    columns: Indices,
    sources: Sources,
    influence: Vector,
    wide: Index,
    sums: Vector,
) -> None:
    """Write to each tile the sum over the sources of all tiles.

    Parameters: how many tiles, and where they are, counted in tiles; the influence at offsets of rows from zero up, and
    of columns to both sides of its middle; how long its rows are.
    """
    steps = {sign: [wide * (sign * v) for v in range(SIDE)] for sign in (-1, 1)}
    for tile in code.shared(0, tiles):
        totals = [[code.variable(code.lanes(0.0)) for _ in _lanes(code)] for _ in range(SIDE)]
        for source in code.range(0, tiles):
            down = (rows[tile] - rows[source]) * SIDE
            across = wide // 2 + (columns[tile] - columns[source]) * SIDE
            for sign, met in ((-1, down <= -1), (0, down.equals(0)), (1, -down <= -1)):
                with code.when(met):
                    for shift, value in sources.of(code, source):
                        y = shift // WIDE
                        first = across + y * WIDE - shift
                        start = first + (down - y) * wide * sign
                        for v, row in enumerate(totals):
                            at = start + steps[sign][v] if sign else first + abs(y - v) * wide
                            for total, x in zip(row, _lanes(code), strict=True):
                                total.set(total.get() + influence[(at + x).lanes] * value)
        for v, row in enumerate(totals):
            for total, x in zip(row, _lanes(code), strict=True):
                sums[((tile * SIDE + v) * SIDE + x).lanes] = total.get()


@kernel
def add_near_sources(
    code: Code,
    tiles: Index,
    map: TilePlaces,
    reach: Index,
    sources: Sources,
    influence: Vector,
    sums: Vector,
) -> None:
    """Add to each of `count` tiles the sums over the sources of tiles near it.

    Near are `reach` tiles to each side. The influence is at offsets of cells from the middle of rows of eight tiles.
    """
    middle = WIDE // 2 * WIDE + WIDE // 2
    for tile in _shared(code, tiles):
        totals: list[tuple[Local[Number], int, int]] = [
            (code.variable(sums[((tile * SIDE + y) * SIDE + x).lanes]), y, x)
            for y in range(SIDE)
            for x in _lanes(code)
        ]
        for dy in code.range(-reach, reach + 1):
            for dx in code.range(-reach, reach + 1):
                of = map.numbers[map.places[tile] + dy * map.across + dx]
                with code.when(of <= tiles - 1):
                    origin = code.index(middle) - (dy * WIDE + dx) * SIDE
                    for shift, value in sources.of(code, of):
                        at = origin - shift
                        for total, y, x in totals:
                            total.set(total.get() + influence[(at + (y * WIDE + x)).lanes] * value)
        for total, y, x in totals:
            sums[((tile * SIDE + y) * SIDE + x).lanes] = total.get()


@kernel
def sum_stencil_on_tiles(
    code: Code,
    tiles: Index,
    map: TilePlaces,
    x: Vector,
    y: Vector,
    weights: Vector,
    scratch: Vector,
) -> None:
    """Write to `count` tiles of y the weighted sums over the cells of x near each; see `sum_stencil`.

    Scratch holds the rows of three by three tiles that such sums look at, for each thread.
    """
    wide = 3 * SIDE
    scratch = scratch + code.thread * NEAR_ROWS
    for tile in _shared(code, tiles):
        for k in range(9):
            of, first = (
                map.numbers[map.places[tile] + map.across * (k // 3 - 1) + (k % 3 - 1)],
                SIDE * (k % 3),
            )
            # Rows of the scratch: those above, the tile's own, those below.
            from_, to, top = ((SIDE - REACH, SIDE, 0), (0, SIDE, REACH), (0, REACH, SIDE + REACH))[k // 3]
            for row in code.range(from_, to):
                for lane in _lanes(code):
                    place = (row + (top - from_)) * wide + first + lane
                    scratch[place.lanes] = x[((of * SIDE + row) * SIDE + lane).lanes]
        for row in code.range(0, SIDE):
            for lane in _lanes(code):
                here = ((row + REACH) * wide + SIDE + lane).lanes
                total = sum_near(lambda v, u, i=here: scratch[i + (v * wide + u)], weights, code.index(0))  # type: ignore[misc]
                y[((tile * SIDE + row) * SIDE + lane).lanes] = total


@kernel
def sum_blocks_of_tiles(code: Code, blocks: Blocks, x: Vector, sums: Vector) -> None:
    """Sum over the square blocks of each tile."""
    for block, cells in _blocks_of(code, blocks):
        total = code.variable(code.number(0.0))
        for cell in cells:
            total.set(total.get() + x[cell])
        sums[block] = total.get()


@kernel
def add_blocks_to_tiles(code: Code, blocks: Blocks, x: Vector, shares: Vector) -> None:
    """Add to each cell of tiles what its block has."""
    for block, cells in _blocks_of(code, blocks):
        share = shares[block]
        for cell in cells:
            x[cell] = x[cell] + share


def _blocks_of(code: Code, blocks: Blocks) -> Iterator[tuple[Index, Iterator[Index]]]:
    """Loop over the blocks of tiles: where each is in the plane of blocks, and its cells."""
    tiles, places, across, side = blocks
    many = code.index(SIDE) // side
    for tile in _shared(code, tiles):
        for down in code.range(0, many):
            for right in code.range(0, many):
                first = (tile * SIDE + down * side) * SIDE + right * side
                cells = (first + y * SIDE + x for y in code.range(0, side) for x in code.range(0, side))
                yield places[tile] + down * across + right, cells


def _shared(code: Code, tiles: Index) -> Iterator[Index]:
    """Loop over tiles, some of which a thread takes at once."""
    for part in code.shared(0, (tiles + (TOGETHER - 1)) // TOGETHER):
        yield from code.range(part * TOGETHER, (part * TOGETHER + TOGETHER).min(tiles))


def _lanes(code: Code) -> range:
    """Return where lanes begin in a row of a tile."""
    return range(0, SIDE, code.count)
