"""Places in the first row and column of a table, which are not heights: numbers of columns and rows, or axes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.files.file_errors import ContentError
from roughcontact.validation import Array

__all__ = ["Axes", "axes_of", "counts", "even_step"]

# Measured heights do not lie on a line: a row that does, beside one that does not, holds places. Largest deviation
# of places from a line, in steps, for both sides, which may have few digits; smallest deviation of the row beside:
_EVEN, _ROUNDED, _UNEVEN = 0.1, 0.25, 0.5
_EXACT = 0.01  # and at most a few places
# Numbers needed beside a corner without a number, on both sides, and on only one; and if they count 0, 1, 2, ...
_NAMED, _BOTH, _ALONE, _COUNTED = 3, 5, 8, 4
_RISING = 12  # sorted numbers along both sides that count as places, even or not
_TELLING = 3  # heights needed in a row to show a deviation from a line
_KEEP = "to keep them as heights, save the table as .npz under the key 'heights'"


@dataclass(frozen=True, slots=True, eq=False)
class Axes:
    """The heights of a table without its first row, or its first column, or both.

    Parameters
    ----------
    heights : array, shape (ny, nx)
        The remaining heights.
    x, y : array, optional
        Numbers of the first row and of the first column.
    """

    heights: Array
    x: Array | None
    y: Array | None

    @property
    def warning(self) -> str:
        """Message about what was left out, and how to keep it."""
        rows = (("row", self.x), ("column", self.y))
        parts = [f"its first {name} ({_shown(places)})" for name, places in rows if places is not None]
        verb = "holds places" if len(parts) == 1 else "hold places"
        return f"{' and '.join(parts)} {verb}, not heights, and {'is' if len(parts) == 1 else 'are'} left out; {_KEEP}"

    def steps(self) -> tuple[float, float] | None:
        """Return the steps (dy, dx) of two axes; None if one is missing or only numbers the points."""
        if self.x is None or self.y is None or counts(self.x) or counts(self.y):
            return None
        return abs(even_step(self.y)), abs(even_step(self.x))


def axes_of(values: Array) -> Axes | None:
    """Return a table (rows, columns) without places in its first row and column; None if it holds only heights.

    Places are even; the row or column beside them is not, unless the table is a slope.

    Raises
    ------
    ContentError
        If both the first row and the first column are monotonic like uneven places.
    """
    if values.ndim != 2 or min(values.shape) < 3:
        return None
    body, x, y = values[1:, 1:], values[0, 1:], values[1:, 0]
    fewest = _NAMED if np.isnan(values[0, 0]) else _BOTH  # a corner without a number, as in data frames
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
            "its first row and its first column are sorted and uneven, like places, and unlike the heights beside them",
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
    """Whether rows beside places are not a slope, or hold fractions beside places that count."""
    with np.errstate(all="ignore"):  # infinite numbers
        fractions = counts(places) and bool((rows % 1 > 0).any())
    return fractions or _is_uneven(rows)


def _is_uneven(rows: Array) -> bool:
    """Whether the first row with enough heights is not a slope."""
    for row in rows:
        if np.count_nonzero(np.isfinite(row)) >= _TELLING:
            return _off(row[np.isfinite(row)], np.flatnonzero(np.isfinite(row))) > _UNEVEN
    return False


def _is_sorted(places: Array) -> bool:
    with np.errstate(all="ignore"):  # as below
        steps = np.diff(places)
    return bool((steps > 0).all() or (steps < 0).all())  # a missing number is neither


def _off(places: Array, at: npt.NDArray[np.intp] | None = None) -> float:
    """Return the deviation of places from a line through their ends, in steps; infinite without a step."""
    at = np.arange(len(places)) if at is None else at
    with np.errstate(all="ignore"):  # numbers of a damaged file
        step = (places[-1] - places[0]) / (at[-1] - at[0])
        off = float(np.abs(places - places[0] - step * (at - at[0])).max() / abs(step))
    return off if np.isfinite(off) else np.inf


def _shown(places: Array) -> str:
    first = ", ".join(f"{place:g}" for place in places[:3])
    return f"{first}, ..., {places[-1]:g}" if len(places) > 3 else first
