"""One task after the other, in this process."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roughcontact.study.task import Outcome, Perform, Task

__all__ = ["Serial"]


@dataclass(frozen=True, slots=True)
class Serial:
    """Compute one task after the other, in this process: for trying, and for small studies."""

    @property
    def workers(self) -> int:
        """How many tasks are computed at once: one."""
        return 1

    def outcomes(self, perform: Perform, tasks: Iterable[Task]) -> Iterator[Outcome]:
        """Yield the outcome of each task, in their order.

        Parameters
        ----------
        perform : function
            Takes a task and returns its outcome; it never raises.
        tasks : iterable of Task
            The tasks, which are taken one by one as workers become free.

        Yields
        ------
        Outcome
            One for each task.
        """
        for task in tasks:
            yield perform(task)
