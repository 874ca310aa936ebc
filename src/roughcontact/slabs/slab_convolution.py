"""A convolution of planes in slabs in machine code: rows where they lie, columns by exchange with all processes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from roughcontact.kernels.convolution_steps import filter_columns, transform_rows, transform_rows_back
from roughcontact.kernels.plane_plan import Indices, PlanePlan
from roughcontact.slabs.exchange import at_once
from roughcontact.slabs.rows import Edges
from roughcontact.slabs.slab_array import SlabArray
from roughcontact.validation import Array

__all__ = ["SlabConvolution"]


@dataclass(frozen=True, slots=True, eq=False)
class SlabConvolution:
    """A kernel, ready for periodic planes of one precision whose rows are dealt out in one way.

    Blocks of columns go round some at a time, so that what goes to a process, and comes back, lies in one piece.

    Attributes
    ----------
    plan : PlanePlan
    turns : tuple of tuple of int
        For each exchange: where the blocks of each process begin, and where the last ones end.
    multipliers : tuple of array
        Transform of the kernel in the blocks of this process, for each exchange: no process holds more.
    edges, places : int array
        For each process and after the last: its first row, and how many rows spectra before its own have memory for.
    """

    plan: PlanePlan
    turns: tuple[Edges, ...]
    multipliers: tuple[Array, ...]
    edges: Indices
    places: Indices

    @classmethod
    def of(
        cls,
        multiplier: Callable[[slice], Array],
        lengths: tuple[int, int],
        precision: str,
        edges: Edges,
        rank: int,
    ) -> SlabConvolution:
        """Make a kernel ready for one process.

        Parameters
        ----------
        multiplier : function
            Takes columns, a slice, and returns these of the real transform of an even kernel, rows from 0 up.
        lengths : tuple of int
            ``(ny, nx)`` of the planes.
        precision : {"float32", "float64"}
        edges : tuple of int
            Where the rows of each process begin, and where the last ones end.
        rank : int
            Number of the process.
        """
        plan = PlanePlan.of(lengths, lengths, precision)
        turns = _turns(plan, edges)
        none, waves = np.zeros((lengths[0] // 2 + 1, 0)), lengths[1] // 2 + 1
        ends = [[min(block * plan.lanes, waves) for block in turn[rank : rank + 2]] for turn in turns]
        multipliers = tuple(
            plan.in_blocks(multiplier(slice(start, end)) if end > start else none) for start, end in ends
        )
        places = np.cumsum([0, *(plan.padded(end - start) for start, end in pairwise(edges))])
        return cls(plan, turns, multipliers, np.array(edges, np.int64), places.astype(np.int64))

    def apply(self, field: SlabArray) -> SlabArray:
        """Return the convolution; all processes ask for it."""
        plan, size = self.plan, 2 * self.plan.lanes
        communicator, rank = field.functions.communicator, field.functions.rank
        spectrum = transform_rows(plan, field.local)
        held = np.diff(self.places).tolist()
        for turn, multiplier in zip(self.turns, self.multipliers, strict=True):
            part = spectrum[turn[0] : turn[-1]]
            there = [(end - start) * held[rank] * size for start, end in pairwise(turn)]
            back = [len(multiplier) * rows * size for rows in held]
            columns = np.empty(sum(back), plan.precision)
            communicator.Alltoallv((part, there), (columns, back))
            filter_columns(plan, columns, multiplier, self.edges, self.places)
            communicator.Alltoallv((columns, back), (part, there))
        return field.like(transform_rows_back(plan, spectrum, field.local.shape))


def _turns(plan: PlanePlan, edges: Edges) -> tuple[Edges, ...]:
    """Return which blocks go to each process in every exchange.

    All processes take part in all of them, and the largest slabs fix their number on each.
    """
    (ny, nx), processes = plan.lengths, len(edges) - 1
    many = max(1, at_once(edges, nx) // (ny * plan.lanes)) * processes
    parts = ((start, min(many, plan.blocks - start)) for start in range(0, plan.blocks, many))
    return tuple(
        tuple(start + count * process // processes for process in range(processes + 1))
        for start, count in parts
    )
