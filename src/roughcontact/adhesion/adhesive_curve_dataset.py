"""A path of surfaces that stick as labelled data, and as a plain record."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.adhesion.state_dataset import (
    adhesion_record,
    adhesion_variables,
    adhesive_variable,
    jump_variables,
    jumps_record,
)
from roughcontact.labels.labelled import dataset_of, plain_values, sizes, units_of, variable

if TYPE_CHECKING:
    import xarray

    from roughcontact.adhesion.adhesive_curve import AdhesiveCurve

__all__ = ["LOOP_POINTS", "LOOP_SCALES", "adhesive_curve_dataset", "adhesive_curve_record"]

LOOP_POINTS = (
    *("force", "depth", "stiffness", "contact_stiffness", "contact_area", "mean_gap"),
    *("elastic_energy", "energy", "residual", "lowest_force"),
)
"""What a path has at each load, and a file holds."""
LOOP_SCALES = ("modulus", "nominal_area", "rms")
_DERIVED = ("contact_fraction", "adhesive_energy")
_SCALARS = {"pull_off_force": "pull_off_force", "jump_in_force": "jump_in_force", "lost_energy": "lost"}
_NUMBERS = ("unresolved", *LOOP_SCALES)


def adhesive_curve_dataset(loop: AdhesiveCurve) -> xarray.Dataset:
    """Return the points along ``load``, the jumps along ``jump``, and the scales."""
    kind = loop.geometry
    names = (*LOOP_POINTS, *_DERIVED)
    data = {name: adhesive_variable(name, ("load",), getattr(loop, name), kind) for name in names}
    data["branch"] = adhesive_variable("branch", ("load",), _branches(loop), kind)
    data["status"] = variable("status", ("load",), [each.value for each in loop.status])
    data |= {name: variable(name, (), getattr(loop, attribute), kind) for name, attribute in _SCALARS.items()}
    data |= {name: variable(name, (), getattr(loop, name), kind) for name in _NUMBERS}
    data |= adhesion_variables(loop.adhesion, kind) | jump_variables(loop.jumps, _bracket(loop), kind)
    data["jumped"] = variable("jumped", ("jump",), np.array(loop.jumped, np.int64))
    title = "approach and retreat of surfaces that stick"
    attributes = {"law": loop.adhesion.law, "control": loop.control, "tolerance": loop.tolerance}
    return dataset_of(data | sizes(loop), {}, title, kind).assign_attrs(attributes)


def adhesive_curve_record(loop: AdhesiveCurve) -> dict[str, Any]:
    """Return a path as plain numbers, words and lists that JSON can hold."""
    names = (*LOOP_POINTS, *_DERIVED, *_NUMBERS, "lengths", "spacing", "periodic")
    record = {name: plain_values(getattr(loop, name)) for name in names}
    record |= {name: plain_values(getattr(loop, attribute)) for name, attribute in _SCALARS.items()}
    record |= adhesion_record(loop.adhesion) | jumps_record(loop.jumps, _bracket(loop))
    record |= {
        "jumped": list(loop.jumped),
        "branch": _branches(loop).tolist(),
        "status": [each.value for each in loop.status],
    }
    record |= {"control": loop.control, "tolerance": loop.tolerance, "ambiguous": loop.ambiguous}
    return record | {"geometry": loop.geometry.value, "units": units_of(record, loop.geometry)}


def _branches(loop: AdhesiveCurve) -> Any:
    return np.where(loop.approach, "approach", "retreat")


def _bracket(loop: AdhesiveCurve) -> str:
    return f"jump_{loop.control}_bracket"
