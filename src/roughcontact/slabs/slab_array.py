"""An array whose rows lie in slabs, one on each process; its operators work on the rows of their own process."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from itertools import pairwise
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.slabs.rows import Edges

__all__ = ["SlabArray"]

Local = npt.NDArray[Any]


def _plain(function: Callable[[Any, Any], Any]) -> Any:
    def method(self: SlabArray, other: Any) -> SlabArray:
        return self.like(function(self.local, self.rows_of(other)))

    return method


def _reflected(function: Callable[[Any, Any], Any]) -> Any:
    def method(self: SlabArray, other: Any) -> SlabArray:
        return self.like(function(self.rows_of(other), self.local))

    return method


def _in_place(function: Callable[[Any, Any], Any]) -> Any:
    def method(self: SlabArray, other: Any) -> SlabArray:
        function(self.local, self.rows_of(other))
        return self

    return method


class SlabArray:
    """An array whose rows are dealt out to the processes of a communicator; `roughcontact.Slabs` makes one.

    Parameters
    ----------
    local : array
        The rows of this process; of an array of one axis its entries.
    edges : tuple of int
        Where the rows of each process begin, and where the last ones end.
    functions : SlabFunctions
        Of the array API standard, over the same processes.

    Attributes
    ----------
    shape : tuple of int
        Of the whole.
    """

    __slots__ = ("edges", "functions", "local", "shape")
    # NumPy's numbers leave a product with slabs to the slabs.
    __array_ufunc__: ClassVar[None] = None
    __hash__: ClassVar[None] = None  # type: ignore[assignment]
    device: ClassVar[str] = "slabs"

    def __init__(self, local: Local, edges: Edges, functions: Any) -> None:
        self.local, self.edges, self.functions = local, edges, functions
        self.shape = (edges[-1], *local.shape[1:])

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the numbers."""
        return self.local.dtype

    @property
    def ndim(self) -> int:
        """Number of axes."""
        return self.local.ndim

    @property
    def size(self) -> int:
        """Number of entries of the whole."""
        return math.prod(self.shape)

    def __repr__(self) -> str:
        """Say what this process holds, without a word from the others."""
        rank, shape = self.functions.rank, " x ".join(map(str, self.shape))
        return f"SlabArray({shape} {self.dtype}, rows {self.edges[rank]} to {self.edges[rank + 1]} here)"

    def gathered(self) -> Local:
        """Return the whole as an array of NumPy on every process; all of them ask for it."""
        whole = np.empty(self.shape, self.dtype)
        row = math.prod(self.shape[1:]) * self.dtype.itemsize
        counts = [row * (end - start) for start, end in pairwise(self.edges)]
        own = np.ascontiguousarray(self.local).reshape(-1).view(np.uint8)
        self.functions.communicator.Allgatherv(own, (whole.reshape(-1).view(np.uint8), counts))
        return whole

    def like(self, local: Local) -> SlabArray:
        """Return other numbers on the same rows."""
        return SlabArray(local, self.edges, self.functions)

    def in_blocks(self, local: Local, side: int) -> SlabArray:
        """Return numbers of blocks of `side` rows, each on the process that holds these rows."""
        return SlabArray(local, tuple(edge // side for edge in self.edges), self.functions)

    def rows_of(self, other: Any) -> Any:
        """Return the rows of this process of another array; a number as it is.

        Raises
        ------
        ValueError
            If the rows of the other are dealt out in another way, or it is a whole array.
        """
        if isinstance(other, SlabArray):
            if other.edges != self.edges:
                raise InputError(
                    f"rows dealt out at {other.edges} do not fit those dealt out at {self.edges}"
                )
            return other.local
        if np.size(other) != 1:
            raise InputError("a whole array does not go with one in slabs", "deal it out by Slabs.array")
        return other

    def to_device(self, device: str, /, stream: Any = None) -> Any:
        """Return it, or on the device "host" the whole as an array of NumPy."""
        return self.gathered() if device == "host" else self

    def __array_namespace__(self, api_version: str | None = None) -> Any:
        return self.functions

    def __array__(self, *_: Any, **__: Any) -> Local:
        raise TypeError(
            "an array in slabs is not NumPy's: .local are the rows of this process, .gathered() all"
        )

    def __getitem__(self, key: Any) -> SlabArray:
        if isinstance(key, SlabArray):  # a mask
            part = self.local[self.rows_of(key)]
            ends = np.cumsum([0, *self.functions.communicator.allgather(len(part))])
            return SlabArray(part, tuple(map(int, ends)), self.functions)
        key = key if isinstance(key, tuple) else (key,)
        first, *others = key
        if first is Ellipsis and not others:
            return self
        if not isinstance(first, slice):
            raise TypeError(f"the rows of an array in slabs are taken by slices, not by {first!r}")
        start, stop, step = first.indices(self.shape[0])
        count = len(range(start, stop, step))
        edges = tuple(min(count, max(0, -((start - edge) // step))) for edge in self.edges)
        begin, rank = self.edges[self.functions.rank], self.functions.rank
        mine = slice(start + edges[rank] * step - begin, start + edges[rank + 1] * step - begin, step)
        if edges[rank] == edges[rank + 1]:
            mine = slice(0, 0)
        return SlabArray(self.local[(mine, *others)], edges, self.functions)

    def __setitem__(self, key: Any, value: Any) -> None:
        if key is not Ellipsis:
            raise TypeError("entries of an array in slabs are set all at once: array[...] = values")
        self.local[...] = self.rows_of(value)

    def __neg__(self) -> SlabArray:
        return self.like(-self.local)

    def __invert__(self) -> SlabArray:
        return self.like(~self.local)

    __lt__, __le__ = _plain(operator.lt), _plain(operator.le)
    __gt__, __ge__ = _plain(operator.gt), _plain(operator.ge)
    __eq__, __ne__ = _plain(operator.eq), _plain(operator.ne)
    __add__, __radd__, __iadd__ = _plain(operator.add), _reflected(operator.add), _in_place(operator.iadd)
    __sub__, __rsub__, __isub__ = _plain(operator.sub), _reflected(operator.sub), _in_place(operator.isub)
    __mul__, __rmul__, __imul__ = _plain(operator.mul), _reflected(operator.mul), _in_place(operator.imul)
    __truediv__, __rtruediv__ = _plain(operator.truediv), _reflected(operator.truediv)
    __itruediv__ = _in_place(operator.itruediv)
    __pow__, __rpow__ = _plain(operator.pow), _reflected(operator.pow)
    __and__, __rand__, __iand__ = _plain(operator.and_), _reflected(operator.and_), _in_place(operator.iand)
    __or__, __ror__, __ior__ = _plain(operator.or_), _reflected(operator.or_), _in_place(operator.ior)
