"""A regular subset of many numbers, from which quantiles are computed."""

from __future__ import annotations

from typing import Any

__all__ = ["regular_subset"]

_ENOUGH = 100_000


def regular_subset(values: Any) -> Any:
    """Return numbers in one row at an odd stride: all of up to 200 000, otherwise 67 000 to 200 000 of them.

    Even and odd columns of an image may differ, and an odd stride takes as many of each.
    """
    return values.reshape(-1)[:: 2 * (values.size // _ENOUGH // 2) + 1]
