"""Transforms of planes in slabs: rows where they lie, columns by exchange with all processes, some at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.slabs.rows import Edges, edges_of
from roughcontact.slabs.slab_array import SlabArray

if TYPE_CHECKING:
    from roughcontact.slabs.array_functions import SlabFunctions

__all__ = ["at_once", "filtered_in_slabs", "is_in_slabs", "plane_of_waves"]

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
    import scipy.fft

    if tuple(field.shape) != tuple(lengths):
        raise InputError(
            "a surface in slabs must be periodic along both axes",
            "make the grid with periodic=True, or press it in one process",
        )
    functions, (ny, nx), rows = field.functions, lengths, len(field.local)
    communicator, rank = functions.communicator, functions.rank
    spectrum = scipy.fft.rfft(field.local, axis=1)
    heights = np.diff(field.edges).tolist()
    for parts in _turns(spectrum.shape[1], ny, field.edges):
        mine = parts[rank]
        there = [rows * (part.stop - part.start) for part in parts]
        back = [height * (mine.stop - mine.start) for height in heights]
        given = np.concatenate([spectrum[:, part].reshape(-1) for part in parts])
        columns = np.empty((ny, mine.stop - mine.start), spectrum.dtype)
        communicator.Alltoallv((given, there), (columns, back))
        if columns.size:
            columns = scipy.fft.fft(columns, axis=0, overwrite_x=True)
            multiply(columns, mine)
            columns = np.ascontiguousarray(scipy.fft.ifft(columns, axis=0, overwrite_x=True))
        communicator.Alltoallv((columns, back), (given, there))
        _put(spectrum, given, parts)
    return field.like(scipy.fft.irfft(spectrum, n=nx, axis=1, overwrite_x=True))


def plane_of_waves(
    waves: Callable[[slice], npt.NDArray[np.complex128]], shape: tuple[int, int], functions: SlabFunctions
) -> SlabArray:
    """Return the plane in slabs whose real transform is made by columns, each where it is transformed first.

    Parameters
    ----------
    waves : function
        Takes which columns of ``nx//2 + 1`` are wanted, and returns them, shape ``(ny, n)``.
    shape : tuple of int
        Of the plane, ``(ny, nx)``.
    functions : SlabFunctions
        Of the processes that make it together.
    """
    import scipy.fft

    (ny, nx), rank, edges = shape, functions.rank, edges_of(shape[0], functions.size)
    heights = np.diff(edges).tolist()
    spectrum = np.empty((heights[rank], nx // 2 + 1), np.complex128)
    for parts in _turns(nx // 2 + 1, ny, edges):
        mine = parts[rank]
        columns = np.empty((ny, 0), np.complex128)
        if mine.stop > mine.start:
            columns = np.ascontiguousarray(scipy.fft.ifft(waves(mine), axis=0, overwrite_x=True))
        there = [heights[rank] * (part.stop - part.start) for part in parts]
        back = [height * (mine.stop - mine.start) for height in heights]
        taken = np.empty(sum(there), np.complex128)
        functions.communicator.Alltoallv((columns, back), (taken, there))
        _put(spectrum, taken, parts)
    return SlabArray(scipy.fft.irfft(spectrum, n=nx, axis=1, overwrite_x=True), edges, functions)


def at_once(edges: Edges, nx: int) -> int:
    """Return how many waves of a slab of columns go round at once, of planes with rows of `nx` cells."""
    return max(FEWEST, max(np.diff(edges).tolist()) * nx // PARTS)  # cells of the largest slab


def _turns(columns: int, ny: int, edges: Edges) -> Iterator[list[slice]]:
    """Yield which columns go to each process in one exchange, until all have gone.

    Every process takes part in every exchange, and the largest slabs fix their number on all.
    """
    ends = [columns * process // (len(edges) - 1) for process in range(len(edges))]
    width = max(1, at_once(edges, 2 * columns - 2) // ny)
    for turn in range(max(-(-(end - start) // width) for start, end in pairwise(ends))):
        yield [
            slice(min(start + turn * width, end), min(start + (turn + 1) * width, end))
            for start, end in pairwise(ends)
        ]


def _put(spectrum: Any, taken: Any, parts: list[slice]) -> None:
    """Put columns that came from all processes, one behind the other, where they belong."""
    rows = len(spectrum)
    ends = np.cumsum([0, *(rows * (part.stop - part.start) for part in parts)])
    for part, start, end in zip(parts, ends[:-1], ends[1:], strict=True):
        spectrum[:, part] = taken[start:end].reshape(rows, -1) if end > start else 0.0
