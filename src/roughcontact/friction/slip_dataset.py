"""Answers under a tangential load as labelled data, and as plain records."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from roughcontact.arrays import on_host
from roughcontact.friction.slip_curve import SlipCurve
from roughcontact.friction.slip_solution import TangentialSolution
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import centres, dataset_of, plain_values, sizes, units_of, variable

if TYPE_CHECKING:
    import xarray


__all__ = ["slip_curve_dataset", "slip_curve_record", "tangential_dataset", "tangential_record"]

# Names in a file, where normal and tangential answers may stand side by side, and those of the attributes.
_VECTORS = MappingProxyType({"tangential_force": "force", "tangential_displacement": "displacement"})
_AREAS = MappingProxyType({"stick_area": "stick_area", "slip_area": "slip_area", "dissipated": "dissipated"})
_ENERGY = MappingProxyType({"tangential_elastic_energy": "elastic_energy"})
_POINTS = _AREAS | {"dissipated_energy": "dissipated_energy"} | _ENERGY | {"residual": "residual"}
_SCALARS = _AREAS | _ENERGY | {"residual": "residual", "steps": "steps"}
_COMPONENT = (("component",), ["x", "y"], {"long_name": "component of a tangential vector"})


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
    problem = solution.problem
    pressed = problem.pressed
    grid, axes = pressed.problem.grid, Geometry.SURFACE.axes
    fields = {"traction": solution.traction, "slip": solution.slip}
    masks = {"contact": pressed.contact, "slipping": solution.slipping}
    data = {name: variable(name, ("component", *axes), on_host(field)) for name, field in fields.items()}
    if pressed.problem.surface is not None:
        data["heights"] = variable("heights", axes, on_host(pressed.problem.surface.heights))
    data["pressure"] = variable("pressure", axes, on_host(pressed.pressure))
    data |= {name: variable(name, axes, on_host(mask).astype(bool)) for name, mask in masks.items()}
    data |= {name: variable(name, ("component",), value) for name, value in _vectors(solution).items()}
    stiffness = on_host(solution.stiffness)
    data["tangential_stiffness"] = variable("tangential_stiffness", ("component", "direction"), stiffness)
    data |= {name: variable(name, (), value) for name, value in _scalars(solution).items()}
    data["status"] = variable("status", (), solution.status.value)
    data |= sizes(grid)
    moved = (("direction",), ["x", "y"], {"long_name": "component of the displacement"})
    coordinates = centres(grid, Geometry.SURFACE) | {"component": _COMPONENT, "direction": moved}
    dataset = dataset_of(
        data, coordinates, "contact of a rough surface under a tangential load", Geometry.SURFACE
    )
    if solution.notes:
        dataset.attrs["notes"] = "\n".join(solution.notes)
    return dataset


def tangential_record(solution: TangentialSolution) -> dict[str, Any]:
    """Return the numbers of one state as plain values that JSON can hold; vectors are pairs (x, y).

    Units stand once, under ``"units"``. JSON knows neither NaN nor infinity: both become None.

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
    whole = _vectors(solution) | {"tangential_stiffness": on_host(solution.stiffness)} | _scalars(solution)
    whole |= {name: getattr(grid, name) for name in ("shape", "lengths", "spacing", "periodic")}
    record = {name: plain_values(value) for name, value in whole.items()}
    record |= {"status": solution.status.value, "sliding": solution.sliding, "notes": list(solution.notes)}
    return record | {"units": units_of(record, Geometry.SURFACE)}


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
    data = {name: variable(name, ("load", "component"), values) for name, values in _vectors(curve).items()}
    data |= {name: variable(name, ("load",), values) for name, values in _taken(_POINTS, curve).items()}
    data["status"] = variable("status", ("load",), [each.value for each in curve.status])
    data["capacity"] = variable("capacity", (), curve.capacity)
    title = "tangential force against displacement of a rough contact"
    return dataset_of(data, {"component": _COMPONENT}, title, Geometry.SURFACE)


def slip_curve_record(curve: SlipCurve) -> dict[str, Any]:
    """Return a path of tangential loads as plain numbers, words and lists that JSON can hold.

    Units stand once, under ``"units"``. JSON knows neither NaN nor infinity: both become None.

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
    record = {name: plain_values(value) for name, value in (_vectors(curve) | _taken(_POINTS, curve)).items()}
    record |= {"status": [each.value for each in curve.status], "capacity": plain_values(curve.capacity)}
    return record | {"units": units_of(record, Geometry.SURFACE)}


def _vectors(answer: TangentialSolution | SlipCurve) -> dict[str, Any]:
    return {name: on_host(value) for name, value in _taken(_VECTORS, answer).items()}


def _scalars(solution: TangentialSolution) -> dict[str, Any]:
    """Return the numbers of one state, with those of what it started from."""
    problem = solution.problem
    return {
        "force": problem.pressed.force,
        "friction": problem.friction,
        "capacity": problem.capacity,
        **_taken(_SCALARS, solution),
    }


def _taken(names: Mapping[str, str], answer: TangentialSolution | SlipCurve) -> dict[str, Any]:
    return {name: getattr(answer, attribute) for name, attribute in names.items()}
