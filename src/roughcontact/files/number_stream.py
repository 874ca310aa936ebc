"""A known number of heights in a text, on lines of any length."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from roughcontact.files.fields import put_points
from roughcontact.files.file_errors import ContentError
from roughcontact.files.numbers import Marks
from roughcontact.validation import Array

__all__ = ["grid_of"]


def grid_of(fields: Sequence[str], shape: tuple[int, int]) -> tuple[Array, tuple[str, ...], tuple[str, ...]]:
    """Return the heights (rows, columns) in the fields of a text, notes and warnings about the marks among them.

    Raises
    ------
    ContentError
        If a field is not a number, or their number differs from that of `shape`.
    """
    expected = shape[0] * shape[1]
    if len(fields) != expected:
        cut = ": it is cut short" if len(fields) < expected else ""
        raise ContentError(
            f"it holds {len(fields)} numbers and states {shape[0]} rows of {shape[1]}{cut}",
            "copy or export it again, or correct the numbers of rows and columns",
        )
    marks = Marks()
    row = list(fields)
    put_points([row], ["among its heights"])
    try:
        values = marks.numbers(row)
    except ValueError as error:
        raise ContentError(
            f"{error.args[0]!r} is not a number", "write nan where a point was not measured"
        ) from None
    return np.array(values).reshape(shape), *marks.notes_and_warnings()
