"""Sums over square blocks of a plane, their separations, and what adds to each cell what its block has."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from roughcontact.kernels.code import Code
from roughcontact.kernels.signature import Double, Doubles, Indices, Vector, kernel
from roughcontact.kernels.values import Index, maximum, where


class Plane(NamedTuple):
    """Rows and columns of a plane, the side of a block, the numbers of its cells and of its blocks."""

    ny: Index
    nx: Index
    side: Index
    x: Vector
    blocks: Vector


class RowScratch(NamedTuple):
    """Memory for a row, as long as all its blocks, for each thread; `stride` is their distance in numbers."""

    rows: Vector
    stride: Index


class Pieces(NamedTuple):
    """Groups of cells on rows that are whole groups, which are whole blocks.

    Where groups begin; which is the first of each part of the work, of whole rows of blocks, and at last how many they
    are; how many parts; how many cells and blocks a row has; the side of a block; the numbers of cells and of blocks.
    """

    starts: Indices
    edges: Indices
    parts: Index
    nx: Index
    side: Index
    across: Index
    x: Vector
    blocks: Vector

    def of(self, code: Code) -> Iterator[tuple[Index, Iterator[Index]]]:
        """Loop over the pieces of blocks that groups are: which block, and its cells."""
        for part in code.shared(0, self.parts):
            for k in code.range(self.edges[part], self.edges[part + 1]):
                first = self.starts[k]
                y = first // self.nx
                block = y // self.side * self.across + (first - y * self.nx) // self.side
                for b in code.range(0, code.index(code.count) // self.side):
                    begin = first + b * self.side
                    yield block + b, code.range(begin, begin + self.side)


@kernel
def sum_blocks(code: Code, plane: Plane, scratch: RowScratch) -> None:
    """Sum over the blocks of a plane."""
    (ny, nx, side, x, blocks), row = plane, scratch.rows + code.thread * scratch.stride
    across = (nx + side - 1) // side
    for block in code.shared(0, (ny + side - 1) // side):
        for k in code.range(0, across * side):
            row[k] = 0.0
        for y in code.range(block * side, (block * side + side).min(ny)):
            for k in code.each(nx):
                row[k] = row[k] + x[y * nx + k]
        for b in code.range(0, across):
            total = code.variable(code.number(0.0))
            for k in code.range(b * side, b * side + side):
                total.set(total.get() + row[k])
            blocks[block * across + b] = total.get()


@kernel
def add_blocks(code: Code, plane: Plane, scratch: RowScratch) -> None:
    """Add to each cell what its block has."""
    (ny, nx, side, x, blocks), row = plane, scratch.rows + code.thread * scratch.stride
    across = (nx + side - 1) // side
    for block in code.shared(0, (ny + side - 1) // side):
        for b in code.range(0, across):
            for k in code.range(b * side, b * side + side):
                row[k] = blocks[block * across + b]
        for y in code.range(block * side, (block * side + side).min(ny)):
            for k in code.each(nx):
                x[y * nx + k] = x[y * nx + k] + row[k]


@kernel
def raise_blocks(code: Code, ny: Index, nx: Index, share: Double, s: Doubles, blocks: Doubles) -> None:
    """Write the mean of each block of 2 x 2 cells of s, less a share of how far they stand out of their plane.

    It is no less than the lowest of them, and the lowest where one is infinite. Both sides are even.
    """
    across = nx // 2
    for row in code.shared(0, ny // 2):
        for k in code.range(0, across):
            at = row * nx * 2 + k * 2
            a, b, c, d = (s[at + nx * down + right] for down in (0, 1) for right in (0, 1))
            out_of_it = abs((a - c) - (b - d))
            wanted = (((a + c) + (b + d)) - out_of_it * share) * 0.25
            upper, lower = (where(x < y, x, y) for x, y in ((a, b), (c, d)))
            blocks[row * across + k] = maximum(wanted, where(upper < lower, upper, lower))


@kernel
def sum_listed_blocks(code: Code, pieces: Pieces) -> None:
    """Sum over the blocks of a list of groups."""
    for block, cells in pieces.of(code):
        total = code.variable(pieces.blocks[block])
        for cell in cells:
            total.set(total.get() + pieces.x[cell])
        pieces.blocks[block] = total.get()


@kernel
def add_listed_blocks(code: Code, pieces: Pieces) -> None:
    """Add to each cell of a list of groups what its block has."""
    for block, cells in pieces.of(code):
        share = pieces.blocks[block]
        for cell in cells:
            pieces.x[cell] = pieces.x[cell] + share
