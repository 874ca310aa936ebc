"""A table of numbers in a text: all rows complete, all gaps reported."""

from __future__ import annotations

import codecs
import math
import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from roughcontact.errors import InputError
from roughcontact.files.fields import (
    EMPTY,
    fields_of,
    is_mark,
    is_number,
    number_of,
    put_points,
    require_one_separator,
)
from roughcontact.files.file_errors import ContentError
from roughcontact.validation import Array

__all__ = ["Marks", "Table", "decode", "last_digit", "parse_table", "require_rows", "stated_rows", "unended"]

_HOLE = "write nan where a point was not measured, so that all rows are equally long"
_ROWS = re.compile(
    r"(?:(?:number of )?rows|y-pixels|y-?res|ny|zeilen|lignes)\s*[:=,;\t]\s*(\d{1,9})", re.IGNORECASE
)
_PLAIN = "give rows of numbers only; header lines must start with # or have the form name = value"
_COMMENT = re.compile(r"(?:#(?!n/?a\b|num\b)|%|//|!)\s*", re.IGNORECASE)  # spreadsheets write #N/A and #NUM!
# Above a table: a name that does not begin like a number, with a value; or the words that end a header.
_STATEMENT = re.compile(r"(?!(?:nan|inf)\b)[^\W\d_][^=:;\t]*[=:].*|start of data\W*", re.IGNORECASE)
_WORDS = re.compile(r"(?:(?!(?:nan|inf)\b)[^\W\d_]+\s+){2}.*", re.IGNORECASE)  # among such lines
_NAME = re.compile(r"[^\W\d_][^\[\]]*\[[^\]]*\]")  # above a single column: pressure [MPa]
# Line ends of other systems; signs for a minus, a dash and a colon in typeset and in Japanese texts.
_SIGNS = {"\r\n": "\n", "\r": "\n", "\N{MINUS SIGN}": "-", "\N{EN DASH}": "-", "\N{FULLWIDTH COLON}": ":"}
_CORNER = re.compile(
    r"(?!nan|inf)[^\W\d_]|[\[(/\\]", re.IGNORECASE
)  # what a word above a first column begins with
_TELLING = 32  # bytes, every other one zero, that show a text of two bytes a letter
_PLAIN_MARK = re.compile(r"[-+]?nan", re.IGNORECASE)


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """The numbers of a text, shape (rows, columns), the lines above them without their ``#``, notes and warnings.

    `statements` is true if some of these lines had no ``#``.
    """

    values: Array
    comments: tuple[str, ...]
    statements: bool
    notes: tuple[str, ...]
    warnings: tuple[str, ...]
    corner: Corner | None


@dataclass(frozen=True, slots=True)
class Corner:
    """The corner of a table with coordinates in its first row and column, and the error if they are not coordinates.

    An empty corner may be a missing point of the map, which is not an error.
    """

    text: str
    error: ContentError | None


@dataclass(slots=True)
class Marks:
    """The marks of missing points that a reader has found, with the number of each."""

    counts: Counter[str] = field(default_factory=Counter)

    def numbers(self, fields: list[str]) -> list[float]:
        """Return the numbers in fields, NaN for marks; raise ValueError for anything else."""
        try:
            if not any("_" in text for text in fields):
                return [float(text) for text in fields]
        except ValueError:
            pass
        return [self.number(text) for text in fields]

    def number(self, text: str) -> float:
        """Return the number in a field, NaN for a mark; raise ValueError for anything else."""
        number = number_of(text)
        if math.isnan(number) and not _PLAIN_MARK.fullmatch(text):
            if not is_mark(text):
                raise InputError(text)
            self.counts[text] += 1
        return number

    def notes_and_warnings(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Return notes, and warnings about marks so short that they may come from damage."""
        notes: list[str] = []
        warnings: list[str] = []
        for text, count in self.counts.items():
            what = "empty" if text == EMPTY else f"that hold {text!r}"
            (notes if len(text) > 1 else warnings).append(f"fields read as missing points: {count} {what}")
        return tuple(notes), tuple(warnings)


def parse_table(text: str, *, points: bool = False) -> Table:
    """Return the table in a text separated by blanks, tabs, semicolons or commas.

    Lines such as ``width = 1 mm`` may stand above it, without a ``#`` too. A decimal comma is understood with any
    separator except the comma, and in quotes. A list of `points` may stand under any words and contain empty lines,
    because each point has its coordinates.

    Raises
    ------
    ContentError
        If a row is longer or shorter than the first, a field is not a number, commas may mean two things, or an empty
        line or a comment interrupts the rows of a matrix; the message names the row.
    """
    comments: list[str] = []
    rows: list[tuple[int, str]] = []
    interrupted = False
    interruption = 0  # the line of an empty line or comment after the first row
    statements = False
    for number, line in enumerate(text.split("\n"), start=1):
        bare = line.strip()
        mark = _COMMENT.match(bare)
        if mark or not bare:
            if mark:
                comments.append(bare[mark.end() :].lstrip("# ").strip())
            if rows and not interruption:
                interruption = number
        elif not rows and (_is_header(bare, statements) or (points and not _holds_a_point(bare))):
            comments.append(bare)
            statements = True
        elif interruption and not points:
            interrupted = True
            break
        else:
            rows.append((number, line))
    if not rows:
        raise ContentError("it holds no numbers", _PLAIN)
    # Errors in the rows come first: a row without numbers is a better message than the gap after it.
    table = _numbers(rows)
    if interrupted:
        raise ContentError(
            f"line {interruption}, empty or a comment, is a hole after row {len(rows)}",
            "keep one uninterrupted table in a file, or name a list of points x, y, z .xyz",
        )
    require_rows(comments, len(table.values))
    return Table(
        table.values,
        (*comments, *table.comments),
        statements or table.statements,
        table.notes,
        (*unended(text), *table.warnings),
        table.corner,
    )


def _is_header(line: str, among_statements: bool) -> bool:
    return bool(_STATEMENT.fullmatch(line) or (among_statements and _WORDS.fullmatch(line)))


def _holds_a_point(line: str) -> bool:
    """Whether a line is that of a point, even if one of its numbers is damaged."""
    return sum(is_number(text.replace(",", ".")) for text in fields_of(line)) > 1


def require_rows(comments: Iterable[str], found: int) -> None:
    """Refuse a text with fewer rows than a comment states."""
    stated = stated_rows(comments)
    if stated is not None and stated > found:
        raise ContentError(
            f"it holds {found} rows and states {stated}: it is cut short",
            "copy or export it again, or remove that line if it has another meaning",
        )


def stated_rows(comments: Iterable[str]) -> int | None:
    """Return the number of rows that a comment such as ``Rows: 512`` or ``y-pixels = 512`` states."""
    found = (_ROWS.fullmatch(comment.strip()) for comment in comments)
    return next((int(match[1]) for match in found if match is not None), None)


def unended(text: str) -> tuple[str, ...]:
    """Return a warning if the last line has no end: its last number may lack digits."""
    last = text.rpartition("\n")[2].strip()
    if not last or last.startswith("#"):
        return ()
    return ("its last line has no end: it may be cut short, and its last number may lack digits",)


def decode(data: bytes) -> str:
    """Return the text with newlines as line ends; the numbers are ASCII in every encoding tried."""
    encoding = "utf-16" if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) else "utf-8-sig"
    if len(data) >= _TELLING and data[1:_TELLING:2] == bytes(_TELLING // 2):
        encoding = "utf-16-le"  # without a byte-order mark
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        text = data.decode("latin-1")  # older Western exports: only comments are affected
    if "\0" in text:
        raise ContentError(
            "it is not a text: it holds zero bytes", "rename it to the extension of its format"
        )
    for sign, plain in _SIGNS.items():
        text = text.replace(sign, plain)
    return text


def last_digit(number: str) -> float:
    """Return the unit of the last digit of a printed number."""
    mantissa, _, exponent = number.casefold().partition("e")
    return float(10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])))


def _numbers(rows: list[tuple[int, str]]) -> Table:
    where = [f"row {k} (line {number})" for k, (number, _) in enumerate(rows, start=1)]
    fields = [fields_of(line) for _, line in rows]
    if len(rows) > 1 and not all(map(is_number, fields[0])):
        fields[0] = fields_of(rows[0][1], like=rows[1][1])
    # Some programs end every row with a separator; if only some rows end with one, values are missing.
    if all(len(row) > 1 and row[-1] == EMPTY for row in fields):
        fields = [row[:-1] for row in fields]
    names: tuple[str, ...] = ()
    named = len(rows) > 1 and len(fields[-1]) == 1 and _NAME.fullmatch(rows[0][1].strip())
    if named or _are_names(fields[:2]):
        names = (rows[0][1].strip(),)
        fields, where = fields[1:], where[1:]
    put_points(fields, where)
    corner = _corner(fields, where)
    marks = Marks()
    table = []
    for index, (row, place) in enumerate(zip(fields, where, strict=True)):
        fields[index] = []  # the row is no longer needed
        try:
            table.append(marks.numbers(row))
        except ValueError:
            raise _bad_field(row, place) from None
        if len(row) != len(table[0]):
            raise ContentError(f"{place} holds {len(row)} numbers, the first row {len(table[0])}", _HOLE)
    lines = [line for _, line in rows[bool(names) :]]
    require_one_separator(lines[corner is not None :], where[corner is not None :])
    notes, warnings = marks.notes_and_warnings()
    if names:
        notes = (f"its first line, {names[0][:60]!r}, names the columns", *notes)
    return Table(np.array(table, dtype=np.float64), names, bool(names), notes, warnings, corner)


def _are_names(fields: list[list[str]]) -> bool:
    """Whether the first of two lines names the columns of the other: at least two words; rows may also be named."""
    if len(fields) < 2 or len(fields[0]) < 2 or not 0 <= len(fields[1]) - len(fields[0]) <= 1:
        return False
    return all(text[0].isalpha() and not is_mark(text) for text in fields[0][fields[0][0] == EMPTY :] if text)


def _corner(rows: list[list[str]], where: list[str]) -> Corner | None:
    """Put NaN where the first row has a word, or nothing, above a column; return the original text there."""
    first = rows[0]
    if len(rows) < 2 or not first or not all(map(is_number, first[1:])):
        return None
    if len(first) == len(rows[1]) - 1 and is_number(first[0]):
        first.insert(0, "nan")
        return Corner(
            "",
            ContentError(f"{where[1]} holds {len(rows[1])} numbers, the first row {len(first) - 1}", _HOLE),
        )
    if len(first) > 1 and (first[0] == EMPTY or (_CORNER.match(first[0]) and not is_mark(first[0]))):
        corner = Corner(first[0], _bad_field(first, where[0]) if first[0] else None)
        first[0] = "nan"
        return corner
    return None


def _bad_field(fields: list[str], where: str) -> ContentError:
    """Return the error that names the first field which is not a number."""
    for column, text in enumerate(fields, start=1):
        if is_mark(text) or not math.isnan(number_of(text)):
            continue
        shown = text if len(text) <= 30 else text[:27] + "..."
        return ContentError(f"{where}, column {column}: {shown!r} is not a number", _PLAIN)
    return ContentError(f"{where} is not a row of numbers", _PLAIN)
