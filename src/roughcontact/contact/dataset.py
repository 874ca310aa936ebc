"""Answers as labelled data: an `xarray.Dataset` for files and notebooks, a plain record for scripts."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.contact.variables import VARIABLES

if TYPE_CHECKING:
    import xarray

    from roughcontact.contact.curve import Curve
    from roughcontact.contact.solution import Solution
    from roughcontact.contact.status import Status

__all__ = ["curve_dataset", "curve_record", "solution_dataset", "solution_record"]

_CURVE_POINTS = (
    "force",
    "depth",
    "stiffness",
    "interfacial_stiffness",
    "contact_area",
    "mean_gap",
    "elastic_energy",
    "spots",
    "dimensionless_force",
    "dimensionless_stiffness",
    "residual",
    "stiffness_residual",
    "resolved",
)
_CURVE_SCALES = ("modulus", "rms", "saturation", "cell_stiffness")
_SOLUTION_MAPS = ("pressure", "displacement", "gap", "contact")
_SOLUTION_SCALARS = (
    "force",
    "depth",
    "stiffness",
    "interfacial_stiffness",
    "contact_area",
    "contact_fraction",
    "mean_gap",
    "elastic_energy",
    "residual",
    "steps",
    "missing",
    "touches_edge",
)
_AXES = ("y", "x")


def curve_dataset(curve: Curve) -> xarray.Dataset:
    """Return a loading curve as a dataset.

    Every array of the curve is a variable along ``load``; the secant stiffness, which belongs to
    pairs of neighbours, lies along ``interval``; the scales are variables without a dimension, or
    along ``axis`` (y, then x). Each carries ``units`` and ``long_name``.
    """
    data = {name: _variable(name, ("load",), getattr(curve, name)) for name in _CURVE_POINTS}
    data["status"] = _variable("status", ("load",), _words(curve.status))
    data["secant_stiffness"] = _variable("secant_stiffness", ("interval",), curve.secant_stiffness)
    data |= {name: _variable(name, (), getattr(curve, name)) for name in _CURVE_SCALES}
    data |= _geometry(curve.lengths, curve.spacing, curve.periodic)
    return _dataset(data, {}, "normal contact stiffness of a rough surface against load")


def solution_dataset(solution: Solution) -> xarray.Dataset:
    """Return one loaded state as a dataset.

    Maps lie along ``y, x`` with the cell centres [m] as coordinates. Row 0 is the top of the picture,
    so y points down. Scalars are variables without a dimension, areas and loads of the spots lie
    along ``spot`` (1, 2, ... as in ``spot_label``).
    """
    problem, spots = solution.problem, solution.spots
    grid = problem.grid
    _check_two_dimensional(len(grid.shape))
    data = {name: _variable(name, _AXES, getattr(solution, name)) for name in _SOLUTION_MAPS}
    if problem.surface is not None:
        data["heights"] = _variable("heights", _AXES, problem.surface.heights)
    data["spot_label"] = _variable("spot_label", _AXES, spots.labels)
    data["spot_area"] = _variable("spot_area", ("spot",), spots.areas)
    data["spot_load"] = _variable("spot_load", ("spot",), spots.loads)
    data |= {name: _variable(name, (), getattr(solution, name)) for name in _SOLUTION_SCALARS}
    data["spots"] = _variable("spots", (), spots.count)
    data["status"] = _variable("status", (), _word(solution.status))
    data |= {name: _variable(name, (), value) for name, value in _scales(solution).items()}
    data |= _geometry(grid.lengths, grid.spacing, grid.periodic)
    coordinates = {
        axis: _variable(axis, (axis,), (np.arange(n) + 0.5) * step)
        for axis, n, step in zip(_AXES, grid.shape, grid.spacing, strict=True)
    }
    coordinates["spot"] = (("spot",), np.arange(1, spots.count + 1), {"long_name": "number of the spot"})
    dataset = _dataset(data, coordinates, "contact of a rough surface under load")
    if solution.notes:
        dataset.attrs["notes"] = "\n".join(solution.notes)
    return dataset


def curve_record(curve: Curve) -> dict[str, Any]:
    """Return a loading curve as plain numbers, words and lists that JSON can hold.

    Units stand once, under ``"units"``. JSON knows neither NaN nor infinity: both become None.
    """
    _check_two_dimensional(len(curve.lengths))
    names = (*_CURVE_POINTS, "secant_stiffness", *_CURVE_SCALES, "lengths", "spacing", "periodic")
    record = {name: _plain(getattr(curve, name)) for name in names}
    record["status"] = _words(curve.status)
    return record | {"units": _units(record)}


def solution_record(solution: Solution) -> dict[str, Any]:
    """Return the scalars of one loaded state as plain numbers and words that JSON can hold.

    Units stand once, under ``"units"``. JSON knows neither NaN nor infinity: both become None.
    """
    grid = solution.problem.grid
    _check_two_dimensional(len(grid.shape))
    record = {name: _plain(getattr(solution, name)) for name in _SOLUTION_SCALARS}
    record["spots"] = int(solution.spots.count)
    record["status"] = _word(solution.status)
    record["notes"] = list(solution.notes)
    record |= {name: _plain(value) for name, value in _scales(solution).items()}
    record |= {name: _plain(getattr(grid, name)) for name in ("shape", "lengths", "spacing", "periodic")}
    return record | {"units": _units(record)}


def _variable(name: str, dimensions: tuple[str, ...], values: Any) -> tuple[Any, Any, dict[str, str]]:
    """Return the triple (dimensions, values, attributes) that xarray takes as a variable."""
    known = VARIABLES[name]
    attributes = {"long_name": known.long_name} | ({"units": known.unit} if known.unit else {})
    return dimensions, np.asarray(values), attributes


def _scales(solution: Solution) -> dict[str, float]:
    """Return the numbers by which one loaded state is judged and that it has no attribute for."""
    problem = solution.problem
    scales = {
        "largest_pressure": float(solution.pressure.max()),
        "nominal_pressure": solution.force / problem.grid.area,
        "stiffness_residual": solution.frozen.residual,
        "modulus": problem.modulus,
    }
    return scales if problem.surface is None else scales | {"rms": problem.surface.rms}


def _geometry(lengths: Any, spacing: Any, periodic: Any) -> dict[str, Any]:
    """Return the size of the map, one value for each axis."""
    _check_two_dimensional(len(lengths))
    values = {"lengths": lengths, "spacing": spacing, "periodic": periodic}
    return {name: _variable(name, ("axis",), value) for name, value in values.items()}


def _dataset(data: dict[str, Any], coordinates: dict[str, Any], title: str) -> xarray.Dataset:
    import xarray

    axis = (("axis",), list(_AXES), {"long_name": "axis of the map: rows run along x, down the picture is y"})
    attributes = {"Conventions": "CF-1.11", "title": title}
    return xarray.Dataset(data, coordinates | {"axis": axis}, attributes)


def _check_two_dimensional(ndim: int) -> None:
    # On a line force is per unit length: the units of the table would be wrong without a word.
    if ndim != 2:
        raise ValueError(f"datasets and records describe surfaces of two dimensions, not {ndim}")


def _units(record: dict[str, Any]) -> dict[str, str]:
    return {name: VARIABLES[name].unit for name in record if name in VARIABLES and VARIABLES[name].unit}


def _word(status: Status) -> str:
    return str(status.value)


def _words(statuses: Iterable[Status]) -> list[str]:
    return [_word(status) for status in statuses]


def _plain(value: Any) -> Any:
    """Return a number, an array or a sequence as built-in types, with None for what is not finite."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    elif isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
