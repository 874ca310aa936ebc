"""Computation of a task, which always returns a result."""

from __future__ import annotations

import os
import sys
import time
import traceback
from contextlib import AbstractContextManager
from functools import lru_cache
from typing import TYPE_CHECKING

from roughcontact.study.record import require_record
from roughcontact.study.task import Result, Task, generator
from roughcontact.threads import controller, limit_threads

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

__all__ = ["run_task"]

_LONGEST = 1000  # characters of a message that are stored


def run_task(task: Task) -> Result:
    """Compute a task on one thread, and return its result.

    An exception of the case is not raised: the result is that of a failed task.

    Parameters
    ----------
    task : Task
        The task.

    Returns
    -------
    Result
        The record, or the reason of the failure.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> task = next(rc.study.Study(name="few", case="curve", parameters=fixed).tasks())
    >>> rc.study.run_task(task).record["residual"].max().item() < 1e-8
    True
    """
    start = time.perf_counter()
    try:
        with limit_threads(1), _one_thread():
            record = task.case.run(task.parameters, generator(task.seed, task.sample))
        require_record(record, task.case.fields)
    except (Exception, SystemExit) as error:
        if isinstance(error, SystemExit) and _of_a_signal(error):
            raise
        return Result(task.key, None, _reason(error), time.perf_counter() - start)
    return Result(task.key, record, "", time.perf_counter() - start)


def _of_a_signal(end: SystemExit) -> bool:
    """Whether a signal ends the program, rather than its case: by convention the status is then 128 plus the signal."""
    return isinstance(end.code, int) and end.code > 128


def _reason(error: Exception | SystemExit) -> str:
    """Return the class, the message and the place of an error."""
    text = f"{type(error).__name__}: {error}".removesuffix(": ")
    text = text if len(text) <= _LONGEST else f"{text[:_LONGEST]} ..."
    frames = traceback.extract_tb(error.__traceback__)[1:]  # without the frame of this function
    if not frames:
        return text
    return f"{text} ({os.path.basename(frames[-1].filename)}, line {frames[-1].lineno}, in {frames[-1].name})"


def _one_thread() -> AbstractContextManager[object]:
    # A library that was imported since the last case has separate threads.
    import scipy.linalg  # noqa: F401  # its BLAS must be there to be limited

    limit: AbstractContextManager[object] = _controller(len(sys.modules)).limit(limits=1)
    return limit


@lru_cache(maxsize=1)
def _controller(modules: int) -> ThreadpoolController:
    return controller()
