"""Detachment of stuck surfaces as labelled data, and as plain records."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roughcontact.adhesion.detachment_curve import DetachmentCurve
from roughcontact.adhesion.detachment_state import DetachmentState
from roughcontact.adhesion.state_dataset import events, work_variables
from roughcontact.labels.adhesive_columns import (
    DETACHMENT_CURVE,
    DETACHMENT_MAPS,
    DETACHMENT_STATE,
    DETACHMENTS,
)
from roughcontact.labels.column import CELLS
from roughcontact.labels.contact_columns import HEIGHTS, RMS, STATE_NAMES
from roughcontact.labels.labelled import Variables, centres, dataset_of, record_of, variables_of

if TYPE_CHECKING:
    import xarray

__all__ = [
    *("DETACHMENT_NAMES", "detachment_curve_dataset", "detachment_curve_record"),
    *("detachment_state_dataset", "detachment_state_record"),
]

DETACHMENT_NAMES = {column: column.name.removeprefix("detachment_") for column in DETACHMENTS}
"""The attributes of a `Detachment`, by the columns of detachments."""
_NAMES = {**STATE_NAMES, "lost_energy": "lost"}


def detachment_curve_dataset(curve: DetachmentCurve) -> xarray.Dataset:
    """Return the points along ``load``, the detachments along ``detachment``, and the scales.

    Parameters
    ----------
    curve : DetachmentCurve

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> curve = rc.detachment_curve(rc.press(ball, 1e8, depth=2e-8), 10e-3)
    >>> curve.to_dataset()["detachment_lost"].attrs["units"]
    'J'
    """
    dataset = dataset_of(_of_curve(curve), {}, "stuck surfaces that are drawn back", curve.geometry)
    attributes = {"control": curve.control, "tolerance": curve.tolerance, "notes": "\n".join(curve.notes)}
    return dataset.assign_attrs(attributes)


def detachment_curve_record(curve: DetachmentCurve) -> dict[str, Any]:
    """Return a curve as plain numbers, words and lists, for JSON.

    Parameters
    ----------
    curve : DetachmentCurve

    Returns
    -------
    dict
        Numbers, texts and lists of them; values that are not finite become None.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> curve = rc.detachment_curve(rc.press(ball, 1e8, depth=2e-8), 10e-3)
    >>> curve.to_record()["control"]
    'depth'
    """
    more = {"control": curve.control, "tolerance": curve.tolerance, "notes": list(curve.notes)}
    return record_of(_of_curve(curve), curve.geometry, **more)


def detachment_state_dataset(state: DetachmentState) -> xarray.Dataset:
    """Return a state as a dataset: maps along the axes of the grid, detachments along ``detachment``.

    Row 0 is the top of the picture, so y points down. On a line forces, areas and energies are per unit length.

    Parameters
    ----------
    state : DetachmentState

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> *_, state = rc.detachment_path(rc.press(ball, 1e8, depth=2e-8), 10e-3, depths=[1e-8, 0.0])
    >>> state.to_dataset()["detachment_depth"].attrs["units"]
    'm'
    """
    kind, grid, surface = state.geometry, state.problem.grid, state.problem.surface
    data = variables_of(state, {(CELLS,): DETACHMENT_MAPS}, kind)
    if surface is not None:
        data |= variables_of(surface, {(CELLS,): (HEIGHTS,)}, kind)
    title = "contact of stuck surfaces that are drawn back"
    dataset = dataset_of(data | _of_state(state), centres(grid, kind), title, kind)
    return dataset.assign_attrs({"notes": "\n".join(state.notes)})


def detachment_state_record(state: DetachmentState) -> dict[str, Any]:
    """Return the numbers of a state as plain values; units stand once, under ``"units"``.

    Parameters
    ----------
    state : DetachmentState

    Returns
    -------
    dict
        Numbers, texts and lists of them; values that are not finite become None.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rings = rc.RadialGrid.uniform(60, radius=6e-7)
    >>> ball = rc.RadialProfile(-(rings.radii**2) / 2e-5, rings)
    >>> *_, state = rc.detachment_path(rc.press(ball, 1e8, depth=2e-8), 10e-3, depths=[1e-8, 0.0])
    >>> state.to_record()["status"]
    'converged'
    """
    more = {"tolerance": state.problem.tolerance, "notes": list(state.notes)}
    return record_of(_of_state(state), state.geometry, **more)


def _of_curve(curve: DetachmentCurve) -> Variables:
    kind = curve.geometry
    data = variables_of(curve, DETACHMENT_CURVE, kind, {"lost_energy": "lost"})
    data |= work_variables(curve.work, kind)
    return data | events("detachment", curve.detachments, DETACHMENT_NAMES, kind)


def _of_state(state: DetachmentState) -> Variables:
    kind, surface = state.geometry, state.problem.surface
    data = variables_of(state, DETACHMENT_STATE, kind, _NAMES) | work_variables(state.work, kind)
    data |= {} if surface is None else variables_of(surface, {(): (RMS,)}, kind)
    return data | events("detachment", state.detachments, DETACHMENT_NAMES, kind)
