"""A dataset of many dimensions as one long table of comma-separated values."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from roughcontact.files.write import plain_cells, scale_remark, units_remark, write_table

if TYPE_CHECKING:
    import xarray

__all__ = ["write_long_csv"]

_AT_ONCE = 10_000  # lines


def write_long_csv(dataset: xarray.Dataset, path: str | os.PathLike[str]) -> None:
    """Write one line for every point of every case, laid out as `roughcontact.files.write.write_csv` lays out a curve.

    The first line names the columns: the number or value along each dimension, then all that varies, words last.
    Lines that start with ``#`` follow: units, what is the same for all points, attributes. The points are those of
    the variable with the most values of each case. One along further dimensions takes a column for each of their names
    (``lengths_y``, ``lengths_x``), or is left out and said to be. Points without any value are no lines, such as those
    of cases that failed. Equal datasets give equal files.

    Raises
    ------
    WriteError
        If the file cannot be written.
    """
    points = _points(dataset)
    columns, left_out = _columns(dataset, points)
    sizes = {d: dataset.sizes[d] for d in points} or {"": 1}  # scalars alone make one line
    cells = {name: _laid(values.variable, sizes) for name, values in columns.items()}
    kept = np.flatnonzero(_kept(dataset, points, sizes))

    def rows() -> Iterator[tuple[Any, ...]]:
        for start in range(0, len(kept), _AT_ONCE):
            chunk = np.unravel_index(kept[start : start + _AT_ONCE], tuple(sizes.values()))
            yield from zip(*(plain_cells(values[chunk]).tolist() for values in cells.values()), strict=True)

    write_table(path, columns, _remarks(dataset, columns, left_out), rows())


def _points(dataset: xarray.Dataset) -> tuple[Any, ...]:
    """Return the dimensions of the points: those of the cases, and what most lies along."""
    cases = set(dataset["case_status"].dims) if "case_status" in dataset else set()
    found = [values for values in dataset.data_vars.values() if cases <= set(values.dims)]
    return max(found, key=lambda values: values.size).dims if found else ()


def _columns(
    dataset: xarray.Dataset, points: tuple[Any, ...]
) -> tuple[dict[str, xarray.DataArray], list[xarray.DataArray]]:
    """Return what varies from point to point, and what has no place in a table of them."""
    columns = {str(d): dataset[d] for d in points}  # where there is no coordinate, the number
    left_out = []
    for name, values in {**dataset.coords, **dataset.data_vars}.items():
        others = [d for d in values.dims if d not in points]
        parts = dataset[others[0]].to_numpy().tolist() if len(others) == 1 else []
        if points and not set(values.dims) & set(points):
            continue
        if not others:
            columns[str(name)] = values
        elif all(isinstance(part, str) for part in parts) and parts:
            columns |= {f"{name}_{part}": values.sel({others[0]: part}) for part in parts}
        else:
            left_out.append(values)
    words = [name for name, values in columns.items() if values.dtype.kind in "OUT"]
    return {name: columns[name] for name in (*(n for n in columns if n not in words), *words)}, left_out


def _remarks(
    dataset: xarray.Dataset, columns: dict[str, xarray.DataArray], left_out: list[xarray.DataArray]
) -> Iterator[str]:
    yield units_remark(columns)
    for name, values in {**dataset.coords, **dataset.data_vars}.items():
        if values.dims in ((), ("axis",)) and name != "axis" and str(name) not in columns:
            yield scale_remark(values)
    for values in left_out:
        yield f"not in this table: {values.name} ({', '.join(map(str, values.dims))})"
    if "case_status" in dataset:
        states, numbers_of = np.unique(dataset["case_status"].to_numpy(), return_counts=True)
        yield f"cases: {', '.join(f'{n} {state}' for state, n in zip(states, numbers_of, strict=True))}"
    yield from (f"{name} = {value}" for name, value in dataset.attrs.items())


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
    """Return values with all the dimensions of a point, as a view."""
    known = variable.transpose(*(d for d in sizes if d in variable.dims)).to_numpy()
    shaped = known[tuple(slice(None) if d in variable.dims else np.newaxis for d in sizes)]
    return np.broadcast_to(shaped, tuple(sizes.values()))
