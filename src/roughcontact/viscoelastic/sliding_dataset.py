"""Steady sliding as labelled data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import centres, dataset_of, record_of, variable, variables_of
from roughcontact.labels.sliding_columns import FRICTION_CURVE, SLIDING, SLIDING_NAMES
from roughcontact.viscoelastic.friction_curve import FrictionCurve
from roughcontact.viscoelastic.steady_sliding import SlidingContact

if TYPE_CHECKING:
    import xarray

__all__ = ["friction_dataset", "friction_record", "sliding_dataset"]

_KIND = Geometry.SURFACE
_COMPONENT = (("component",), ["x", "y"], {"long_name": "component of a tangential vector"})


def sliding_dataset(sliding: SlidingContact) -> xarray.Dataset:
    """Return the maps and the numbers of steady sliding at one speed.

    Vectors lie along ``component`` (x, then y), maps along ``y, x``.

    Parameters
    ----------
    sliding : SlidingContact

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> surface = rc.shapes.wave(rc.Grid((16, 64), 1e-5, periodic=True), 1e-5, 6.4e-4)
    >>> sliding = rc.steady_sliding(surface, rubber, speed=0.1, pressure=1e5)
    >>> sliding.to_dataset()["friction_traction"].attrs["units"]
    'Pa'
    """
    data = variables_of(sliding, SLIDING, _KIND, SLIDING_NAMES)
    coordinates = centres(sliding.problem.grid, _KIND) | {"component": _COMPONENT}
    dataset = dataset_of(data, coordinates, "steady sliding over a viscoelastic plane", _KIND)
    return dataset.assign_attrs(notes="\n".join(sliding.notes))


def friction_dataset(curve: FrictionCurve) -> xarray.Dataset:
    """Return hysteretic friction against speed, along ``sliding_speed``; vectors also along ``component``.

    Parameters
    ----------
    curve : FrictionCurve

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> surface = rc.shapes.wave(rc.Grid((16, 64), 1e-5, periodic=True), 1e-5, 6.4e-4)
    >>> curve = rc.friction_curve(surface, rubber, speeds=[0.01, 0.1], pressure=1e5)
    >>> curve.to_dataset()["friction_coefficient"].dims
    ('sliding_speed',)
    """
    data, speed = _columns(curve)
    coordinates = {"sliding_speed": speed, "component": _COMPONENT}
    dataset = dataset_of(data, coordinates, "hysteretic friction against speed", _KIND)
    return dataset.assign_attrs(notes="\n".join(curve.notes))


def friction_record(curve: FrictionCurve) -> dict[str, Any]:
    """Return hysteretic friction against speed as plain values, for JSON; units stand once, under ``"units"``.

    Parameters
    ----------
    curve : FrictionCurve

    Returns
    -------
    dict
        Lists along the speeds; values that are not finite become None.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e8, 1e-3)
    >>> surface = rc.shapes.wave(rc.Grid((16, 64), 1e-5, periodic=True), 1e-5, 6.4e-4)
    >>> curve = rc.friction_curve(surface, rubber, speeds=[0.01, 0.1], pressure=1e5)
    >>> curve.to_record()["sliding_speed"], curve.to_record()["units"]["sliding_speed"]
    ([0.01, 0.1], 'm s-1')
    """
    data, speed = _columns(curve)
    return record_of(data | {"sliding_speed": speed}, _KIND, notes=list(curve.notes))


def _columns(curve: FrictionCurve) -> tuple[dict[str, Any], Any]:
    """Return the variables of a curve, and its speeds."""
    data = dict(variables_of(curve, FRICTION_CURVE, _KIND, SLIDING_NAMES))
    return data, variable("sliding_speed", ("sliding_speed",), curve.speed)
