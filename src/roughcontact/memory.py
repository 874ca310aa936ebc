"""How much memory there is, and a refusal before the machine comes to a halt."""

from __future__ import annotations

import math
from pathlib import Path

import psutil

__all__ = ["most_memory", "require_memory"]

SMALL = 2**24  # [bytes] what every machine has: nothing is asked
GROUPS = Path("/sys/fs/cgroup")  # where Linux says what a container or a job may use
OWN = Path("/proc/self/cgroup")


def require_memory(least: int, what: str, remedy: str) -> None:
    """Refuse what needs more memory than there is.

    Parameters
    ----------
    least : int
        A lower bound of the memory that it takes [bytes]: what could be done is never refused.
    what, remedy : str
        For the message.

    Raises
    ------
    ValueError
        If the bound exceeds what there is, see `most_memory`.
    """
    if least < SMALL:
        return
    most = most_memory()
    if least > most:
        raise ValueError(
            f"{what} needs {least / 1e9:.3g} GB of memory at least, and {most / 1e9:.3g} GB are there: "
            f"{remedy}, or use a machine with more memory"
        )


def most_memory() -> float:
    """Return the memory that work here could have at most [bytes].

    What is free with the swap space, and what this process holds already, of which part may be free for it; within the
    limit of the container.
    """
    swap = psutil.swap_memory()
    free: float = psutil.virtual_memory().available + swap.free + psutil.Process().memory_info().rss
    return min(free, _limit() + float(swap.total))


def _limit() -> float:
    """Return the smallest limit of the control groups of this process [bytes]; infinite without one."""
    try:
        lines = OWN.read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError):
        return math.inf
    limit = math.inf
    for line in lines:
        fields = line.split(":", 2)
        if len(fields) < 3 or fields[1] not in ("", "memory"):
            continue
        _, controllers, path = fields
        root, name = (
            (GROUPS, "memory.max") if controllers == "" else (GROUPS / "memory", "memory.limit_in_bytes")
        )
        # A container may see its own group as the root, or the path of the host, which it has not.
        group = root / path.strip("/")
        for place in (group, *group.parents):
            if place.is_relative_to(root):
                limit = min(limit, _number(place / name))
    return limit


def _number(file: Path) -> float:
    """Return the number in a file; infinite if there is none."""
    try:
        return float(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):  # "max"
        return math.inf
