"""Whether a process had its cores to itself: how long its threads stood ready to run and did not."""

from __future__ import annotations

from pathlib import Path

__all__ = ["disturbed", "waited"]

TASKS = Path("/proc/self/task")
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


def disturbed(seconds: float, waiting: float) -> bool:
    """Return whether something else on the machine falsified a time of `seconds`."""
    return waiting > SHARE * seconds + MOMENT
