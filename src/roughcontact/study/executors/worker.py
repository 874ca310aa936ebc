"""What every engine does in a worker: a task comes in, a result goes out as bytes."""

from __future__ import annotations

import pickle
import sys
from importlib import import_module

from roughcontact.errors import InputError
from roughcontact.study.task import Result, RunTask, Task

__all__ = ["TRIES", "WorkersError", "cannot_load", "computed", "lost", "pickled", "require_cluster"]

# A task whose worker died is tried again twice: workers are also killed from outside, by people, for the memory that
# another program wanted, with their machine.
TRIES = 3


class WorkersError(InputError):
    """The workers cannot be used: they do not start, cannot load the case, or have gone for good."""


def computed(run_task: RunTask, task: Task) -> bytes:
    """Return the result of `task`, pickled: one that cannot be sent is the failure of its case and of nothing else."""
    try:
        result = run_task(task)
    except SystemExit as error:  # would end the worker
        result = Result(task.key, None, f"the case called for an exit with status {error.code}", 0.0)
    try:
        return pickle.dumps(result, pickle.HIGHEST_PROTOCOL)
    except Exception as error:
        message = f"its record cannot be sent back: {type(error).__name__}: {error}"
        return pickle.dumps(Result(task.key, None, message, result.seconds), pickle.HIGHEST_PROTOCOL)


def pickled(thing: object, name: str) -> bytes:
    """Return what is sent to another process.

    Raises
    ------
    WorkersError
        If it cannot be sent.
    """
    try:
        return pickle.dumps(thing, pickle.HIGHEST_PROTOCOL)
    except Exception as error:
        raise WorkersError(
            f"{name} cannot be sent to another process: {error}",
            "define its functions and classes at the top of a module, none inside another function",
        ) from error


def require_cluster(module: str, name: str) -> None:
    """Refuse to go on without a package of the extra for clusters.

    Raises
    ------
    WorkersError
        If it cannot be imported.
    """
    try:
        import_module(module)
    except ImportError as error:
        raise WorkersError(
            f"{name} cannot be imported ({error})",
            f"run: {sys.executable} -m pip install 'roughcontact[cluster]'",
        ) from error


def cannot_load(reason: str) -> WorkersError:
    """Return the error of a worker that cannot load what it was sent."""
    return WorkersError(
        f"a worker cannot load what it is to compute ({reason}); the case must stand in a module that the workers can "
        "import, not in the script or notebook that runs the study, and other machines need the same versions"
    )


def lost(task: Task, reason: str) -> Result:
    """Return the result of a task that took its workers down."""
    return Result(task.key, None, reason, 0.0)
