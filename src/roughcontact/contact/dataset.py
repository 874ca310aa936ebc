"""Answers as labelled data: an `xarray.Dataset` for files and notebooks, a plain record for scripts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.arrays import max_abs
from roughcontact.contact.flow_curve import flow_point
from roughcontact.labels.labelled import centres, dataset_of, plain_values, sizes, units_of, variable
from roughcontact.labels.variables import CURVE_POINTS, CURVE_SCALES, FLOW_POINTS

if TYPE_CHECKING:
    import pandas
    import xarray

    from roughcontact.contact.curve import Curve
    from roughcontact.contact.solution import Solution

__all__ = [
    *(
        "curve_dataframe",
        "curve_dataset",
        "curve_record",
        "numbers_dataset",
        "solution_dataset",
        "solution_maps",
    ),
    "solution_record",
]

_CURVE_ARRAYS = (
    *(*CURVE_POINTS, "nominal_pressure", "contact_fraction", "interfacial_stiffness_per_area"),
    *("spots", "dimensionless_force", "dimensionless_stiffness"),
    *("residual", "stiffness_residual", "resolved"),
)
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


def curve_dataset(curve: Curve) -> xarray.Dataset:
    """Return the curve as an `xarray.Dataset` with units and long names.

    Parameters
    ----------
    curve : Curve

    Returns
    -------
    xarray.Dataset
        Every array of the curve is a variable along ``load``; the secant stiffness, which belongs to
        pairs of neighbours, lies along ``interval``; the scales are variables without a dimension, or
        along ``axis`` (y, then x). Each carries ``units`` and ``long_name``. On a line the units are per length.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> dataset = rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]).to_dataset()
    >>> print(dataset["stiffness"].round().values, dataset["stiffness"].attrs["units"])
    [ 8493. 10325.] N m-1
    """
    kind = curve.geometry
    data = {name: variable(name, ("load",), getattr(curve, name), kind) for name in _CURVE_ARRAYS}
    data["status"] = variable("status", ("load",), [each.value for each in curve.status])
    data["secant_stiffness"] = variable("secant_stiffness", ("interval",), curve.secant_stiffness, kind)
    data |= {name: variable(name, (), getattr(curve, name), kind) for name in CURVE_SCALES}
    if math.isfinite(curve.hardness):
        data["hardness"] = variable("hardness", (), curve.hardness, kind)
    if curve.flow is not None:
        data |= {name: variable(name, ("load",), getattr(curve.flow, name), kind) for name in FLOW_POINTS}
    data |= sizes(curve)
    return dataset_of(data, {}, "normal contact stiffness of a rough surface against load", kind)


def solution_dataset(solution: Solution) -> xarray.Dataset:
    """Return one loaded state as a dataset.

    Maps lie along ``y, x`` with the cell centres [m] as coordinates, profiles along ``x``, rings along ``r``. Row 0
    is the top of the picture, so y points down. Scalars are variables without a dimension, areas and loads of the
    spots lie along ``spot`` (1, 2, ... as in ``spot_label``). On a line the units are per length.
    """
    kind = solution.problem.geometry
    maps = {name: variable(name, kind.axes, values, kind) for name, values in solution_maps(solution).items()}
    return numbers_dataset(solution, maps)


def solution_maps(solution: Solution) -> dict[str, Any]:
    """Return the fields of one loaded state, wherever they are, by their names in a dataset."""
    surface = solution.problem.surface
    maps = {name: getattr(solution, name) for name in _SOLUTION_MAPS}
    if solution.flow is not None:
        maps["flow_depth"] = solution.flow.depth
    if surface is not None:
        maps["heights"] = surface.heights
    return maps | {"spot_label": solution.spots.labels}


def numbers_dataset(solution: Solution, maps: Mapping[str, Any] = MappingProxyType({})) -> xarray.Dataset:
    """Return one loaded state as a dataset of such variables for its fields: without, of its numbers alone."""
    problem, spots = solution.problem, solution.spots
    grid, kind = problem.grid, problem.geometry
    data = dict(maps)
    data["spot_area"] = variable("spot_area", ("spot",), spots.areas, kind)
    data["spot_load"] = variable("spot_load", ("spot",), spots.loads, kind)
    data |= {name: variable(name, (), getattr(solution, name), kind) for name in _SOLUTION_SCALARS}
    data["spots"] = variable("spots", (), spots.count)
    data["status"] = variable("status", (), solution.status.value)
    data |= {name: variable(name, (), value, kind) for name, value in _scales(solution).items()}
    data |= sizes(grid)
    spot = (("spot",), np.arange(1, spots.count + 1), {"long_name": "number of the spot"})
    coordinates = centres(grid, kind) | {"spot": spot}
    dataset = dataset_of(data, coordinates, "contact of a rough surface under load", kind)
    if solution.notes:
        dataset.attrs["notes"] = "\n".join(solution.notes)
    return dataset


def curve_dataframe(curve: Curve) -> pandas.DataFrame:
    """Return a loading curve as a table of pandas: one row a load, in SI units.

    Parameters
    ----------
    curve : Curve

    Returns
    -------
    DataFrame
        Columns by the names of the quantities, with ``resolved`` and ``status``; units by column stand in
        ``attrs["units"]``.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> frame = rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]).to_dataframe()
    >>> frame["force"].round(6).tolist(), frame.attrs["units"]["force"], bool(frame["resolved"].any())
    ([0.001, 0.002], 'N', False)
    """
    dataset = curve_dataset(curve)
    columns = dataset[[name for name, values in dataset.items() if values.dims == ("load",)]]
    frame = columns.to_dataframe()
    frame.attrs["units"] = {name: values.attrs.get("units", "") for name, values in columns.items()}
    return frame


def curve_record(curve: Curve) -> dict[str, Any]:
    """Return the curve as plain values, for JSON.

    Parameters
    ----------
    curve : Curve

    Returns
    -------
    dict
        Numbers, texts and lists of them, as JSON takes them: it knows neither NaN nor infinity, and both become None.
        Units stand once, under ``"units"``.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> record = rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]).to_record()
    >>> [round(force, 6) for force in record["force"]], record["units"]["force"], record["status"][0]
    ([0.001, 0.002], 'N', 'converged')
    """
    names = (*_CURVE_ARRAYS, "secant_stiffness", *CURVE_SCALES, "lengths", "spacing", "periodic")
    record = {name: plain_values(getattr(curve, name)) for name in names}
    if curve.flow is not None:
        record |= {name: plain_values(getattr(curve.flow, name)) for name in FLOW_POINTS}
    record["status"] = [each.value for each in curve.status]
    return record | {"geometry": curve.geometry.value, "units": units_of(record, curve.geometry)}


def solution_record(solution: Solution) -> dict[str, Any]:
    """Return the scalars of one loaded state as plain numbers and words that JSON can hold.

    Units stand once, under ``"units"``. JSON knows neither NaN nor infinity: both become None.
    """
    grid, kind = solution.problem.grid, solution.problem.geometry
    record = {name: plain_values(getattr(solution, name)) for name in _SOLUTION_SCALARS}
    record["spots"] = int(solution.spots.count)
    record["status"] = solution.status.value
    record["notes"] = list(solution.notes)
    record |= {name: plain_values(value) for name, value in _scales(solution).items()}
    record |= {
        name: plain_values(getattr(grid, name)) for name in ("shape", "lengths", "spacing", "periodic")
    }
    return record | {"geometry": kind.value, "units": units_of(record, kind)}


def _scales(solution: Solution) -> dict[str, float]:
    """Return the numbers by which one loaded state is judged and that it has no attribute for."""
    problem = solution.problem
    scales = {
        "largest_pressure": max_abs(solution.pressure),
        "nominal_pressure": solution.force / problem.grid.area,
        "stiffness_residual": solution.frozen.residual,
        "modulus": problem.modulus,
    }
    if solution.flow is not None:
        scales |= dict(zip(FLOW_POINTS, flow_point(solution), strict=True)) | {
            "flow_rise": solution.flow.rise
        }
    return scales if problem.surface is None else scales | {"rms": problem.surface.rms}
