"""A dataset of many dimensions as one long table of comma-separated values."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.write import in_parts, plain_cells, write_table

if TYPE_CHECKING:
    import xarray

__all__ = ["write_long_csv"]

_AT_ONCE = 10_000  # lines


def write_long_csv(dataset: xarray.Dataset, path: str | os.PathLike[str]) -> list[str]:
    """Write one line for every point of every case, in the layout of `roughcontact.files.write.write_csv` for a curve.

    The first line names the columns with their units: the index or value along each dimension, then varying
    quantities, then constant ones, and words last. The points are those of the variable with the most values in each
    case. A variable along another dimension has a column for each name in it (``lengths_y``, ``lengths_x``). Points
    without any value, such as those of failed cases, have no lines. Equal datasets give equal files.

    Returns
    -------
    list of str
        Names of the variables that do not fit into such a table.

    Raises
    ------
    WriteError
        If the file cannot be written.
    """
    points = _points(dataset)
    columns, left_out = _columns(dataset, points)
    sizes = {d: dataset.sizes[d] for d in points} or {"": 1}  # only scalars: one line
    cells = {name: _laid(values.variable, sizes) for name, values in columns.items()}
    kept = np.flatnonzero(_kept(dataset, points, sizes))

    def rows() -> Iterator[tuple[Any, ...]]:
        for start in range(0, len(kept), _AT_ONCE):
            chunk = np.unravel_index(kept[start : start + _AT_ONCE], tuple(sizes.values()))
            yield from zip(*(plain_cells(values[chunk]).tolist() for values in cells.values()), strict=True)

    write_table(path, columns, rows())
    return left_out


def _points(dataset: xarray.Dataset) -> tuple[Any, ...]:
    """Return the dimensions of the points: those of the cases, and those of the largest variable."""
    cases = set(dataset["case_status"].dims) if "case_status" in dataset else set()
    found = [values for values in dataset.data_vars.values() if cases <= set(values.dims)]
    return max(found, key=lambda values: values.size).dims if found else ()


def _columns(
    dataset: xarray.Dataset, points: tuple[Any, ...]
) -> tuple[dict[str, xarray.DataArray], list[str]]:
    """Return the columns of a table of the points, and the names of the variables that do not fit into it."""
    columns = {str(d): dataset[d] for d in points}  # the index if there is no coordinate
    left_out = []
    for name, values in {**dataset.coords, **dataset.data_vars}.items():
        others = [d for d in values.dims if d not in points]
        named = len(others) == 1 and others[0] in dataset.coords and dataset[others[0]].dtype.kind in "OUT"
        if not others:
            columns.setdefault(str(name), values)
        elif named and name not in others:
            columns |= in_parts(values, others[0])
        elif name not in others:
            left_out.append(str(name))
    return dict(sorted(columns.items(), key=lambda each: _rank(each[1], points))), left_out


def _rank(values: xarray.DataArray, points: tuple[Any, ...]) -> tuple[bool, bool]:
    """Return the sort key of a column: varying before constant ones, numbers before words."""
    return values.dtype.kind in "OUT", bool(points) and not set(values.dims) & set(points)


def _kept(dataset: xarray.Dataset, points: tuple[Any, ...], sizes: dict[Any, int]) -> npt.NDArray[np.bool_]:
    """Return which points have a value."""
    kept = np.zeros(tuple(sizes.values()), dtype=bool)
    for values in dataset.data_vars.values():
        if values.dims == points and values.dtype.kind != "b":
            kept |= values.to_numpy() != "" if values.dtype.kind == "U" else values.notnull().to_numpy()
    if "case_status" in dataset and set(dataset["case_status"].dims) <= set(sizes):
        kept &= _laid(dataset["case_status"].variable, sizes) == "done"
    return kept


def _laid(variable: xarray.Variable, sizes: dict[Any, int]) -> npt.NDArray[Any]:
    """Return values broadcast to all dimensions of the points, as a view."""
    known = variable.transpose(*(d for d in sizes if d in variable.dims)).to_numpy()
    shaped = known[tuple(slice(None) if d in variable.dims else np.newaxis for d in sizes)]
    return np.broadcast_to(shaped, tuple(sizes.values()))
