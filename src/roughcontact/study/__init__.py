"""Studies: a case computed for a table of parameters and many samples, stored so that it can go on at any time."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

# Functions that are named as the files they live in: imported first, they keep the names.
from roughcontact.study.export import export as export
from roughcontact.study.perform import perform as perform
from roughcontact.study.run import run as run

_ROOMS = {
    "Case": "case",
    "Parameters": "case",
    "Study": "study",
    "Range": "ranges",
    "Store": "store",
    "Row": "row",
    "Summary": "summary",
    "StudyError": "study_errors",
    "StoreError": "study_errors",
    "Task": "task",
    "Outcome": "task",
    "Executor": "task",
    "Serial": "executors.serial",
    "Processes": "executors.processes",
    "Dask": "executors.dask",
    "Slurm": "executors.slurm",
    "Length": "parameters",
    "Area": "parameters",
    "Pressure": "parameters",
    "Force": "parameters",
    "Stiffness": "parameters",
    "Energy": "parameters",
    "Positive": "parameters",
    "find_case": "cases",
    "on_common": "common",
    "fit_power_laws": "fit",
    "law_at": "fit",
    "force_window": "fit_window",
    "resolved_window": "fit_window",
}
# Public names that are modules themselves.
_MODULES = ("statistics",)

__all__ = ["export", "perform", "run", *_ROOMS, *_MODULES]

if TYPE_CHECKING:
    from roughcontact.study import statistics as statistics
    from roughcontact.study.case import Case as Case
    from roughcontact.study.case import Parameters as Parameters
    from roughcontact.study.cases import find_case as find_case
    from roughcontact.study.common import on_common as on_common
    from roughcontact.study.executors.dask import Dask as Dask
    from roughcontact.study.executors.processes import Processes as Processes
    from roughcontact.study.executors.serial import Serial as Serial
    from roughcontact.study.executors.slurm import Slurm as Slurm
    from roughcontact.study.fit import fit_power_laws as fit_power_laws
    from roughcontact.study.fit import law_at as law_at
    from roughcontact.study.fit_window import force_window as force_window
    from roughcontact.study.fit_window import resolved_window as resolved_window
    from roughcontact.study.parameters import Area as Area
    from roughcontact.study.parameters import Energy as Energy
    from roughcontact.study.parameters import Force as Force
    from roughcontact.study.parameters import Length as Length
    from roughcontact.study.parameters import Positive as Positive
    from roughcontact.study.parameters import Pressure as Pressure
    from roughcontact.study.parameters import Stiffness as Stiffness
    from roughcontact.study.ranges import Range as Range
    from roughcontact.study.row import Row as Row
    from roughcontact.study.store import Store as Store
    from roughcontact.study.study import Study as Study
    from roughcontact.study.study_errors import StoreError as StoreError
    from roughcontact.study.study_errors import StudyError as StudyError
    from roughcontact.study.summary import Summary as Summary
    from roughcontact.study.task import Executor as Executor
    from roughcontact.study.task import Outcome as Outcome
    from roughcontact.study.task import Task as Task


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return import_module(f"roughcontact.study.{name}")
    if name not in _ROOMS:
        raise AttributeError(f"module 'roughcontact.study' has no attribute {name!r}")
    value = getattr(import_module(f"roughcontact.study.{_ROOMS[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
