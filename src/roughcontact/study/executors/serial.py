"""One task after the other, in this process."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roughcontact.study.task import Result, RunTask, Task

__all__ = ["Serial"]


@dataclass(frozen=True, slots=True)
class Serial:
    """Compute one task after the other, in this process: for trying, and for small studies.

    Examples
    --------
    >>> import roughcontact as rc
    >>> fixed = {"points": 16, "size": "1 mm", "modulus": "1 GPa", "rms": "1 um", "hurst": 0.8, "loads": 3}
    >>> study = rc.study.Study(name="few", case="curve", samples=2, parameters=fixed)
    >>> executor = rc.study.Serial()
    >>> executor.workers, [result.message for result in executor.results(rc.study.run_task, study.tasks())]
    (1, ['', ''])
    """

    @property
    def workers(self) -> int:
        """Number of tasks that are computed at once: 1."""
        return 1

    def results(self, run_task: RunTask, tasks: Iterable[Task]) -> Iterator[Result]:
        """Yield the result of each task, in their order.

        Parameters
        ----------
        run_task : function
            Takes a task and returns its result; it never raises.
        tasks : iterable of Task
            The tasks; the next is taken when the last is done.

        Yields
        ------
        Result
            One for each task.
        """
        for task in tasks:
            yield run_task(task)
