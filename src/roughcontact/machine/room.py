"""Memory to work in, that is kept for the next time: fresh memory costs a product of two threads half its time again.

A page that is touched for the first time is cleared by the system, and what is given back must be forgotten by all
cores.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.machine.loader import address

__all__ = ["room_for"]

Bytes = npt.NDArray[np.uint8]

LINE = 64  # bytes of a line of the cache
MOST = 2**25  # bytes that are kept
_kept: list[Bytes] = []  # one at most: whoever finds none, because another thread works in it, makes his own


@contextmanager
def room_for(numbers: int, precision: str) -> Iterator[npt.NDArray[Any]]:
    """Lend room for so many numbers, from the start of a line of the cache on: NumPy's begins anywhere."""
    needed = numbers * np.dtype(precision).itemsize
    room = _take(needed + LINE)
    start = -address(room) % LINE
    yield room[start : start + needed].view(precision)
    # After a failure others may still be at work in it: then it is left to them.
    if room.nbytes <= MOST and not _kept:
        _kept.append(room)


def _take(size: int) -> Bytes:
    if size > MOST:
        return np.empty(size, np.uint8)
    try:
        room = _kept.pop()
    except IndexError:
        return np.empty(size, np.uint8)
    return room if room.nbytes >= size else np.empty(size, np.uint8)
