"""How surfaces become datasets of xarray and come from its arrays: the door from heights to the room of files."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray

    from roughcontact.files.assemble import Length, Size
    from roughcontact.surface.surface import Surface

__all__ = ["surface_from_dataarray", "surface_to_dataset"]


def surface_to_dataset(surface: Surface) -> xarray.Dataset:
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
    from roughcontact.files.surface_dataset import surface_dataset

    return surface_dataset(surface)


def surface_from_dataarray(
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
        Unit of the heights, as for `roughcontact.read`: it goes before what the array states.
    size : length or pair of lengths, optional
        Width Lx, or ``(Ly, Lx)``, as for `roughcontact.read`: it goes before what the coordinates state.
    periodic : bool or pair of bool, optional
        Whether the surface repeats itself (along y and x). Without it the coordinates state it, or the surface is free.

    Returns
    -------
    Surface

    Raises
    ------
    ReadError
        If the array is silent about a unit or size that is not given here, or its coordinates are not even.
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
    from roughcontact.files.surface_dataset import surface_of

    return surface_of(array, unit, size, periodic)
