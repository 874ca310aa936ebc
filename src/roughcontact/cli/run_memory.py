"""How much memory a run will need, and a refusal before the machine comes to a halt."""

from __future__ import annotations

from roughcontact.cli.messages import UsageError, remark
from roughcontact.memory import free_memory, gigabytes, require_free

__all__ = ["require_memory"]

_WORTH_SAYING = 1e9  # [bytes]


def require_memory(need: int, shape: tuple[int, ...]) -> None:
    """Say how much memory a big run takes, and refuse one beyond what is free.

    Parameters
    ----------
    need : int
        Memory of the run at its peak [bytes].
    shape : tuple of int
        The grid it is for, named in the message.

    Raises
    ------
    UsageError
        If the run needs more than the machine has free.
    """
    what = f"a grid of {' x '.join(str(n) for n in shape)} cells"
    require_free(need, what, "use fewer points", UsageError)
    if need > _WORTH_SAYING:
        remark(f"{what} needs about {gigabytes(need)} of memory; {gigabytes(free_memory())} are free")
