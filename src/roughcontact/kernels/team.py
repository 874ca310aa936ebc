"""Kernels run by several threads at once.

The thread that calls a kernel leads; others serve it, call after call. They look for the next one for some
microseconds, then now and then for some milliseconds, since to wake a thread of Python takes longer than most kernels.
A call offers its work and begins: it does not wait for threads to come, and waits for those that have come only until
their part is done.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from roughcontact.kernels.calls import address
from roughcontact.kernels.constants import APART
from roughcontact.threads import wake, wakes_pending

__all__ = ["BOX", "Team"]

# Back-off of a thread without work: it spins, then sleeps briefly, then leaves the team.
SPINS = 2000  # some 50 us
SLEEPS = 200  # some 20 ms
# Indices of the shared state, a work queue of one entry. Those that some threads change while others read are in
# separate cache lines: the sequence number (a sequence lock, odd while a kernel is offered); whether there is a leader;
# the threads that read the offer, that have joined in it, and that serve; and the offer itself.
SEQUENCE, HAS_LEADER, INSIDE, JOINED, SERVING, OFFER = (k * APART for k in range(6))
KERNEL, PACKED, COUNTERS, WANTED = (OFFER + k for k in range(4))
BOX = OFFER + APART  # indices in all


class Team:
    """The threads that run kernels. One leads at a time: another that calls meanwhile does all its work itself.

    Parameters
    ----------
    lead, serve : int
        Addresses of these functions.
    """

    def __init__(self, lead: int, serve: int) -> None:
        box, number = ctypes.c_void_p, ctypes.c_int64
        self._lead = ctypes.CFUNCTYPE(None, box, number, ctypes.c_char_p, number)(lead)
        self._serve = ctypes.CFUNCTYPE(None, box, number, number, number, number)(serve)
        self._sleep = _system_sleep()
        memory = np.zeros(BOX + APART, np.int64)
        first = -(address(memory) // memory.itemsize) % APART  # a line of the cache begins there
        self._box = memory[first : first + BOX].data
        self._place = address(memory[first:])
        if hasattr(os, "register_at_fork"):
            os.register_at_fork(after_in_child=self._begin_again)

    def running(self, kernel: int) -> Callable[[bytes, int], None]:
        """Return the run of a kernel at an address, on packed arguments, by this thread and others that come."""
        return partial(self._lead, self._place, kernel)

    def gather(self, workers: int) -> None:
        """Call `workers` threads, this one among them; those that do not serve already come."""
        missing = workers - 1 - self._box[SERVING] - wakes_pending()
        if missing > 0:
            wake(self._join, missing)

    def _join(self, _: int) -> None:
        self._serve(self._place, SPINS, SLEEPS, *self._sleep)

    def _begin_again(self) -> None:
        """In a forked process there is one thread: the one that forked, which leads no other now."""
        for place in range(len(self._box)):
            self._box[place] = 0


def _system_sleep() -> tuple[int, int]:
    """Return the address of the system's function that lets a thread sleep, and its argument for a short time."""
    if sys.platform == "win32":
        return _place(ctypes.windll.kernel32.Sleep), 1  # ms
    else:  # in its own branch, by which mypy separates platforms
        return _place(ctypes.CDLL(None).usleep), 50  # us


def _place(function: Any) -> int:
    return ctypes.cast(function, ctypes.c_void_p).value or 0
