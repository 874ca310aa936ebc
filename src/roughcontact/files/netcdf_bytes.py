"""A dataset as the bytes of a NetCDF-4 file."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray

__all__ = ["netcdf_bytes"]


def netcdf_bytes(dataset: xarray.Dataset) -> bytes:
    """Return a dataset as the bytes of a NetCDF-4 file; maps are compressed without loss.

    They are made in memory since HDF5 does not survive a disk that fills up: it takes the process down with it.
    """
    import h5netcdf
    from xarray.backends import H5NetCDFStore

    # Shuffled bytes compress better; level 4 is where more time stops buying size.
    maps = [name for name, values in dataset.variables.items() if values.ndim > 1 and values.size]
    encoding: dict[Any, dict[str, Any]] = {
        name: {"zlib": True, "complevel": 4, "shuffle": True} for name in maps
    }
    # CF wants a fill value only where something can be missing: coordinates never are.
    encoding |= {
        name: {"_FillValue": None} for name, values in dataset.coords.items() if values.dtype.kind == "f"
    }
    stream = io.BytesIO()
    with h5netcdf.File(stream, "w") as file:
        dataset.dump_to_store(H5NetCDFStore(file), encoding=encoding)
    return stream.getvalue()
