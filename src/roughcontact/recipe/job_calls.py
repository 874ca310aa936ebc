"""A recipe as calls of the library: the same list is executed and printed as Python."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import reduce
from typing import Any

from roughcontact.errors import InputError

__all__ = ["Call", "Name", "perform", "performed", "python_of"]


@dataclass(frozen=True, slots=True)
class Name:
    """A variable of an earlier call, or an attribute of one, as an argument of a later call."""

    name: str

    def value(self, known: Mapping[str, Any]) -> Any:
        """Return its value."""
        return _found(self.name, known)

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class Call:
    """One call.

    Parameters
    ----------
    function : str
        The function, from a module or a variable: ``"rc.read"``, ``"surface.levelled"``; empty where the first
        argument is the result.
    given, named : tuple, dict
        Its arguments by place and by name: plain values, a `Name`, or a call whose result is the argument.
    result : str
        The variable for the result; ``"*_, solution"`` takes the last value that is yielded.
    attribute : str
        An attribute of the result to use in its place.
    place : str
        Part and field of the recipe behind the call, for errors.
    doing : str
        Its name in reports of progress: ``"Levelling"``.
    fields : dict
        The fields of arguments that have another name.
    """

    function: str
    given: tuple[Any, ...] = ()
    named: Mapping[str, Any] = field(default_factory=dict)
    result: str = ""
    attribute: str = ""
    place: str = ""
    doing: str = ""
    fields: Mapping[str, str] = field(default_factory=dict)

    def value(self, known: Mapping[str, Any]) -> Any:
        """Return the result of the function, from the variables `known`."""
        given, named = self.arguments(known)
        found = _found(self.function, known)(*given, **named) if self.function else given[0]
        return getattr(found, self.attribute) if self.attribute else found

    def arguments(self, known: Mapping[str, Any]) -> tuple[list[Any], dict[str, Any]]:
        """Return the values of its arguments, by place and by name, from the variables `known`."""
        given = [_value(each, known) for each in self.given]
        return given, {name: _value(each, known) for name, each in self.named.items()}

    def __str__(self) -> str:
        arguments = [written(each) for each in self.given]
        arguments += [f"{name}={written(each)}" for name, each in self.named.items()]
        called = f"{self.function}({', '.join(arguments)})" if self.function else arguments[0]
        called = f"{called}.{self.attribute}" if self.attribute else called
        return f"{self.result} = {called}" if self.result else called


def perform(call: Call, known: dict[str, Any]) -> None:
    """Make a call and store its result in `known`. An `InputError` gets the place in the recipe."""
    try:
        found = call.value(known)
        if call.result.startswith("*_, "):
            *_, found = found
    except InputError as error:
        error.place = _place(call, error.place)
        raise
    known[call.result.removeprefix("*_, ")] = found


def _place(call: Call, place: str | None) -> str | None:
    """Return the fields of a recipe that an error in a call concerns: its arguments, if these are fields."""
    part, _, field = call.place.partition(".")
    names = [call.fields.get(name, name) for name in place.split(", ")] if place else []
    if field:  # a step: only its arguments by name are fields
        names = [name for name in names if name in call.named]
    return ", ".join(f"{part}.{name}" for name in names) or call.place


def performed(calls: Iterable[Call], known: dict[str, Any]) -> dict[str, Any]:
    """Make calls in order, and return all variables."""
    known = dict(known)
    for call in calls:
        perform(call, known)
    return known


def python_of(calls: Iterable[Call]) -> str:
    """Return the program that makes the calls."""
    lines = [str(call) for call in calls]
    modules = [
        line for name, line in (("np", "import numpy as np"),) if any(f"{name}." in text for text in lines)
    ]
    return "\n".join([*modules, *([""] if modules else []), "import roughcontact as rc", "", *lines]) + "\n"


def written(value: Any) -> str:
    """Return a value as Python source."""
    if isinstance(value, Call | Name):
        return str(value)
    if isinstance(value, slice):
        return f"slice({value.start}, {value.stop})"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, tuple | list):
        inside = ", ".join(map(written, value))
        one = "," if isinstance(value, tuple) and len(value) == 1 else ""
        return f"({inside}{one})" if isinstance(value, tuple) else f"[{inside}]"
    return repr(value)


def _found(path: str, known: Mapping[str, Any]) -> Any:
    first, *names = path.split(".")
    return reduce(getattr, names, known[first])


def _value(argument: Any, known: Mapping[str, Any]) -> Any:
    if isinstance(argument, tuple | list):
        return type(argument)(_value(each, known) for each in argument)
    return argument.value(known) if isinstance(argument, Call | Name) else argument
