"""What people write in a study, in the form that it is kept in."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from roughcontact.study.case import Case
from roughcontact.study.explain import explained
from roughcontact.study.ranges import Range

__all__ = ["case_name", "entry", "plain", "study_name"]


def study_name(name: str) -> str:
    """Return the name of a study, which must do as the name of a folder on every system.

    Raises
    ------
    ValueError
        If it does not.
    """
    if re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", name, re.ASCII) is None:
        raise ValueError(
            f"{name!r} is no name for a study: use letters, digits, '-', '_' and '.', and begin with a letter or digit"
        )
    return name


def case_name(case: Any) -> Any:
    """Return the name of a case; other processes need it to find the case.

    Raises
    ------
    ValueError
        If it is a case itself.
    """
    if isinstance(case, Case):
        raise ValueError(
            f"name the case {case.name!r} by its module, such as 'mycases:CASE', so that other processes can import it"
        )
    return case


def plain(value: Any) -> Any:
    """Return arrays and numbers of NumPy, at any depth, as lists and numbers of Python."""
    if isinstance(value, Mapping):
        return {name: plain(each) for name, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value.tolist() if hasattr(value, "tolist") else value


def entry(value: Any) -> Range | tuple[Any, ...]:
    """Return the values of one parameter of a table.

    Raises
    ------
    ValueError
        If they are neither a list nor a range.
    """
    value = plain(value)
    if isinstance(value, Range):
        return value
    if isinstance(value, Mapping):
        try:
            return Range.model_validate(value)
        except ValidationError as error:
            raise ValueError(explained(error, Range.model_fields)) from None
    if not isinstance(value, list):
        raise ValueError(
            f"{value!r} is neither a list nor a range: a single value is given under parameters, a range as "
            "{ start = 0.1, stop = 0.9, count = 9 }"
        )
    if not value:
        raise ValueError("the list is empty: give one value or more")
    return tuple(value)
