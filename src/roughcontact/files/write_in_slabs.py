"""Planes in slabs as one file: all processes make the same call, and what goes wrong on one is raised on all."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.files.aside import written_aside
from roughcontact.files.write import netcdf_bytes
from roughcontact.labels.labelled import attributes_of
from roughcontact.slabs.agreement import by_each, by_first, entered_by_first
from roughcontact.slabs.by_rows import gather_to_first
from roughcontact.slabs.slab_array import SlabArray

if TYPE_CHECKING:
    import xarray

__all__ = ["write_netcdf_in_slabs", "write_npy_in_slabs"]

CHUNK = 256  # rows and columns of the parts of a map, each compressed by itself


def write_npy_in_slabs(heights: SlabArray, path: str | os.PathLike[str]) -> None:
    """Write heights as ``numpy.save`` would: each process its rows."""
    functions, mine = heights.functions, np.ascontiguousarray(heights.local, "<f8")
    before = heights.edges[functions.rank] * math.prod(heights.shape[1:]) * mine.itemsize

    with entered_by_first(functions.communicator, lambda: written_aside(path)) as aside:

        def begin() -> int:
            with open(aside, "wb") as file:
                header = {"descr": "<f8", "fortran_order": False, "shape": heights.shape}
                np.lib.format.write_array_header_1_0(file, header)
                start = file.tell()
                file.truncate(start + heights.size * mine.itemsize)
            return start

        start = by_first(functions.communicator, begin)

        def write() -> None:
            with open(aside, "r+b") as file:
                file.seek(start + before)
                file.write(mine.data if mine.size else b"")

        by_each(functions.communicator, write)


def write_netcdf_in_slabs(
    numbers: xarray.Dataset, maps: Mapping[str, SlabArray], path: str | os.PathLike[str]
) -> None:
    """Write numbers and maps as one NetCDF-4 file: by the first process, which takes the rows in turn.

    Parameters
    ----------
    numbers : Dataset
        With the coordinates of the maps, ``y`` and ``x``.
    maps : mapping of str to SlabArray
        By their names in the table of variables.
    path : str or path
        What the first process says.
    """
    import h5netcdf

    communicator = next(iter(maps.values())).functions.communicator
    with entered_by_first(communicator, lambda: written_aside(path)) as aside:
        # Only the maps are too large to be made in memory, where a full disk does no harm to HDF5.
        by_first(communicator, lambda: aside.write_bytes(netcdf_bytes(numbers)))
        for name, field in maps.items():
            for start, rows in gather_to_first(field, CHUNK):

                def write(
                    name: str = name, field: SlabArray = field, start: int = start, rows: Any = rows
                ) -> None:
                    with h5netcdf.File(aside, "a") as file:
                        stored = file[name] if start else _new_map(file, name, field)
                        stored[start : start + len(rows)] = rows

                by_first(communicator, write)


def _new_map(file: Any, name: str, field: SlabArray) -> Any:
    """Return a new variable of a file, stored as xarray would: compressed without loss, truth values as numbers."""
    truth, real = field.dtype.kind == "b", field.dtype.kind == "f"
    stored = file.create_variable(
        name,
        ("y", "x"),
        np.dtype("int8") if truth else field.dtype,
        fillvalue=np.nan if real else None,
        chunks=tuple(min(CHUNK, n) for n in field.shape),
        compression="gzip",
        compression_opts=4,
        shuffle=True,
    )
    stored.attrs.update(attributes_of(name) | ({"dtype": "bool"} if truth else {}))
    return stored
