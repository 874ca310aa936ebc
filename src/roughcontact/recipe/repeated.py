"""Comparison of the records of a job that was repeated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from roughcontact.validation import Array

__all__ = ["Difference", "differences"]

# Entries of a record that are not results: names, history, versions, and words.
_WORDS = {
    "command",
    "doubtful",
    "errors",
    "file",
    "material",
    "notes",
    "provenance",
    "recipe",
    "surface",
    "units",
}


@dataclass(frozen=True, slots=True)
class Difference:
    """A quantity that differs.

    Parameters
    ----------
    name : str
        Its name, after the names of the tables that contain it.
    before, after : Any
        The value in each record: a number, a list or a word.
    """

    name: str
    before: Any
    after: Any

    def __str__(self) -> str:
        old, new = _numbers(self.before), _numbers(self.after)
        if old is None or new is None:
            return f"{self.name}: {self.before} before, {self.after} now"
        if old.shape != new.shape:
            return f"{self.name}: {old.size} numbers before, {new.size} now"
        there = np.isfinite(old) & np.isfinite(new)
        change, scale = np.abs(new - old)[there], float(np.max(np.abs(old[there]), initial=0.0))
        most = float(np.max(change, initial=0.0))
        words = f"{most / scale:.2g} of the largest" if scale > 0 else f"{most:.2g}"
        return f"{self.name}: {_count(old, new)} of {old.size} differ, by at most {words}"


def differences(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[Difference]:
    """Return the quantities of a record that a repeated job lost or changed, to the last digit.

    Quantities that only the second record holds are not differences: the page writes fewer than the command.

    Parameters
    ----------
    before, after : mapping
        Records as ``to_record`` of an answer returns them, or as they were read from JSON.

    Returns
    -------
    list of Difference
        Empty if all numbers are the same.

    Examples
    --------
    >>> from roughcontact.recipe.repeated import differences
    >>> [str(each) for each in differences({"force": [1.0, 2.0]}, {"force": [1.0, 2.5]})]
    ['force: 1 of 2 differ, by at most 0.25 of the largest']
    """
    return list(_differences(before, after, ""))


def _differences(before: Mapping[str, Any], after: Mapping[str, Any], path: str) -> Iterator[Difference]:
    for name in sorted(before.keys() - (set() if path else _WORDS)):
        old, new = before.get(name), after.get(name)
        old, new = _by_number(old), _by_number(new)
        if isinstance(old, Mapping) and isinstance(new, Mapping):
            yield from _differences(old, new, f"{path}{name}.")
        elif not _same(old, new):
            yield Difference(f"{path}{name}", old, new)


def _by_number(value: Any) -> Any:
    """Return a list of tables as a table by index; other values unchanged."""
    if isinstance(value, list) and value and all(isinstance(each, Mapping) for each in value):
        return {str(number): each for number, each in enumerate(value)}
    return value


def _same(old: Any, new: Any) -> bool:
    first, second = _numbers(old), _numbers(new)
    if first is None and second is None:
        return bool(old == new)
    if first is None or second is None:
        return False
    return first.shape == second.shape and not _count(first, second)


def _count(first: Array, second: Array) -> int:
    """Return how many numbers differ, to the last digit; NaN in both counts as equal."""
    return int(np.count_nonzero((first != second) & ~(np.isnan(first) & np.isnan(second))))


def _numbers(value: Any) -> Array | None:
    """Return numbers as an array of one axis or more; None for words, truth values, or an empty list."""
    try:
        found = np.atleast_1d(np.asarray(value))
    except ValueError:  # lists of several lengths
        return None
    return found.astype(np.float64) if found.dtype.kind in "iuf" else None
