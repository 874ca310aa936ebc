"""ESRI's text grid: ``ncols``, ``nrows``, ``cellsize`` or ``dx`` and ``dy``, ``NODATA_value``, rows from the north."""

from __future__ import annotations

import re

import numpy as np

from roughcontact.files.fields import number_of
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.missing_marks import holds_mark
from roughcontact.files.number_stream import grid_of

__all__ = ["read_esri"]

_HEADER = re.compile(r"\s*([a-z][a-z_]*)[ \t]+(\S+)([ \t]+\S+)?[ \t]*\n", re.IGNORECASE)
_MARK = -9999.0  # if a file states no mark


def read_esri(text: str) -> HeightMap:
    """Return the heights of a grid; its cells are in the unit of its heights, which it does not state."""
    stated: dict[str, list[float]] = {}
    place = 0
    while (line := _HEADER.match(text, place)) is not None and line[1].casefold() != "nan":
        words = [word.replace(",", ".") for word in line.groups()[1:] if word]
        stated[line[1].casefold()] = [number_of(word.strip()) for word in words]
        place = line.end()
    nx, ny = (_count(stated, name) for name in ("ncols", "nrows"))
    heights, notes, warnings = grid_of(text[place:].split(), (ny, nx))
    mark = next(
        (stated[name][0] for name in ("nodata_value", "nodata", "no_data_value") if name in stated), _MARK
    )
    if (found := holds_mark(heights, (mark,))).any():
        heights = np.where(found, np.nan, heights)
        notes = (*notes, f"not measured where it is {mark:g}")
    steps = _steps(stated)
    if steps is not None and min(steps) < 0:
        warnings = (*warnings, f"its cells are {steps[1]:g} x {steps[0]:g}: the sign is left out")
        steps = (abs(steps[0]), abs(steps[1]))
    return HeightMap(as_heights(heights), "ESRI grid", steps=steps, notes=notes, warnings=warnings)


def _count(stated: dict[str, list[float]], name: str) -> int:
    number = stated.get(name, [np.nan])[0]
    if not (1 <= number <= 1e9 and number == int(number)):
        raise ContentError(
            f"it does not state the number of {name}", "write ncols and nrows above the heights"
        )
    return int(number)


def _steps(stated: dict[str, list[float]]) -> tuple[float, float] | None:
    """Return the cell (dy, dx) that the header states."""
    sides = [
        next((stated[name] for name in names if name in stated), None)
        for names in (("dx", "xdim"), ("dy", "ydim"))
    ]
    if sides[0] is not None and sides[1] is not None:
        return sides[1][0], sides[0][0]
    cell = stated.get("cellsize")
    return None if cell is None else (cell[-1], cell[0])
