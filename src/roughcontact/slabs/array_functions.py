"""The functions of the array API standard for arrays in slabs, as far as solvers ask for them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.slabs.communicator import Communicator
from roughcontact.slabs.rows import Edges, edges_of
from roughcontact.slabs.slab_array import Local, SlabArray

__all__ = ["SlabFunctions"]


def _cell_by_cell(function: Callable[[Any], Any]) -> Any:
    def of_one(self: SlabFunctions, x: SlabArray) -> SlabArray:
        return x.like(function(x.local))

    return of_one


def _of_pairs(function: Callable[[Any, Any], Any]) -> Any:
    def of_two(self: SlabFunctions, x: SlabArray, y: Any) -> SlabArray:
        return x.like(function(x.local, x.rows_of(y)))

    return of_two


class SlabFunctions:
    """An array library whose arrays are `SlabArray`: what is one number is that of the whole, on every process.

    Such a number is made of the parts in the order of the processes, so that all of them decide alike.

    Parameters
    ----------
    communicator : Communicator
    """

    __name__ = "roughcontact.slabs"  # by which libraries of arrays are distinguished
    bool, int64, float32, float64 = (np.dtype(name) for name in ("bool", "int64", "float32", "float64"))
    isdtype: ClassVar[Any] = staticmethod(np.isdtype)
    finfo: ClassVar[Any] = staticmethod(np.finfo)

    def __init__(self, communicator: Communicator) -> None:
        self.communicator, self.rank, self.size = communicator, communicator.rank, communicator.size

    # --- cell by cell ---

    isfinite, isinf, isnan = (_cell_by_cell(function) for function in (np.isfinite, np.isinf, np.isnan))
    abs, sqrt, zeros_like = (_cell_by_cell(function) for function in (np.abs, np.sqrt, np.zeros_like))
    minimum, maximum = _of_pairs(np.minimum), _of_pairs(np.maximum)

    def where(self, condition: SlabArray, x: Any, y: Any) -> SlabArray:
        """Return x where the condition holds, otherwise y."""
        return condition.like(np.where(condition.local, condition.rows_of(x), condition.rows_of(y)))

    def clip(self, x: SlabArray, low: Any, high: Any) -> SlabArray:
        """Return it between its bounds."""
        return x.like(np.clip(x.local, x.rows_of(low), x.rows_of(high)))

    def astype(self, x: SlabArray, dtype: Any, *, copy: Any = True) -> SlabArray:
        """Return it in another type."""
        return x.like(x.local.astype(dtype, copy=bool(copy)))

    # --- new arrays, and other shapes ---

    def asarray(self, values: Any, *, dtype: Any = None, device: Any = None) -> SlabArray:
        """Return what every process has as a whole, dealt out."""
        whole = np.asarray(values, dtype)
        return self.cut(whole, edges_of(len(whole), self.size))

    def cut(self, whole: Local, edges: Edges) -> SlabArray:
        """Return what every process has as a whole, dealt out at some edges."""
        return SlabArray(whole[edges[self.rank] : edges[self.rank + 1]].copy(), edges, self)

    def full(self, shape: tuple[int, ...], value: Any, *, dtype: Any = None, device: Any = None) -> SlabArray:
        """Return one number everywhere."""
        edges = edges_of(shape[0], self.size)
        count = edges[self.rank + 1] - edges[self.rank]
        return SlabArray(np.full((count, *shape[1:]), value, dtype), edges, self)

    def zeros(self, shape: tuple[int, ...], *, dtype: Any = None, device: Any = None) -> SlabArray:
        """Return zeros."""
        return self.full(shape, 0.0, dtype=dtype)

    def arange(self, start: int, stop: int | None = None, *, device: Any = None) -> SlabArray:
        """Return whole numbers."""
        first, end = (0, start) if stop is None else (start, stop)
        return self.asarray(np.arange(first, end))

    def reshape(self, x: SlabArray, shape: tuple[int, ...]) -> SlabArray:
        """Return it in another shape: by way of the whole, since rows go elsewhere."""
        return self.asarray(x.gathered().reshape(shape))

    def concat(self, arrays: list[SlabArray], *, axis: int = 0) -> SlabArray:
        """Return arrays one beside the other."""
        if axis == 0:
            raise about("arrays", "in slabs are joined along their rows, not one below the other")
        return arrays[0].like(np.concatenate([x.local for x in arrays], axis=axis))

    def repeat(self, x: SlabArray, repeats: int, *, axis: int) -> SlabArray:
        """Return it with each row or column repeated."""
        edges = tuple(repeats * edge for edge in x.edges) if axis == 0 else x.edges
        return SlabArray(np.repeat(x.local, repeats, axis=axis), edges, self)

    def roll(self, x: SlabArray, shift: int, *, axis: int) -> SlabArray:
        """Return it moved along an axis; along the rows by one, which each process gives its neighbour."""
        if axis != 0:
            return x.like(np.roll(x.local, shift, axis=axis))
        if shift not in (1, -1):
            raise InputError(f"rows in slabs are rolled by one, not by {shift}", place="shift")
        taken = self.row_beside(x, shift)
        return x.like(np.concatenate([taken, x.local[:-1]] if shift == 1 else [x.local[1:], taken]))

    def row_beside(self, x: SlabArray, shift: int) -> Local:
        """Return the row before the first of this process (1) or after its last (-1), round the edge.

        A process without rows gets none.
        """
        holders = [rank for rank in range(self.size) if x.edges[rank] < x.edges[rank + 1]]
        if self.rank not in holders:
            return x.local
        place, given = holders.index(self.rank), x.local[-1:] if shift == 1 else x.local[:1]
        to, source = (holders[(place + step) % len(holders)] for step in (shift, -shift))
        row: Local = self.communicator.sendrecv(given.copy(), to, source=source)
        return row

    def beyond(self, x: SlabArray, count: int) -> tuple[Local, Local]:
        """Return `count` entries before the first of this process, row by row, and `count` after its last.

        They are fewer where the whole begins or ends; a process without rows gets none.
        """
        ends = [math.prod(x.shape[1:]) * edge for edge in x.edges]

        def given(giver: int, taker: int) -> slice:
            """Return what one process gives to another, counted from its own first entry."""
            low, high = ends[taker], ends[taker + 1]
            start, end = (low - count, low) if giver < taker else (high, high + count)
            if giver == taker or low == high:
                start = end
            places = (min(max(place, ends[giver]), ends[giver + 1]) for place in (start, end))
            return slice(*(place - ends[giver] for place in places))

        own, others = x.local.reshape(-1), range(self.size)
        sent = [own[given(self.rank, other)] for other in others]
        back = [part.stop - part.start for part in (given(other, self.rank) for other in others)]
        taken = np.empty(sum(back), x.dtype)
        there = [part.size for part in sent]
        self.communicator.Alltoallv((np.concatenate(sent), there), (taken, back))
        before = sum(back[: self.rank])
        return taken[:before], taken[before:]

    def with_rows_beside(self, x: SlabArray, count: int) -> tuple[Local, int]:
        """Return the rows of this process with `count` before and after them, and which row is the first of all these.

        They are fewer where the whole begins or ends.
        """
        row = math.prod(x.shape[1:])
        before, after = self.beyond(x, count * row)
        rows = np.concatenate([before, x.local.reshape(-1), after]).reshape(-1, *x.shape[1:])
        return rows, x.edges[self.rank] - before.size // row

    # --- of the whole ---

    def combined(self, totals: list[float], largest: int) -> list[float]:
        """Return the first `largest` totals as the largest of the processes, the others as their sums."""
        of_each = np.empty((self.size, len(totals)))
        counts = [len(totals)] * self.size
        self.communicator.Allgatherv(np.array(totals), (of_each.reshape(-1), counts))
        return [*of_each[:, :largest].max(axis=0).tolist(), *of_each[:, largest:].sum(axis=0).tolist()]

    def agreed(self, verdict: Any) -> Any:
        """Return whether all processes find so."""
        return False not in self._of_each(bool(verdict))

    def sum(self, x: SlabArray, *, dtype: Any = None) -> Any:
        """Return the sum of the entries, those of floating numbers in double precision."""
        wide = np.float64 if x.dtype.kind == "f" else None
        return sum(self._of_each(x.local.sum(dtype=wide).item()))

    def mean(self, x: SlabArray, *, axis: Any = None, keepdims: Any = False) -> Any:
        """Return the mean of all entries."""
        mean = self.sum(x) / x.size
        return np.full((1,) * x.ndim, mean, x.dtype) if keepdims else mean

    def max(self, x: SlabArray) -> Any:
        """Return the largest entry, NaN if one is."""
        return self._extreme(x, np.max)

    def min(self, x: SlabArray) -> Any:
        """Return the smallest entry, NaN if one is."""
        return self._extreme(x, np.min)

    def any(self, x: SlabArray) -> Any:
        """Return whether an entry is true."""
        return True in self._of_each(bool(x.local.any()))

    def all(self, x: SlabArray) -> Any:
        """Return whether all entries are true."""
        return False not in self._of_each(bool(x.local.all()))

    def count_nonzero(self, x: SlabArray) -> Any:
        """Return how many entries are true."""
        return sum(self._of_each(int(np.count_nonzero(x.local))))

    def argmin(self, x: SlabArray) -> Any:
        """Return the place of the first of the lowest entries, counted row by row."""
        mine = math.inf, 0
        if x.local.size:
            place = int(x.local.argmin())
            mine = x.local.reshape(-1)[place].item(), x.edges[self.rank] * (x.size // x.shape[0]) + place
        return min(self._of_each(mine))[1]

    def _of_each(self, value: Any) -> list[Any]:
        return self.communicator.allgather(value)

    def _extreme(self, x: SlabArray, extreme: Callable[[Any], Any]) -> Any:
        parts = self._of_each(extreme(x.local).item() if x.local.size else None)
        return extreme([part for part in parts if part is not None]).item()

    def __array_namespace_info__(self) -> SlabFunctions:
        return self

    def default_device(self) -> str:
        """Return where arrays of NumPy are."""
        return "host"
