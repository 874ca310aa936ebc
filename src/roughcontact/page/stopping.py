"""How a computation is stopped from outside, between two lines of Python."""

from __future__ import annotations

import _thread
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

__all__ = ["Stopped", "Stopping", "uninterrupted"]


class Stopped(BaseException):
    """The page no longer wants the answer; no ``except Exception`` on the way takes it for a failure."""


@dataclass(slots=True)
class Stopping:
    """Which request is being worked on, and which one is no longer wanted.

    One thread listens and calls `stop`, the main thread computes between `begin` and `end`. The exception is raised in
    the main thread alone, and never while a message is written.
    """

    running: int | None = None
    unwanted: int | None = None
    interruptible: bool = False

    def install(self) -> None:
        """Take over the signal that interrupts a program."""
        _installed[:] = [self]
        signal.signal(signal.SIGINT, self._interrupt)
        sys.unraisablehook = self._swallowed

    def begin(self, number: int) -> None:
        """Begin a request."""
        self.running, self.interruptible = number, True
        self.check()

    def end(self) -> None:
        """End it: from here on nothing is raised."""
        self.interruptible, self.running = False, None

    def pause(self) -> None:
        """Raise nothing until `go_on`."""
        self.interruptible = False

    def go_on(self) -> None:
        """Let the request be stopped again, at once if that was asked for meanwhile."""
        self.interruptible = True
        self.check()

    def stop(self, number: int) -> None:
        """Stop a request if it is being worked on, or as soon as it is begun."""
        self.unwanted = number
        if self.running == number:
            _thread.interrupt_main()

    def check(self) -> None:
        """Raise `Stopped` if the request is no longer wanted."""
        if self.interruptible and self.running is not None and self.running == self.unwanted:
            self.unwanted = None  # said once: what was computed so far may still be sent
            raise Stopped

    def _interrupt(self, *_: object) -> None:
        self.check()

    def _swallowed(self, lost: sys.UnraisableHookArgs) -> None:
        """Remember a stop that came while an object was taken apart, where Python lets nothing through."""
        if isinstance(lost.exc_value, Stopped):
            self.unwanted = self.running
        else:
            sys.__unraisablehook__(lost)


_installed: list[Stopping] = []  # that of this process, if it is a worker


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Raise `Stopped` behind a block, and not in it."""
    for stopping in _installed:
        stopping.pause()
    yield
    for stopping in _installed:
        stopping.go_on()
