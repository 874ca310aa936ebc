"""Studies: a case computed for a table of parameters and many samples, stored so that it can go on at any time."""

from types import ModuleType as _Module

from roughcontact.study.case import Area as Area
from roughcontact.study.case import Case as Case
from roughcontact.study.case import Energy as Energy
from roughcontact.study.case import Force as Force
from roughcontact.study.case import Length as Length
from roughcontact.study.case import Parameters as Parameters
from roughcontact.study.case import Positive as Positive
from roughcontact.study.case import Pressure as Pressure
from roughcontact.study.case import Stiffness as Stiffness
from roughcontact.study.cases import find_case as find_case
from roughcontact.study.executors import Dask as Dask
from roughcontact.study.executors import Processes as Processes
from roughcontact.study.executors import Serial as Serial
from roughcontact.study.executors import Slurm as Slurm
from roughcontact.study.export import export as export
from roughcontact.study.perform import perform as perform
from roughcontact.study.ranges import Range as Range
from roughcontact.study.record import Row as Row
from roughcontact.study.run import run as run
from roughcontact.study.store import Store as Store
from roughcontact.study.study import Study as Study
from roughcontact.study.study_errors import StoreError as StoreError
from roughcontact.study.study_errors import StudyError as StudyError
from roughcontact.study.task import Executor as Executor
from roughcontact.study.task import Outcome as Outcome
from roughcontact.study.task import Summary as Summary
from roughcontact.study.task import Task as Task

__all__ = [
    name for name, each in globals().items() if not (name.startswith("_") or isinstance(each, _Module))
]
