"""The pieces that labelled answers are made of: variables with units, plain values."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.variables import VARIABLES, unit_of

if TYPE_CHECKING:
    import xarray


__all__ = [
    "attributes_of",
    "centres",
    "dataset_of",
    "described",
    "plain_values",
    "sizes",
    "units_of",
    "variable",
]


def variable(
    name: str, dimensions: tuple[str, ...], values: Any, geometry: Geometry = Geometry.SURFACE
) -> tuple[Any, Any, dict[str, str]]:
    """Return the triple (dimensions, values, attributes) that xarray takes as a variable."""
    return dimensions, np.asarray(values), attributes_of(name, geometry)


def attributes_of(name: str, geometry: Geometry = Geometry.SURFACE) -> dict[str, str]:
    """Return what a variable says of itself: its name in words, and its unit if it has one."""
    unit = unit_of(name, geometry)
    return {"long_name": VARIABLES[name].long_name} | ({"units": unit} if unit else {})


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
    data: dict[str, Any], coordinates: dict[str, Any], title: str, geometry: Geometry
) -> xarray.Dataset:
    """Return the variables and coordinates as a dataset, with the names of the grid's axes."""
    import xarray

    words = "axis of the map: rows run along x, down the picture is y" if len(geometry.axes) == 2 else "axis"
    axis = (("axis",), list(geometry.axes), {"long_name": words})
    attributes = {"Conventions": "CF-1.11", "title": title, "geometry": geometry.value}
    return xarray.Dataset(data, coordinates | {"axis": axis}, attributes)


def units_of(record: dict[str, Any], geometry: Geometry) -> dict[str, str]:
    """Return the units of those names in a record that have one."""
    units = {name: unit_of(name, geometry) for name in record if name in VARIABLES}
    return {name: unit for name, unit in units.items() if unit}


def plain_values(value: Any) -> Any:
    """Return a number, an array or a sequence as built-in types, with None for what is not finite."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    elif isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, list | tuple):
        return [plain_values(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
