"""Sums over square blocks of a plane, and what adds to each cell what its block has."""

from __future__ import annotations

from collections.abc import Iterator

from roughcontact.kernels.code import Code
from roughcontact.kernels.groups import Groups
from roughcontact.kernels.signature import Vector, kernel
from roughcontact.kernels.values import Index


@kernel
def sum_blocks(code: Code, ny: Index, nx: Index, side: Index, x: Vector, blocks: Vector, row: Vector) -> None:
    """Sum over the blocks of a plane of ny rows and nx columns; `row` is scratch, as long as all blocks of a row."""
    across = (nx + side - 1) // side
    for block in code.range(0, (ny + side - 1) // side):
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
def add_blocks(code: Code, ny: Index, nx: Index, side: Index, x: Vector, blocks: Vector, row: Vector) -> None:
    """Add to each cell what its block has; parameters as there."""
    across = (nx + side - 1) // side
    for block in code.range(0, (ny + side - 1) // side):
        for b in code.range(0, across):
            for k in code.range(b * side, b * side + side):
                row[k] = blocks[block * across + b]
        for y in code.range(block * side, (block * side + side).min(ny)):
            for k in code.each(nx):
                x[y * nx + k] = x[y * nx + k] + row[k]


@kernel
def sum_listed_blocks(
    code: Code, groups: Groups, nx: Index, side: Index, across: Index, x: Vector, blocks: Vector
) -> None:
    """Sum over the blocks of a list of groups, on rows that are whole groups, which are whole blocks.

    A row has nx cells and `across` blocks.
    """
    for block, cells in _listed_blocks(code, groups, nx, side, across):
        total = code.variable(blocks[block])
        for cell in cells:
            total.set(total.get() + x[cell])
        blocks[block] = total.get()


@kernel
def add_listed_blocks(
    code: Code, groups: Groups, nx: Index, side: Index, across: Index, x: Vector, blocks: Vector
) -> None:
    """Add to each cell of a list of groups what its block has; parameters as there."""
    for block, cells in _listed_blocks(code, groups, nx, side, across):
        share = blocks[block]
        for cell in cells:
            x[cell] = x[cell] + share


def _listed_blocks(
    code: Code, groups: Groups, nx: Index, side: Index, across: Index
) -> Iterator[tuple[Index, Iterator[Index]]]:
    """Loop over the pieces of blocks that groups are: which block, and its cells."""
    for k in code.range(groups.begin, groups.end):
        first = groups.starts[k]
        y = first // nx
        block = y // side * across + (first - y * nx) // side
        for b in code.range(0, code.index(code.count) // side):
            begin = first + b * side
            yield block + b, code.range(begin, begin + side)
