"""Solutions and curves as labelled data: an `xarray.Dataset` for files and notebooks, a record for scripts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.contact.curve import Curve
from roughcontact.contact.flow_curve import FlowCurve, flow_point
from roughcontact.contact.measures import measured_variables
from roughcontact.contact.solution import Solution
from roughcontact.contact.spots import are_labelled
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import (
    CURVE,
    FLOW,
    FLOW_DEPTH,
    FLOW_RISE,
    HARDNESS,
    HEIGHTS,
    MAPS,
    RMS,
    SPOT_LABEL,
    SPOTS,
    STATE,
    STATE_NAMES,
)
from roughcontact.labels.labelled import (
    Variables,
    centres,
    dataframe_of,
    dataset_of,
    record_of,
    variable,
    variables_of,
)

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = [
    *("curve_dataframe", "curve_dataset", "curve_record"),
    *("numbers_dataset", "solution_dataset", "solution_maps", "solution_record"),
]


def curve_dataset(curve: Curve) -> xarray.Dataset:
    """Return the curve as an `xarray.Dataset` with units and long names.

    Parameters
    ----------
    curve : Curve

    Returns
    -------
    xarray.Dataset
        Every array of the curve is a variable along ``load``; the secant stiffness, which belongs to pairs of
        neighbours, lies along ``interval``; the scales are variables without a dimension, or along ``axis`` (y, then
        x). Each variable carries ``units`` and ``long_name``. On a line the units are per length.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> dataset = rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]).to_dataset()
    >>> print(dataset["stiffness"].round().values, dataset["stiffness"].attrs["units"])
    [ 8493. 10325.] N m-1
    """
    title = "normal contact stiffness of a rough surface against load"
    dataset = dataset_of(_of_curve(curve), {}, title, curve.geometry)
    if curve.measured:
        dataset.attrs["measured"] = list(curve.measured)
    notes = [f"{note.rank.name.lower()} at {force!r}: {note.text}" for force, note in curve.state_notes]
    return dataset.assign_attrs({"state_notes": "\n".join(notes)} if notes else {})


def curve_record(curve: Curve) -> dict[str, Any]:
    """Return the curve as plain values, for JSON.

    Parameters
    ----------
    curve : Curve

    Returns
    -------
    dict
        Numbers, texts and lists of them. JSON has neither NaN nor infinity, so both become None. Units stand once,
        under ``"units"``.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> record = rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]).to_record()
    >>> [round(force, 6) for force in record["force"]], record["units"]["force"], record["status"][0]
    ([0.001, 0.002], 'N', 'converged')
    """
    return record_of(_of_curve(curve), curve.geometry, notes=list(curve.notes))


def _of_curve(curve: Curve) -> Variables:
    kind = curve.geometry
    data = variables_of(curve, CURVE, kind) | measured_variables(curve.measured)
    if math.isfinite(curve.hardness):
        data |= variables_of(curve, {(): (HARDNESS,)}, kind)
    return data if curve.flow is None else data | variables_of(curve.flow, {("load",): FLOW}, kind)


def curve_dataframe(curve: Curve) -> pandas.DataFrame:
    """Return a loading curve as a table of pandas: one row for each load, in SI units.

    Parameters
    ----------
    curve : Curve

    Returns
    -------
    DataFrame
        Columns have the names of the quantities, and there are ``resolved`` and ``status``; ``attrs["units"]`` holds
        the unit of each column.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> frame = rc.loading_curve(ball, 1e9, forces=[1e-3, 2e-3]).to_dataframe()
    >>> frame["force"].round(6).tolist(), frame.attrs["units"]["force"], bool(frame["resolved"].any())
    ([0.001, 0.002], 'N', False)
    """
    return dataframe_of(curve_dataset(curve), "load")


def solution_dataset(solution: Solution) -> xarray.Dataset:
    """Return one loaded state as a dataset.

    Maps lie along ``y, x`` with the cell centres [m] as coordinates, profiles along ``x``, rings along ``r``. Row 0
    is the top of the picture, so y points down. Scalars are variables without a dimension, areas and loads of the
    spots lie along ``spot`` (1, 2, ... as in ``spot_label``). On a line the units are per length.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> solution.to_dataset()["gap"].attrs["units"]
    'm'
    """
    solution = solution.on_host()
    kind = solution.problem.geometry
    maps = {name: variable(name, kind.axes, values, kind) for name, values in solution_maps(solution).items()}
    return numbers_dataset(solution, maps)


def solution_maps(solution: Solution) -> dict[str, Any]:
    """Return the fields of one loaded state, on their devices, by their names in a dataset."""
    surface = solution.problem.surface
    maps = {name: getattr(solution, name) for name in names_of(MAPS)}
    if solution.flow is not None:
        maps[FLOW_DEPTH.name] = solution.flow.depth
    if surface is not None:
        maps[HEIGHTS.name] = surface.heights
    return maps | {SPOT_LABEL.name: solution.spots.labels}


def numbers_dataset(solution: Solution, maps: Mapping[str, Any] = MappingProxyType({})) -> xarray.Dataset:
    """Return one loaded state as a dataset of its numbers, with `maps` as the variables of its fields."""
    grid, kind, spots = solution.problem.grid, solution.problem.geometry, solution.spots
    data = variables_of(spots, SPOTS, kind, {"spot_area": "areas", "spot_load": "loads"})
    spot = (("spot",), np.arange(1, spots.count + 1), {"long_name": "number of the spot"})
    coordinates = centres(grid, kind) | {"spot": spot}
    title = "contact of a rough surface under load"
    dataset = dataset_of(dict(maps) | data | _of_state(solution), coordinates, title, kind)
    return dataset.assign_attrs({"notes": "\n".join(solution.notes)} if solution.notes else {})


def solution_record(solution: Solution) -> dict[str, Any]:
    """Return the scalars of one loaded state as plain numbers and words, for JSON.

    Units stand once, under ``"units"``. JSON has neither NaN nor infinity: both become None.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    dict
        Numbers, texts and lists of them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> solution.to_record()["spots"], solution.to_record()["units"]["force"]
    (1, 'N')
    """
    solution = solution if are_labelled(solution.pressure) else solution.on_host()
    problem = solution.problem
    more = {"notes": list(solution.notes), "shape": list(problem.grid.shape)}
    return record_of(_of_state(solution), problem.geometry, **more)


def _of_state(solution: Solution) -> Variables:
    """Return the numbers of one loaded state."""
    kind, flow, surface = solution.problem.geometry, solution.flow, solution.problem.surface
    data = variables_of(solution, STATE, kind, STATE_NAMES)
    if flow is not None:
        data |= variables_of(FlowCurve(*map(np.asarray, flow_point(solution))), {(): FLOW}, kind)
        data |= variables_of(flow, {(): (FLOW_RISE,)}, kind, {"flow_rise": "rise"})
    return data if surface is None else data | variables_of(surface, {(): (RMS,)}, kind)
