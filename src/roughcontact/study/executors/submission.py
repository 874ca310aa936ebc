"""Tasks sent to the workers of a Dask client, a few at a time, until all have come back."""

from __future__ import annotations

import math
import os
import pickle
import queue
import sys
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from itertools import chain, islice
from typing import TYPE_CHECKING, Any

from roughcontact.study.executors.worker import WorkersError, cannot_load, lost, pickled
from roughcontact.version import __version__

if TYPE_CHECKING:
    from distributed import Client, Future

    from roughcontact.study.task import Result, RunTask, Task

__all__ = ["Cluster", "connected", "submitted"]

ANSWER = 20.0  # [s] for a scheduler to answer
MOMENT = 5.0  # [s] between two counts of the workers
Compute = Callable[[bytes, list[str], str], bytes | str]
GONE = "the scheduler has ended", "start it again, and run the study again to resume it"


@dataclass(frozen=True, slots=True)
class Cluster:
    """A scheduler, and the supervision of its workers.

    Parameters
    ----------
    target : object
        The address of a scheduler, or a cluster of Dask's.
    keep : callable, optional
        Called every few seconds, to restart missing workers.
    patience : float, optional
        Longest time without any worker [s].
    """

    target: Any
    keep: Callable[[], object] = lambda: None
    patience: float = math.inf


def submitted(
    opened: Callable[[], AbstractContextManager[Cluster]], run_task: RunTask, tasks: Iterable[Task]
) -> Iterator[Result]:
    """Yield one result for each task; the cluster is opened for the first task."""
    tasks = iter(tasks)
    for first in tasks:
        with opened() as cluster, connected(cluster.target) as client:
            yield from _Submission(client, cluster, run_task, chain([first], tasks)).results()


@contextmanager
def connected(target: Any) -> Iterator[Client]:
    """Connect to a scheduler.

    Raises
    ------
    WorkersError
        If it does not answer.
    """
    from distributed import Client

    try:
        client = Client(target, timeout=ANSWER, set_as_default=False)
    except (OSError, ValueError) as error:
        raise WorkersError(f"no scheduler answers at {target}: {error}") from error
    with client:
        yield client


@dataclass(slots=True)
class _Submission:
    """The tasks at the workers of a client."""

    client: Client
    cluster: Cluster
    run_task: RunTask
    tasks: Iterator[Task]
    compute: Compute = field(default_factory=lambda: _by_value())
    under_way: dict[Future, Task] = field(default_factory=dict)
    done: queue.SimpleQueue[Future] = field(default_factory=queue.SimpleQueue)
    alone: deque[Task] = field(default_factory=deque)  # at the end, one at a time
    room: int = 0
    looked: float = -math.inf  # when the workers were last counted
    seen: float = field(default_factory=time.monotonic)  # when there last were workers

    def results(self) -> Iterator[Result]:
        """Yield one result for each task."""
        from distributed import KilledWorker

        last: Future | None = None
        while True:
            self._look()
            for task in islice(self.tasks, max(0, self.room - len(self.under_way))):
                self._submit(task)
            if not self.under_way:
                if not self.alone:
                    return
                last = self._submit(self.alone.popleft())
            future = self._next_done()
            task = self.under_way.pop(future)
            try:
                result = self._result(future)
            except KilledWorker as error:
                if future is not last:
                    self.alone.append(task)
                    continue
                tries = 2 * (error.allowed_failures + 1)
                result = lost(task, f"its worker died in each of {tries} tries (killed; out of memory?)")
            yield result

    def _submit(self, task: Task) -> Future:
        message = pickled((self.run_task, task), f"the case {task.case.name!r}")
        path = [os.path.abspath(place) for place in sys.path]
        future = self.client.submit(self.compute, message, path, __version__, pure=False)
        self.under_way[future] = task
        future.add_done_callback(self.done.put)
        return future

    def _look(self) -> None:
        """Count the workers at intervals: on a cluster their number changes."""
        now = time.monotonic()
        if now < self.looked + MOMENT:
            return
        self.looked = now
        try:
            count = sum(self.client.nthreads().values())
        except OSError as error:
            raise WorkersError(*GONE) from error
        # The same number of tasks waits at the scheduler, ready when a worker becomes free.
        self.room = 2 * count + 2
        if count:
            self.seen = now
        elif now > self.seen + self.cluster.patience:
            raise WorkersError("the workers have died, and no new ones start")
        self.cluster.keep()

    def _next_done(self) -> Future:
        while True:
            try:
                return self.done.get(timeout=MOMENT)
            except queue.Empty:
                self._look()

    def _result(self, future: Future) -> Result:
        while True:
            try:
                answer: bytes | str = future.result(timeout=MOMENT)
            except TimeoutError:  # the worker died before the result was fetched: the task is computed again
                self._look()
            except CancelledError as error:
                raise WorkersError(*GONE) from error
            else:
                break
        if isinstance(answer, str):
            raise cannot_load(answer)
        result: Result = pickle.loads(answer)
        return result


def _by_value() -> Compute:
    """Return the function that workers call.

    Dask sends a nested function as code, and its argument as bytes. Otherwise a worker that cannot import a module
    named in the message would break without a message, and further workers after it.
    """

    def compute(message: bytes, path: list[str], version: str) -> bytes | str:
        import pickle
        import sys

        sys.path.extend(place for place in path if place not in sys.path)  # modules on a shared disk
        try:
            from roughcontact.study.executors.worker import computed
            from roughcontact.version import __version__

            if __version__ != version:
                return f"it has roughcontact {__version__}, but this machine has {version}"

            run_task, task = pickle.loads(message)
        except Exception as error:
            return f"{type(error).__name__}: {error}"
        return computed(run_task, task)

    return compute
