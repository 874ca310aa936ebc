"""How much memory a run will need, and a refusal before the machine comes to a halt."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from roughcontact.arrays import is_numpy
from roughcontact.cli.messages import UsageError, note
from roughcontact.memory import free_memory, gigabytes, require_free

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["require_memory", "require_memory_for_load"]

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
    require_free(need, what, "use fewer points", _refusal)
    if need > _WORTH_SAYING:
        note(f"{what} needs about {gigabytes(need)} of memory; {gigabytes(free_memory())} are free")


def require_memory_for_load(
    surface: Surface, modulus: float, load: Mapping[str, float], *, curve: bool = False
) -> None:
    """Do so for a load on a map, or a curve up to it; how much touches is asked only where it could be big.

    Nothing is asked of a surface in slabs: its processes may have different memory free, and must do the same.

    Raises
    ------
    UsageError
        If the load needs more memory than the machine has free.
    """
    import roughcontact as rc

    grid = surface.grid
    whole = grid.ndim == 2 and is_numpy(surface.heights)
    if whole and rc.memory_needed(grid, curve=curve) > min(_WORTH_SAYING, free_memory()):
        require_memory(rc.memory_needed(surface, modulus, curve=curve, **load), grid.shape)


def _refusal(problem: str, remedy: str) -> UsageError:
    return UsageError(f"{problem}: {remedy}")
