"""A profile in a text: heights, or places and heights, under any number of lines of words."""

from __future__ import annotations

import re

import numpy as np

from roughcontact.files.file_errors import ContentError
from roughcontact.files.heightmap import HeightMap, as_heights
from roughcontact.files.length_units import is_length, length_factor, parse_length
from roughcontact.files.numbers import decode, last_digit, require_rows, unended
from roughcontact.validation import Array

__all__ = ["read_profile"]

# Places may lie so far from even ones: in steps, or in units of their last printed digit.
_SLACK = 0.1
_PRINTED = 1.001
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|nan", re.IGNORECASE)
_UNIT = r"[^\W\d_]{1,10}"
_NAMED = {"micrometer": "um", "micrometers": "um", "nanometer": "nm", "nanometers": "nm", "millimeter": "mm"}
_REMEDY = (
    "give one column of heights, or two: places along the line and heights; or a third, valid, of 1 and 0"
)
_VALID = re.compile(r"valid|\[?1/0\]?", re.IGNORECASE)


def read_profile(data: bytes) -> HeightMap:
    """Return the heights of a profile.

    Lines of words come first; their last one may name the units of two columns, in brackets or as last words
    (``Lateral um, Raw Micrometer``). Then every line is a row of one or two numbers to the end of the file. A line
    such as ``Length, 1500 um`` is compared with the places. A third column that the words call ``valid`` says by 1 and
    0 which heights were measured, as in the profiles headed ``X;Y;valid`` and ``[mm];[mm];[1/0]``.
    """
    text = decode(data)
    words, rows = _split(text)
    require_rows(words, len(rows))
    doubts = unended(text)
    values = np.array([[float(field or "nan") for field in row] for row in rows])
    if values.shape[1] == 3:
        values[values[:, 2] == 0, 1] = np.nan
    if values.shape[1] == 1:
        unit = _header_units(words, 1)[0]
        return HeightMap(as_heights(values[:, 0]), "text profile", unit=unit, doubts=doubts)
    step, note = _step(values[:, 0], [row[0] for row in rows])
    lateral, unit = _header_units(words, 2)
    factor = length_factor(lateral) if lateral is not None else None
    if factor is not None:
        doubts += _announced(words, step * factor * (len(values) - 1))
    return HeightMap(
        as_heights(values[:, 1]),
        "text profile",
        unit=unit,
        spacing=None if factor is None else (step * factor,),
        steps=(step,) if factor is None else None,
        notes=note,
        doubts=doubts,
    )


def _split(text: str) -> tuple[list[str], list[list[str]]]:
    """Return the lines of words and the rows of numbers after them."""
    words: list[str] = []
    rows: list[list[str]] = []
    lines = text.rstrip().split("\n")
    for number, line in enumerate(lines, start=1):
        bare = line.strip().rstrip(",;").rstrip()
        fields = _fields(bare)
        judged = len(fields) == 3 and _of_validity(words) and fields[2] in ("0", "1")
        if all(_NUMBER.fullmatch(field) for field in fields) or (judged and fields[1:] == ["", "0"]):
            if len(fields) > 2 + judged or len(fields) != len((rows or [fields])[0]):
                raise ContentError(f"line {number} holds {len(fields)} numbers", _REMEDY)
            rows.append(fields)
        elif rows:
            raise ContentError(
                f"line {number}: {line.strip()[:30]!r} interrupts the rows of numbers", _REMEDY
            )
        elif bare.strip("# "):
            words.append(bare.strip("# "))
    if len(rows) < 2:
        raise ContentError(f"it holds {len(rows)} rows of numbers", _REMEDY)
    return words, rows


def _fields(line: str) -> list[str]:
    """Return the fields of a line; beside a semicolon or a tab a comma is the decimal mark."""
    if re.search(r"[;\t]", line):
        return re.split(r"\s*[;\t]\s*", line.replace(",", "."))
    return re.split(r"\s*,\s*|\s+", line)


def _of_validity(words: list[str]) -> bool:
    """Whether the last two lines of words call the third of three columns that of validity."""
    columns = (re.split(r"\s*[,;\t]\s*|\s+", line) for line in words[-2:])
    return any(len(each) == 3 and _VALID.fullmatch(each[2]) for each in columns)


def _step(places: Array, printed: list[str]) -> tuple[float, tuple[str, ...]]:
    """Return the step of places that are even but for their printed digits, and a remark where that matters."""
    count = len(places)
    step = float((places[-1] - places[0]) / (count - 1))
    if not step > 0:
        raise ContentError(f"its places run from {places[0]:g} to {places[-1]:g}", "sort the rows by place")
    digit = min(last_digit(text) for text in printed)
    error = float(np.abs(places - places[0] - step * np.arange(count)).max())
    # The two ends are rounded as well: half a digit of each place, and of the line through the ends.
    if not error <= max(_SLACK * step, _PRINTED * digit, 1e-6 * abs(places).max()):
        raise ContentError(
            f"its places are not even: one is {error:g} off steps of {step:g}",
            "interpolate to even steps first",
        )
    if error <= _SLACK * step:
        return step, ()
    return step, (f"places printed to {digit:g} are taken as even steps of {step:g}",)


def _header_units(words: list[str], columns: int) -> tuple[str | None, ...]:
    """Return the units that the last line of words gives to the columns."""
    if words:
        bracketed = re.findall(r"[\[(]\s*([^\])]+?)\s*[\])]", words[-1])
        last = [re.split(r"\s+", part.strip())[-1] for part in re.split(r"[,;\t]", words[-1])]
        for found in (bracketed, last):
            units = [_NAMED.get(unit.casefold(), unit) for unit in found if not _VALID.fullmatch(unit)]
            if len(units) == columns and all(map(is_length, units)):
                return tuple(units)
    return (None,) * columns


def _announced(words: list[str], span: float) -> tuple[str, ...]:
    """Return a doubt where a line of words announces another length [m] than the places cover."""
    for line in words:
        parts = re.fullmatch(rf"(?:scan )?length\s*[,:;=\t]\s*([\d.]+\s*{_UNIT})", line, re.IGNORECASE)
        if parts is None:
            continue
        try:
            length = parse_length(parts[1])
        except ValueError:
            continue
        if abs(span - length) > 0.01 * length:
            return (f"it announces a length of {length:g} m and covers {span:g} m: it may be cut short",)
    return ()
