"""How much memory there is, and a refusal before the machine comes to a halt.

What is known by bounds is compared with all that there could be, what is estimated with what is free.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable
from pathlib import Path

from roughcontact.errors import InputError

__all__ = ["MemoryWarning", "free_memory", "gigabytes", "most_memory", "require_free", "require_memory"]

SMALL = 2**27  # [bytes] less than Python and its libraries take: a need below it is not compared
GROUPS = Path("/sys/fs/cgroup")  # where Linux states what a container or a job may use
OWN = Path("/proc/self/cgroup")
_ELSEWHERE = "or use a machine with more memory"


class MemoryWarning(UserWarning):
    """The memory of this machine suffices for light loads on a surface, but may not for heavy ones.

    Examples
    --------
    >>> import warnings
    >>> import roughcontact as rc
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("error", rc.MemoryWarning)  # stop instead
    ...     solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> solution.status.value
    'converged'
    """


def require_memory(least: int, most: int, what: str, remedy: str) -> None:
    """Refuse what cannot be done in the memory that work here could have, see `most_memory`; warn if it may not fit.

    Parameters
    ----------
    least, most : int
        Bounds of the memory that it takes [bytes]: what could be done is never refused.
    what, remedy : str
        For the message.

    Raises
    ------
    ValueError
        If the lower bound exceeds the free memory.
    """
    if most < SMALL:
        return
    there = most_memory()
    if most > there:
        impossible = least > there
        need = (
            f"{gigabytes(least)} of memory at least" if impossible else f"up to {gigabytes(most)} of memory"
        )
        error = InputError(
            f"{what} needs {need}, and {gigabytes(there)} are there", f"{remedy}, {_ELSEWHERE}"
        )
        if impossible:
            raise error
        warnings.warn(str(error), MemoryWarning, stacklevel=6)  # the caller of `press`


def require_free(need: int, what: str, remedy: str, error: Callable[[str, str], Exception]) -> None:
    """Refuse what takes more memory than is free now.

    Parameters
    ----------
    need : int
        An estimate of the memory that it takes from now on [bytes].
    what, remedy : str
        For the message.
    error : callable
        Makes the exception to raise from a problem and a remedy in words.
    """
    free = free_memory()
    if need > free:
        problem = f"{what} needs {gigabytes(need)} of memory, and {gigabytes(free)} are free"
        raise error(problem, f"{remedy}, {_ELSEWHERE}")


def free_memory() -> int:
    """Return the memory that is free now, without the swap space [bytes]."""
    import psutil  # late: errors of the command line are reported without it

    return int(psutil.virtual_memory().available)


def gigabytes(size: float) -> str:
    """Return a number of bytes in words."""
    return f"{float(f'{size / 1e9:.3g}'):g} GB"  # 1880, not 1.88e+03


def most_memory() -> float:
    """Return the memory that work here could have at most [bytes].

    What is free with the swap space, and what this process holds already, of which part may be free for it; within the
    limit of the container.
    """
    import psutil

    swap = psutil.swap_memory()
    free: float = free_memory() + swap.free + psutil.Process().memory_info().rss
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
