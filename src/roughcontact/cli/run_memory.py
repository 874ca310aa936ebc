"""How much memory a run will need, and a refusal before the machine comes to a halt."""

from __future__ import annotations

import psutil

from roughcontact.cli.messages import UsageError, note

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
    free = psutil.virtual_memory().available
    if need > free:
        raise UsageError(
            f"{what} needs {_gigabytes(need)} of memory, and {_gigabytes(free)} are free: "
            "use fewer points, or use a machine with more memory"
        )
    if need > _WORTH_SAYING:
        note(f"{what} needs about {_gigabytes(need)} of memory; {_gigabytes(free)} are free")


def _gigabytes(size: float) -> str:
    return f"{size / 1e9:.3g} GB"
