"""Records side by side: their variables, gathered one record after the other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from roughcontact.study.columns import Column, Place

if TYPE_CHECKING:
    import xarray

__all__ = ["Gathering"]

Variables = dict[str, tuple[tuple[str, ...], Any, dict[str, Any]]]


@dataclass(slots=True, eq=False)
class Gathering:
    """The records of many cases.

    Parameters
    ----------
    cases : dict of int
        Dimensions of the cases and their sizes.
    taken : set of str
        Names that are not free: what a record calls so is called ``record_NAME``.
    """

    cases: Mapping[str, int]
    taken: frozenset[str]
    attributes: dict[str, Any] = field(default_factory=dict)
    _count: int = 0
    _columns: dict[str, Column] = field(default_factory=dict)
    _lengths: dict[str, int] = field(default_factory=dict)
    _coordinates: set[str] = field(default_factory=set)

    @property
    def names(self) -> set[str]:
        """Names of all variables and dimensions of the records."""
        return self._columns.keys() | self._lengths.keys()

    def add(self, place: Place, record: xarray.Dataset) -> None:
        """Take the record of the case at a place.

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
                column = self._columns[str(name)] = Column(str(name), dims, dict(variable.attrs))
            column.add(place, variable)
        for dimension, size in record.sizes.items():
            self._lengths[str(dimension)] = max(size, self._lengths.get(str(dimension), 0))
        self._coordinates |= {str(name) for name in record.coords}
        agreed = record.attrs if self._count == 0 else self.attributes
        self.attributes = {key: value for key, value in agreed.items() if record.attrs.get(key) == value}
        self._count += 1

    def laid(self) -> tuple[Variables, Variables]:
        """Return variables and coordinates, each with its dimensions and attributes; what was gathered is gone."""
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
                data[f"record_{name}"] = found  # coordinates of points that differ are no coordinate
            else:
                (coordinates if name in self._coordinates else data)[name] = found
        return data, coordinates

    def _kept_once(self, column: Column, sizes: tuple[int, ...], coordinate: bool) -> Any:
        """Return the values that all records agree on; None where they do not."""
        if column.dims == (column.name,):
            longest = column.longest()
            return longest if longest is not None and longest.shape == sizes else None
        # One record agrees with itself: this says nothing about a study.
        agree = column.same and len(column) == self._count and (self._count > 1 or coordinate)
        return column.once() if agree else None
