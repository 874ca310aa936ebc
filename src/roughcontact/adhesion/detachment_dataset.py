"""Stuck surfaces that are drawn back as labelled data, and as plain records."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.adhesion.detachment import Detachment
from roughcontact.adhesion.state_dataset import adhesive_variable
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import centres, dataset_of, plain_values, sizes, units_of, variable
from roughcontact.validation import Array

if TYPE_CHECKING:
    import xarray

    from roughcontact.adhesion.detachment_curve import DetachmentCurve
    from roughcontact.adhesion.detachment_state import DetachmentState

__all__ = [
    *("DETACHMENTS", "DETACHMENT_POINTS", "DETACHMENT_SCALES"),
    *("detachment_curve_dataset", "detachment_curve_record"),
    *("detachment_state_dataset", "detachment_state_record"),
]

DETACHMENTS = ("depth", "depth_after", "force_before", "force_after", "cells", "lost")
"""What a file says of detachments, each after ``detachment_``."""
DETACHMENT_POINTS = (
    *("force", "depth", "stiffness", "contact_area", "mean_gap"),
    *("elastic_energy", "adhesive_energy", "residual", "lowest_force"),
)
"""What a curve has at each load, and a file holds."""
DETACHMENT_SCALES = ("modulus", "nominal_area", "rms", "preload_too_small")
_DERIVED = ("contact_fraction", "energy")
_STATE = (
    "lowest_force_area",
    "pull_off_force",
    "lost",
    "preload_too_small",
    "largest_pressure",
    "largest_tension",
)
_MAPS = ("pressure", "displacement", "gap", "contact")


def detachment_curve_dataset(curve: DetachmentCurve) -> xarray.Dataset:
    """Return the points along ``load``, the detachments along ``detachment``, and the scales."""
    data = _curve_variables(curve) | sizes(curve)
    dataset = dataset_of(data, {}, "stuck surfaces that are drawn back", curve.geometry)
    attributes = {"control": curve.control, "tolerance": curve.tolerance, "notes": "\n".join(curve.notes)}
    return dataset.assign_attrs(attributes)


def detachment_curve_record(curve: DetachmentCurve) -> dict[str, Any]:
    """Return a curve as plain numbers, words and lists that JSON can hold."""
    record = _record(_curve_variables(curve), curve, curve.geometry)
    return record | {"control": curve.control, "tolerance": curve.tolerance, "notes": list(curve.notes)}


def detachment_state_dataset(state: DetachmentState) -> xarray.Dataset:
    """Return a state as a dataset: maps along the axes of the grid, detachments along ``detachment``.

    Row 0 is the top of the picture, so y points down. On a line forces, areas and energies are per unit length.
    """
    kind, grid, surface = state.geometry, state.problem.grid, state.problem.surface
    data = {name: adhesive_variable(name, kind.axes, getattr(state, name), kind) for name in _MAPS}
    if surface is not None:
        data["heights"] = variable("heights", kind.axes, surface.heights)
    data |= _state_variables(state) | sizes(grid)
    dataset = dataset_of(data, centres(grid, kind), "contact of stuck surfaces that are drawn back", kind)
    return dataset.assign_attrs({"notes": "\n".join(state.notes)})


def detachment_state_record(state: DetachmentState) -> dict[str, Any]:
    """Return the numbers of a state as plain values; units stand once, under ``"units"``."""
    record = _record(_state_variables(state), state.problem.grid, state.geometry)
    return record | {"tolerance": state.problem.tolerance, "notes": list(state.notes)}


def _curve_variables(curve: DetachmentCurve) -> dict[str, Any]:
    kind = curve.geometry
    points = {name: getattr(curve, name) for name in (*DETACHMENT_POINTS, *_DERIVED)}
    scales = {name: getattr(curve, name) for name in (*DETACHMENT_SCALES, "pull_off_force", "lost")}
    data = {name: adhesive_variable(name, ("load",), values, kind) for name, values in points.items()}
    data["status"] = variable("status", ("load",), [each.value for each in curve.status])
    data["detached_at"] = variable("detached_at", ("detachment",), np.array(curve.detached_at, np.int64))
    return data | _numbers(scales, curve.work, curve.detachments, kind)


def _state_variables(state: DetachmentState) -> dict[str, Any]:
    problem = state.problem
    scales = {name: getattr(state, name) for name in (*DETACHMENT_POINTS, *_DERIVED, *_STATE)}
    scales |= {"nominal_pressure": state.force / problem.grid.area, "modulus": problem.modulus}
    scales |= {} if problem.surface is None else {"rms": problem.surface.rms}
    data = _numbers(scales, state.work, state.detachments, state.geometry)
    return data | {"status": variable("status", (), state.status.value)}


def _numbers(
    scales: dict[str, Any], work: float | Array, events: Sequence[Detachment], kind: Geometry
) -> dict[str, Any]:
    scales["lost_energy"] = scales.pop("lost")
    data = {name: adhesive_variable(name, (), value, kind) for name, value in scales.items()}
    axes = kind.axes if np.ndim(work) else ()
    data["work_of_adhesion"] = variable("work_of_adhesion", axes, work)
    for name in DETACHMENTS:
        column = np.array([getattr(each, name) for each in events], np.int64 if name == "cells" else float)
        data[f"detachment_{name}"] = variable(f"detachment_{name}", ("detachment",), column, kind)
    return data


def _record(data: dict[str, Any], grid: Any, kind: Geometry) -> dict[str, Any]:
    """Return variables as plain values, without importing xarray."""
    record = {name: plain_values(values) for name, (_, values, _) in (data | sizes(grid)).items()}
    return record | {"geometry": kind.value, "units": units_of(record, kind)}
