"""One variable of many records, laid side by side."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import xarray

__all__ = ["Column"]

Array = npt.NDArray[Any]
Place = tuple[int, ...]

_NOTHING: dict[str, Any] = {"f": math.nan, "b": False, "U": "", "i": 0, "u": 0}


@dataclass(slots=True, eq=False)
class Column:
    """A variable as the records bring it along, one after the other.

    Parameters
    ----------
    name : str
    dims : tuple of str
        Its dimensions in every record.
    attributes : dict
        Those that all records agree on.
    same : bool
        Whether no record differs from the first.
    """

    name: str
    dims: tuple[str, ...]
    attributes: dict[str, Any]
    same: bool = True
    _places: list[Place] = field(default_factory=list)
    _values: list[Array] = field(default_factory=list)

    def __len__(self) -> int:
        """Return the number of records that have it."""
        return len(self._places)

    def add(self, place: Place, variable: xarray.Variable) -> None:
        """Take it from the record of the case at a place.

        Raises
        ------
        ValueError
            If it has other dimensions or another unit than before.
        """
        if variable.dims != self.dims:
            raise ValueError(
                f"{self.name!r} lies along {variable.dims} in one record and along {self.dims} in another: "
                "such cases make two studies"
            )
        self._agree(variable.attrs)
        values = variable.to_numpy()
        if self._values and _equal(values, self._values[0]):
            values = self._values[0]  # once is enough
        elif self._values:
            self.same = False
        self._places.append(place)
        self._values.append(values)

    def once(self) -> Array:
        """Return the values of the first record."""
        return self._values[0]

    def longest(self) -> Array | None:
        """Return the values of the longest record where all others begin like it, of one dimension; else None."""
        longest = max(self._values, key=len)
        return longest if all(np.array_equal(each, longest[: len(each)]) for each in self._values) else None

    def spread(self, cases: tuple[int, ...], sizes: tuple[int, ...]) -> Array:
        """Return the values of all cases, in an array of their shape with its own dimensions of these sizes behind.

        What is missing is NaN, an empty word or False; whole numbers become real ones where one is missing.
        """
        dtype = np.result_type(*{each.dtype for each in self._values})
        there = sum(each.size for each in self._values)
        if dtype.kind in "iu" and there < math.prod(cases) * math.prod(sizes):
            dtype = np.dtype(np.float64)
        laid = np.full((*cases, *sizes), _NOTHING[dtype.kind], dtype=dtype)
        for place, values in zip(self._places, self._values, strict=True):
            where: tuple[int | slice, ...] = (*place, *(slice(n) for n in values.shape))
            laid[where] = values
        return laid

    def _agree(self, attributes: dict[Any, Any]) -> None:
        if attributes == self.attributes:
            return
        one, other = self.attributes.get("units"), attributes.get("units")
        if self._places and one != other:
            raise ValueError(
                f"{self.name!r} is in {one} in one record and in {other} in another: such cases make two studies"
            )
        self.attributes = {
            key: value for key, value in self.attributes.items() if attributes.get(key) == value
        }


def _equal(one: Array, other: Array) -> bool:
    return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
