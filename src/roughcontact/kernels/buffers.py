"""A pool of memory for arrays.

A page that is touched for the first time is cleared by the system, and what is given back must be forgotten by all
cores. That costs 9 % of a press of half of 512 x 512 periodic cells on two threads (benchmarks/pairs.py, "flat-half").
So memory goes back to the pool when its array is gone, for the next array of the same shape. Very large buffers are
pooled only within a loop whose steps take arrays of the same sizes (`keep_large_buffers`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.kernels.calls import address
from roughcontact.threads import no_fork

__all__ = ["aligned", "empty", "keep_large_buffers", "release", "zeros"]

Array = npt.NDArray[Any]
Kind = tuple[tuple[int, ...], str]
Memory = npt.NDArray[np.uint8]
Block = tuple[dict[str, Any], Memory]

LINE = 64  # bytes of a cache line, to which buffers are aligned
SMALL = 2**16  # bytes up to which the allocator pools memory itself
LARGE = 2**24  # bytes from which on buffers are pooled only within a loop
MOST = 2**26  # bytes of the pool, without those of loops
FITTING = 1.25  # largest ratio of the size of a reused buffer to that of its array, within a loop
_kept: dict[Kind, list[Block]] = {}
_total = [0]  # bytes that are kept now


class _LoopPool:
    """The pool of large buffers of a loop, until it ends."""

    def __init__(self) -> None:
        self._left: list[Memory] | None = []

    def block(self, kind: Kind, size: int) -> Block:
        """Return the smallest buffer in which an array fits, or a new one where that is much too large."""
        left = self._left or []
        fit = [(k.nbytes, at) for at, k in enumerate(left) if size <= k.nbytes - LINE <= FITTING * size]
        return _block(kind, left.pop(min(fit)[1]) if fit else np.empty(size + LINE, np.uint8))

    def keep(self, block: Block) -> None:
        if self._left is not None:
            self._left.append(block[1])

    def clear(self) -> None:
        if self._left is not None:
            self._left.clear()

    def end(self) -> None:
        self._left = None


_loop: ContextVar[_LoopPool | None] = ContextVar("loop", default=None)


@contextmanager
def keep_large_buffers() -> Iterator[None]:
    """Pool very large buffers too, until this ends."""
    loop = _LoopPool()
    token = _loop.set(loop)
    try:
        yield
    finally:
        _loop.reset(token)
        loop.end()


def empty(shape: tuple[int, ...], precision: npt.DTypeLike) -> Array:
    """Return an array without setting its entries."""
    dtype = np.dtype(precision)
    kind, size = (shape, dtype.str), math.prod(shape) * dtype.itemsize
    loop = _loop.get() if size >= LARGE else None
    if loop is not None:
        return np.asarray(_Pooled(loop.block(kind, size), loop.keep))
    if not SMALL <= size < LARGE:
        return np.empty(shape, dtype)
    block = None
    with no_fork:
        blocks = _kept.get(kind)
        if blocks:
            block = blocks.pop()
            _total[0] -= size
    return np.asarray(_Pooled(block or _block(kind, np.empty(size + LINE, np.uint8)), _keep))


def zeros(shape: tuple[int, ...], precision: npt.DTypeLike) -> Array:
    """Return an array of zeros."""
    dtype = np.dtype(precision)
    if not SMALL <= math.prod(shape) * dtype.itemsize < LARGE:  # the system has cleared large ones
        return np.zeros(shape, dtype)
    array = empty(shape, dtype)
    array.fill(0)
    return array


def release() -> None:
    """Free all buffers of the pool that no array uses."""
    loop = _loop.get()
    if loop is not None:
        loop.clear()
    with no_fork:
        _kept.clear()
        _total[0] = 0


def aligned(numbers: int, precision: str, *, kept: bool = True) -> Array:
    """Return an array of n numbers that is aligned to a cache line, without setting its entries."""
    dtype = np.dtype(precision)
    size = numbers * dtype.itemsize
    if kept and size >= SMALL and (size < LARGE or _loop.get() is not None):
        return empty((numbers,), dtype)
    memory = np.empty(size + LINE, np.uint8)
    start = -address(memory) % LINE
    return memory[start : start + size].view(dtype)


class _Pooled:
    """A buffer of the pool under some arrays; it goes back when the last of them is gone."""

    __slots__ = ("__array_interface__", "_block", "_keep")

    def __init__(self, block: Block, keep: Callable[[Block], None]) -> None:
        self._block, self._keep = block, keep
        self.__array_interface__ = block[0]

    def __del__(self) -> None:
        self._keep(self._block)


def _block(kind: Kind, memory: Memory) -> Block:
    """Return what NumPy calls the interface of an array, and the memory that it describes."""
    start = address(memory)
    data = start + -start % LINE, False
    return {"data": data, "shape": kind[0], "typestr": kind[1], "version": 3}, memory


def _keep(block: Block) -> None:
    kind, size = (block[0]["shape"], block[0]["typestr"]), block[1].nbytes - LINE
    # An array may go whenever Python clears up, even here or on the way into a fork: this does not wait then.
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
