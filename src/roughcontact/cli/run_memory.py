"""The memory that a run needs, and an error if it exceeds the free memory."""

from __future__ import annotations

from roughcontact.cli.messages import UsageError, remark
from roughcontact.memory import free_memory, gigabytes, require_free

__all__ = ["require_memory"]

_WORTH_SAYING = 1e9  # [bytes]


def require_memory(need: int, shape: tuple[int, ...]) -> None:
    """Print the memory of a large run; raise an error if it exceeds the free memory.

    Parameters
    ----------
    need : int
        Memory of the run at its peak [bytes].
    shape : tuple of int
        The grid it is for, named in the message.

    Raises
    ------
    UsageError
        If the run needs more than the free memory.
    """
    what = f"a grid of {' x '.join(str(n) for n in shape)} cells"
    require_free(need, what, "use fewer points", UsageError)
    if need > _WORTH_SAYING:
        remark(f"{what} needs about {gigabytes(need)} of memory; {gigabytes(free_memory())} are free")
