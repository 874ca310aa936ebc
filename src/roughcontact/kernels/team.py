"""Kernels run by several threads at once.

The thread that calls a kernel leads; others serve it, call after call. They look for the next one for some
microseconds, then now and then for some milliseconds, since to wake a thread of Python takes longer than most kernels.
A call offers its work and begins: it waits for nobody to come, and for those who have come only until they have done
what they took.
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
from roughcontact.threads import call_others, others_called

__all__ = ["BOX", "Team"]

PAUSES = 2000  # that a thread waits for the next kernel: some 50 us
NAPS = 200  # that it takes before it sleeps: some 20 ms
# Places in the box of indices by which threads know of each other. Those that some change while others look are in
# lines of the cache of their own: the ticket, odd while a kernel is offered; whether there is a leader; how many look
# at the offer; how many have joined in it; how many serve; and the offer itself.
TICKET, LED, INSIDE, JOINED, SERVING, OFFER = (k * APART for k in range(6))
KERNEL, PACKED, COUNTERS, WANTED = (OFFER + k for k in range(4))
BOX = OFFER + APART  # indices in all


class Team:
    """The threads that run kernels. One leads at a time: another that calls meanwhile does all alone.

    Parameters
    ----------
    lead, serve : int
        Addresses of these functions.
    """

    def __init__(self, lead: int, serve: int) -> None:
        box, number = ctypes.c_void_p, ctypes.c_int64
        self._lead = ctypes.CFUNCTYPE(None, box, number, ctypes.c_char_p, number)(lead)
        self._serve = ctypes.CFUNCTYPE(None, box, number, number, number, number)(serve)
        self._nap = _nap()
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
        """Call so many threads, this one among them, of which those that do not serve already come."""
        missing = workers - 1 - self._box[SERVING] - others_called()
        if missing > 0:
            call_others(self._join, missing)

    def _join(self, _: int) -> None:
        self._serve(self._place, PAUSES, NAPS, *self._nap)

    def _begin_again(self) -> None:
        """In a forked process there is one thread: the one that forked, which leads nobody now."""
        for place in range(len(self._box)):
            self._box[place] = 0


def _nap() -> tuple[int, int]:
    """Return the address of the system's function that lets a thread sleep, and what to tell it for a short time."""
    if sys.platform == "win32":
        return _place(ctypes.windll.kernel32.Sleep), 1  # ms
    else:  # in its own branch, by which mypy knows platforms
        return _place(ctypes.CDLL(None).usleep), 50  # us


def _place(function: Any) -> int:
    return ctypes.cast(function, ctypes.c_void_p).value or 0
