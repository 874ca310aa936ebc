"""Names of a package, and methods of a class, that are imported on first access.

The names of a package stand in the block ``if TYPE_CHECKING or LATE is None`` of its ``__init__.py``. Type checkers and
bundlers of programs read that block as it is; at run time its source text gives the module of each name. A bundle
contains no source text: there the block is run, and all names are imported at once.
"""

from __future__ import annotations

import ast
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib import import_module
from importlib.machinery import ModuleSpec
from typing import Any, ParamSpec, TypeVar

from roughcontact.guesses import did_you_mean
from roughcontact.threads import no_fork

__all__ = ["LateMethod", "late_names", "open_name", "static"]

P = ParamSpec("P")
R = TypeVar("R")


def late_names(spec: ModuleSpec) -> dict[str, str] | None:
    """Return the modules of the names that a package imports late; None if there is no source text.

    Parameters
    ----------
    spec : ModuleSpec
        The ``__spec__`` of the package.
    """
    source = getattr(spec.loader, "get_source", lambda name: None)(spec.name)
    if source is None:
        return None
    conditions = (node for node in ast.parse(source).body if isinstance(node, ast.If))
    block = next(node for node in conditions if "TYPE_CHECKING" in ast.unparse(node.test))
    return {
        alias.name: node.module or ""
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


def open_name(package: dict[str, Any], names: dict[str, str] | None, name: str) -> Any:
    """Import a name, and keep it in the package's globals.

    Raises
    ------
    AttributeError
        If the package has no such name.
    """
    home = package["__name__"]
    if names is None or name not in names:
        if name.startswith("__"):  # tools ask every module for these, thousands of times
            raise AttributeError(f"module {home!r} has no attribute {name!r}", name=name)
        known = package["__all__"]
        hint = did_you_mean(home, name, known) or f"; it has {', '.join(known)}"
        raise AttributeError(f"module {home!r} has no attribute {name!r}{hint}", name=name)
    with no_fork:  # a process forked during an import could never import the same module
        members = vars(import_module(names[name]))
        package[name] = members[name] if name in members else import_module(f"{names[name]}.{name}")
    return package[name]


@dataclass(frozen=True, slots=True)
class LateMethod:
    """A function of another module as a method of a class; its module is imported when the method is looked up.

    This gives a class methods from modules that import the class. The lookup returns the function itself, with its
    signature and docstring, bound to the object if there is one.

    Parameters
    ----------
    module, name : str
        The module of the function, and its name there.
    is_static : bool
        Whether the function is not bound to an object.
    """

    module: str
    name: str
    is_static: bool = False

    def __get__(self, value: Any, owner: type | None = None) -> Any:
        function = self.function
        return function if self.is_static else function.__get__(value, owner)

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Call the function."""
        return self.function(*args, **kwargs)

    @property
    def function(self) -> Any:
        """The function itself."""
        with no_fork:
            return getattr(import_module(self.module), self.name)


def static(method: Callable[P, R]) -> staticmethod[P, R]:
    """Return a late method as a static method."""
    return replace(method, is_static=True)  # type: ignore[type-var, return-value]
