"""A state of a contact that sticks as labelled data, and as a plain record; jumps as a table."""

from __future__ import annotations

from collections.abc import Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.control_form import ForceControl
from roughcontact.adhesion.quasi_static import Jump
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.labelled import centres, dataset_of, plain_values, sizes, units_of, variable

if TYPE_CHECKING:
    import xarray

    from roughcontact.adhesion.adhesive_state import AdhesiveState

__all__ = [
    "JUMPS",
    "adhesion_record",
    "adhesion_variables",
    "adhesive_variable",
    "jump_variables",
    "jumps_record",
]

_MAPS = ("pressure", "displacement", "gap", "contact", "attracted")
_SCALARS = (
    *("force", "depth", "stiffness", "contact_stiffness", "contact_area", "contact_fraction", "mean_gap"),
    *(
        "elastic_energy",
        "adhesive_energy",
        "energy",
        "stability",
        "stability_residual",
        "residual",
        "unresolved",
    ),
)
# What these names say of a contact that sticks, and not of others.
_WORDS = MappingProxyType(
    {
        "stiffness": "slope of the force with the depth along the branch, the attraction taking part",
        "pressure": "reaction of the wall less the attraction, tension negative",
        "contact": "whether the wall holds the cell",
        "contact_area": "area of the cells that the wall holds",
        "force": "normal force, tension negative",
        "branch": "branch of the path: approach or retreat",
    }
)
JUMPS = MappingProxyType(
    {
        **{f"jump_{name}": name for name in ("depth", "depth_after", "force_before", "force_after")},
        **{f"jump_{name}": name for name in ("lost", "approach", "ambiguous")},
    }
)
"""What a file says of jumps, and the attribute that it is."""


def adhesive_variable(
    name: str, dimensions: tuple[str, ...], values: Any, geometry: Geometry
) -> tuple[Any, Any, dict[str, str]]:
    """Return what xarray takes as a variable, of a contact that sticks."""
    along, numbers, words = variable(name, dimensions, values, geometry)
    return along, numbers, words | ({"long_name": _WORDS[name]} if name in _WORDS else {})


def adhesion_variables(adhesion: Adhesion, geometry: Geometry) -> dict[str, Any]:
    """Return the numbers of a law of adhesion as variables; its name is an attribute of the file."""
    axes = geometry.axes if np.ndim(adhesion.work) else ()
    return {
        "work_of_adhesion": variable("work_of_adhesion", axes, adhesion.work),
        "adhesion_range": variable("adhesion_range", (), adhesion.range),
        "allow_unresolved": variable("allow_unresolved", (), adhesion.allow_unresolved),
    }


def adhesion_record(adhesion: Adhesion) -> dict[str, Any]:
    """Return a law of adhesion as plain values."""
    return {
        "law": adhesion.law,
        "work_of_adhesion": plain_values(np.asarray(adhesion.work)),
        "adhesion_range": adhesion.range,
        "allow_unresolved": adhesion.allow_unresolved,
    }


def jump_variables(jumps: Sequence[Jump], bracket: str, geometry: Geometry) -> dict[str, Any]:
    """Return the jumps as variables along ``jump``; `bracket` names that of the depth or of the force."""
    return {
        name: variable(name, ("jump",), values, geometry) for name, values in _columns(jumps, bracket).items()
    }


def jumps_record(jumps: Sequence[Jump], bracket: str) -> dict[str, Any]:
    """Return the jumps as lists of plain values."""
    return {name: plain_values(values) for name, values in _columns(jumps, bracket).items()}


def state_dataset(state: AdhesiveState) -> xarray.Dataset:
    """Return a state as a dataset: maps along the axes of the grid, numbers without a dimension, jumps along ``jump``.

    Row 0 is the top of the picture, so y points down. On a line forces, areas and energies are per unit length.
    """
    problem, kind = state.problem, state.geometry
    grid = problem.operator.grid
    data = {name: adhesive_variable(name, kind.axes, getattr(state, name), kind) for name in _MAPS}
    if problem.surface is not None:
        data["heights"] = variable("heights", kind.axes, problem.surface.heights)
    data |= {name: adhesive_variable(name, (), value, kind) for name, value in _scalars(state).items()}
    data["status"] = variable("status", (), state.status.value)
    data |= adhesion_variables(problem.adhesion, kind) | jump_variables(state.jumps, _bracket(state), kind)
    dataset = dataset_of(data | sizes(grid), centres(grid, kind), "contact of surfaces that stick", kind)
    return dataset.assign_attrs(law=problem.adhesion.law)


def state_record(state: AdhesiveState) -> dict[str, Any]:
    """Return the numbers of a state as plain values; units stand once, under ``"units"``."""
    grid = state.problem.operator.grid
    numbers = _scalars(state) | {
        name: getattr(grid, name) for name in ("shape", "lengths", "spacing", "periodic")
    }
    record = {name: plain_values(value) for name, value in numbers.items()}
    record |= adhesion_record(state.problem.adhesion) | jumps_record(state.jumps, _bracket(state))
    record |= {"status": state.status.value, "tolerance": state.problem.tolerance}
    return record | {"geometry": state.geometry.value, "units": units_of(record, state.geometry)}


def _scalars(state: AdhesiveState) -> dict[str, Any]:
    """Return the numbers of a state, and those by which it is judged."""
    scalars = {name: getattr(state, name) for name in _SCALARS} | {
        "largest_pressure": float(state.pressure.max()),
        "largest_tension": float(np.maximum(-state.pressure, 0.0).max()),
        "nominal_pressure": state.force / state.problem.operator.grid.area,
        "modulus": state.problem.modulus,
    }
    return scalars if state.problem.surface is None else scalars | {"rms": state.problem.surface.rms}


def _bracket(state: AdhesiveState) -> str:
    return "jump_force_bracket" if isinstance(state.problem.control, ForceControl) else "jump_depth_bracket"


def _columns(jumps: Sequence[Jump], bracket: str) -> dict[str, Any]:
    names = {**JUMPS, bracket: "bracket"}
    kinds = {"approach": bool, "ambiguous": bool}
    return {
        name: np.array([getattr(jump, attribute) for jump in jumps], kinds.get(attribute, float))
        for name, attribute in names.items()
    }
