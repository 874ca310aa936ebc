"""Paths that show on a terminal how far they are, and that Ctrl-C ends with the states that are done."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from roughcontact.cli.report import screen

__all__ = ["collected"]

State = TypeVar("State")
Answer = TypeVar("Answer")


def collected(
    states: Iterable[State], collect: Callable[[Iterator[State]], Answer], words: str, total: int | None
) -> tuple[Answer, bool]:
    """Return what is collected of the states of a path, and whether it is whole.

    Ctrl-C before the first state is passed on, because there is nothing to keep.
    """
    stopped: list[bool] = []

    def watched() -> Iterator[State]:
        done = 0
        try:
            for state in states:
                done += 1
                progress.advance(task)
                yield state
        except KeyboardInterrupt:
            if not done:
                raise
            stopped.append(True)

    columns = (TextColumn(words), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=screen()) as progress:
        task = progress.add_task("", total=total)
        answer = collect(watched())
    return answer, not stopped
