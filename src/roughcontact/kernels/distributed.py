"""Fields that several processes hold together, by rows: a kernel runs on the rows here, its totals are those of all.

Kernels know nothing else of them. What is decided by totals, or by `agreed`, is decided alike by all processes; all of
them make the same calls in the same order.
"""

from __future__ import annotations

import math
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

__all__ = ["Distributed", "agreed", "contiguous", "local", "of_all", "with_rows_beside"]

Held = npt.NDArray[Any]


class Distributed(Protocol):
    """A field of which each process holds some rows, as `roughcontact.slabs` has it."""

    @property
    def local(self) -> Held:
        """The rows of this process."""
        ...

    @property
    def functions(self) -> Any:
        """What its processes do together."""
        ...

    @property
    def edges(self) -> tuple[int, ...]:
        """Where the rows of each process begin, and where the last ones end."""
        ...

    def like(self, local: Held) -> Any:
        """Return other numbers on the same rows."""
        ...


def local(field: Any) -> Any:
    """Return what this process holds of a field; anything else as it is."""
    return getattr(field, "local", field)


def contiguous(field: Any, precision: npt.DTypeLike) -> Any:
    """Return a field in a precision, its numbers here one after the other; not a copy if it is so."""
    if isinstance(field, np.ndarray):
        return np.ascontiguousarray(field, dtype=precision)
    return field.like(np.ascontiguousarray(field.local, dtype=precision))


def of_all(field: Any, totals: list[float], largest: int) -> list[float]:
    """Return the totals of all who hold a field: the largest of the first so many, sums of the others."""
    if isinstance(field, np.ndarray) or not totals:
        return totals
    found: list[float] = field.functions.combined(totals, largest)
    return found


def agreed(field: Any, verdict: bool) -> bool:
    """Whether all who hold a field find so."""
    return verdict if isinstance(field, np.ndarray) else bool(field.functions.agreed(verdict))


def with_rows_beside(field: Any, count: int) -> tuple[Held, int, int]:
    """Return the rows here with so many of those before and behind; which row is the first of these, and of those here.

    They are fewer where the whole begins or ends.
    """
    if isinstance(field, np.ndarray):
        return field, 0, 0
    here, first = field.local, field.edges[field.functions.rank]
    entries = math.prod(here.shape[1:])
    before, behind = field.functions.beyond(field, count * entries)
    rows = np.concatenate([before, here.reshape(-1), behind]).reshape(-1, *here.shape[1:])
    return rows, first - before.size // entries, first
