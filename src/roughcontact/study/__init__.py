"""Studies: a case computed for a table of parameters and many samples, stored so that it can be resumed at any time."""

from types import ModuleType as _Module

from roughcontact.study.case import (
    Area as Area,
    Case as Case,
    Energy as Energy,
    EnergyPerArea as EnergyPerArea,
    Force as Force,
    Length as Length,
    Parameters as Parameters,
    Positive as Positive,
    Pressure as Pressure,
    Stiffness as Stiffness,
)
from roughcontact.study.cases import find_case as find_case
from roughcontact.study.executors import (
    Dask as Dask,
    Processes as Processes,
    Serial as Serial,
)
from roughcontact.study.export import export as export
from roughcontact.study.ranges import Range as Range
from roughcontact.study.record import Row as Row
from roughcontact.study.run import run as run
from roughcontact.study.run_task import run_task as run_task
from roughcontact.study.store import Store as Store
from roughcontact.study.study import Study as Study
from roughcontact.study.study_errors import StoreError as StoreError, StudyError as StudyError
from roughcontact.study.task import Executor as Executor, Result as Result, Summary as Summary, Task as Task

__all__ = [
    name for name, each in globals().items() if not (name.startswith("_") or isinstance(each, _Module))
]
