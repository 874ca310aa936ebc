"""Profilm's text: ``numCols numRows pixelSize (um)``, their values, ``Z-data (um)``, and rows of heights."""

from __future__ import annotations

import re

from roughcontact.files.fields import fields_of, number_of
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.number_stream import grid_of

__all__ = ["read_profilm"]

_UNIT = re.compile(r"[\[(]\s*([^\])]+?)\s*[\])]")


def read_profilm(text: str) -> HeightMap:
    """Return the heights of an export."""
    lines = [line for line in text.split("\n") if line.strip()]
    if len(lines) < 4 or len(values := [number_of(f.replace(",", ".")) for f in fields_of(lines[1])]) < 3:
        raise ContentError(
            "its header is damaged", "write numCols, numRows and pixelSize, and their values below"
        )
    nx, ny, cell = values[:3]
    if not (1 <= nx <= 1e9 and 1 <= ny <= 1e9):
        raise ContentError(f"it states {ny:g} rows of {nx:g} heights", "copy or export it again")
    fields = [field for line in lines[3:] for field in fields_of(line)]
    heights, notes, warnings = grid_of(fields, (int(ny), int(nx)))
    lateral, unit = (found[1] if (found := _UNIT.search(line)) else None for line in (lines[0], lines[2]))
    step = cell * length_factor(lateral or "") if is_length(lateral) else None
    return HeightMap(
        as_heights(heights),
        "Profilm text",
        unit=unit,
        spacing=None if step is None else (step, step),
        unclear=lines[0].strip() if step is None else None,
        notes=notes,
        warnings=warnings,
    )
