"""How the rows of a plane are dealt out to processes."""

from __future__ import annotations

__all__ = ["Edges", "edges_of"]

Edges = tuple[int, ...]
"""Where the rows of each process begin, and where the last ones end."""

# Rows go out in blocks of a power of two, so that coarse levels keep the dealing; by so much may the largest slab
# exceed its share for that.
IMBALANCE = 1.07


def edges_of(count: int, processes: int) -> Edges:
    """Return where the rows of each process begin, and where the last ones end, of `count` rows."""
    unit = 1
    while count and count % (2 * unit) == 0 and _largest(count, 2 * unit, processes) <= IMBALANCE * count:
        unit *= 2
    blocks = count // unit
    return tuple(unit * (blocks * rank // processes) for rank in range(processes + 1))


def _largest(count: int, unit: int, processes: int) -> int:
    """Return what all processes together would hold if each held the number of the largest."""
    return processes * unit * -(-(count // unit) // processes)
