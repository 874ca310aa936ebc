"""Options of the command line for the executor of a study."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from roughcontact.cli.messages import UsageError
from roughcontact.cli.option_groups import option
from roughcontact.recipe.texts import Choice, whole

if TYPE_CHECKING:
    from roughcontact.study.task import Executor

__all__ = ["Workplace"]

_EXECUTORS = ("serial", "processes", "dask")


@dataclass(frozen=True, slots=True)
class Workplace:
    """The executor of a study, and its number of workers."""

    executor: str = option("Executor that computes the cases.", default="processes", read=Choice(_EXECUTORS))
    workers: int | None = option(
        "Number of cases that run at once (default: one per core).",
        "N",
        read=whole(1, "the number of workers"),
    )
    scheduler: str | None = option(
        "Address of a running Dask scheduler, such as tcp://node7:8786.", "ADDRESS"
    )

    def open(self) -> Executor:
        """Return the executor that was asked for.

        Raises
        ------
        UsageError
            If the options contradict each other.
        """
        from roughcontact.study import executors

        workers, scheduler = self.workers, self.scheduler
        if scheduler is not None and self.executor != "dask":
            raise UsageError("only --executor dask has a scheduler", place="--scheduler")
        match self.executor:
            case "serial":
                if workers not in (None, 1):
                    raise UsageError(
                        "--executor serial computes one case at a time", "choose processes", place="--workers"
                    )
                return executors.Serial()
            case "dask":
                if scheduler is not None and workers is not None:
                    raise UsageError(
                        "the workers of a scheduler are already started",
                        "leave out --workers or --scheduler",
                        place="--workers",
                    )
                return executors.Dask(scheduler, workers=workers)
            case _:
                return executors.Processes(workers)

    def typed(self) -> list[str]:
        """Return the options that differ from their defaults, as typed."""
        given = {
            "--executor": None if self.executor == "processes" else self.executor,
            "--workers": self.workers,
            "--scheduler": self.scheduler,
        }
        return [each for name, value in given.items() if value is not None for each in (name, str(value))]
