"""The units that a line of words above a table gives to its columns."""

from __future__ import annotations

import re
from collections.abc import Sequence

from roughcontact.files.length_units import is_length

__all__ = ["VALIDITY", "column_names", "column_order", "column_units"]

VALIDITY = re.compile(r"valid|\[?1/0\]?", re.IGNORECASE)  # name of a column that marks measured heights


# Names of columns, compared in lower case. There is no agreement on the meaning of i and j.
_PLACES = r"x|col(umn)?|lon(gitude)?|easting", r"y|row|lat(itude)?|northing"
_PLACE = r"x|(lateral|horizontal )?(position|distance|place)|lateral"


def column_order(lines: Sequence[str], columns: int) -> tuple[int, ...]:
    """Return the columns in the order x, y, z of points, or place and height of a profile, as a line names them.

    Without such names, the columns have this order.
    """
    given = tuple(range(columns))
    for line in reversed(lines):
        names = column_names(line, columns)
        words = _PLACES if columns > 2 else (_PLACE,)
        places = [[k for k in range(len(names)) if re.fullmatch(word, names[k])] for word in words]
        if all(len(each) == 1 for each in places):
            first = tuple(each[0] for each in places)
            return (*first, *(k for k in given if k not in first))
    return given


def column_names(line: str, columns: int) -> list[str]:
    """Return the names of columns in a line, in lower case and without units; nothing if their number is different."""
    return [re.split(r"[_/\[(.]", name)[0].strip().casefold() for name in _parts_of(line, columns)]


def _parts_of(line: str, columns: int) -> list[str]:
    """Return the names of columns in a line, or nothing if their number is different."""
    for parts in (re.split(r"[,;\t]", line), re.sub(r"[\[(][^\])]*[\])]", " ", line).split()):
        if len(parts) == columns:
            return [part.strip(" \"'") for part in parts]
    return []


def column_units(lines: Sequence[str], columns: int) -> tuple[str | None, ...]:
    """Return the unit of each column from the last line that names any unit; it may be an unknown word.

    Units stand in brackets, ``x [mm], z (um)``, or after a name, ``Lateral um, Raw Micrometer``, ``x_mm z/um``.
    """
    for line in reversed(lines):
        found = _units_in(line, columns)
        if any(found):
            return found
    return (None,) * columns


def _units_in(line: str, columns: int) -> tuple[str | None, ...]:
    brackets = [
        unit for unit in re.findall(r"[\[(]\s*([^\])]*?)\s*[\])]", line) if not VALIDITY.fullmatch(unit)
    ]
    if len(brackets) == columns:
        return tuple(brackets)
    for parts in (re.split(r"[,;\t]", line), line.split()):
        columns_of = [part.strip(" \"'") for part in parts if not VALIDITY.fullmatch(part.strip(" \"'"))]
        if len(columns_of) == columns:
            alone = all(map(is_length, columns_of))
            return tuple(part if alone else _unit_behind(part) for part in columns_of)
    return (None,) * columns


def _unit_behind(part: str) -> str | None:
    bracket = re.search(r"[\[(]\s*([^\])]*?)\s*[\])]", part)
    if bracket is not None:
        return bracket[1]
    *name, last = re.split(r"[\s_/]+", part)
    return last if name and is_length(last) else None
