"""Whether a process had its cores to itself: how long its threads stood ready to run, and others ran instead."""

from __future__ import annotations

import os
import time
from pathlib import Path

__all__ = ["disturbed", "others", "waited"]

TASKS = Path("/proc/self/task")
CORES = Path("/proc/stat")
SHARE = 0.05  # of the time that went by
MOMENT = 2e-3  # [s], what the start of a thread may cost anyway


def waited() -> float:
    """Return how long the threads alive have waited for a core so far [s]; 0 where the system does not tell."""
    total = 0
    for entry in TASKS.glob("*/schedstat"):
        try:
            total += int(entry.read_text().split()[1])
        except (OSError, IndexError, ValueError):  # the thread has ended, or the system counts nothing
            continue
    return total / 1e9


def others() -> float:
    """Return how long other processes, and other guests of the host, have run on any core so far [s]."""
    try:
        user, nice, system, _, _, *interrupts = (
            int(t) for t in CORES.read_text().split("\n", 1)[0].split()[1:9]
        )
    except (OSError, ValueError):  # the system does not tell: all waiting is put down to them
        return time.perf_counter() * (os.cpu_count() or 1)
    return (user + nice + system + sum(interrupts)) / os.sysconf("SC_CLK_TCK") - time.process_time()


def disturbed(seconds: float, waiting: float, taken: float) -> bool:
    """Return whether something else on the machine falsified a time of `seconds`.

    Threads also wait for each other's cores; what they waited for others is no more than what those have `taken`.
    """
    return min(waiting, taken) > SHARE * seconds + MOMENT
