"""Results on disk: NetCDF-4 for everything, CSV for tables, JSON for scripts."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Hashable, Iterable, Mapping
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.files.aside import WriteError, written_aside
from roughcontact.files.installed import lacking
from roughcontact.labels.labelled import attributes_of
from roughcontact.labels.variables import VARIABLES
from roughcontact.slabs.agreement import by_first, entered_by_first
from roughcontact.slabs.by_rows import gather_to_first
from roughcontact.slabs.one_process import OneProcess
from roughcontact.slabs.slab_array import SlabArray

if TYPE_CHECKING:
    import xarray

__all__ = [
    *("netcdf_bytes", "in_parts", "plain_cells", "require_netcdf"),
    *("write_csv", "write_json", "write_netcdf", "write_table", "write_text"),
]

Attributes = Mapping[str, str | float]

_UNEVEN = ("time", "sliding_speed")  # dimensions whose values are a column of a table
CHUNK = 256  # rows and columns of the parts of a map in slabs, each compressed separately


def write_netcdf(
    dataset: xarray.Dataset,
    path: str | os.PathLike[str],
    provenance: Attributes | None = None,
    maps: Mapping[str, SlabArray] = MappingProxyType({}),
) -> None:
    """Write a dataset as NetCDF-4, which xarray, netCDF4 and any HDF5 reader open.

    Maps are compressed without loss. `provenance` (see `roughcontact.files.provenance`) becomes
    attributes of the file. The file appears whole or not at all.

    Parameters
    ----------
    dataset : Dataset
        Includes the coordinates of the maps in slabs, ``y`` and ``x``.
    path : str or path
        With maps in slabs, that of the first process is used.
    provenance : mapping, optional
    maps : mapping of str to SlabArray
        Fields in slabs by their names in the table of variables: all processes must call, and the first one collects
        the rows one process at a time.

    Raises
    ------
    WriteError
        If the file cannot be written.
    """
    whole = dataset.assign_attrs(dict(provenance or {}))
    communicator = next((field.functions.communicator for field in maps.values()), OneProcess())
    with entered_by_first(communicator, lambda: written_aside(path)) as aside:
        # Everything except the maps is built in memory, where a full disk does no harm to HDF5.
        by_first(communicator, lambda: aside.write_bytes(netcdf_bytes(whole)))
        for name, field in maps.items():
            for start, rows in gather_to_first(field, CHUNK):
                by_first(communicator, partial(_write_rows, aside, name, field, start, rows))


def _write_rows(path: Path, name: str, field: SlabArray, start: int, rows: Any) -> None:
    import h5netcdf

    with h5netcdf.File(path, "a") as file:
        stored = file[name] if start else _new_map(file, name, field)
        stored[start : start + len(rows)] = rows


def _new_map(file: Any, name: str, field: SlabArray) -> Any:
    """Return a new variable of a file, stored as by xarray: compressed without loss, truth values as numbers."""
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
    stored.attrs.update(attributes_of(VARIABLES[name]) | ({"dtype": "bool"} if truth else {}))
    return stored


def netcdf_bytes(dataset: xarray.Dataset) -> bytes:
    """Return a dataset as the bytes of a NetCDF-4 file; maps are compressed without loss.

    They are built in memory, because HDF5 crashes the process if the disk is full.
    """
    require_netcdf()
    import h5netcdf
    from xarray.backends import H5NetCDFStore

    # Shuffled bytes compress better; higher levels than 4 take more time and save almost no space.
    maps = [name for name, values in dataset.variables.items() if values.ndim > 1 and values.size]
    encoding: dict[Any, dict[str, Any]] = {
        name: {"zlib": True, "complevel": 4, "shuffle": True} for name in maps
    }
    # CF requires a fill value only where values can be missing; coordinates are never missing.
    encoding |= {
        name: {"_FillValue": None} for name, values in dataset.coords.items() if values.dtype.kind == "f"
    }
    stream = io.BytesIO()
    with h5netcdf.File(stream, "w") as file:
        dataset.dump_to_store(H5NetCDFStore(file), encoding=encoding)
    return stream.getvalue()


def require_netcdf() -> None:
    """Refuse NetCDF if no package can write it; call this before a long computation.

    Raises
    ------
    WriteError
        If the package that writes it is not installed.
    """
    if (lack := lacking("h5py", "h5netcdf")) is not None:
        raise WriteError(f"NetCDF needs {lack[0]}", lack[1])


def write_csv(dataset: xarray.Dataset, path: str | os.PathLike[str], *, dimension: str | None = None) -> None:
    """Write the points of a curve or spectrum, or the scalars of one state, as a table of comma-separated values.

    The first line names the columns with their units: ``force [N]``. Each further line is a point, every number with
    all its digits; truth values are 1 and 0. Scales such as the modulus are columns of equal values.
    `pandas.read_csv` and spreadsheets read it without options, `numpy.genfromtxt` with ``delimiter=",", names=True``.
    A vector with a ``component`` or an ``axis`` takes one column for each: ``tangential_force_x``, ``lengths_y``.

    Parameters
    ----------
    dataset : Dataset
    path : str or path
    dimension : str, optional
        The dimension of the points; by default ``load``, ``time`` or ``sliding_speed``, or a single row if there is
        no such dimension.

    Raises
    ------
    ValueError
        If the dataset has no such dimension.
    WriteError
        If the file cannot be written.
    """
    if dimension is None:
        dimension = next((name for name in ("load", *_UNEVEN) if name in dataset.sizes), None)
    if dimension is not None and dimension not in dataset.sizes:
        raise InputError(
            f"nothing lies along {dimension!r}", f"choose one of {', '.join(map(str, dataset.sizes))}"
        )
    along = () if dimension is None else (dimension,)
    columns: dict[str, xarray.DataArray] = {}
    if dimension in _UNEVEN:
        columns[dimension] = dataset[dimension]
    for name, values in dataset.data_vars.items():
        if values.dims in (along, ()):
            columns[str(name)] = values
        elif len(parts := set(values.dims) - set(along)) == 1 and parts <= {"component", "axis"}:
            columns |= in_parts(values, *parts)
    # Points before scales; words last: readers of pure numbers can select the columns before them.
    columns = dict(
        sorted(columns.items(), key=lambda each: (each[1].dtype.kind in "OUT", each[1].dims != along))
    )
    count = 1 if dimension is None else dataset.sizes[dimension]
    cells = (np.broadcast_to(plain_cells(each.to_numpy()), count).tolist() for each in columns.values())
    write_table(path, columns, zip(*cells, strict=True))


def write_table(
    path: str | os.PathLike[str], columns: Mapping[str, xarray.DataArray], rows: Iterable[Iterable[Any]]
) -> None:
    """Write a line with the names and units of the columns, and the rows; the file appears whole or not at all."""
    # The same line ends on every system: equal results give equal files.
    with written_aside(path) as aside, open(aside, "w", encoding="utf-8", newline="\n") as file:
        table = csv.writer(file, lineterminator="\n")  # it writes all digits of a real number, by `repr`
        table.writerow(_title(name, values.attrs.get("units", "1")) for name, values in columns.items())
        table.writerows(rows)


def _title(name: str, unit: str) -> str:
    return name if unit in ("", "1") else f"{name} [{unit}]"


def in_parts(values: xarray.DataArray, dimension: Hashable) -> dict[str, xarray.DataArray]:
    """Return a variable as one column for each name along a dimension: ``lengths_y``, ``lengths_x``."""
    return {
        f"{values.name}_{part}": values.sel({dimension: part})
        for part in values[dimension].to_numpy().tolist()
    }


def plain_cells(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return values with 1 and 0 for truth values."""
    return values.astype(np.int8) if values.dtype.kind == "b" else values


def write_json(
    record: Mapping[str, Any], path: str | os.PathLike[str], provenance: Attributes | None = None
) -> None:
    """Write a record as one JSON object, with the provenance under ``"provenance"``.

    Raises
    ------
    WriteError
        If the file cannot be written.
    """
    added = {name: value for name, value in (provenance or {}).items() if name not in record}
    whole = dict(record) | ({"provenance": added} if added else {})
    # Strict JSON: a NaN is an error here, because readers would refuse the file later.
    write_text(json.dumps(whole, indent=2, ensure_ascii=False, allow_nan=False) + "\n", path)


def write_text(text: str, path: str | os.PathLike[str]) -> None:
    """Write a text; the file appears whole or not at all.

    Raises
    ------
    WriteError
        If the file cannot be written.
    """
    with written_aside(path) as aside:
        aside.write_text(text, encoding="utf-8", newline="\n")
