"""Transforms of planes in slabs: rows where they lie, columns by exchange with all processes, some at a time."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import scipy.fft

from roughcontact.slabs.slab_array import SlabArray

__all__ = ["filtered_in_slabs", "is_in_slabs"]

FEWEST = 2**18  # waves of a slab of columns that goes round at once, at least: messages of megabytes
PARTS = 16  # of a slab that do so otherwise: what goes round is memory beyond it


def is_in_slabs(field: Any) -> bool:
    """Whether an array is one in slabs."""
    return isinstance(field, SlabArray)


def filtered_in_slabs(
    field: SlabArray, multiply: Callable[[Any, slice], None], lengths: tuple[int, int]
) -> SlabArray:
    """Return `field` with its spectrum multiplied.

    Parameters
    ----------
    field : SlabArray, shape (ny, nx)
    multiply : function
        Takes columns of the spectrum, shape ``(ny, n)``, and which ones of ``nx//2 + 1`` they are, and multiplies them
        in place.
    lengths : tuple of int
        Of the transforms: those of the field.

    Raises
    ------
    ValueError
        If the transforms are longer than the field: the plane is not periodic.
    """
    if tuple(field.shape) != tuple(lengths):
        raise ValueError(
            "a surface in slabs must be periodic along both axes: Grid(..., periodic=True), or press it in one process"
        )
    communicator, rank, processes = field.functions.communicator, field.functions.rank, field.functions.size
    (ny, nx), rows = lengths, len(field.local)
    spectrum = scipy.fft.rfft(field.local, axis=1)
    edges = [spectrum.shape[1] * process // processes for process in range(processes + 1)]
    width = max(1, max(FEWEST, field.local.size // PARTS) // ny)
    heights = np.diff(field.edges)
    # Every process takes part in every exchange, as the largest slabs tell: all know how many there are.
    rounds = max(-(-(end - start) // width) for start, end in pairwise(edges))
    for turn in range(rounds):
        parts = [
            slice(min(start + turn * width, end), min(start + (turn + 1) * width, end))
            for start, end in pairwise(edges)
        ]
        mine = parts[rank]
        there = [rows * (part.stop - part.start) for part in parts]
        back = [int(height) * (mine.stop - mine.start) for height in heights]
        given = np.concatenate([spectrum[:, part].reshape(-1) for part in parts])
        columns = np.empty((ny, mine.stop - mine.start), spectrum.dtype)
        communicator.Alltoallv((given, there), (columns, back))
        if columns.size:
            columns = scipy.fft.fft(columns, axis=0, overwrite_x=True)
            multiply(columns, mine)
            columns = np.ascontiguousarray(scipy.fft.ifft(columns, axis=0, overwrite_x=True))
        communicator.Alltoallv((columns, back), (given, there))
        ends = np.cumsum([0, *there])
        for part, start, end in zip(parts, ends[:-1], ends[1:], strict=True):
            spectrum[:, part] = given[start:end].reshape(rows, -1) if end > start else 0.0
    return field.like(scipy.fft.irfft(spectrum, n=nx, axis=1, overwrite_x=True))
