"""A profile in a text: heights, or places and heights, under any number of lines of words."""

from __future__ import annotations

import re

import numpy as np

from roughcontact.files.column_units import VALIDITY, column_order, column_units
from roughcontact.files.fields import EMPTY, fields_of, is_mark, is_number, put_points
from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor, stated_length
from roughcontact.files.missing_marks import without_marks
from roughcontact.files.numbers import Marks, decode, last_digit, require_rows, unended
from roughcontact.files.table_axes import counts
from roughcontact.files.text_dialects import dialect_of
from roughcontact.files.text_header import header_of
from roughcontact.validation import Array

__all__ = ["read_profile"]

# Largest deviation of places from even ones: in steps, or in units of their last printed digit.
_SLACK = 0.1
_PRINTED = 1.001
_UNIT = r"[^\W\d_]{1,10}"
_REMEDY = (
    "give one column of heights, or two: places along the line and heights; or a third, valid, of 1 and 0"
)


def read_profile(data: bytes) -> HeightMap:
    """Return the heights of a profile.

    Lines of words come first; their last one may name the units of two columns, in brackets or as last words
    (``Lateral um, Raw Micrometer``). Then every line is a row of one or two numbers to the end of the file. A line
    such as ``Length, 1500 um`` is compared with the places. A third column named ``valid`` marks by 1 and 0 which
    heights were measured, as in the profiles headed ``X;Y;valid`` and ``[mm];[mm];[1/0]``. A line such as ``nodata =
    -9999`` states the mark of points that were not measured, as for a map.
    """
    text = decode(data)
    if dialect_of(text) is not None:
        raise ContentError("it is a text of a map, by its first line", "use read")
    words, rows, warnings = _without_name(*_split(text))
    require_rows(words, len(rows))
    columns = len(rows[0])
    header = header_of(words, (0, 0))
    marks = Marks()
    order = list(column_order(words, columns)) if columns == 2 else list(range(columns))
    values = np.array([marks.numbers(row) for row in rows])[:, order]
    notes, of_marks = marks.notes_and_warnings()
    heights, stated, near = without_marks(values[:, min(columns - 1, 1)], header.missing)
    notes, warnings = (*notes, *stated), (*unended(text), *warnings, *of_marks, *header.warnings, *near)
    if columns == 3:
        heights = np.where(values[:, 2] == 0, np.nan, heights)
    units = column_units(words, min(columns, 2))
    lateral, unit = (None, None, *(units[k] for k in order[:2]))[-2:]
    lateral = lateral or header.lateral
    spacing, steps, unclear = None, None, header.unclear
    if columns == 1:
        length = header.dx if header.width is None else header.width / len(rows)
        spacing = None if length is None else (length,)
    else:
        step, of_places = _step(values[:, 0], [row[order[0]] for row in rows])
        notes = (*notes, *of_places)
        if is_length(lateral):
            spacing = (step * length_factor(lateral or ""),)
            warnings += _announced(words, spacing[0] * (len(values) - 1))
        else:
            unclear = _unclear(lateral, unit or header.unit_unknown, values[:, 0])
            steps = (step,) if unclear is None else None
    return HeightMap(
        as_heights(heights),
        "text profile",
        unit=unit or header.unit,
        spacing=spacing,
        steps=steps,
        unclear=unclear,
        notes=notes,
        warnings=warnings,
    )


def _unclear(lateral: str | None, unit: str | None, places: Array) -> str | None:
    """Return why the unit of the places is unclear; None without any unit, when that of the heights may apply."""
    if lateral is not None:
        return f"places in {lateral!r}"
    if unit is not None:
        return f"heights in {unit}, places without a unit"
    return "the first column numbers the heights" if counts(places) else None


def _without_name(
    words: list[str], rows: list[list[str]]
) -> tuple[list[str], list[list[str]], tuple[str, ...]]:
    """Return rows without a first row 0, the name that data frames give to a single column."""
    if rows[0] == ["0"] and len(rows) > 2 and all("." in row[0] or is_mark(row[0]) for row in rows[1:]):
        return words, rows[1:], ("its first number, 0, is taken for the name of the column, and left out",)
    return words, rows, ()


def _split(text: str) -> tuple[list[str], list[list[str]]]:
    """Return the lines of words and the rows of numbers after them."""
    words: list[str] = []
    rows: list[list[str]] = []
    where: list[str] = []
    for number, line in enumerate(text.rstrip().split("\n"), start=1):
        fields = _trimmed(fields_of(line.strip(" ")), len(rows[0]) if rows else 1)
        judged = len(fields) == 3 and _of_validity(words) and fields[2] in ("0", "1")
        if _is_row(fields, judged):
            if len(fields) > 2 + judged or len(fields) != len((rows or [fields])[0]):
                raise ContentError(f"line {number} holds {len(fields)} numbers", _REMEDY)
            rows.append([field or "nan" for field in fields] if judged else fields)
            where.append(f"line {number}")
        elif rows:
            raise ContentError(
                f"line {number}: {line.strip()[:30]!r} interrupts the rows of numbers", _REMEDY
            )
        elif bare := line.strip("# \t,;"):
            words.append(bare)
    if len(rows) < 2:
        raise ContentError(f"it holds {len(rows)} rows of numbers", _REMEDY)
    put_points(rows, where)
    return words, rows


def _trimmed(fields: list[str], fewest: int) -> list[str]:
    """Return fields without the empty ones at their end, of which at least `fewest` fields are left."""
    while len(fields) > fewest and fields[-1] == EMPTY:
        fields = fields[:-1]
    return fields


def _is_row(fields: list[str], judged: bool) -> bool:
    """Whether fields are a row: a number, then numbers or marks of missing points; or a single mark."""
    known = [is_number(field.replace(",", ".")) for field in fields]
    if not fields or not all(number or is_mark(field) for number, field in zip(known, fields, strict=True)):
        return False
    if len(fields) == 1:
        return known[0] or fields[0].casefold() == "nan"
    return (known[0] or fields[0].casefold() == "nan") and (
        fields[1] != EMPTY or not judged or fields[2] == "0"
    )


def _of_validity(words: list[str]) -> bool:
    """Whether the last two lines of words name the third of three columns as that of validity."""
    columns = (re.split(r"\s*[,;\t]\s*|\s+", line) for line in words[-2:])
    return any(len(each) == 3 and VALIDITY.fullmatch(each[2]) for each in columns)


def _step(places: Array, printed: list[str]) -> tuple[float, tuple[str, ...]]:
    """Return the step of places that are even except for their printed digits, and a remark where that matters."""
    count = len(places)
    step = float((places[-1] - places[0]) / (count - 1))
    if not step > 0:
        raise ContentError(f"its places run from {places[0]:g} to {places[-1]:g}", "sort the rows by place")
    digit = min(last_digit(text) for text in printed)
    error = float(np.abs(places - places[0] - step * np.arange(count)).max())
    # The two ends are also rounded: half a digit of each place, and of the line through the ends.
    if not error <= max(_SLACK * step, _PRINTED * digit, 1e-6 * abs(places).max()):
        raise ContentError(
            f"its places are not even: one is {error:g} off steps of {step:g}",
            "interpolate to even steps first",
        )
    if error <= _SLACK * step:
        return step, ()
    return step, (f"places printed to {digit:g} are taken as even steps of {step:g}",)


def _announced(words: list[str], span: float) -> tuple[str, ...]:
    """Return a warning if a line of words announces another length [m] than the places cover."""
    for line in words:
        parts = re.fullmatch(rf"(?:scan )?length\s*[,:;=\t]\s*([\d.]+\s*{_UNIT})", line, re.IGNORECASE)
        if parts is None:
            continue
        length = stated_length(parts[1])
        if length is None:
            continue
        if abs(span - length) > 0.01 * length:
            return (f"it announces a length of {length:g} m and covers {span:g} m: it may be cut short",)
    return ()
