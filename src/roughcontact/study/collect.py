"""The variables of many records, collected one record after the other."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError

if TYPE_CHECKING:
    import xarray

__all__ = ["Collector"]

Array = npt.NDArray[Any]
Place = tuple[int, ...]
Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]]

_NOTHING: dict[str, Any] = {"f": math.nan, "b": False, "U": "", "i": 0, "u": 0}


@dataclass(slots=True, eq=False)
class GatheredColumn:
    """A variable of the records, collected from one record after the other.

    Parameters
    ----------
    name : str
    dims : tuple of str
        Its dimensions in every record.
    attributes : dict
        The attributes that are equal in all records.
    same : bool
        Whether all records are equal to the first.
    """

    name: str
    dims: tuple[str, ...]
    attributes: dict[str, Any]
    same: bool = True
    _places: list[Place] = field(default_factory=list)
    _values: list[Array] = field(default_factory=list)

    def __len__(self) -> int:
        """Return the number of records that contain the variable."""
        return len(self._places)

    def add(self, place: Place, variable: xarray.Variable) -> None:
        """Add the variable from the record of the case at a place.

        Raises
        ------
        ValueError
            If it has other dimensions or another unit than before.
        """
        if variable.dims != self.dims:
            raise InputError(
                f"{self.name!r} has the dimensions {variable.dims} in one record and {self.dims} in another",
                "make two studies of such cases",
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
        """Return the values of the longest record, in one dimension, if all records begin like it; otherwise None."""
        longest = max(self._values, key=len)
        return longest if all(np.array_equal(each, longest[: len(each)]) for each in self._values) else None

    def spread(self, cases: tuple[int, ...], sizes: tuple[int, ...]) -> Array:
        """Return the values of all cases, in an array of the cases' shape followed by the dimensions of the variable.

        Missing values are NaN, an empty word or False; whole numbers become real ones if one is missing.
        """
        dtype = np.result_type(*{each.dtype for each in self._values})
        there = sum(each.size for each in self._values)
        if dtype.kind in "iu" and there < math.prod(cases) * math.prod(sizes):
            dtype = np.dtype(np.float64)
        filled = np.full((*cases, *sizes), _NOTHING[dtype.kind], dtype=dtype)
        for place, values in zip(self._places, self._values, strict=True):
            where: tuple[int | slice, ...] = (*place, *(slice(n) for n in values.shape))
            filled[where] = values
        return filled

    def _agree(self, attributes: dict[Any, Any]) -> None:
        if attributes == self.attributes:
            return
        one, other = self.attributes.get("units"), attributes.get("units")
        if self._places and one != other:
            raise InputError(
                f"{self.name!r} is in {one} in one record and in {other} in another",
                "make two studies of such cases",
            )
        self.attributes = {
            key: value for key, value in self.attributes.items() if attributes.get(key) == value
        }


@dataclass(slots=True, eq=False)
class Collector:
    """The records of many cases.

    Parameters
    ----------
    cases : dict of int
        Dimensions of the cases and their sizes.
    taken : set of str
        Reserved names: variables of these names are renamed to ``record_NAME``.
    """

    cases: Mapping[str, int]
    taken: frozenset[str]
    attributes: dict[str, Any] = field(default_factory=dict)
    _count: int = 0
    _columns: dict[str, GatheredColumn] = field(default_factory=dict)
    _lengths: dict[str, int] = field(default_factory=dict)
    _coordinates: set[str] = field(default_factory=set)

    @property
    def names(self) -> set[str]:
        """Names of all variables and dimensions of the records."""
        return self._columns.keys() | self._lengths.keys()

    def add(self, place: Place, record: xarray.Dataset) -> None:
        """Add the record of the case at a place.

        Raises
        ------
        ValueError
            If a variable has other dimensions or another unit than before.
        """
        clash = self.taken & (record.variables.keys() | record.sizes.keys())
        if clash:
            record = record.rename({name: f"record_{name}" for name in clash})
        for name, variable in record.variables.items():
            column = self._columns.get(str(name))
            if column is None:
                dims = tuple(map(str, variable.dims))
                column = self._columns[str(name)] = GatheredColumn(str(name), dims, dict(variable.attrs))
            column.add(place, variable)
        for dimension, size in record.sizes.items():
            self._lengths[str(dimension)] = max(size, self._lengths.get(str(dimension), 0))
        self._coordinates |= {str(name) for name in record.coords}
        agreed = record.attrs if self._count == 0 else self.attributes
        self.attributes = {key: value for key, value in agreed.items() if record.attrs.get(key) == value}
        self._count += 1

    def variables(self) -> tuple[Variables, Variables]:
        """Return variables and coordinates, each with dimensions and attributes; the collected values are released."""
        data: Variables = {}
        coordinates: Variables = {}
        while self._columns:
            name = next(iter(self._columns))
            column = self._columns.pop(name)
            sizes = tuple(self._lengths[d] for d in column.dims)
            single = self._kept_once(column, sizes, name in self._coordinates)
            if single is not None:
                found = column.dims, single, column.attributes
            else:
                spread = column.spread(tuple(self.cases.values()), sizes)
                found = (*self.cases, *column.dims), spread, column.attributes
            if single is None and column.dims == (name,):
                data[f"record_{name}"] = found  # differing coordinates cannot be one coordinate
            else:
                (coordinates if name in self._coordinates else data)[name] = found
        return data, coordinates

    def _kept_once(self, column: GatheredColumn, sizes: tuple[int, ...], coordinate: bool) -> Any:
        """Return the values that are the same in all records; None if they differ."""
        if column.dims == (column.name,):
            longest = column.longest()
            return longest if longest is not None and longest.shape == sizes else None
        # A single record trivially agrees, which does not make its values constant in a study.
        agree = column.same and len(column) == self._count and (self._count > 1 or coordinate)
        return column.once() if agree else None


def _equal(one: Array, other: Array) -> bool:
    return one.dtype == other.dtype and np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
