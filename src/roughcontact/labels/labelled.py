"""Parts of labelled answers: variables with units, plain values."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from enum import Enum
from operator import attrgetter
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from roughcontact.arrays import on_host
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.column import CELLS, Column, Table
from roughcontact.labels.variables import VARIABLES

if TYPE_CHECKING:
    import pandas
    import xarray


__all__ = [
    "attributes_of",
    "centres",
    "dataframe_of",
    "dataset_of",
    "described",
    "plain_values",
    "record_of",
    "sizes",
    "units_of",
    "values_of",
    "variable",
    "variables_of",
]

Variables: TypeAlias = dict[str, tuple[Any, Any, dict[str, str]]]
"""Dimensions, values and attributes of each variable, as xarray takes them."""
Names: TypeAlias = Mapping[str, str]
"""Attributes of an answer whose name differs from that of the column; dotted for those of a part."""
_SAME: Names = MappingProxyType({})


def values_of(answer: Any, columns: Iterable[Column], names: Names = _SAME) -> dict[Column, Any]:
    """Return the values of an answer for some columns."""
    return {column: attrgetter(names.get(column.name, column.name))(answer) for column in columns}


def variables_of(answer: Any, table: Table, geometry: Geometry, names: Names = _SAME) -> Variables:
    """Return the values of an answer for a table, as variables with units and long names."""
    return {
        column.name: (
            tuple(axis for each in along for axis in (geometry.axes if each == CELLS else (each,))),
            _array(value),
            attributes_of(column, geometry),
        )
        for along, columns in table.items()
        for column, value in values_of(answer, columns, names).items()
    }


def record_of(variables: Variables, geometry: Geometry, **more: Any) -> dict[str, Any]:
    """Return variables as plain values that JSON can hold, with `more` of them; units stand once, under ``"units"``.

    JSON has neither NaN nor infinity: both become None.
    """
    record = {name: plain_values(values) for name, (_, values, _) in variables.items()} | more
    return record | {"geometry": geometry.value, "units": units_of(record, geometry)}


def _array(value: Any) -> Any:
    """Return a NumPy array: truth values stay, members of an enumeration become words."""
    if isinstance(value, tuple) and value and isinstance(value[0], Enum):
        return np.array([each.value for each in value])
    if isinstance(value, Enum):
        return np.asarray(value.value)
    if not hasattr(value, "dtype") or isinstance(value, np.generic):
        return np.asarray(value)
    return on_host(value).astype(bool) if "bool" in str(value.dtype) else on_host(value)


def variable(
    name: str, dimensions: tuple[str, ...], values: Any, geometry: Geometry = Geometry.SURFACE
) -> tuple[Any, Any, dict[str, str]]:
    """Return the triple (dimensions, values, attributes) that xarray takes as a variable."""
    return dimensions, np.asarray(values), attributes_of(VARIABLES[name], geometry)


def attributes_of(column: Column, geometry: Geometry = Geometry.SURFACE) -> dict[str, str]:
    """Return the attributes of a variable: its name in words, and its unit if it has one."""
    unit = column.unit_on(geometry)
    return {"long_name": column.long_name} | ({"units": unit} if unit else {})


def described(
    dimensions: str | tuple[str, ...], values: Any, words: str, unit: str = "1"
) -> tuple[Any, Any, Any]:
    """Return the triple that xarray takes as a variable, of a quantity that no table names."""
    return dimensions, values, {"units": unit, "long_name": words}


def sizes(grid: Any) -> dict[str, Any]:
    """Return ``lengths``, ``spacing`` and ``periodic`` of a grid, or of a curve on one: a value for each axis."""
    return {
        name: variable(name, ("axis",), getattr(grid, name)) for name in ("lengths", "spacing", "periodic")
    }


def centres(grid: AnyGrid, geometry: Geometry) -> dict[str, Any]:
    """Return the centres of the cells along each axis of a grid [m], as coordinates."""
    places = zip(geometry.axes, grid.coordinates, strict=True)
    return {axis: variable(axis, (axis,), values) for axis, values in places}


def dataset_of(
    data: Mapping[str, Any], coordinates: dict[str, Any], title: str, geometry: Geometry
) -> xarray.Dataset:
    """Return the variables and coordinates as a dataset, with the names of the grid's axes."""
    import xarray

    words = "axis of the map: rows run along x, down the picture is y" if len(geometry.axes) == 2 else "axis"
    axis = (("axis",), list(geometry.axes), {"long_name": words})
    attributes = {"Conventions": "CF-1.11", "title": title, "geometry": geometry.value}
    return xarray.Dataset(dict(data), coordinates | {"axis": axis}, attributes)


def dataframe_of(dataset: xarray.Dataset, dimension: str) -> pandas.DataFrame:
    """Return the variables along a dimension as a table of pandas; ``attrs["units"]`` holds the unit of each column."""
    columns = dataset[[name for name, values in dataset.items() if values.dims == (dimension,)]]
    frame = columns.to_dataframe()
    frame.attrs["units"] = {name: values.attrs.get("units", "") for name, values in columns.items()}
    return frame


def units_of(record: dict[str, Any], geometry: Geometry) -> dict[str, str]:
    """Return the units of the names in a record, where a name has one."""
    units = {name: VARIABLES[name].unit_on(geometry) for name in record if name in VARIABLES}
    return {name: unit for name, unit in units.items() if unit}


def plain_values(value: Any) -> Any:
    """Return a number, an array or a sequence as built-in types, with None for values that are not finite."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    elif isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, list | tuple):
        return [plain_values(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
