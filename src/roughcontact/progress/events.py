"""Progress of long tasks as events, sent to a listener. Nothing is printed here.

A task reports in the thread that computes, and only to a listener of that thread's context: threads that a caller
starts and worker processes report nothing. For a study in several processes, the parent reports finished cases.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from contextvars import ContextVar
from dataclasses import dataclass, replace
from typing import Literal, Self, TypeVar

__all__ = ["Event", "RunningTask", "decades", "listening", "solving", "task", "tracked"]

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Event:
    """The progress of a task.

    Parameters
    ----------
    task : str
        Description of the task.
    state : {"started", "running", "finished", "stopped"}
        The first event of a task is "started", its last one "finished", or "stopped" if an error, an interrupt or the
        caller ended it early.
    done : float
        Amount done, in `unit`; it never decreases.
    total : float or None
        Total amount; None if it is not known before the end.
    unit : str
        What is counted, such as "loads" or "cases"; empty for a task that counts nothing.
    note : str
        Further information, such as "2 failed".
    number : int
        Names the task among those of one listener: 1, 2, ...
    level : int
        Number of tasks inside which the task runs.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rc.progress.Event("Pressing", "running", 3, 24, "loads").done
    3
    """

    task: str
    state: Literal["started", "running", "finished", "stopped"]
    done: float = 0
    total: float | None = None
    unit: str = ""
    note: str = ""
    number: int = 1
    level: int = 0


@dataclass(slots=True, eq=False)
class _Listener:
    """The function that takes events, how often, and what it has been sent."""

    callback: Callable[[Event], None] | None
    interval: float
    count: int = 0
    level: int = 0


_listener: ContextVar[_Listener | None] = ContextVar("progress", default=None)


@contextmanager
def listening(callback: Callable[[Event], None], *, interval: float = 0.0) -> Iterator[None]:
    """Call a function with every `Event` of what is computed in this block, in this thread.

    Parameters
    ----------
    callback : function
        Takes an `Event`. It is called by the thread that computes, which waits for it; an exception that it raises ends
        the computation. Inside another such block only the inner function is called.
    interval : float
        Least time in seconds between two events of a task that runs. A task inside another one is reported once it has
        lasted so long. First and last events of outer tasks are always reported.

    Yields
    ------
    None
        The listener stays until the block ends.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> def show(event):
    ...     if event.unit == "loads":
    ...         print(event.state, event.done, "of", event.total, event.unit)
    >>> with rc.progress.listening(show):
    ...     curve = rc.loading_curve(ball, 1e9, forces=[1e-3, 4e-3])
    started 0 of 2 loads
    running 1 of 2 loads
    running 2 of 2 loads
    finished 2 of 2 loads
    """
    listener = _Listener(callback, interval)
    token = _listener.set(listener)
    try:
        yield
    finally:
        _listener.reset(token)
        listener.callback = None  # a generator that is closed later reports nothing


@dataclass(slots=True, eq=False)
class RunningTask:
    """A task with a listener.

    Examples
    --------
    >>> import roughcontact as rc
    >>> with rc.progress.listening(lambda event: print(event.state, event.done, event.note)):
    ...     with rc.progress.task("Trying", 4, "trials") as trying:
    ...         trying.reached(3, "1 failed")
    started 0
    running 3 1 failed
    finished 3 1 failed
    """

    _listener: _Listener
    _last: Event
    _due: float = 0.0
    _sent: bool = False

    def __enter__(self) -> Self:
        listener = self._listener
        listener.count += 1
        self._last = replace(self._last, number=listener.count, level=listener.level)
        listener.level += 1
        now = time.monotonic()
        self._due = now + listener.interval
        if not self._last.level or not listener.interval:
            self._send(self._last)
        return self

    def reached(self, done: float, note: str = "") -> None:
        """Report the total amount done; it neither decreases nor exceeds the total.

        Parameters
        ----------
        done : float
            In the unit of the task.
        note : str
            Further information, such as "2 failed".
        """
        last = self._last
        done = max(done if last.total is None else min(done, last.total), last.done)
        self._last = replace(last, state="running", done=done, note=note)
        if (now := time.monotonic()) >= self._due:
            if not self._sent:
                self._send(replace(last, state="started"))
            self._due = now + self._listener.interval
            self._send(self._last)

    def advance(self) -> None:
        """Report that one more is done.

        Examples
        --------
        >>> import roughcontact as rc
        >>> with rc.progress.listening(lambda event: print(event.state, event.done)):
        ...     with rc.progress.task("Trying", 4, "trials") as trying:
        ...         trying.advance()
        started 0
        running 1
        finished 1
        """
        self.reached(self._last.done + 1, self._last.note)

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self._listener.level -= 1
        last = self._last
        # A caller that takes a known number of states does not ask whether another one follows.
        whole = kind is None or (kind is GeneratorExit and last.done == last.total)
        if self._sent:
            self._send(replace(last, state="finished" if whole else "stopped"))

    def _send(self, event: Event) -> None:
        self._sent = True
        if self._listener.callback is not None:
            self._listener.callback(event)


_UNHEARD: AbstractContextManager[None] = nullcontext()


def task(
    words: str, total: float | None = None, unit: str = "", *, done: float = 0, shape: Sequence[int] = ()
) -> AbstractContextManager[RunningTask | None]:
    """Return a task as a block that reports its progress.

    Parameters
    ----------
    words : str
        Description, such as "Reading part.x3p".
    total : float, optional
        Total amount, if it is known.
    unit : str
        What is counted, such as "loads".
    done : float
        Amount done before.
    shape : sequence of int
        Shape of an array, which is appended to the description.

    Returns
    -------
    context manager
        Its value is a `RunningTask`, or None if there is no listener. A task that returns is "finished", with what was
        reported as done; one that raises is "stopped".

    Examples
    --------
    >>> import roughcontact as rc
    >>> def own(files):
    ...     with rc.progress.task("Reading", len(files), "files") as reading:
    ...         for file in files:
    ...             if reading is not None:
    ...                 reading.advance()
    >>> with rc.progress.listening(lambda event: print(event.state, event.done)):
    ...     own(["a.x3p", "b.x3p"])
    started 0
    running 1
    running 2
    finished 2
    """
    listener = _listener.get()
    if listener is None:
        return _UNHEARD
    if shape:
        words = f"{words} {' x '.join(map(str, shape))} cells"
    return RunningTask(listener, Event(words, "started", done, total, unit))


def tracked(items: Iterable[T], words: str, unit: str, total: int | None = None) -> Iterator[T]:
    """Yield items, and report their number.

    Parameters
    ----------
    items : iterable
        Items that take long to compute, such as the states of a path.
    words : str
        Description.
    unit : str
        What is counted.
    total : int, optional
        Number of items; by default their length if they have one.

    Yields
    ------
    object
        The items.

    Examples
    --------
    >>> import roughcontact as rc
    >>> with rc.progress.listening(lambda event: print(event.state, event.done, event.total)):
    ...     list(rc.progress.tracked("ab", "Spelling", "letters"))
    started 0 2
    running 1 2
    running 2 2
    finished 2 2
    ['a', 'b']
    """
    if total is None and isinstance(items, Collection):
        total = len(items)
    with task(words, total, unit) as here:
        for item in items:
            if here is not None:
                here.advance()
            yield item
            del item  # it may be large: released before the next one is made


def solving(tolerance: float, shape: Sequence[int]) -> AbstractContextManager[RunningTask | None]:
    """Return the solution of a problem as a task, which counts decades of the residual from 1 to the tolerance."""
    return task("Solving", decades(tolerance), "decades of the residual", shape=shape)


def decades(residual: float) -> float:
    """Return how many decades a residual lies below 1, to a tenth."""
    if residual == 0:
        return math.inf
    return round(max(0.0, -math.log10(residual)), 1) if residual > 0 else 0.0  # 0 for NaN
