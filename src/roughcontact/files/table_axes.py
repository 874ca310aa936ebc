"""Places in the first row and column of a table, which are no heights: numbers of columns and rows, or axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_errors import ContentError
from roughcontact.validation import Array

__all__ = ["Axes", "axes_of", "counts", "even_step"]

# Measured heights do not lie on a line: a row that does, beside one that does not, holds places. By how many steps
# places are off a line at most, those of both sides, which may be printed short, and the row beside them at least:
_EVEN, _ROUNDED, _UNEVEN = 0.1, 0.25, 0.5
_EXACT = 0.01  # and a few places at most
# Numbers that are enough beside a corner without one, of both sides, and of one alone; and if they count 0, 1, 2, ...
_NAMED, _BOTH, _ALONE, _COUNTED = 3, 5, 8, 4
_RISING = 12  # sorted numbers along both sides that are places, even or not
_TELLING = 3  # heights in a row that can be off a line
_KEEP = "to keep them as heights, save the table as .npz under the key 'heights'"


@dataclass(frozen=True, slots=True, eq=False)
class Axes:
    """The heights of a table without its first row, or its first column, or both.

    Parameters
    ----------
    heights : array, shape (ny, nx)
        What is left.
    x, y : array, optional
        What stood in the first row and in the first column.
    """

    heights: Array
    x: Array | None
    y: Array | None

    @property
    def warning(self) -> str:
        """What was left out, and how to keep it."""
        rows = (("row", self.x), ("column", self.y))
        parts = [f"its first {name} ({_shown(places)})" for name, places in rows if places is not None]
        verb = "holds places" if len(parts) == 1 else "hold places"
        return f"{' and '.join(parts)} {verb}, no heights, and {'is' if len(parts) == 1 else 'are'} left out; {_KEEP}"

    def steps(self) -> tuple[float, float] | None:
        """Return the steps (dy, dx) of two axes; None where one is missing or only numbers the points."""
        if self.x is None or self.y is None or counts(self.x) or counts(self.y):
            return None
        return abs(even_step(self.y)), abs(even_step(self.x))


def axes_of(values: Array) -> Axes | None:
    """Return a table (rows, columns) without places in its first row and column; None where it holds heights only.

    Places are even; the row or column beside them is not, or the table is a slope.

    Raises
    ------
    ContentError
        If both a row and a column rise or fall all along as only uneven places do.
    """
    if values.ndim != 2 or min(values.shape) < 3:
        return None
    body, x, y = values[1:, 1:], values[0, 1:], values[1:, 0]
    fewest = _NAMED if np.isnan(values[0, 0]) else _BOTH  # a corner without a number, as data frames have
    both = _are_places(x, fewest, _ROUNDED) and _are_places(y, fewest, _ROUNDED)
    if both and (_is_uneven(body) or _is_uneven(body.T)):
        return Axes(body, x, y)
    if _are_places(values[0], _ALONE) and _are_heights(values[1:], values[0]):
        return Axes(values[1:], values[0], None)
    if _are_places(values[:, 0], _ALONE) and _are_heights(values.T[1:], values[:, 0]):
        return Axes(values[:, 1:], None, values[:, 0])
    if (
        not both
        and min(x.size, y.size) >= _RISING
        and _is_sorted(x)
        and _is_sorted(y)
        and not (_is_sorted(body[0]) or _is_sorted(body[:, 0]))
    ):
        raise ContentError(
            "its first row and its first column are sorted and uneven, as places are and heights beside them are not",
            f"interpolate to even steps first, or, {_KEEP}",
        )
    return None


def counts(places: Array) -> bool:
    """Whether places are 0, 1, 2, ... or 1, 2, 3, ..., as points are numbered."""
    return len(places) > 1 and any(np.array_equal(places, np.arange(len(places)) + first) for first in (0, 1))


def even_step(places: Array) -> float:
    """Return the mean step of places."""
    return float((places[-1] - places[0]) / (len(places) - 1))


def _are_places(places: Array, fewest: int, most: float = _EVEN) -> bool:
    enough = min(fewest, _COUNTED) if counts(places) else fewest
    return len(places) >= enough and _off(places) <= (most if len(places) >= _BOTH else _EXACT)


def _are_heights(rows: Array, places: Array) -> bool:
    """Whether rows beside places are no slope, or hold fractions beside places that count."""
    with np.errstate(all="ignore"):  # of infinite ones
        fractions = counts(places) and bool((rows % 1 > 0).any())
    return fractions or _is_uneven(rows)


def _is_uneven(rows: Array) -> bool:
    """Whether the first row with enough heights to tell is no slope."""
    for row in rows:
        if np.count_nonzero(np.isfinite(row)) >= _TELLING:
            return _off(row[np.isfinite(row)], np.flatnonzero(np.isfinite(row))) > _UNEVEN
    return False


def _is_sorted(places: Array) -> bool:
    with np.errstate(all="ignore"):  # as below
        steps = np.diff(places)
    return bool((steps > 0).all() or (steps < 0).all())  # a missing one is neither


def _off(places: Array, at: npt.NDArray[np.intp] | None = None) -> float:
    """Return how far places lie off a line through their ends, in steps; infinite where none is or has a step."""
    at = np.arange(len(places)) if at is None else at
    with np.errstate(all="ignore"):  # of what a damaged file holds
        step = (places[-1] - places[0]) / (at[-1] - at[0])
        off = float(np.abs(places - places[0] - step * (at - at[0])).max() / abs(step))
    return off if np.isfinite(off) else np.inf


def _shown(places: Array) -> str:
    first = ", ".join(f"{place:g}" for place in places[:3])
    return f"{first}, ..., {places[-1]:g}" if len(places) > 3 else first
