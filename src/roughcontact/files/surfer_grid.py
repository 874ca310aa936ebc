"""Surfer's text grid: ``DSAA``, numbers of columns and rows, ranges of x, y and z, rows from the smallest y."""

from __future__ import annotations

import numpy as np

from roughcontact.files.fields import number_of
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.missing_marks import holds_mark
from roughcontact.files.number_stream import grid_of

__all__ = ["read_surfer"]

_BLANK = 2.0**127  # printed as 1.70141e+38
_HEAD = 9  # fields before the heights
_ROUNDING = 1e-6  # relative to the range: its printed digits


def read_surfer(text: str) -> HeightMap:
    """Return the heights of a grid, largest y first; x and y are in the unit of its heights, which is not stated."""
    fields = text.split()
    head = [number_of(field.replace(",", ".")) for field in fields[1:_HEAD]]
    if len(head) < _HEAD - 1 or not all(2 <= n <= 1e9 and n == int(n) for n in head[:2]):
        raise ContentError(
            "its header is damaged", "write columns and rows, and the ranges of x, y and z, below DSAA"
        )
    nx, ny, west, east, south, north, low, high = head
    heights, notes, warnings = grid_of(fields[_HEAD:], (int(ny), int(nx)))
    found = holds_mark(heights, (_BLANK,))
    heights = np.where(found, np.nan, heights)[::-1]
    slack = _ROUNDING * max(abs(low), abs(high))
    outside = np.count_nonzero((heights < low - slack) | (heights > high + slack))
    if outside:
        warnings = (
            *warnings,
            f"{outside} heights lie outside the range {low:g} to {high:g} that its header states",
        )
    if found.any():
        notes = (*notes, f"not measured where it is {_BLANK:g}")
    steps = abs(north - south) / (ny - 1), abs(east - west) / (nx - 1)
    return HeightMap(as_heights(heights), "Surfer grid", steps=steps, notes=notes, warnings=warnings)
