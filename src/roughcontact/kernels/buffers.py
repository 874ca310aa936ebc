"""Memory to work in, that is kept for the next time.

A page that is touched for the first time is cleared by the system, and what is given back must be forgotten by all
cores. That costs 9 % of a press of half of 512 x 512 periodic cells on two threads (benchmarks/pairs.py, "flat-half").
So what an array leaves is kept for the next one like it. Very large planes are not: their pages are better touched
where they are needed. Nor are those in slabs, where memory is short.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.calls import address
from roughcontact.kernels.distributed import local
from roughcontact.threads import no_fork

__all__ = ["aligned", "empty", "empty_like", "give_back", "zeros", "zeros_like"]

Array = npt.NDArray[Any]
Kind = tuple[tuple[int, ...], str]
Block = tuple[dict[str, Any], npt.NDArray[np.uint8]]

LINE = 64  # bytes of a line of the cache, with one of which all that is kept begins
SMALL = 2**16  # bytes up to which the allocator keeps memory itself
LARGE = 2**23  # bytes from which on none is kept
MOST = 2**26  # bytes that are kept in all
_kept: dict[Kind, list[Block]] = {}
_total = [0]  # bytes that are kept now


def empty(shape: tuple[int, ...], precision: npt.DTypeLike) -> Array:
    """Return an array of which no number is set."""
    dtype = np.dtype(precision)
    size = math.prod(shape) * dtype.itemsize
    if not SMALL <= size < LARGE:
        return np.empty(shape, dtype)
    kind, block = (shape, dtype.str), None
    with no_fork:
        blocks = _kept.get(kind)
        if blocks:
            block = blocks.pop()
            _total[0] -= size
    return np.asarray(_Lent(block or _new(kind, size)))


def zeros(shape: tuple[int, ...], precision: npt.DTypeLike) -> Array:
    """Return an array of zeros."""
    dtype = np.dtype(precision)
    if not SMALL <= math.prod(shape) * dtype.itemsize < LARGE:
        return np.zeros(shape, dtype)
    array = empty(shape, dtype)
    array.fill(0)
    return array


def empty_like(field: Any, precision: npt.DTypeLike) -> Any:
    """Return an array where another lies, of which no number is set."""
    here = local(field)
    return empty(here.shape, precision) if field is here else field.like(np.empty(here.shape, precision))


def zeros_like(field: Any, precision: npt.DTypeLike) -> Any:
    """Return an array of zeros where another lies."""
    here = local(field)
    return zeros(here.shape, precision) if field is here else field.like(np.zeros(here.shape, precision))


def give_back() -> None:
    """Keep nothing any more of what has been left so far."""
    with no_fork:
        _kept.clear()
        _total[0] = 0


def aligned(numbers: int, precision: str, *, kept: bool = True) -> Array:
    """Return so many numbers, of which none is set, from the start of a line of the cache on."""
    dtype = np.dtype(precision)
    size = numbers * dtype.itemsize
    if kept and SMALL <= size < LARGE:
        return empty((numbers,), dtype)
    memory = np.empty(size + LINE, np.uint8)
    start = -address(memory) % LINE
    return memory[start : start + size].view(dtype)


class _Lent:
    """A block under some arrays; when the last of them is gone it is kept."""

    __slots__ = ("__array_interface__", "_block")

    def __init__(self, block: Block) -> None:
        self._block = block
        self.__array_interface__ = block[0]

    def __del__(self) -> None:
        _keep(self._block)


def _new(kind: Kind, size: int) -> Block:
    """Return what NumPy calls the interface of an array, and the memory that this speaks of."""
    memory = np.empty(size + LINE, np.uint8)
    start = address(memory)
    data = start + -start % LINE, False
    return {"data": data, "shape": kind[0], "typestr": kind[1], "version": 3}, memory


def _keep(block: Block) -> None:
    kind, size = (block[0]["shape"], block[0]["typestr"]), block[1].nbytes - LINE
    # An array may go whenever Python clears up, even here or on the way into a fork: nobody waits then.
    if not no_fork.acquire(blocking=False):
        return
    try:
        _kept[kind] = _kept.pop(kind, [])  # the last of all
        while _total[0] + size > MOST:  # those to which nothing came for longest make room
            other = next(iter(_kept))
            if other == kind:
                break
            lost = sum(memory.nbytes - LINE for _, memory in _kept.pop(other, []))
            _total[0] -= lost
        if _total[0] + size <= MOST:
            _kept[kind].append(block)
            _total[0] += size
    finally:
        no_fork.release()
