"""Coarse levels of a plane in slabs or on a device: dealt out as the fine one, and on the host where they are small."""

from __future__ import annotations

import math
from typing import Any

from roughcontact.arrays import as_like, is_numpy, on_host
from roughcontact.slabs.slab_array import SlabArray

__all__ = ["divides", "gathered_if_small", "scatter_like"]

# Cells: a solve on this number takes some tens of megabytes.
SMALL = 2**18


def divides(field: Any, factors: tuple[int, ...]) -> bool:
    """Whether each block of cells lies on one process; always so for an array that is not in slabs."""
    return not isinstance(field, SlabArray) or all(edge % factors[0] == 0 for edge in field.edges)


def gathered_if_small(field: Any) -> Any:
    """Return a small array as one of NumPy, in slabs on every process, each of which solves on it; any other as it is.

    On so few cells machine code takes less time than a device takes to start.
    """
    if math.prod(field.shape) > SMALL:
        return field
    return field.gathered() if isinstance(field, SlabArray) else on_host(field)


def scatter_like(values: Any, model: Any) -> Any:
    """Return an array that was found on what `gathered_if_small` returned, dealt out or on the device as a model is."""
    if isinstance(model, SlabArray) and not isinstance(values, SlabArray):
        return model.functions.cut(values, model.edges)
    return as_like(values, model) if is_numpy(values) else values
