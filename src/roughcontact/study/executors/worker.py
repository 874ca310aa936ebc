"""The part of all executors that runs in a worker: it receives a task and returns a result as bytes."""

from __future__ import annotations

import pickle
import sys
from importlib import import_module

from roughcontact.errors import InputError
from roughcontact.study.task import Result, RunTask, Task

__all__ = ["TRIES", "WorkersError", "cannot_load", "computed", "lost", "pickled", "require_cluster"]

# A task whose worker died is tried twice again, because workers are also killed from outside: by users, for memory of
# other programs, or with their machine.
TRIES = 3


class WorkersError(InputError):
    """The workers cannot be used: they do not start, cannot load the case, or have ended."""


def computed(run_task: RunTask, task: Task) -> bytes:
    """Return the result of `task`, pickled: if it cannot be sent, only its case fails."""
    try:
        result = run_task(task)
    except SystemExit as error:  # would end the worker
        result = Result(task.key, None, f"the case called exit with status {error.code}", 0.0)
    try:
        return pickle.dumps(result, pickle.HIGHEST_PROTOCOL)
    except Exception as error:
        message = f"its record cannot be sent back: {type(error).__name__}: {error}"
        return pickle.dumps(Result(task.key, None, message, result.seconds), pickle.HIGHEST_PROTOCOL)


def pickled(thing: object, name: str) -> bytes:
    """Return an object as bytes for another process.

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
            "define its functions and classes at the top level of a module",
        ) from error


def require_cluster(module: str, name: str) -> None:
    """Raise an error if a package of the extra for clusters is missing.

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
        f"a worker cannot load its task ({reason}); put the case into a module that the workers can import, "
        "rather than into the script or notebook that runs the study, and install the same versions on all "
        "machines"
    )


def lost(task: Task, reason: str) -> Result:
    """Return the result of a task whose workers died."""
    return Result(task.key, None, reason, 0.0)
