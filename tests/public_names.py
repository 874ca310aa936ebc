"""List every public function, class, method and property, with what its docstring lacks.

python tests/public_names.py              all names, by room
python tests/public_names.py --lacking    those whose docstring lacks something, and what

Public is what is reached without a leading underscore from `roughcontact.__all__`, from the modules that it names, and
from the modules of these; of a class its methods and properties.

Every function and class has an example of its own. A method has one, or the example of its class calls it; properties
need none.
"""

import ast
import doctest
import inspect
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from types import ModuleType
from typing import Any

from numpydoc.docscrape import NumpyDocString, get_doc_object
from numpydoc.validate import Validator, validate

import roughcontact
from roughcontact.cached import cached_property
from roughcontact.late import LateMethod

# Of numpydoc's checks those of content: there is a docstring (GL08); it names the parameters of the signature, no
# other, in their order, with a type (PR01, PR02, PR03, PR04); it says what is returned or yielded (RT01, YD01).
# Layout is ruff's affair (GL, SS). A description of every parameter (PR07) would repeat types that say all, as in
# "surface : Surface".
CODES = {"GL08", "PR01", "PR02", "PR03", "PR04", "RT01", "YD01"}


@dataclass(frozen=True)
class PublicName:
    """A public object and the shortest path to it."""

    path: str
    value: Any

    @property
    def room(self) -> str:
        """Part of the package in which it is defined."""
        return inspect.unwrap(_function(self.value)).__module__.split(".")[1]

    def lacking(self) -> list[str]:
        """Return what its docstring lacks."""
        if isinstance(self.value, property | cached_property):
            return [] if self.value.__doc__ else ["GL08 a docstring"]
        lacks = _of_class(self.value) if inspect.isclass(self.value) else _of_function(self.value)
        if not _example(self.value) and not self._is_shown_by_its_class():
            lacks.append("EX01 an example")
        return lacks

    def _is_shown_by_its_class(self) -> bool:
        """Return whether it is a method that its class's example calls, or one of a protocol, which has no body."""
        function = inspect.unwrap(self.value)
        owner = getattr(sys.modules[function.__module__], function.__qualname__.partition(".")[0])
        if not inspect.isclass(owner) or inspect.isclass(self.value):
            return False
        shown = ast.Module(_example(owner), [])
        used = {node.attr for node in ast.walk(shown) if isinstance(node, ast.Attribute)}
        return function.__name__ in used or bool(getattr(owner, "_is_protocol", False) and shown.body)


def public_names(package: ModuleType = roughcontact) -> list[PublicName]:
    """Return all public objects of a package, each once."""
    found: dict[int, PublicName] = {}
    for path, value in sorted(_reached(package.__name__, package), key=lambda pair: pair[0].count(".")):
        found.setdefault(id(value), PublicName(path, value))
    return list(found.values())


def _function(value: Any) -> Any:
    """Return the function behind a property; anything else as it is."""
    if isinstance(value, cached_property):
        return value._function
    return value.fget if isinstance(value, property) else value


def _reached(path: str, module: ModuleType) -> Iterator[tuple[str, Any]]:
    """Yield the path and the value of what `module` names in ``__all__``, and of what is reached from there."""
    for name in module.__all__:
        value, here = getattr(module, name), f"{path}.{name}"
        if isinstance(value, ModuleType):
            yield from _reached(here, value)
        elif inspect.isfunction(value) or inspect.isclass(value):
            yield here, value
            for member, what in vars(value).items() if inspect.isclass(value) else ():
                if isinstance(what, staticmethod | classmethod | LateMethod):
                    what = what.__get__(None, value)
                if not member.startswith("_") and (
                    inspect.isfunction(what) or isinstance(what, property | cached_property)
                ):
                    yield f"{here}.{member}", what


def _example(value: Any) -> list[ast.stmt]:
    """Return the statements of the example of a class or function."""
    shown = doctest.DocTestParser().get_examples(inspect.getdoc(value) or "")
    return ast.parse("".join(each.source for each in shown)).body


def _parsed(value: Any) -> NumpyDocString:
    return NumpyDocString(inspect.getdoc(value) or "")


def _of_function(function: Any) -> list[str]:
    report = validate("", validator_cls=lambda obj_name: Validator(get_doc_object(function)))
    # What returns an iterator of its own making may say what that yields.
    fulfilled = {"RT01"} if _parsed(function)["Yields"] else set()
    return [f"{code} {text}" for code, text in report["errors"] if code in CODES - fulfilled]


def _never_called(cls: type) -> bool:
    """Return whether users do not call the class: an exception, a choice, or a protocol."""
    return issubclass(cls, BaseException | Enum) or getattr(cls, "_is_protocol", False)


def _of_class(cls: type) -> list[str]:
    """Return what is lacking: a class that users call has Parameters, one that is only returned Attributes."""
    doc = _parsed(cls)
    if not doc["Summary"]:
        return ["GL08 a docstring"]
    if _never_called(cls):
        return []
    described = {part: _entries(doc, part) for part in ("Parameters", "Attributes")}
    wanted = {name for name in inspect.signature(cls).parameters if not name.startswith("_")}
    missing = wanted - described["Parameters"] - described["Attributes"]
    unknown = described["Parameters"] - wanted
    return [f"PR01 {sorted(missing)}"] * bool(missing) + [f"PR02 {sorted(unknown)}"] * bool(unknown)


def _entries(doc: NumpyDocString, section: str) -> set[str]:
    return {name.strip().lstrip("*") for entry in doc[section] for name in entry.name.split(",")}


if __name__ == "__main__":
    for name in sorted(public_names(), key=lambda name: (name.room, name.path)):
        lacks = name.lacking()
        if lacks or "--lacking" not in sys.argv:
            print(name.room, name.path, *(f"\n    {lack}" for lack in lacks))  # noqa: T201
