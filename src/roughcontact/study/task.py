"""One case of a study to be computed: what names it, what its randomness is made of, and what came of it."""

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
        Names it in the store: from the name and version of the case, canonical parameters, seed and sample.
    case : Case
    parameters : Parameters
    seed, sample : int
        The generator of the sample is made of these two alone, so that samples are paired across parameters and
        depend neither on order nor on executor.

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
    """What came of a task: a record, or the reason why there is none.

    Parameters
    ----------
    key : str
        Of the task.
    record : xarray.Dataset or None
        None if the case failed.
    message : str
        Why it failed, empty otherwise.
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
    """Where tasks are computed.

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
        """How many tasks are computed at once."""

    def results(self, run_task: RunTask, tasks: Iterable[Task]) -> Iterator[Result]:
        """Yield one result for each task, in whatever order they come.

        `run_task` never raises. A task that takes its worker down is yielded as failed, and takes no other task with
        it. Closing the iterator (or Ctrl-C while it waits) stops the workers; nothing goes on in the background.

        Parameters
        ----------
        run_task : function
            Takes a task and returns its result; it never raises.
        tasks : iterable of Task
            The tasks, which are taken one by one as workers become free.

        Yields
        ------
        Result
            One for each task.

        Raises
        ------
        WorkersError
            If the workers do not start, cannot load the case, or are gone for good.
        """


@dataclass(frozen=True, slots=True)
class Summary:
    """How far a study is.

    Parameters
    ----------
    done, failed, left : int
        Cases.
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
        """Return how far it is with one case more.

        Parameters
        ----------
        failed : bool
            Whether this case failed.
        seconds : float
            Time that the run has taken.

        Returns
        -------
        Summary
            With a case less that is left.
        """
        return Summary(self.done + (not failed), self.failed + failed, self.left - 1, seconds)

    def with_failed_left(self) -> Summary:
        """Return the same with the failed cases among those that are left, to be tried again.

        Returns
        -------
        Summary
            Without failed cases.
        """
        return Summary(self.done, 0, self.left + self.failed, self.seconds)


def canonical(parameters: Parameters) -> str:
    """Return parameters as JSON that is the same for equal ones: names sorted, no blanks, every digit of a number."""
    return json.dumps(
        parameters.model_dump(mode="json"), sort_keys=True, separators=(",", ":"), allow_nan=False
    )


def key_of(case: Case, parameters: str, *, seed: int, sample: int) -> str:
    """Return the key of one sample of a case with `canonical` parameters: 64 hexadecimal digits."""
    text = json.dumps([case.name, case.version, seed, sample], separators=(",", ":")) + parameters
    return hashlib.sha256(text.encode()).hexdigest()


def generator(seed: int, sample: int) -> np.random.Generator:
    """Return the generator of a sample: of the seed of the study and its number alone, so that samples are paired."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(sample,)))
