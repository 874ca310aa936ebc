"""A state of an adhesive contact as labelled data and as a plain record, with its jumps and its law."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from roughcontact.adhesion.adhesive_state import AdhesiveState
from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.control_form import ForceControl
from roughcontact.adhesion.quasi_static import Jump
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.adhesive_columns import ADHESION, ADHESIVE_STATE, BRACKETS, JUMPS, WORK_OF_ADHESION
from roughcontact.labels.column import CELLS, Column
from roughcontact.labels.contact_columns import HEIGHTS, RMS
from roughcontact.labels.labelled import (
    Variables,
    attributes_of,
    centres,
    dataset_of,
    record_of,
    variable,
    variables_of,
)
from roughcontact.validation import Array

if TYPE_CHECKING:
    import xarray

__all__ = [
    *("events", "jump_columns", "jump_variables", "law_variables", "state_dataset", "state_record"),
    "work_variables",
]

_NAMES = {
    "modulus": "problem.modulus",
    **{name: f"problem.operator.grid.{name}" for name in ("lengths", "spacing", "periodic")},
}


def state_dataset(state: AdhesiveState) -> xarray.Dataset:
    """Return a state as a dataset: maps along the axes of the grid, numbers without a dimension, jumps along ``jump``.

    Row 0 is the top of the picture, so y points down. On a line forces, areas and energies are per unit length.

    Parameters
    ----------
    state : AdhesiveState

    Returns
    -------
    xarray.Dataset
        Variables with units and long names.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 2e-8), radius=1e-5)
    >>> state = rc.adhesive_state(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=2e-9)
    >>> f"{float(state.to_dataset()['adhesive_energy']) * 1e15:.1f} fJ of adhesion"
    '-3.8 fJ of adhesion'
    """
    problem, kind = state.problem, state.geometry
    grid = problem.operator.grid
    data = variables_of(state, {(CELLS,): ADHESIVE_STATE[(CELLS,)]}, kind, _NAMES)
    if problem.surface is not None:
        data |= variables_of(problem.surface, {(CELLS,): (HEIGHTS,)}, kind)
    title = "contact of surfaces that stick"
    dataset = dataset_of(data | _numbers(state), centres(grid, kind), title, kind)
    return dataset.assign_attrs(law=problem.adhesion.law, notes="\n".join(state.notes))


def state_record(state: AdhesiveState) -> dict[str, Any]:
    """Return the numbers of a state as plain values; units stand once, under ``"units"``.

    Parameters
    ----------
    state : AdhesiveState

    Returns
    -------
    dict
        Numbers, texts and lists of them; values that are not finite become None.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 2e-8), radius=1e-5)
    >>> state = rc.adhesive_state(ball, 1e8, rc.Adhesion(work=10e-3, range=4e-9), depth=2e-9)
    >>> state.to_record()["law"], state.to_record()["units"]["stability"]
    ('exponential', '1')
    """
    problem = state.problem
    more = {
        "shape": list(problem.operator.grid.shape),
        "law": problem.adhesion.law,
        "tolerance": problem.tolerance,
        "notes": list(state.notes),
    }
    return record_of(_numbers(state), state.geometry, **more)


def _numbers(state: AdhesiveState) -> Variables:
    problem, kind = state.problem, state.geometry
    control = "force" if isinstance(problem.control, ForceControl) else "depth"
    table = {along: columns for along, columns in ADHESIVE_STATE.items() if along != (CELLS,)}
    data = variables_of(state, table, kind, _NAMES)
    if problem.surface is not None:
        data |= variables_of(problem.surface, {(): (RMS,)}, kind)
    return data | law_variables(problem.adhesion, kind) | jump_variables(state.jumps, control, kind)


def law_variables(adhesion: Adhesion, geometry: Geometry) -> Variables:
    """Return the numbers of a law of adhesion; its name is an attribute of the file."""
    law = variables_of(adhesion, {(): ADHESION}, geometry, {"adhesion_range": "range"})
    return work_variables(adhesion.work, geometry) | law


def work_variables(work: float | Array, geometry: Geometry) -> Variables:
    """Return a work of adhesion, one number or a map."""
    axes = geometry.axes if np.ndim(work) else ()
    return {WORK_OF_ADHESION.name: variable(WORK_OF_ADHESION.name, axes, work)}


def jump_columns(control: str) -> dict[Column, str]:
    """Return the columns of jumps under prescribed depths or forces, with the attributes of a `Jump`."""
    names = {column: column.name.removeprefix("jump_") for column in JUMPS}
    return names | {BRACKETS[control]: "bracket"}


def jump_variables(jumps: Sequence[Jump], control: str, geometry: Geometry) -> Variables:
    """Return jumps under prescribed depths or forces as variables along ``jump``."""
    return events("jump", jumps, jump_columns(control), geometry)


def events(along: str, each: Sequence[Any], columns: dict[Column, str], geometry: Geometry) -> Variables:
    """Return the events of a path as variables along a dimension."""
    kinds = {
        "": bool,
        "1": np.int64,
    }  # types of truths and counts, which NumPy cannot infer from an empty list
    return {
        column.name: (
            (along,),
            np.array([getattr(event, name) for event in each], kinds.get(column.unit, float)),
            attributes_of(column, geometry),
        )
        for column, name in columns.items()
    }
