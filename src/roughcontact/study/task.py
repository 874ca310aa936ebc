"""One case of a study to be computed, and what came of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import xarray

    from roughcontact.study.case import Case, Parameters

__all__ = ["Executor", "Outcome", "Perform", "Task"]


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
    """

    key: str
    case: Case
    parameters: Parameters
    seed: int
    sample: int


@dataclass(frozen=True, slots=True)
class Outcome:
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
    """

    key: str
    record: xarray.Dataset | None
    message: str
    seconds: float


Perform = Callable[[Task], Outcome]


class Executor(Protocol):
    """Where tasks are computed."""

    @property
    def workers(self) -> int:
        """How many tasks are computed at once."""

    def outcomes(self, perform: Perform, tasks: Iterable[Task]) -> Iterator[Outcome]:
        """Yield one outcome for each task, in whatever order they come.

        `perform` never raises. A task that takes its worker down is yielded as failed, and takes no other task with
        it. Closing the iterator (or Ctrl-C while it waits) stops the workers; nothing goes on in the background.

        Raises
        ------
        WorkersError
            If the workers do not start, cannot load the case, or are gone for good.
        """
