"""Values in nested tables, and their dotted names such as ``"preparation.level"``."""

from __future__ import annotations

from collections.abc import Mapping
from functools import reduce
from typing import Any

from roughcontact.study.ranges import Range

__all__ = ["at", "flat", "merged"]


def at(values: Any, name: str) -> Any:
    """Return the value of a dotted name in nested tables; None if the name is missing."""
    return reduce(
        lambda table, key: table.get(key) if isinstance(table, Mapping) else None, name.split("."), values
    )


def flat(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return values in nested tables by dotted names; ranges are values."""
    found: dict[str, Any] = {}
    for name, value in values.items():
        if isinstance(value, Mapping) and value and not value.keys() & Range.model_fields.keys():
            found |= {f"{name}.{inner}": each for inner, each in flat(value).items()}
        else:
            found[name] = value
    return found


def merged(*tables: Mapping[str, Any]) -> dict[str, Any]:
    """Return merged tables, later values replacing earlier ones; a dotted name is a value in a nested table."""
    whole: dict[str, Any] = {}
    for table in tables:
        for name, value in table.items():
            first, _, rest = name.partition(".")
            value = {rest: value} if rest else value
            if isinstance(value, Mapping):
                before = whole.get(first, {})
                value = merged(before if isinstance(before, Mapping) else {}, value)
            whole[first] = value
    return whole
