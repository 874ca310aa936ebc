"""Whether a job that was done again gave the same numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

__all__ = ["Difference", "differences"]

# What a record says of itself: names, history, versions, and words.
_WORDS = {"command", "errors", "file", "notes", "provenance", "recipe", "surface", "units"}


@dataclass(frozen=True, slots=True)
class Difference:
    """A quantity that is not the same.

    Parameters
    ----------
    name : str
        Its name, with those of the tables that it stands in before it.
    before, after : Any
        A number, a list or a word of each record.
    """

    name: str
    before: Any
    after: Any

    def __str__(self) -> str:
        try:
            old, new = (
                np.atleast_1d(np.asarray(each, dtype=np.float64)) for each in (self.before, self.after)
            )
        except (TypeError, ValueError):
            return f"{self.name}: {self.before} before, {self.after} now"
        if old.shape != new.shape:
            return f"{self.name}: {old.size} numbers before, {new.size} now"
        change = np.abs(new - old)
        scale = float(np.max(np.abs(old), initial=0.0))
        most = (
            f"{float(change.max()) / scale:.2g} of the largest" if scale > 0 else f"{float(change.max()):.2g}"
        )
        return f"{self.name}: {int(np.count_nonzero(change))} of {change.size} differ, by at most {most}"


def differences(before: Mapping[str, Any], after: Mapping[str, Any]) -> list[Difference]:
    """Return what two records of the same job do not have in common, to the last digit.

    Parameters
    ----------
    before, after : mapping
        Records as ``to_record`` of an answer returns them, or as they were read from JSON.

    Returns
    -------
    list of Difference
        Empty where all numbers are the same.

    Examples
    --------
    >>> from roughcontact.recipe.repeated import differences
    >>> [str(each) for each in differences({"force": [1.0, 2.0]}, {"force": [1.0, 2.5]})]
    ['force: 1 of 2 differ, by at most 0.25 of the largest']
    """
    return list(_differences(before, after, ""))


def _differences(before: Mapping[str, Any], after: Mapping[str, Any], path: str) -> Iterator[Difference]:
    for name in sorted((before.keys() | after.keys()) - (set() if path else _WORDS)):
        old, new = before.get(name), after.get(name)
        if isinstance(old, Mapping) and isinstance(new, Mapping):
            yield from _differences(old, new, f"{path}{name}.")
        elif _plain(old) != _plain(new):
            yield Difference(f"{path}{name}", old, new)


def _plain(value: Any) -> Any:
    return [_plain(each) for each in value] if isinstance(value, list | tuple) else value
