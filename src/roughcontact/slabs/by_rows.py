"""Rows of a plane in slabs, some at a time to the first process or from it: as files take and give them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from roughcontact.slabs.slab_array import Local, SlabArray
from roughcontact.slabs.slabs import Slabs

__all__ = ["gather_to_first", "scatter_from_first"]

AT_ONCE = 2**23  # numbers that go at once: some tens of megabytes beside what a process holds


def gather_to_first(field: SlabArray, multiple: int = 1) -> Iterator[tuple[int, Local | None]]:
    """Yield the number of a row, and on the first process the rows from there on, down the plane.

    Parameters
    ----------
    field : SlabArray
        All processes go through it together.
    multiple : int
        Of which the count of rows is one, but at the end.

    Yields
    ------
    int
        The first of some rows.
    array or None
        The rows; None on all processes but the first.
    """
    functions = field.functions
    row, rank = math.prod(field.shape[1:]), functions.rank
    for start, end in _turns(field.shape[0], row, multiple):
        held = [_within(edges, start, end) for edges in pairwise(field.edges)]
        first, mine = field.edges[rank], held[rank]
        given = np.ascontiguousarray(field.local[mine.start - first : mine.stop - first]).reshape(-1)
        taken = np.empty((end - start if rank == 0 else 0, *field.shape[1:]), field.dtype)
        there = [given.size if other == 0 else 0 for other in range(functions.size)]
        back = [row * (part.stop - part.start) if rank == 0 else 0 for part in held]
        functions.communicator.Alltoallv((given, there), (taken, back))
        yield start, taken if rank == 0 else None


def scatter_from_first(slabs: Slabs, whole: Local | None, shape: tuple[int, ...]) -> SlabArray:
    """Return an array of which the first process has the whole, in double precision, in slabs.

    Parameters
    ----------
    slabs : Slabs
    whole : array or None
        None on all processes but the first.
    shape : tuple of int
        Of the whole.
    """
    communicator, row = slabs.communicator, math.prod(shape[1:])
    rank, mine = communicator.rank, slabs.rows(shape[0])
    rows_of_all = communicator.allgather(mine)
    local = np.empty((mine.stop - mine.start, *shape[1:]))
    for start, end in _turns(shape[0], row, 1):
        parts = [_within((rows.start, rows.stop), start, end) for rows in rows_of_all]
        given = np.empty(0) if whole is None else np.array(whole[start:end], np.float64).reshape(-1)
        there = [0 if whole is None else row * (part.stop - part.start) for part in parts]
        taken = local[parts[rank].start - mine.start : parts[rank].stop - mine.start]
        back = [taken.size if other == 0 else 0 for other in range(communicator.size)]
        communicator.Alltoallv((given, there), (taken, back))
    return slabs.array(local)


def _turns(rows: int, row: int, multiple: int) -> Iterator[tuple[int, int]]:
    step = multiple * max(1, AT_ONCE // (row * multiple))
    for start in range(0, rows, step):
        yield start, min(start + step, rows)


def _within(edges: tuple[int, int], start: int, end: int) -> slice:
    """Return which rows from `start` to `end` lie between two edges; none lie at the edge that is nearer."""
    low, high = (min(max(edge, start), end) for edge in edges)
    return slice(low, high)
