"""Tasks of a study: their keys, their random generators, and their results."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

if TYPE_CHECKING:
    import xarray

    from roughcontact.study.case import Case, Parameters

__all__ = ["Executor", "Result", "RunTask", "Summary", "Task", "canonical", "generator", "key_of"]


@dataclass(frozen=True, slots=True)
class Task:
    """A case with its parameters and the number of its sample; small, and can be sent to another process.

    Parameters
    ----------
    key : str
        Its name in the store: a hash of name and version of the case, canonical parameters, seed and sample.
    case : Case
    parameters : Parameters
    seed, sample : int
        The generator of the sample depends only on these two. Therefore samples are paired across parameters and do
        not depend on order or executor.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> first, second = rc.study.Study(name="few", case="curve", samples=2, parameters=fixed).tasks()
    >>> first.sample, second.sample, len(first.key), first.parameters.rms
    (0, 1, 64, 1e-06)
    """

    key: str
    case: Case
    parameters: Parameters
    seed: int
    sample: int


@dataclass(frozen=True, slots=True)
class Result:
    """The result of a task: a record, or the reason of the failure.

    Parameters
    ----------
    key : str
        The key of the task.
    record : xarray.Dataset or None
        None if the case failed.
    message : str
        Why the case failed; empty otherwise.
    seconds : float
        Wall time of the computation.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> task = next(rc.study.Study(name="few", case="curve", parameters=fixed).tasks())
    >>> result = rc.study.run_task(task)
    >>> result.key == task.key, result.message, result.record.sizes["load"]
    (True, '', 3)
    """

    key: str
    record: xarray.Dataset | None
    message: str
    seconds: float


RunTask = Callable[[Task], Result]


class Executor(Protocol):
    """The protocol of executors, which compute tasks.

    Examples
    --------
    >>> import roughcontact as rc
    >>> class Backwards:  # the last case first
    ...     workers = 1
    ...     def results(self, run_task, tasks):
    ...         yield from map(run_task, reversed(list(tasks)))
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=2, parameters=fixed)
    >>> rc.study.run(study, "few", Backwards()).done
    2
    """

    @property
    def workers(self) -> int:
        """Number of tasks that are computed at once."""

    def results(self, run_task: RunTask, tasks: Iterable[Task]) -> Iterator[Result]:
        """Yield one result for each task, in any order.

        `run_task` never raises. A task that kills its worker is yielded as failed, without effect on other tasks.
        Closing the iterator (or Ctrl-C while it waits) stops the workers.

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
            If the workers do not start, cannot load the case, or have ended.
        """


@dataclass(frozen=True, slots=True)
class Summary:
    """The progress of a study.

    Parameters
    ----------
    done, failed, left : int
        Numbers of cases.
    seconds : float
        Time that the run has taken.

    Examples
    --------
    >>> import roughcontact as rc
    >>> summary = rc.study.Summary(done=3, failed=0, left=2).after(failed=True, seconds=4.0)
    >>> summary.total, summary.left, summary.with_failed_left().left
    (5, 1, 2)
    """

    done: int
    failed: int
    left: int
    seconds: float = 0.0

    @property
    def total(self) -> int:
        """Number of cases of the study."""
        return self.done + self.failed + self.left

    def after(self, *, failed: bool, seconds: float) -> Summary:
        """Return the progress after one more case.

        Parameters
        ----------
        failed : bool
            Whether this case failed.
        seconds : float
            Time that the run has taken.

        Returns
        -------
        Summary
            With one case less that is left.
        """
        return Summary(self.done + (not failed), self.failed + failed, self.left - 1, seconds)

    def with_failed_left(self) -> Summary:
        """Return the progress with failed cases counted as left, to try them again.

        Returns
        -------
        Summary
            Without failed cases.
        """
        return Summary(self.done, 0, self.left + self.failed, self.seconds)


def canonical(parameters: Parameters) -> str:
    """Return parameters as canonical JSON: names sorted, no blanks, all digits of numbers."""
    return json.dumps(
        parameters.model_dump(mode="json"), sort_keys=True, separators=(",", ":"), allow_nan=False
    )


def key_of(case: Case, parameters: str, *, seed: int, sample: int) -> str:
    """Return the key of one sample of a case with `canonical` parameters: 64 hexadecimal digits."""
    text = json.dumps([case.name, case.version, seed, sample], separators=(",", ":")) + parameters
    return hashlib.sha256(text.encode()).hexdigest()


def generator(seed: int, sample: int) -> np.random.Generator:
    """Return the generator of a sample: only its number and the seed matter, so that samples are paired."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(sample,)))
