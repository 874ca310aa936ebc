"""The fields of a line of a table: separators, quotes, decimal commas, and marks of points without a height."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Sequence

from roughcontact.files.file_errors import ContentError

__all__ = [
    *("EMPTY", "fields_of", "is_mark", "is_number", "number_of"),
    *("put_points", "require_one_separator", "separator_of"),
]

EMPTY = ""  # a field between two separators
# Words of instruments and spreadsheets for a point without a height, beside nan.
_MARK = re.compile(
    r"[-+]?nan(\(\w*\))?|[-+]?1\.#(ind|qnan|snan)\d*|#?n/?a!?|n\.a\.|#num!?|null|none|missing|bad|void|invalid"
    r"|undefined|masked|no ?data|[-*?.]+|",
    re.IGNORECASE,
)
# "1,5 2,5" holds blanks that do not follow a comma; "1, 2" and "1,2" do not.
_APART = re.compile(r"[^,\s]\s+[^,\s]")
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(,\d{3})+")
_POINT = re.compile(r"\d\.|\.\d")
_PRINTED = re.compile(r"[-+\d.,]+([eE][-+]?\d+)?")
_NO_DATA = re.compile(r"\bno data\b", re.IGNORECASE)  # two words between blanks
_NEEDS_POINTS = "write decimal points, and no commas between thousands"


def fields_of(line: str, like: str | None = None) -> list[str]:
    """Return the fields of a line as they are printed, without blanks and quotes around them.

    A line of words is split with the separator of the line `like`.
    """
    separator = separator_of(line if like is None else like)
    if separator is None:
        return _NO_DATA.sub("nodata", line).replace('"', "").split()
    if '"' in line:
        return [
            field.strip() for field in next(csv.reader([line], delimiter=separator, skipinitialspace=True))
        ]
    return [field.strip() for field in line.split(separator)]


def require_one_separator(lines: Sequence[str], where: Sequence[str]) -> None:
    """Refuse lines that are separated in two ways."""
    for line, place in zip(lines, where, strict=True):
        if separator_of(line) != separator_of(lines[0]):
            raise ContentError(
                f"{place} has other separators than the first row", "separate all numbers alike"
            )


def is_number(field: str) -> bool:
    """Whether a field, with a decimal point, is a finite number."""
    return not math.isnan(number := number_of(field)) and math.isfinite(number) and not is_mark(field)


def is_mark(field: str) -> bool:
    """Whether a field stands for a point without a height; an empty one does."""
    return _MARK.fullmatch(field) is not None


def number_of(field: str) -> float:
    """Return the number in a field; NaN if it holds none."""
    try:
        return math.nan if "_" in field else float(field)  # Python reads 1_000 as a thousand
    except ValueError:
        return math.nan


def put_points(rows: list[list[str]], where: Sequence[str]) -> None:
    """Put points for decimal commas into rows of fields.

    Raises
    ------
    ContentError
        If commas may separate thousands, or separate both fields and decimals; the message names the row.
    """
    if not any("," in field for row in rows for field in row):
        if _halves(rows):
            shown = ",".join(rows[0][:4])
            raise ContentError(
                f"{where[0]}: {shown!r} may be {len(rows[0][:4])} numbers, or half as many with decimal commas",
                "write decimal points, or semicolons between the numbers",
            )
        return
    certain = False
    for row, place in zip(rows, where, strict=True):
        for field in row:
            if _POINT.search(field) and _PRINTED.fullmatch(field):
                raise ContentError(f"{place} holds decimal commas and points", _NEEDS_POINTS)
            certain = certain or ("," in field and _THOUSANDS.fullmatch(field) is None)
    if not certain:
        row, place = next((r, p) for r, p in zip(rows, where, strict=True) if any("," in f for f in r))
        field = next(f for f in row if "," in f)
        raise ContentError(
            f"{place}: {field!r} may be {field.replace(',', '.')} or {field.replace(',', '')}", _NEEDS_POINTS
        )
    for row in rows:  # in place, because the fields take most of the memory
        row[:] = [field.replace(",", ".") for field in row]


def separator_of(line: str) -> str | None:
    """Return what separates the fields of a line; None: blanks."""
    if '"' in line:
        after = re.search(r'"[^"]*"\s*?([,;\t])', line)
        if after is not None:
            return after[1]
    for mark in (";", "\t"):
        if mark in line.strip(" "):
            return mark
    return None if "," not in line or _APART.search(line.strip()) else ","


def _halves(rows: list[list[str]]) -> bool:
    """Whether every second field may be the decimals of the one before it: digits of one width, some after zeros."""
    widths = {len(row) for row in rows}
    if len(widths) > 1 or min(widths) % 2 or any("." in field for row in rows for field in row):
        return False
    decimals = [field for row in rows for field in row[1::2]]
    alike = len({len(field) for field in decimals}) == 1 and all(map(str.isdecimal, decimals))
    return alike and len(decimals[0]) > 1 and any(field.startswith("0") for field in decimals)
