"""Groups of cells that a kernel goes through, instead of all cells of a field."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from roughcontact.kernels.code import Code
from roughcontact.kernels.signature import Indices
from roughcontact.kernels.values import Index

__all__ = ["Groups"]


class Groups(NamedTuple):
    """Where groups begin, from which to which of them, and the single cells after the last whole group.

    A group has as many cells as there are lanes.
    """

    starts: Indices
    begin: Index
    end: Index
    single: Index
    last: Index

    def cells(self, code: Code) -> Iterator[Index]:
        """Loop over the groups, then over the single cells; the body is written twice."""
        for k in code.range(self.begin, self.end):
            yield self.starts[k].lanes
        yield from code.range(self.single, self.last)
