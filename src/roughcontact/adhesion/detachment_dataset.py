"""Stuck surfaces that are drawn back as labelled data, and as plain records."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.adhesion.detachment import Detachment
from roughcontact.adhesion.state_dataset import adhesive_variable
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import centres, dataset_of, plain_values, sizes, units_of, variable

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
_MAPS = ("pressure", "displacement", "gap", "contact")


def detachment_curve_dataset(curve: DetachmentCurve) -> xarray.Dataset:
    """Return the points along ``load``, the detachments along ``detachment``, and the scales."""
    kind = curve.geometry
    names = (*DETACHMENT_POINTS, *_DERIVED)
    data = {name: adhesive_variable(name, ("load",), getattr(curve, name), kind) for name in names}
    data["status"] = variable("status", ("load",), [each.value for each in curve.status])
    data |= {name: variable(name, (), value, kind) for name, value in _scalars(curve).items()}
    data |= _work(curve, kind) | _detachments(curve.detachments, kind)
    data["detached"] = variable("detached", ("detachment",), np.array(curve.detached, np.int64))
    dataset = dataset_of(data | sizes(curve), {}, "stuck surfaces that are drawn back", kind)
    attributes = {"control": curve.control, "tolerance": curve.tolerance, "notes": "\n".join(curve.notes)}
    return dataset.assign_attrs(attributes)


def detachment_curve_record(curve: DetachmentCurve) -> dict[str, Any]:
    """Return a curve as plain numbers, words and lists that JSON can hold."""
    names = (*DETACHMENT_POINTS, *_DERIVED, "lengths", "spacing", "periodic")
    record = {name: plain_values(getattr(curve, name)) for name in names}
    record |= {name: plain_values(value) for name, value in _scalars(curve).items()}
    record |= _work_record(curve) | _detachments_record(curve.detachments)
    record |= {"detached": list(curve.detached), "status": [each.value for each in curve.status]}
    record |= {"control": curve.control, "tolerance": curve.tolerance, "notes": list(curve.notes)}
    return record | {"geometry": curve.geometry.value, "units": units_of(record, curve.geometry)}


def detachment_state_dataset(state: DetachmentState) -> xarray.Dataset:
    """Return a state as a dataset: maps along the axes of the grid, detachments along ``detachment``.

    Row 0 is the top of the picture, so y points down. On a line forces, areas and energies are per unit length.
    """
    kind, grid, surface = state.geometry, state.problem.grid, state.problem.surface
    data = {name: adhesive_variable(name, kind.axes, getattr(state, name), kind) for name in _MAPS}
    if surface is not None:
        data["heights"] = variable("heights", kind.axes, surface.heights)
    data |= {name: adhesive_variable(name, (), value, kind) for name, value in _numbers(state).items()}
    data["status"] = variable("status", (), state.status.value)
    data |= _work(state, kind) | _detachments(state.detachments, kind)
    title = "contact of stuck surfaces that are drawn back"
    dataset = dataset_of(data | sizes(grid), centres(grid, kind), title, kind)
    return dataset.assign_attrs({"notes": "\n".join(state.notes)} if state.notes else {})


def detachment_state_record(state: DetachmentState) -> dict[str, Any]:
    """Return the numbers of a state as plain values; units stand once, under ``"units"``."""
    grid = state.problem.grid
    numbers = _numbers(state) | {
        name: getattr(grid, name) for name in ("shape", "lengths", "spacing", "periodic")
    }
    record = {name: plain_values(value) for name, value in numbers.items()}
    record |= _work_record(state) | _detachments_record(state.detachments)
    record |= {"status": state.status.value, "tolerance": state.problem.tolerance, "notes": list(state.notes)}
    return record | {"geometry": state.geometry.value, "units": units_of(record, state.geometry)}


def _scalars(curve: DetachmentCurve) -> dict[str, Any]:
    scales = {name: getattr(curve, name) for name in DETACHMENT_SCALES}
    return scales | {"pull_off_force": curve.pull_off_force, "lost_energy": curve.lost}


def _numbers(state: DetachmentState) -> dict[str, Any]:
    problem = state.problem
    names = (*DETACHMENT_POINTS, *_DERIVED, "lowest_force_area", "pull_off_force", "preload_too_small")
    numbers = {name: getattr(state, name) for name in names} | {
        "lost_energy": state.lost,
        "largest_pressure": float(state.pressure.max()),
        "largest_tension": float(np.maximum(-state.pressure, 0.0).max()),
        "nominal_pressure": state.force / problem.grid.area,
        "modulus": problem.modulus,
    }
    return numbers if problem.surface is None else numbers | {"rms": problem.surface.rms}


def _work(answer: DetachmentCurve | DetachmentState, geometry: Geometry) -> dict[str, Any]:
    axes = geometry.axes if np.ndim(answer.work) else ()
    return {"work_of_adhesion": variable("work_of_adhesion", axes, answer.work)}


def _work_record(answer: DetachmentCurve | DetachmentState) -> dict[str, Any]:
    return {"work_of_adhesion": plain_values(np.asarray(answer.work))}


def _columns(events: Sequence[Detachment]) -> dict[str, Any]:
    return {
        f"detachment_{name}": np.array(
            [getattr(event, name) for event in events], np.int64 if name == "cells" else np.float64
        )
        for name in DETACHMENTS
    }


def _detachments(events: Sequence[Detachment], geometry: Geometry) -> dict[str, Any]:
    return {
        name: variable(name, ("detachment",), values, geometry) for name, values in _columns(events).items()
    }


def _detachments_record(events: Sequence[Detachment]) -> dict[str, Any]:
    return {name: plain_values(values) for name, values in _columns(events).items()}
