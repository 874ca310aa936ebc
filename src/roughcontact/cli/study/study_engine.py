"""Where the cases of a study are computed, as options of the command line say it."""

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
    """Where the cases of a study are computed, and how many at once."""

    executor: str = option("Where cases are computed.", default="processes", read=Choice(_EXECUTORS))
    workers: int | None = option(
        "Cases computed at once (default: one a core).", "N", read=whole(1, "the number of workers")
    )
    scheduler: str | None = option("Of a running Dask scheduler, such as tcp://node7:8786.", "ADDRESS")

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
            raise UsageError("only --executor dask has one", place="--scheduler")
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
                        "a scheduler has workers of its own", "leave out one of the two", place="--workers"
                    )
                return executors.Dask(scheduler, workers=workers)
            case _:
                return executors.Processes(workers)

    def typed(self) -> list[str]:
        """Return what is not by default, as it is typed."""
        given = {
            "--executor": None if self.executor == "processes" else self.executor,
            "--workers": self.workers,
            "--scheduler": self.scheduler,
        }
        return [each for name, value in given.items() if value is not None for each in (name, str(value))]
