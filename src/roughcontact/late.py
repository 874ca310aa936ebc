"""Names that a package, or a class as its methods, imports when they are first asked for.

They stand once, in the block ``if TYPE_CHECKING or LATE is None`` of the package's ``__init__.py``. Type checkers and
bundlers of programs read that block as it is; at run time its text tells where each name comes from. A bundle holds no
text: there the block itself is run, and all is imported at once.
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
    """Return the modules of the names that a package imports late; None where there is no text to read.

    Parameters
    ----------
    spec : ModuleSpec
        Of the package: its ``__spec__``.
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
        known = package["__all__"]
        hint = did_you_mean(home, name, known) or f"; it has {', '.join(known)}"
        raise AttributeError(f"module {home!r} has no attribute {name!r}{hint}", name=name)
    with no_fork:  # a process forked in the middle of an import could never import the same
        members = vars(import_module(names[name]))
        package[name] = members[name] if name in members else import_module(f"{names[name]}.{name}")
    return package[name]


@dataclass(frozen=True, slots=True)
class LateMethod:
    """A function of another module that is a method of a class; the module is imported when the method is looked up.

    A class then has what is below or above it as its method, and imports neither. What is looked up is the function
    itself, with its signature and docstring, bound to the object where there is one.

    Parameters
    ----------
    module, name : str
        Where the function is, and what it is called there.
    is_static : bool
        Whether it is bound to no object.
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
    """Return a late method as one that is bound to no object."""
    return replace(method, is_static=True)  # type: ignore[type-var, return-value]
