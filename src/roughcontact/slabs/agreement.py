"""Work that can fail on some processes: its error is raised on all, so that none waits for another."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from typing import Any, TypeVar

from roughcontact.slabs.communicator import Communicator

__all__ = ["by_each", "by_first", "entered_by_first"]

T = TypeVar("T")


def by_first(communicator: Communicator, work: Callable[[], T]) -> T:
    """Return what the first process finds, on all of them.

    Raises
    ------
    Exception
        What is raised there.
    """
    answers: list[T] = _agreed(communicator, [work] if communicator.rank == 0 else [])
    return answers[0]


def by_each(communicator: Communicator, work: Callable[[], Any]) -> None:
    """Let every process do its own work.

    Raises
    ------
    Exception
        What is raised on the first process where something is.
    """
    _agreed(communicator, [lambda: work() and None])


@contextmanager
def entered_by_first(
    communicator: Communicator, context: Callable[[], AbstractContextManager[T]]
) -> Iterator[T]:
    """Let the first process enter a context, and leave it when all have come to the end.

    Parameters
    ----------
    communicator : Communicator
    context : function
        Makes it, on the first process; what it yields is given to all.

    Raises
    ------
    Exception
        What is raised there, on the way in or out.
    """
    with ExitStack() as stack:
        yield by_first(communicator, lambda: stack.enter_context(context()))
        by_first(communicator, stack.close)


def _agreed(communicator: Communicator, works: list[Callable[[], Any]]) -> list[Any]:
    """Return what the works of all processes find, in their order."""
    found: list[Any] = []
    fault: Exception | None = None
    try:
        found = [work() for work in works]
    except Exception as error:  # raised on all, or the others would never return
        fault = error
    gathered = communicator.allgather((found, fault))
    for _, raised in gathered:
        if raised is not None:
            raise raised
    return [each for parts, _ in gathered for each in parts]
