"""What a model refuses, in plain words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pydantic import ValidationError

__all__ = ["explained", "meant"]


def meant(name: str, known: Iterable[str]) -> str:
    """Return what a misspelt `name` may have meant, and all that is known."""
    known = sorted(known)
    near = get_close_matches(name, known, n=1)
    return (f"did you mean {near[0]!r}? " if near else "") + f"It may be {', '.join(known)}"


def explained(error: ValidationError, known: Iterable[str] = ()) -> str:
    """Return what is wrong with the values of a model, which has fields of the `known` names."""
    return "; ".join(_line(each, known) for each in error.errors(include_url=False))


def _line(found: Mapping[str, Any], known: Iterable[str]) -> str:
    place = ".".join(str(part) for part in found["loc"])
    if found["type"] == "extra_forbidden":
        return f"there is no {place!r}: {meant(place, known)}"
    if found["type"] == "missing":
        return f"{place!r} is missing"
    if found["type"] in ("value_error", "assertion_error"):  # of a validator, with words of its own
        words = str(found["ctx"]["error"])
    else:
        words = f"{found['input']!r} {found['msg'].removeprefix('Input ').removeprefix('Value ')}"
    return f"{place}: {words}" if place else words
