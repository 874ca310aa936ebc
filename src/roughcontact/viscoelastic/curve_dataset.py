"""The curve of a viscoelastic contact as labelled data, and as a plain record."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.contact.measures import measured_variables
from roughcontact.labels.labelled import Variables, dataset_of, record_of, variables_of
from roughcontact.labels.viscoelastic_columns import TIME, VISCOELASTIC_CURVE
from roughcontact.viscoelastic.viscoelastic_curve import ViscoelasticCurve

if TYPE_CHECKING:
    import xarray

__all__ = ["viscoelastic_dataset", "viscoelastic_record"]


def viscoelastic_dataset(curve: ViscoelasticCurve) -> xarray.Dataset:
    """Return the curve of a viscoelastic contact as a dataset along ``time``.

    Parameters
    ----------
    curve : ViscoelasticCurve

    Returns
    -------
    xarray.Dataset
        Variables with units and long names; two equal times are a jump.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> curve = rc.viscoelastic_curve(ball, rubber, times=[0, 1], forces=[1e-6, 1e-6], steps=4)
    >>> curve.to_dataset()["time"].attrs["units"]
    's'
    """
    data, kind = _variables(curve), curve.geometry
    time = data.pop(TIME.name)
    dataset = dataset_of(data, {TIME.name: time}, "viscoelastic contact of a rough surface in time", kind)
    return dataset.assign_attrs({"notes": "\n".join(curve.notes)} if curve.notes else {})


def viscoelastic_record(curve: ViscoelasticCurve) -> dict[str, Any]:
    """Return the curve of a viscoelastic contact as plain numbers, words and lists that JSON can hold.

    Units stand once, under ``"units"``. JSON has neither NaN nor infinity: both become None.

    Parameters
    ----------
    curve : ViscoelasticCurve

    Returns
    -------
    dict
        Numbers, texts and lists of them.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> curve = rc.viscoelastic_curve(ball, rubber, times=[0, 1], forces=[1e-6, 1e-6], steps=4)
    >>> curve.to_record()["units"]["relaxed_stiffness"]
    'N m-1'
    """
    return record_of(_variables(curve), curve.geometry, notes=list(curve.notes))


def _variables(curve: ViscoelasticCurve) -> Variables:
    data = variables_of(curve, VISCOELASTIC_CURVE, curve.geometry)
    return data | measured_variables(curve.measured, TIME.name)
