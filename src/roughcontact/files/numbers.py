"""A table of numbers in a text: every row whole, every hole named."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from roughcontact.files.file_errors import ContentError
from roughcontact.validation import Array

__all__ = ["Table", "decode", "last_digit", "parse_table", "require_rows", "stated_rows", "unended"]

_HOLE = "write nan where a point was not measured, so that all rows are equally long"
_ROWS = re.compile(
    r"(?:(?:number of )?rows|y-pixels|y-?res|ny|zeilen|lignes)\s*[:=,;\t]\s*(\d{1,9})", re.IGNORECASE
)
_PLAIN = "give rows of numbers only; lines of explanation before them start with #, or read name = value"
# Above a table: a name that no number begins with, and what it is; or the words that end a header.
_STATEMENT = re.compile(r"(?!(?:nan|inf)\b)[^\W\d_][^=:;\t]*[=:].*|start of data\W*", re.IGNORECASE)
_WORDS = re.compile(r"(?:(?!(?:nan|inf)\b)[^\W\d_]+\s+){2}.*", re.IGNORECASE)  # among such lines


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """The numbers of a text, shape (rows, columns), the lines above them without their ``#``, and doubts.

    `statements` says whether some of these lines had no ``#``, but were of the form ``name = value``.
    """

    values: Array
    comments: tuple[str, ...]
    statements: bool
    doubts: tuple[str, ...]


def parse_table(data: bytes) -> Table:
    """Return the table in a text separated by blanks, tabs, semicolons or commas.

    Lines such as ``width = 1 mm`` may stand above it, without a ``#`` too. A decimal comma is understood beside any
    separator but the comma itself.

    Raises
    ------
    ContentError
        If a row is longer or shorter than the first, a field is empty or not a number, or an empty line or a
        comment interrupts the rows; the message names the row.
    """
    comments: list[str] = []
    rows: list[tuple[int, str]] = []
    interrupted = False
    interruption = 0  # the line of an empty line or comment after the first row
    statements = False
    text = decode(data)
    for number, line in enumerate(text.split("\n"), start=1):
        bare = line.strip()
        if bare.startswith("#") or not bare:
            if bare:
                comments.append(bare.lstrip("# ").strip())
            if rows and not interruption:
                interruption = number
        elif not rows and (_STATEMENT.fullmatch(bare) or (statements and _WORDS.fullmatch(bare))):
            comments.append(bare)
            statements = True
        elif interruption:
            interrupted = True
            break
        else:
            rows.append((number, line))
    if not rows:
        raise ContentError("it holds no numbers", _PLAIN)
    # The rows come first: one that holds no numbers says more about the file than the hole after it.
    values = _numbers(rows)
    if interrupted:
        raise ContentError(
            f"line {interruption}, empty or a comment, is a hole after row {len(rows)}",
            "keep one uninterrupted table in a file",
        )
    require_rows(comments, len(rows))
    return Table(values, tuple(comments), statements, unended(text))


def require_rows(comments: Iterable[str], found: int) -> None:
    """Refuse a text of fewer rows than a comment states."""
    stated = stated_rows(comments)
    if stated is not None and stated > found:
        raise ContentError(
            f"{found} rows are there where it states {stated}: it is cut short",
            "copy or export it again, or take out that line if it says something else",
        )


def stated_rows(comments: Iterable[str]) -> int | None:
    """Return the number of rows that a comment such as ``Rows: 512`` or ``y-pixels = 512`` states."""
    found = (_ROWS.fullmatch(comment.strip()) for comment in comments)
    return next((int(match[1]) for match in found if match is not None), None)


def unended(text: str) -> tuple[str, ...]:
    """Return a doubt where the last line has no end: its last number may lack digits."""
    last = text.rpartition("\n")[2].strip()
    if not last or last.startswith("#"):
        return ()
    return ("its last line has no end: it may be cut short, and its last number may lack digits",)


def decode(data: bytes) -> str:
    """Return the text with newlines as line ends; the numbers are ASCII in every encoding tried."""
    utf16 = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        text = data.decode("utf-16" if utf16 else "utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")  # older Western exports: only comments are concerned
    if "\0" in text:
        raise ContentError(
            "it is not a text: it holds zero bytes", "rename it to the extension of its format"
        )
    return text.replace("\r\n", "\n").replace("\r", "\n")


def last_digit(number: str) -> float:
    """Return the unit of the last digit of a number that is printed."""
    mantissa, _, exponent = number.casefold().partition("e")
    return float(10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2])))


def _numbers(rows: list[tuple[int, str]]) -> Array:
    separator, decimal_comma = _separator(rows[0][1])
    lines = [line.strip(" ") for _, line in rows]
    # A separator closing every row is a habit of some programs; one closing only some rows leaves holes.
    closed = separator is not None and all(line.endswith(separator) for line in lines)
    table = []
    for index, ((number, _), line) in enumerate(zip(rows, lines, strict=True)):
        fields = line.split() if separator is None else line.split(separator)
        if closed:
            fields.pop()
        if decimal_comma:
            fields = _without_decimal_comma(fields, f"row {index + 1} (line {number})")
        try:
            if "_" in line:  # Python reads 1_000 as a thousand
                raise ValueError
            table.append([float(field) for field in fields])
        except ValueError:
            raise _bad_field(fields, f"row {index + 1} (line {number})") from None
        if len(fields) != len(table[0]):
            raise ContentError(
                f"row {index + 1} (line {number}) holds {len(fields)} numbers, the first row {len(table[0])}",
                _HOLE,
            )
    return np.array(table, dtype=np.float64)


def _separator(line: str) -> tuple[str | None, bool]:
    """Return the separator of a row (None: blanks) and whether a comma is the decimal mark."""
    for mark in (";", "\t"):
        if mark in line.strip(" "):
            return mark, "," in line
    if "," not in line:
        return None, False
    # "1,5 2,5" holds blanks away from its commas; "1, 2" and "1,2" do not.
    blanks = re.search(r"[^,\s]\s+[^,\s]", line.strip()) is not None
    return (None, True) if blanks else (",", False)


def _without_decimal_comma(fields: list[str], where: str) -> list[str]:
    if any("." in field for field in fields):
        raise ContentError(f"{where} holds decimal commas and points", "write decimal points throughout")
    return [field.replace(",", ".") for field in fields]


def _bad_field(fields: list[str], where: str) -> ContentError:
    """Return the error that names the first field which is not a number."""
    for column, field in enumerate(fields, start=1):
        if not field.strip():
            return ContentError(f"{where}, column {column} is empty", _HOLE)
        try:
            if "_" not in field:
                float(field)
                continue
        except ValueError:
            pass
        shown = field.strip() if len(field.strip()) <= 30 else field.strip()[:27] + "..."
        return ContentError(f"{where}, column {column}: {shown!r} is not a number", _PLAIN)
    return ContentError(f"{where} is not a row of numbers", _PLAIN)
