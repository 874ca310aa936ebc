"""Where the cases of a study are computed, as options of the command line say it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from enum import StrEnum
from typing import TYPE_CHECKING

from roughcontact.cli.messages import UsageError

if TYPE_CHECKING:
    from roughcontact.study.task import Executor

__all__ = ["Engine", "engine_of", "options_of", "working"]


class Engine(StrEnum):
    """Where cases are computed."""

    SERIAL = "serial"
    PROCESSES = "processes"
    DASK = "dask"
    SLURM = "slurm"


def engine_of(executor: Engine, workers: int | None, scheduler: str | None) -> Executor:
    """Return the executor that was asked for.

    Raises
    ------
    UsageError
        If the options contradict each other.
    """
    from roughcontact.study import executors

    if scheduler is not None and executor is not Engine.DASK:
        raise UsageError("--scheduler: only --executor dask has one")
    match executor:
        case Engine.SERIAL:
            if workers not in (None, 1):
                raise UsageError("--workers: --executor serial computes one case at a time: choose processes")
            return executors.Serial()
        case Engine.PROCESSES:
            return executors.Processes(workers)
        case Engine.DASK:
            if scheduler is not None and workers is not None:
                raise UsageError("--workers: a scheduler has workers of its own: leave out one of the two")
            return executors.Dask(scheduler, workers=workers)
        case Engine.SLURM:
            if workers is None:
                raise UsageError(
                    "--workers: say how many cases SLURM shall compute at once, such as --workers 48"
                )
            return executors.Slurm(workers)


def options_of(executor: Engine, workers: int | None, scheduler: str | None) -> list[str]:
    """Return what of the engine is not by default, as it is typed."""
    options = {
        "--executor": None if executor is Engine.PROCESSES else executor.value,
        "--workers": workers,
        "--scheduler": scheduler,
    }
    return [each for name, value in options.items() if value is not None for each in (name, str(value))]


@contextmanager
def working() -> Iterator[None]:
    """Turn trouble with the workers into an error for the user."""
    from roughcontact.study.executors.worker import WorkersError

    try:
        yield
    except WorkersError as error:
        raise UsageError(str(error)) from error
