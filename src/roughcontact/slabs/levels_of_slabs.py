"""Coarse levels of a plane in slabs: dealt out as the fine one, and gathered where they are small."""

from __future__ import annotations

from typing import Any

from roughcontact.slabs.slab_array import SlabArray

__all__ = ["divides", "gathered_if_small", "scatter_like"]

# Cells: to solve on so many takes some tens of megabytes.
SMALL = 2**18


def divides(field: Any, factors: tuple[int, ...]) -> bool:
    """Whether blocks of so many cells lie on one process each; so it is of any other array than one in slabs."""
    return not isinstance(field, SlabArray) or all(edge % factors[0] == 0 for edge in field.edges)


def gathered_if_small(field: Any) -> Any:
    """Return a small array in slabs as a whole on every process, each of which solves on it; any other as it is."""
    return field.gathered() if isinstance(field, SlabArray) and field.size <= SMALL else field


def scatter_like(values: Any, model: Any) -> Any:
    """Return an array that each process has as a whole, dealt out as a model; any other as it is."""
    if not isinstance(model, SlabArray) or isinstance(values, SlabArray):
        return values
    return model.functions.cut(values, model.edges)
