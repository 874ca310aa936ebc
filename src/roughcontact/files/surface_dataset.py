"""Surfaces as datasets of xarray, and arrays of xarray as surfaces."""

from __future__ import annotations

import hashlib
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.errors import InputError
from roughcontact.files.assemble import Length, Size, assemble, plain_lengths
from roughcontact.files.content import named
from roughcontact.files.file_errors import SurfaceWarning
from roughcontact.files.netcdf import StoredVariable, height_map_of
from roughcontact.files.provenance import provenance
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import centres, dataset_of, sizes, variable
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.units import in_si

if TYPE_CHECKING:
    import xarray

__all__ = ["dataset_without_heights", "surface_dataset", "surface_of"]


@analysed_on_host
def surface_dataset(surface: Surface) -> xarray.Dataset:
    """Return the heights as a dataset of xarray, with units, places of the cells, and provenance.

    Parameters
    ----------
    surface : Surface

    Returns
    -------
    Dataset
        ``heights`` [m] along ``y`` and ``x``, or ``x``; the coordinates state whether the surface is periodic.

    Examples
    --------
    >>> import roughcontact as rc
    >>> dataset = rc.examples.surface("ground").to_dataset()
    >>> dict(dataset["heights"].sizes), dataset["heights"].attrs["units"]
    ({'y': 192, 'x': 256}, 'm')
    """
    heights = variable("heights", Geometry.of(surface.grid).axes, surface.heights)
    return dataset_without_heights(surface, {"heights": heights})


def dataset_without_heights(surface: Surface, maps: dict[str, Any]) -> xarray.Dataset:
    """Return the metadata that is stored with a surface, together with `maps`."""
    grid, geometry = surface.grid, Geometry.of(surface.grid)
    dataset = dataset_of(sizes(grid) | maps, centres(grid, geometry), "heights of a surface", geometry)
    for axis, length, periodic in zip(geometry.axes, grid.lengths, grid.periodic, strict=True):
        # A single array of the dataset keeps its coordinates, and no other variable.
        dataset[axis].attrs |= {"length": length, "periodic": int(periodic)}
    return dataset.assign_attrs(provenance(surface))


def surface_of(
    array: xarray.DataArray,
    *,
    unit: Length | None = None,
    size: Size | None = None,
    periodic: bool | tuple[bool, ...] | None = None,
) -> Surface:
    """Return the surface in an array of xarray: heights with their unit, cells from the coordinates.

    Parameters
    ----------
    array : DataArray
        Heights along ``y`` and ``x``, or along one dimension, with their unit in ``attrs["units"]`` or as quantities.
        Coordinates of even steps with a unit state the size of the cells; their ``attrs["periodic"]`` states whether
        the surface repeats itself.
    unit : str or float, optional
        Unit of the heights, as for `roughcontact.read`: it overrides the unit of the array.
    size : length or pair of lengths, optional
        Width Lx, or ``(Ly, Lx)``, as for `roughcontact.read`: it overrides the coordinates.
    periodic : bool or pair of bool, optional
        Whether the surface repeats itself (along y and x). By default as the coordinates state; free if they state
        nothing.

    Returns
    -------
    Surface

    Raises
    ------
    ReadError
        If the array states no unit or size and none is given here, or its coordinates are not even.
    ValueError
        If it is not an array of xarray, or `unit` or `size` is not a length.

    Warns
    -----
    SurfaceWarning
        As for `roughcontact.read`.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray
    >>> import roughcontact as rc
    >>> x = ("x", np.arange(64) * 0.5, {"units": "um"})
    >>> wave = xarray.DataArray(100 * np.cos(np.arange(64) / 5), {"x": x}, "x", attrs={"units": "nm"})
    >>> rc.Surface.from_dataarray(wave).grid
    Grid(shape=(64,), spacing=(5e-07,), periodic=(False,))
    """
    if not hasattr(array, "coords"):
        raise InputError(
            f"an xarray.DataArray is needed, not a {type(array).__name__}",
            "give Surface(heights, grid)",
            place="array",
        )
    unit, size = plain_lengths(unit, size)
    variables = {"heights": _stored(array)}
    variables |= {str(axis): _stored(array.coords[axis]) for axis in array.dims if axis in array.coords}
    with named(f"DataArray {str(array.name or 'heights')!r}") as label:
        found = height_map_of(variables, {}, "heights", "xarray")
        digest = hashlib.sha256(np.ascontiguousarray(found.heights).tobytes()).hexdigest()[:16]
        surface, messages = assemble(found, label, digest, unit=unit, size=size, periodic=periodic)
    for message in messages:
        warnings.warn(f"{label}: {message}", SurfaceWarning, stacklevel=2)
    return surface


def _stored(array: xarray.DataArray) -> StoredVariable:
    """Return an array as a variable of a file; for quantities of pint, their unit is stored."""
    values, attributes = array.data, dict(array.attrs)
    if hasattr(values, "units"):
        attributes["units"], values = "m", in_si(values, "m", str(array.name or "heights"))
    plain = np.asarray(values)
    return StoredVariable(tuple(map(str, array.dims)), plain.shape, plain.dtype, attributes, lambda: plain)
