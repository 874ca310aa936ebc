"""Answers under a tangential load as labelled data, and as plain records."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.friction.slip_curve import SlipCurve
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.column import CELLS
from roughcontact.labels.contact_columns import HEIGHTS, SIZES
from roughcontact.labels.labelled import centres, dataset_of, record_of, variables_of
from roughcontact.labels.slip_columns import DIRECTION, SLIP_CURVE, SLIP_STATE

if TYPE_CHECKING:
    import xarray

__all__ = ["slip_curve_dataset", "slip_curve_record", "tangential_dataset", "tangential_record"]

# Names in a file, which may hold normal and tangential answers side by side, and the names of the attributes.
_NAMES = {f"tangential_{name}": name for name in ("force", "displacement", "elastic_energy", "stiffness")}
_OF_A_STATE = _NAMES | {
    **{name: f"problem.{name}" for name in ("friction", "capacity")},
    **{name: f"problem.pressed.{name}" for name in ("force", "pressure", "contact")},
    "heights": "problem.pressed.problem.surface.heights",
}
_KIND = Geometry.SURFACE
_COMPONENT = (("component",), ["x", "y"], {"long_name": "component of a tangential vector"})
_MOVED = ((DIRECTION,), ["x", "y"], {"long_name": "component of the displacement"})


def tangential_dataset(solution: TangentialSolution) -> xarray.Dataset:
    """Return one state under a tangential load as a dataset.

    Vectors lie along ``component`` (x, then y), their maps along ``component, y, x`` with the cell centres [m] as
    coordinates; row 0 is the top of the picture. The stiffness has the force along ``component`` and the displacement
    along ``direction``. ``force`` and ``pressure`` are those that press the bodies together.

    Parameters
    ----------
    solution : TangentialSolution

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> pressed = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3), rubber, force=1e-3)
    >>> state = rc.slide(pressed, rubber, friction=0.5, force=0.25e-3)
    >>> state.to_dataset()["slip"].attrs["units"]
    'm'
    """
    pressed = solution.problem.pressed.problem
    table = dict(SLIP_STATE)
    if pressed.surface is None:
        table[(CELLS,)] = tuple(column for column in table[(CELLS,)] if column is not HEIGHTS)
    data = variables_of(solution, table, _KIND, _OF_A_STATE)
    data |= variables_of(pressed.grid, {("axis",): SIZES}, _KIND)
    coordinates = centres(pressed.grid, _KIND) | {"component": _COMPONENT, DIRECTION: _MOVED}
    title = "contact of a rough surface under a tangential load"
    dataset = dataset_of(data, coordinates, title, _KIND)
    return dataset.assign_attrs({"notes": "\n".join(solution.notes)} if solution.notes else {})


def tangential_record(solution: TangentialSolution) -> dict[str, Any]:
    """Return the numbers of one state as plain values that JSON can hold; vectors are pairs (x, y).

    Units stand once, under ``"units"``. JSON has neither NaN nor infinity: both become None.

    Parameters
    ----------
    solution : TangentialSolution

    Returns
    -------
    dict
        Numbers, texts and lists of them, as JSON takes them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> pressed = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3), rubber, force=1e-3)
    >>> state = rc.slide(pressed, rubber, friction=0.5, force=0.25e-3)
    >>> len(state.to_record()["tangential_force"]), state.to_record()["units"]["dissipated"]
    (2, 'J')
    """
    grid = solution.problem.pressed.problem.grid
    table = {along: columns for along, columns in SLIP_STATE.items() if CELLS not in along}
    data = variables_of(solution, table, _KIND, _OF_A_STATE)
    data |= variables_of(grid, {("axis",): SIZES}, _KIND)
    more = {"shape": list(grid.shape), "sliding": solution.sliding, "notes": list(solution.notes)}
    return record_of(data, _KIND, **more)


def slip_curve_dataset(curve: SlipCurve) -> xarray.Dataset:
    """Return a path of tangential loads as a dataset.

    Every array is a variable along ``load``, force and displacement along ``load, component`` (x, then y).

    Parameters
    ----------
    curve : SlipCurve

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> pressed = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3), rubber, force=1e-3)
    >>> curve = rc.slide_curve(pressed, rubber, friction=0.5, forces=[0.1e-3, 0.2e-3])
    >>> curve.to_dataset()["tangential_displacement"].attrs["units"]
    'm'
    """
    data = variables_of(curve, SLIP_CURVE, _KIND, _NAMES)
    title = "tangential force against displacement of a rough contact"
    return dataset_of(data, {"component": _COMPONENT}, title, _KIND)


def slip_curve_record(curve: SlipCurve) -> dict[str, Any]:
    """Return a path of tangential loads as plain numbers, words and lists that JSON can hold.

    Units stand once, under ``"units"``. JSON has neither NaN nor infinity: both become None.

    Parameters
    ----------
    curve : SlipCurve

    Returns
    -------
    dict
        Numbers, texts and lists of them, as JSON takes them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> pressed = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3), rubber, force=1e-3)
    >>> curve = rc.slide_curve(pressed, rubber, friction=0.5, forces=[0.1e-3, 0.2e-3])
    >>> len(curve.to_record()["stick_area"])
    2
    """
    return record_of(variables_of(curve, SLIP_CURVE, _KIND, _NAMES), _KIND)
