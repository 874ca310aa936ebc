"""Local processes, of one thread each."""

from __future__ import annotations

import os
import pickle
import queue
from collections import deque
from collections.abc import Iterable, Iterator
from contextlib import closing
from dataclasses import dataclass, field, replace
from typing import Any

from roughcontact.errors import about
from roughcontact.study.executors.process import Attempt, Worker
from roughcontact.study.executors.worker import TRIES, WorkersError, cannot_load, lost, pickled
from roughcontact.study.task import Result, RunTask, Task

__all__ = ["Processes", "usable_cores"]

STILLBORN = 3  # consecutive workers that may die before they are ready


class Processes:
    """Executor of local processes.

    Parameters
    ----------
    workers : int, optional
        Number of processes; by default the number of cores available to this process.

    Notes
    -----
    A worker that dies (killed, out of memory, crashed) is replaced, and its task is tried again at once. If a second
    worker dies, the task is tried at the end, without other tasks at the same time. It has failed when a third worker
    dies.

    Examples
    --------
    >>> import roughcontact as rc
    >>> executor = rc.study.Processes(2)  # rc.study.run(study, "folder", executor), or its results one by one
    >>> executor.workers, list(executor.results(rc.study.run_task, []))
    (2, [])
    """

    def __init__(self, workers: int | None = None) -> None:
        self._workers = usable_cores() if workers is None else workers
        if self._workers < 1:
            raise about("workers", f"is {workers}; at least one is needed")

    def __repr__(self) -> str:
        return f"Processes({self.workers})"

    @property
    def workers(self) -> int:
        """Number of tasks that are computed at once."""
        return self._workers

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
            If the workers do not start, or cannot load the case.
        """
        with closing(_Crew(pickled(run_task, "the function"), iter(tasks), self.workers)) as crew:
            yield from crew.results()


def usable_cores() -> int:
    """Return the number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


@dataclass(slots=True)
class _Crew:
    """The workers of one run, and their tasks."""

    run_task: bytes
    tasks: Iterator[Task]
    size: int
    again: deque[Attempt] = field(default_factory=deque)
    alone: deque[Attempt] = field(default_factory=deque)  # at the end, one at a time
    workers: list[Worker] = field(default_factory=list)
    inbox: queue.SimpleQueue[tuple[Worker, Any]] = field(default_factory=queue.SimpleQueue)
    stillborn: int = 0

    def results(self) -> Iterator[Result]:
        while self._employ():
            worker, message = self.inbox.get()
            if isinstance(message, bytes):
                result: Result = pickle.loads(message)
                worker.answered(result.seconds)
                yield result
            elif message is None:
                worker.ready, self.stillborn = True, 0
            elif message is EOFError:
                yield from self._bury(worker)
            else:
                raise cannot_load(message)

    def close(self) -> None:
        """Stop every worker."""
        for worker in self.workers:
            worker.dismiss()
        for worker in self.workers:
            worker.stop()

    def _employ(self) -> bool:
        """Give tasks to workers that can take one, idle workers first; return whether any task is running."""
        for room in 1, 2:
            for worker in self.workers:
                if len(worker.held) < min(room, worker.room) and (attempt := self._next()):
                    worker.give(attempt)
            while room == 1 and len(self.workers) < self.size and (attempt := self._next()):
                self.workers.append(Worker(self.run_task, self.inbox))
                self.workers[-1].give(attempt)
        return any(worker.held for worker in self.workers)

    def _next(self) -> Attempt | None:
        if self.again:
            return self.again.popleft()
        for task in self.tasks:
            return Attempt(task)
        if self.alone and not any(worker.held for worker in self.workers):
            return self.alone.popleft()
        return None

    def _bury(self, worker: Worker) -> Iterator[Result]:
        """Reassign the tasks of a worker that died."""
        self.workers.remove(worker)
        death = worker.death()
        if worker.ready and worker.held:
            # A worker computes in order: it died during the first task, and the other tasks were not begun.
            guilty = worker.held.popleft()
            guilty = replace(guilty, deaths=guilty.deaths + 1)
            if guilty.deaths == TRIES:
                yield lost(guilty.task, f"its worker died in each of {TRIES} tries, the last of {death}")
            elif guilty.deaths == TRIES - 1:
                self.alone.append(guilty)
            else:
                self.again.append(guilty)
        elif not worker.ready:
            self.stillborn += 1
            if self.stillborn == STILLBORN:
                raise WorkersError(f"{STILLBORN} workers died one after the other as they started: {death}")
        self.again.extend(worker.held)
