"""All cases of a study as one dataset, for notebooks and files."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughcontact import __version__
from roughcontact.files.aside import WriteError
from roughcontact.files.write import write_netcdf
from roughcontact.study.gathering import Gathering
from roughcontact.study.layout import layout_of
from roughcontact.study.long_table import write_long_csv

if TYPE_CHECKING:
    import xarray

    from roughcontact.study.record import Row
    from roughcontact.study.store import Store
    from roughcontact.study.study import Study

__all__ = ["assemble", "export", "write_export"]

_CONVENTIONS = {"Conventions": "CF-1.11"}


def export(store: Store, *, seconds: bool = False) -> xarray.Dataset:
    """Return all records of a store side by side, without their fields; see `assemble`.

    A study that is not finished gives what is there.

    Raises
    ------
    StoreError
        If a record is damaged.
    """
    return assemble(store.study, store.rows(), seconds=seconds)


def assemble(study: Study, rows: Iterable[Row], *, seconds: bool = False) -> xarray.Dataset:
    """Return the records of a study side by side.

    Dimensions are the names of the study's table in their order (``row`` first, where it has rows), ``sample``, and
    behind them those of the gathering. Along each lie the values of the parameter, in SI; parameters that are the same
    for all cases are coordinates without a dimension, unless the records say more by this name.

    - A variable that is the same in all records is kept once, with the dimensions it has in a record. So is a
      coordinate of points that goes on in longer records; one that differs is a variable ``record_NAME``.
    - Shorter records are filled up, and so are cases that failed or are missing: real numbers by NaN, words by empty
      ones, truths by False. Whole numbers become real ones where one is missing.
    - A variable or a dimension of the records that is called like a parameter that varies is called ``record_NAME``.
    - ``case_status`` is "done", "failed" or "missing".

    Parameters
    ----------
    study : Study
    rows : iterable of Row
        In any order; what does not belong to the study is left out.
    seconds : bool
        Whether to have the time that each case took. Without, exports of the same study are the same wherever and
        whenever it was computed.

    Raises
    ------
    ValueError
        If a variable has other dimensions or another unit in one record than in another.
    """
    import xarray

    layout = layout_of(study)
    outer, cases = tuple(layout.sizes), tuple(layout.sizes.values())
    status = np.full(cases, "missing")
    times = np.full(cases, np.nan)
    gathering = Gathering(layout.sizes, frozenset(layout.coordinates))
    versions = set()
    for row in rows:
        place = layout.places.get(row.key)
        if place is None:
            continue
        status[place], times[place] = row.status, row.seconds
        record = row.record
        if record is not None:
            gathering.add(place, record)
            versions.add(row.version)

    constants = {name: value for name, value in layout.constants.items() if name not in gathering.names}
    data, coordinates = gathering.laid()
    data["case_status"] = (outer, status, {"long_name": "whether the case is done, failed or missing"})
    if seconds:
        data["case_seconds"] = (outer, times, {"long_name": "wall time of the case", "units": "s"})
    told = {"source": f"roughcontact {', '.join(sorted(versions)) or __version__}", "study": study.to_toml()}
    return xarray.Dataset(
        data,
        {**layout.coordinates, **coordinates, **constants},
        {**_CONVENTIONS, **gathering.attributes, **told},
    )


def write_export(dataset: xarray.Dataset, path: str | os.PathLike[str]) -> None:
    """Write an export, or what statistics and fits make of one, as NetCDF (``.nc``) or as a long table (``.csv``).

    The file appears whole or not at all.

    Raises
    ------
    WriteError
        If the ending is another, or the file cannot be written.
    """
    ending = Path(path).suffix.casefold()
    if ending == ".nc":
        write_netcdf(dataset, path)
    elif ending == ".csv":
        write_long_csv(dataset, path)
    else:
        raise WriteError(f"cannot write {path}: a study is exported as .nc or .csv")
