"""Large variables of a record: one NetCDF file per case, beside the database."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from roughcontact.files.aside import written_aside
from roughcontact.files.installed import lacking
from roughcontact.files.write import netcdf_bytes
from roughcontact.study.study_errors import StoreError, computed_again, on_disk

if TYPE_CHECKING:
    import xarray

__all__ = ["cleaned", "read_fields", "split", "write_fields"]

_FOLDER = "fields"


def split(record: xarray.Dataset, names: tuple[str, ...]) -> tuple[xarray.Dataset, xarray.Dataset]:
    """Return a record without its fields, and the fields, each with the coordinates that it needs."""
    rest = record.drop_vars(names)
    needed = {dimension for values in rest.data_vars.values() for dimension in values.dims}
    idle = [name for name, values in rest.coords.items() if not set(values.dims) <= needed]
    return rest.drop_vars(idle), record[list(names)]


def write_fields(folder: Path, key: str, fields: xarray.Dataset) -> None:
    """Write the fields of a case; they are on the disk when this returns.

    Raises
    ------
    StoreError
        If they cannot be written.
    """
    target, data = _file(folder, key), netcdf_bytes(fields)
    with on_disk(folder, "fields cannot be written"):
        target.parent.mkdir(exist_ok=True)
        with written_aside(target) as aside, open(aside, "wb") as stream:
            stream.write(data)
            stream.flush()
            os.fsync(stream.fileno())
        _keep_names(target.parent)


def read_fields(folder: Path, key: str) -> xarray.Dataset:
    """Return the fields of a case.

    Raises
    ------
    StoreError
        If they cannot be read.
    """
    import xarray

    if (lack := lacking("h5py", "h5netcdf")) is not None:
        raise StoreError(folder, f"its fields need {lack[0]}", lack[1])
    try:
        return xarray.load_dataset(_file(folder, key), engine="h5netcdf")
    except (OSError, ValueError) as error:
        raise StoreError(
            folder,
            f"there are no fields of the case {key}, or they cannot be read ({error})",
            computed_again(key),
        ) from error


def cleaned(folder: Path) -> None:
    """Remove half-written files of killed processes."""
    for path in (folder / _FOLDER).glob(".*.part"):
        with suppress(OSError):
            path.unlink()


def _file(folder: Path, key: str) -> Path:
    return folder / _FOLDER / f"{key}.nc"


def _keep_names(folder: Path) -> None:
    """Wait until the names in a folder are on the disk, if the system supports this."""
    if os.name != "posix":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
