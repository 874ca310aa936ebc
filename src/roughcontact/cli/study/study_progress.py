"""How far a study is while it runs, on standard error: a bar on a terminal, a line a minute in a log."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

import typer

from roughcontact.cli.report import screen

if TYPE_CHECKING:
    from roughcontact.study.task import Summary

__all__ = ["Pace", "duration", "progress"]

_BETWEEN_LINES = 60.0  # seconds


@contextmanager
def progress(name: str) -> Iterator[Callable[[Summary], None]]:
    """Yield what shows the state of the study of that `name`; its first state is where this run begins."""
    console, pace = screen(), Pace()
    if not console.is_terminal:
        yield _lines(name, pace)
        return
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.fields[pace]}"))
    with Progress(*columns, console=console) as bars:
        bar = bars.add_task(name, total=None, pace="")

        def show(now: Summary) -> None:
            bars.update(bar, total=now.total, completed=now.total - now.left, pace=pace.words(now))

        yield show


def _lines(name: str, pace: Pace) -> Callable[[Summary], None]:
    due = time.monotonic()

    def show(now: Summary) -> None:
        nonlocal due
        if time.monotonic() >= due:
            due = time.monotonic() + _BETWEEN_LINES
            typer.echo(f"{name}: {pace.words(now)}", err=True)

    return show


@dataclass(slots=True)
class Pace:
    """How fast a run goes since its first state."""

    first: Summary | None = None

    def words(self, now: Summary) -> str:
        """Return how far a study is, how fast it goes, and how long the rest takes at this rate."""
        first = self.first = self.first or now
        words = [f"{now.done + now.failed} of {now.total} cases"]
        if now.failed:
            words.append(f"{now.failed} failed")
        finished = first.left - now.left
        if finished and now.seconds > 0:
            rate = finished / now.seconds
            words += [_per_time(rate), f"{duration(now.left / rate)} left"]
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
