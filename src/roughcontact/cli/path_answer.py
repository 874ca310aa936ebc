"""Paths of adhesive states: followed as far as they go, then printed, and written into a folder."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import typer

from roughcontact.cached import cached_property
from roughcontact.cli.contact_of_job import name_of
from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.messages import note
from roughcontact.cli.output import all_or_none, command_line, writing
from roughcontact.cli.pressed import Pressed
from roughcontact.cli.report import (
    emit,
    load_table,
    print_facts,
    print_table,
    size_of,
)
from roughcontact.progress.events import task
from roughcontact.recipe.written import carried

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
    from roughcontact.adhesion.detachment_curve import DetachmentCurve
    from roughcontact.cli.options import Answer
    from roughcontact.recipe.jobs import JobOfHeights
    from roughcontact.surface.surface import Surface

__all__ = ["PathAnswer", "collected", "compute_rest"]

State = TypeVar("State")
Collected = TypeVar("Collected")


def collected(
    states: Iterable[State], collect: Callable[[Iterator[State]], Collected]
) -> tuple[Collected, bool]:
    """Return the collected states of a path, and whether it is complete.

    Ctrl-C ends a path with the computed states. Before the first state it is raised, because nothing can be kept.
    """
    stopped: list[bool] = []

    def watched() -> Iterator[State]:
        some = False
        try:
            for state in states:
                some = True
                yield state
        except KeyboardInterrupt:
            if not some:
                raise
            stopped.append(True)

    return collect(watched()), not stopped


def compute_rest(option: str, done: int, left: Sequence[float], out: Path | None, what: str = "loads") -> str:
    """Return how to compute what is missing because a path was stopped: the numbers that are `left` of an option."""
    elsewhere = "" if out is None else ", and a new --out: this folder would be replaced"
    rest = ",".join(f"{each:.12g}" for each in left)
    words = f"stopped: {done} of {done + len(left)} {what} are computed"
    return f"{words}; compute the others with --{option} {rest}{elsewhere}"


@dataclass(frozen=True)
class PathAnswer:
    """A path that has been computed.

    Parameters
    ----------
    job : JobOfHeights
    surface : Surface
    found : AdhesiveCurve or DetachmentCurve
    whole : bool
        Whether it has all its loads.
    stem, events : str
        The names of its files: ``adhesive_loop``, and ``adhesive_loop_jumps`` for the table of its jumps.
    converged : bool
        Whether the tolerance was met.
    answer : Answer
        Its folder and form.
    """

    job: JobOfHeights
    surface: Surface
    found: AdhesiveCurve | DetachmentCurve
    whole: bool
    stem: str
    events: str
    converged: bool
    answer: Answer

    def record(self) -> dict[str, Any]:
        """Return the answer as plain values."""
        return {
            "command": self.job.NAME,
            "file": name_of(self.job.source),
            "surface": list(self.surface.provenance),
            "kind": self._pressed.kind.value,
            **self.found.to_record(),
            "converged": self.converged,
            "whole": self.whole,
            "recipe": self._recipe,
        }

    def write(self, folder: Path, control: str, drawn: Callable[[Any], Figure]) -> None:
        """Write NetCDF, tables, picture and summary into a folder: all of them or none."""
        from roughcontact.files.provenance import provenance
        from roughcontact.files.write import write_csv, write_json, write_netcdf
        from roughcontact.plot.canvas import save

        scales = {"modulus": self.found.modulus, "tolerance": self.found.tolerance}
        source = provenance(
            self.surface, control=control, command=command_line(), recipe=self._recipe, **scales
        )
        dataset = self.found.to_dataset()
        with task("Writing files"), writing(), all_or_none(folder) as aside:
            write_netcdf(dataset, aside / f"{self.stem}.nc", source)
            write_csv(dataset, aside / f"{self.stem}.csv")
            event = self.events.rpartition("_")[2].removesuffix("s")
            write_csv(dataset, aside / f"{self.events}.csv", dimension=event)
            save(drawn(self.found), aside / f"{self.stem}.{self.answer.ending}")
            write_json(self.record(), aside / f"{self.stem}.json", source)

    def show(
        self,
        columns: Sequence[str],
        before: Sequence[tuple[str, str]],
        after: Sequence[tuple[str, str]],
    ) -> None:
        """Print the loads between facts, or one JSON object; print the notes on standard error."""
        found = self.found
        if self.answer.json:
            emit(self.record())
        else:
            print_facts([("surface", size_of(self.surface.grid)), *self._pressed.facts(), *before])
            print_table(*load_table(found.to_dataset(), tuple(columns)))
            print_facts(after)
        for line in found.notes:
            note(line)

    def end(self, folder: Path | None, total: int | None) -> None:
        """Note the files, and where a path of `total` loads was stopped; end with the status of the answer."""
        names = (f"{self.stem}.csv", f"{self.events}.csv", f"{self.stem}.json", f"{self.stem}.nc")
        files = (*names, f"{self.stem}.{self.answer.ending}")
        self.answer.finish(folder, files, self.job, self.found, self.surface)
        if not self.whole:
            kept = f"{len(self.found)} of {total} loads are kept" if total else "the loop is not closed"
            note(
                f"stopped: {kept}; an adhesive path cannot be resumed, because its states depend on the "
                "history"
            )
            raise typer.Exit(INTERRUPTED)
        if not self.converged:
            raise typer.Exit(MISSED)

    @cached_property
    def _recipe(self) -> dict[str, Any]:
        return carried(self.job, self.answer.out)

    @cached_property
    def _pressed(self) -> Pressed:
        return Pressed.of(self.surface, self.found.modulus, None)
