"""Keyence's text of a laser microscope (VK-X, VR): pairs of label and value in any language, then heights."""

from __future__ import annotations

import csv
import itertools
import re

from roughcontact.files.fields import is_mark, is_number, number_of
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor
from roughcontact.files.number_stream import grid_of

__all__ = ["read_keyence"]

_COLUMNS, _ROWS = (
    re.compile(words, re.IGNORECASE) for words in (r"horizont.*|水平.*", r"verti[ck].*|垂直.*")
)
_HEIGHT = re.compile(r"height|höhe|hauteur|altura|高", re.IGNORECASE)


def read_keyence(text: str) -> HeightMap:
    """Return the heights of an export; the one value followed by a unit is the side of a cell."""
    separator = re.search(r"[;,\t]", text)
    # A quoted label may extend over two lines.
    rows = csv.reader(text.splitlines(), delimiter=separator[0] if separator else ",")
    fields = [[field.strip() for field in row] for row in rows]
    header = list(itertools.takewhile(lambda row: not _holds_heights(row), fields))
    heights = [row for row in fields[len(header) :] if len(row) > 1]
    if not heights:
        raise ContentError(
            "it is a text of Keyence without heights", "export it with the data of its height image"
        )
    shape = len(heights), len(heights[0])
    for words, name, found in ((_ROWS, "rows", shape[0]), (_COLUMNS, "columns", shape[1])):
        stated = next((row[1] for row in header if len(row) == 2 and words.fullmatch(row[0])), str(found))
        if stated != str(found):
            raise ContentError(f"it holds {found} {name} and states {stated}", "copy or export it again")
    values, notes, warnings = grid_of([field for row in heights for field in row], shape)
    cell = next((row for row in header if len(row) == 3 and is_length(row[2]) and _is_number(row[1])), None)
    side = None if cell is None else number_of(cell[1].replace(",", ".")) * length_factor(cell[2])
    titles = [row[0] for row in header if len(row) == 1 and row[0]]
    units = [row[1] for row in header if len(row) == 2 and is_length(row[1])]
    if not units and titles and not _HEIGHT.search(titles[-1]):
        raise ContentError(f"it holds {titles[-1]!r}, not heights", "export the data of its height image")
    return HeightMap(
        as_heights(values),
        "Keyence text",
        channel=titles[-1] if titles else None,
        unit=units[-1] if units else None,
        spacing=None if side is None else (side, side),
        notes=notes,
        warnings=warnings,
    )


def _is_number(field: str) -> bool:
    return is_number(field.replace(",", "."))


def _holds_heights(row: list[str]) -> bool:
    return len(row) > 1 and all(is_mark(field) or _is_number(field) for field in row)
