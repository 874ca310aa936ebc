"""Dask.distributed: the engine beyond one machine."""

from __future__ import annotations

import logging
import multiprocessing.resource_tracker
import signal
import sys
from collections.abc import Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from functools import partial
from typing import TYPE_CHECKING, Any

from roughcontact.errors import InputError, about
from roughcontact.study.executors.keys import NO_PAGES, require_keys
from roughcontact.study.executors.processes import usable_cores
from roughcontact.study.executors.submission import Cluster, connected, submitted
from roughcontact.study.executors.worker import WorkersError, require_cluster

if TYPE_CHECKING:
    from roughcontact.study.task import Result, RunTask, Task

__all__ = ["Dask"]

PATIENCE = 60.0  # [s] without any local worker
FORGIVEN = 1  # deaths of workers after which the local scheduler still retries a task


class Dask:
    """Executor that computes cases with the workers of a Dask scheduler.

    Parameters
    ----------
    address : str, optional
        Address of a running scheduler, such as ``"tcp://node1:8786"``; its workers should have one thread each
        (``dask worker --nthreads 1``).
    workers : int, optional
        Number of processes on this machine, if neither address nor cluster is given; by default the number of cores
        available to this process.
    cluster : object, optional
        A cluster of Dask, such as a `dask_jobqueue.SLURMCluster`; it is not closed.

    Raises
    ------
    WorkersError
        If Dask is not installed; or if cryptography is not installed and workers are started here.

    Notes
    -----
    Workers that are started here communicate with their scheduler by TLS, with keys that are made for the run: other
    users of the machine can neither send them tasks nor read their data. A given scheduler or cluster keeps its own
    security settings.

    A task whose worker dies is tried again. If the scheduler gives it up after several deaths, it is computed once
    more at the end, without other tasks at the same time, and has failed if its workers die again. When the iterator
    is closed, the workers of a given scheduler finish their current tasks, whose results are dropped.

    Examples
    --------
    >>> import roughcontact as rc
    >>> executor = rc.study.Dask(workers=2)
    >>> executor.workers
    2
    >>> results = executor.results(rc.study.run_task, [])  # or rc.study.run(study, "folder", executor)
    """

    def __init__(
        self, address: str | None = None, *, workers: int | None = None, cluster: Any = None
    ) -> None:
        if sum(given is not None for given in (address, workers, cluster)) > 1:
            raise InputError(
                "the workers of a scheduler are already started", "give one of address, workers and cluster"
            )
        if workers is not None and workers < 1:
            raise about("workers", f"is {workers}; at least one is needed")
        require_cluster("distributed", "Dask")
        self._target = cluster if address is None else address
        if self._target is None:
            require_keys()
        self._workers = usable_cores() if workers is None else workers

    def __repr__(self) -> str:
        return f"Dask(workers={self._workers})" if self._target is None else f"Dask({self._target!r})"

    @property
    def workers(self) -> int:
        """Number of tasks that are computed at once; for a running scheduler, its current number of workers."""
        if self._target is None:
            return self._workers
        with connected(self._target) as client:
            return sum(client.nthreads().values())

    def results(self, run_task: RunTask, tasks: Iterable[Task]) -> Iterator[Result]:
        """Yield one result for each task, in the order in which they are done.

        Parameters
        ----------
        run_task : function
            Takes a task and returns its result; it never raises.
        tasks : iterable of Task
            The tasks; the next is taken when a worker becomes free.

        Yields
        ------
        Result
            One for each task.

        Raises
        ------
        WorkersError
            If the scheduler cannot be reached or has ended, or its workers cannot load the case.
        """
        return submitted(self._opened, run_task, tasks)

    def _opened(self) -> AbstractContextManager[Cluster]:
        return _local(self._workers) if self._target is None else nullcontext(Cluster(self._target))


@contextmanager
def _local(workers: int) -> Iterator[Cluster]:
    """Start a scheduler and workers of one thread each, which only accept tasks from this process."""
    import dask.config
    from distributed import LocalCluster

    settings = {
        # One task per worker, none in advance, so that the task that killed a worker is known.
        "distributed.scheduler.worker-saturation": 1.0,
        # A worker that dies twice within this time would not be restarted.
        "distributed.deploy.lost-worker-timeout": "1 h",
        **NO_PAGES,
    }
    with dask.config.set(settings):
        try:
            with _interrupts_blocked():
                cluster = LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    host="127.0.0.1",
                    security=True,
                    memory_limit=0,  # Dask must not limit the memory of a case
                    silence_logs=logging.CRITICAL,
                    dashboard_address=None,
                    scheduler_kwargs={"allowed_failures": FORGIVEN, "dashboard_address": "127.0.0.1:0"},
                )
        except RuntimeError as error:
            raise WorkersError(
                f"the workers do not start ({error}); in a script, start them under "
                '`if __name__ == "__main__":`, because they first run the rest of the script'
            ) from error
        with cluster:
            yield Cluster(cluster, partial(cluster.scale, workers), PATIENCE)


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Block Ctrl-C in threads and processes that are started meanwhile: the coordinator stops them."""
    if sys.platform == "win32":
        yield
    else:
        multiprocessing.resource_tracker.ensure_running()  # a later start would end the block of the signal
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            yield
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
