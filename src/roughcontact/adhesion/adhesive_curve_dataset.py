"""A path of surfaces that stick as labelled data, and as a plain record."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
from roughcontact.adhesion.state_dataset import jump_variables, law_variables
from roughcontact.labels.adhesive_columns import ADHESIVE_CURVE
from roughcontact.labels.labelled import Variables, dataset_of, record_of, variables_of

if TYPE_CHECKING:
    import xarray

__all__ = ["adhesive_curve_dataset", "adhesive_curve_record"]


def adhesive_curve_dataset(loop: AdhesiveCurve) -> xarray.Dataset:
    """Return the points along ``load``, the jumps along ``jump``, and the scales.

    Parameters
    ----------
    loop : AdhesiveCurve

    Returns
    -------
    xarray.Dataset
        ``branch`` is the approach or the retreat, for each load.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=10e-9)
    >>> loop.to_dataset()["jump_lost"].attrs["units"]
    'J'
    """
    title = "approach and retreat of surfaces that stick"
    attributes = {"law": loop.adhesion.law, "control": loop.control, "tolerance": loop.tolerance}
    dataset = dataset_of(_variables(loop), {}, title, loop.geometry)
    return dataset.assign_attrs(attributes, notes="\n".join(loop.notes))


def adhesive_curve_record(loop: AdhesiveCurve) -> dict[str, Any]:
    """Return a path as plain numbers, words and lists, for JSON.

    Parameters
    ----------
    loop : AdhesiveCurve

    Returns
    -------
    dict
        Numbers, texts and lists of them; values that are not finite become None.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> loop = rc.adhesive_loop(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=10e-9)
    >>> loop.to_record()["control"], loop.to_record()["branch"][0]
    ('depth', 'approach')
    """
    more = {"law": loop.adhesion.law, "control": loop.control, "tolerance": loop.tolerance}
    return record_of(
        _variables(loop), loop.geometry, **more, notes=list(loop.notes), ambiguous=loop.ambiguous
    )


def _variables(loop: AdhesiveCurve) -> Variables:
    kind = loop.geometry
    data = variables_of(loop, ADHESIVE_CURVE, kind, {"lost_energy": "lost"})
    return data | law_variables(loop.adhesion, kind) | jump_variables(loop.jumps, loop.control, kind)
