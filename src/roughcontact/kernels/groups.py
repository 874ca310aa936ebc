"""The cells that a kernel goes through, in parts that threads share: those of a plane, or groups of some of them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from roughcontact.kernels.code import Code
from roughcontact.kernels.signature import Indices
from roughcontact.kernels.totals import Totals
from roughcontact.kernels.values import Index, where

__all__ = ["Cells", "Groups"]


class Cells(NamedTuple):
    """How many cells, and how many of them are a part of the work: a multiple of the lanes."""

    size: Index
    part: Index

    def each(self, code: Code, totals: Totals | None = None) -> Iterator[Index]:
        """Loop over the cells, as many at once as there are lanes, the rest one by one; the body is written twice.

        Each part has its totals; at last they are combined.
        """
        for first, last in _parts(code, self.size, self.part, totals):
            for i in code.each(last - first):
                yield i + first


class Groups(NamedTuple):
    """Where groups begin, how many they are and how many a part; the single cells after the last whole group.

    A group has as many cells as there are lanes.
    """

    starts: Indices
    size: Index
    part: Index
    single: Index
    end: Index

    def cells(self, code: Code, totals: Totals | None = None) -> Iterator[Index]:
        """Loop over the groups, then over the single cells; the body is written twice.

        The last part has the single cells. Each has its totals; at last they are combined.
        """
        for first, last in _parts(code, self.size, self.part, totals):
            for k in code.range(first, last):
                yield self.starts[k].lanes
            yield from code.range(where(last.equals(self.size), self.single, self.end), self.end)


def _parts(code: Code, count: Index, size: Index, totals: Totals | None) -> Iterator[tuple[Index, Index]]:
    """Loop over the parts, one at least: the first, and the one after the last of each."""
    some = (count + size - 1) // size
    parts = where(some.equals(0), code.index(1), some)
    for part in code.shared(0, parts):
        if totals:
            totals.clear()
        first = part * size
        yield first, (first + size).min(count)
        if totals:
            totals.store(part)
    if totals:
        totals.combine(parts)
