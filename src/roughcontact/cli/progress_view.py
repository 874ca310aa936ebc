"""Progress of a command on standard error: bars on a terminal, JSON lines for programs, a line a minute in a log."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING

import typer

from roughcontact.progress.events import Event, listening

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

__all__ = ["PROGRESS_FORMS", "duration", "progress_shown"]

PROGRESS_FORMS = ("auto", "json", "none")

_INTERVAL = 0.1  # seconds between two events of a task
_BETWEEN_LINES = 60.0  # seconds, in a log
_ENDED = ("finished", "stopped")


@contextmanager
def progress_shown(form: str, *, verbose: bool = False) -> Iterator[None]:
    """Show the progress of long tasks in this block in one form; if `verbose`, a line for each task."""
    if form == "none":
        yield
    elif form == "json":
        with listening(_Objects(), interval=_INTERVAL):
            yield
    elif verbose or not sys.stderr.isatty():
        with listening(_Lines(verbose), interval=_INTERVAL):
            yield
    else:
        bars = _Bars()
        try:
            with listening(bars, interval=_INTERVAL):
                yield
        finally:
            bars.stop()


@dataclass(slots=True)
class _Objects:
    """One JSON object a line."""

    begun: dict[int, float] = field(default_factory=dict)

    def __call__(self, event: Event) -> None:
        now = time.monotonic()
        seconds = round(now - self.begun.setdefault(event.number, now), 3)
        typer.echo(json.dumps({"type": "progress", **asdict(event), "seconds": seconds}), err=True)


@dataclass(slots=True)
class _Lines:
    """A line a minute, about the outermost task that counts; if `every`, a line for each task at its end."""

    every: bool = False
    begun: dict[int, float] = field(default_factory=dict)
    paces: dict[int, _Pace] = field(default_factory=dict)
    due: float = field(default_factory=lambda: time.monotonic() + _BETWEEN_LINES)

    def __call__(self, event: Event) -> None:
        begun = self.begun.setdefault(event.number, time.monotonic())
        if self.every and event.state in _ENDED:
            count = f"{event.done:g} {event.unit}, " if event.unit else ""
            line = f"{'  ' * event.level}{event.task}: {count}{time.monotonic() - begun:.2f} s"
            typer.echo(line if event.state == "finished" else f"{line}, stopped", err=True)
        if event.state in _ENDED:
            self.paces.pop(event.number, None)
        elif event.total is not None:
            self.paces.setdefault(event.number, _Pace(event)).last = event
        if self.paces and time.monotonic() >= self.due:
            self.due = time.monotonic() + _BETWEEN_LINES
            outermost = self.paces[min(self.paces)]
            typer.echo(f"{outermost.last.task}: {outermost.words()}", err=True)


@dataclass(slots=True)
class _Bars:
    """Bars of rich, from the start of an outer task to its end."""

    shown: Progress | None = None
    rows: dict[int, tuple[TaskID, _Pace]] = field(default_factory=dict)

    def __call__(self, event: Event) -> None:
        shown = self.shown = self.shown or _started()
        if event.number not in self.rows:
            row = shown.add_task("  " * event.level + event.task, words="")
            self.rows[event.number] = row, _Pace(event)
        row, pace = self.rows[event.number]
        pace.last = event
        shown.update(row, total=event.total, completed=event.done, words=pace.words())
        if event.state in _ENDED:
            del self.rows[event.number]
            if event.level or not event.unit:
                shown.remove_task(row)
            if not self.rows:
                self.stop()

    def stop(self) -> None:
        if self.shown is not None:
            self.shown.stop()
        self.shown = None


def _started() -> Progress:
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (
        *(TextColumn("{task.description}"), BarColumn()),
        *(TextColumn("{task.fields[words]}"), TimeElapsedColumn()),
    )
    progress = Progress(*columns, console=Console(stderr=True), redirect_stdout=False)
    progress.start()
    return progress


@dataclass(slots=True)
class _Pace:
    """The rate of a task since its first event."""

    last: Event
    before: float = field(init=False)
    since: float = field(default_factory=lambda: time.monotonic())

    def __post_init__(self) -> None:
        self.before = self.last.done

    def words(self) -> str:
        """Return the progress of the task, its rate, and the time that remains at this rate."""
        event = self.last
        if not event.unit:
            return ""
        of = "" if event.total is None else f" of {event.total:g}"
        words = [f"{event.done:g}{of} {event.unit}", *([event.note] if event.note else [])]
        gone, seconds = event.done - self.before, time.monotonic() - self.since
        if gone > 0 and seconds > 0:
            words.append(_per_time(gone / seconds))
            if event.total is not None:
                words.append(f"{duration((event.total - event.done) * seconds / gone)} left")
        return ", ".join(words)


def duration(seconds: float) -> str:
    """Return a time in its two largest units."""
    seconds = round(seconds)
    if seconds < 60:
        return f"{seconds} s"
    if seconds < 3600:
        return f"{seconds // 60} min {seconds % 60} s"
    if seconds < 86400:
        return f"{seconds // 3600} h {seconds % 3600 // 60} min"
    return f"{seconds // 86400} d {seconds % 86400 // 3600} h"


def _per_time(rate: float) -> str:
    for unit, seconds in (("s", 1), ("min", 60)):
        if rate * seconds >= 1:
            return f"{rate * seconds:.3g} a {unit}"
    return f"{rate * 3600:.3g} an h"
