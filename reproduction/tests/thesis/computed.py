"""What studies export, computed in memory."""

from dataclasses import dataclass

import xarray

from roughcontact.study.export import assemble
from roughcontact.study.run_task import run_task


@dataclass(frozen=True)
class Row:
    key: str
    status: str
    seconds: float
    version: str
    record: xarray.Dataset | None


def exported(study, *, seconds=False):
    """Return what a study exports once it is run; a case that fails is an error here."""
    rows = []
    for task in study.tasks():
        result = run_task(task)
        assert not result.message, result.message
        rows.append(Row(task.key, "done", result.seconds, "test", result.record))
    return assemble(study, rows, seconds=seconds)
