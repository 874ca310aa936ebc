"""Stopping a computation from outside, between two lines of Python."""

from __future__ import annotations

import _thread
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

__all__ = ["Stopped", "Stopping", "uninterrupted"]


class Stopped(BaseException):
    """Raised when the page no longer needs the answer; ``except Exception`` does not catch it."""


@dataclass(slots=True)
class Stopping:
    """The running request, and the one that must stop.

    One thread listens and calls `stop`; the main thread computes between `begin` and `end`. The exception is only
    raised in the main thread, and never while a message is written.
    """

    running: int | None = None
    unwanted: int | None = None
    interruptible: bool = False

    def install(self) -> None:
        """Handle the signal that interrupts a program."""
        _installed[:] = [self]
        signal.signal(signal.SIGINT, self._interrupt)
        sys.unraisablehook = self._swallowed

    def begin(self, number: int) -> None:
        """Begin a request."""
        self.running, self.interruptible = number, True
        self.check()

    def end(self) -> None:
        """End the request: nothing is raised from now on."""
        self.interruptible, self.running = False, None

    def pause(self) -> None:
        """Raise nothing until `go_on`."""
        self.interruptible = False

    def go_on(self) -> None:
        """Allow stopping again; raise `Stopped` now if it was requested meanwhile."""
        self.interruptible = True
        self.check()

    def stop(self, number: int) -> None:
        """Stop a request now if it is running, otherwise when it begins."""
        self.unwanted = number
        if self.running == number:
            _thread.interrupt_main()

    def check(self) -> None:
        """Raise `Stopped` if the request must stop."""
        if self.interruptible and self.running is not None and self.running == self.unwanted:
            self.unwanted = None  # raised once: results so far may still be sent
            raise Stopped

    def _interrupt(self, *_: object) -> None:
        self.check()

    def _swallowed(self, lost: sys.UnraisableHookArgs) -> None:
        """Note a stop that came during the destruction of an object, where Python drops exceptions."""
        if isinstance(lost.exc_value, Stopped):
            self.unwanted = self.running
        else:
            sys.__unraisablehook__(lost)


_installed: list[Stopping] = []  # the one of this process, if it is a worker


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Raise `Stopped` after a block instead of within it."""
    for stopping in _installed:
        stopping.pause()
    yield
    for stopping in _installed:
        stopping.go_on()
