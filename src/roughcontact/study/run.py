"""Compute the cases of a study that are left, and store every case when it is done."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import closing
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

from roughcontact.progress.events import task
from roughcontact.study.executors.serial import Serial
from roughcontact.study.run_task import run_task
from roughcontact.study.store import Store

if TYPE_CHECKING:
    from roughcontact.study.study import Study
    from roughcontact.study.task import Executor, Result, Summary

__all__ = ["run"]


def run(
    study: Study,
    folder: str | os.PathLike[str],
    executor: Executor | None = None,
    *,
    retry: bool = False,
    on_result: Callable[[Result], None] | None = None,
) -> Summary:
    """Compute the cases of a study that a folder does not hold yet.

    After a stop at any moment, by Ctrl-C or a power cut, a new call resumes the study.

    Parameters
    ----------
    study : Study
    folder : str or path
        It is created if it does not exist.
    executor : Executor, optional
        Computes the cases; by default one after the other in this process.
    retry : bool, optional
        Whether to try failed cases again.
    on_result : function, optional
        Called with every result after it has been stored.

    Returns
    -------
    Summary
        Numbers of cases of the whole study, and the seconds of this run.

    Raises
    ------
    StoreError
        If the folder cannot be used, see `Store.open`, or cannot be written any more; stored cases are safe.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=2, parameters=fixed)
    >>> summary = rc.study.run(study, "few")
    >>> summary.done, summary.left
    (2, 0)
    >>> rc.study.run(study.with_samples(3), "few", on_result=lambda result: print("one more case")).done
    one more case
    3
    """
    start = time.monotonic()
    study.require_files()
    with Store.open(folder, study) as store:
        known = store.done_keys() if retry else store.done_keys() | store.failed_keys()
        summary = store.summary().with_failed_left() if retry else store.summary()
        tasks = {task.key: task for task in study.tasks() if task.key not in known}
        results = (executor or Serial()).results(run_task, list(tasks.values()))
        ended = summary.total - summary.left
        # Closing it stops the workers.
        with task(study.name, summary.total, "cases", done=ended) as cases, closing(cast("Any", results)):
            for done, result in enumerate(results, ended + 1):
                store.add(tasks[result.key], result)
                summary = summary.after(failed=result.record is None, seconds=time.monotonic() - start)
                if on_result is not None:
                    on_result(result)
                if cases is not None:
                    cases.reached(done, f"{summary.failed} failed" if summary.failed else "")
    return replace(summary, seconds=time.monotonic() - start)
