"""Results on disk: NetCDF-4 for everything, CSV for tables, JSON for scripts."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from roughcontact.files.aside import written_aside

if TYPE_CHECKING:
    import xarray

__all__ = ["netcdf_bytes", "write_csv", "write_json", "write_netcdf"]

Attributes = Mapping[str, str | float]


def write_netcdf(
    dataset: xarray.Dataset, path: str | os.PathLike[str], provenance: Attributes | None = None
) -> None:
    """Write a dataset as NetCDF-4, which xarray, netCDF4 and any HDF5 reader open.

    Maps are compressed without loss. `provenance` (see `roughcontact.files.provenance`) becomes
    attributes of the file. The file appears whole or not at all.

    Raises
    ------
    WriteError
        If the file cannot be written.
    """
    whole = dataset.assign_attrs(dict(provenance or {}))
    with written_aside(path) as aside:
        aside.write_bytes(netcdf_bytes(whole))


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


def write_csv(
    dataset: xarray.Dataset,
    path: str | os.PathLike[str],
    provenance: Attributes | None = None,
    *,
    dimension: str | None = None,
) -> None:
    """Write the points of a curve or spectrum, or the scalars of one state, as a table of comma-separated values.

    The first line names the columns. Lines that start with ``#`` follow it: units, scales,
    provenance. Then one line a point, every number with all its digits; truth values are 1 and 0.
    It stands in this order because `numpy.genfromtxt` (``delimiter=",", names=True``) takes names from
    the first line of a file; `pandas.read_csv` (``comment="#"``) reads it as well. A vector with a
    ``component`` takes one column for each: ``tangential_force_x``, ``tangential_force_y``.

    Parameters
    ----------
    dataset : Dataset
    path : str or path
    provenance : mapping, optional
        Further remarks, see `roughcontact.files.provenance`.
    dimension : str, optional
        The dimension that the points lie along; by default ``load``, and a single row where there is none.

    Raises
    ------
    ValueError
        If the dataset has no such dimension.
    WriteError
        If the file cannot be written.
    """
    if dimension is None and "load" in dataset.sizes:
        dimension = "load"
    if dimension is not None and dimension not in dataset.sizes:
        raise ValueError(
            f"nothing lies along {dimension!r}: choose one of {', '.join(map(str, dataset.sizes))}"
        )
    along = () if dimension is None else (dimension,)
    columns: dict[str, xarray.DataArray] = {}
    for name, values in dataset.data_vars.items():
        if values.dims == along:
            columns[str(name)] = values
        elif values.dims == (*along, "component"):
            parts = values["component"].to_numpy().tolist()
            columns |= {f"{name}_{part}": values.sel(component=part) for part in parts}
    # Words go last, so that readers of pure numbers can ask for the columns before them.
    names = sorted(columns, key=lambda name: columns[name].dtype.kind in "OUT")
    units = [f"{name} [{columns[name].attrs['units']}]" for name in names if "units" in columns[name].attrs]
    remarks = [f"units: {', '.join(units)}"]
    remarks += [
        _scale(str(n), v)
        for n, v in dataset.data_vars.items()
        if v.dims in ((), ("axis",)) and v.dims != along
    ]
    remarks += [f"{name} = {value}" for name, value in (dataset.attrs | dict(provenance or {})).items()]

    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(names)
    # A remark is one line: a break within it becomes a bar.
    text.writelines(f"# {' | '.join(remark.splitlines())}\n" for remark in remarks)
    table.writerows(
        zip(*(map(_cell, columns[name].to_numpy().reshape(-1).tolist()) for name in names), strict=True)
    )
    _write_text(path, text.getvalue())


def write_json(
    record: Mapping[str, Any], path: str | os.PathLike[str], provenance: Attributes | None = None
) -> None:
    """Write a record as one JSON object, with the provenance under ``"provenance"``.

    Raises
    ------
    WriteError
        If the file cannot be written.
    """
    whole = dict(record) | ({"provenance": dict(provenance)} if provenance else {})
    # Strict JSON: a NaN here is a mistake of the record, not something to write and have refused later.
    _write_text(path, json.dumps(whole, indent=2, ensure_ascii=False, allow_nan=False) + "\n")


def _cell(value: Any) -> str:
    """Return one value of a table; `repr` keeps every digit of a number."""
    if isinstance(value, bool):
        return "1" if value else "0"
    return value if isinstance(value, str) else repr(value)


def _scale(name: str, values: xarray.DataArray) -> str:
    """Return one scale as a remark: ``lengths = 1e-05, 2e-05 m (y, x)``."""
    numbers = ", ".join(_cell(value) for value in values.to_numpy().reshape(-1).tolist())
    axes = f" ({', '.join(values['axis'].to_numpy().tolist())})" if values.dims else ""
    unit = values.attrs.get("units", "1")
    return f"{name} = {numbers}{'' if unit == '1' else f' {unit}'}{axes}"


def _write_text(path: str | os.PathLike[str], text: str) -> None:
    with written_aside(path) as aside:
        # Line ends as they are, on every system, so that equal results are equal files.
        aside.write_text(text, encoding="utf-8", newline="\n")
