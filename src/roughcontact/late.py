"""Names that a package imports when they are first asked for.

They stand once, in the block ``if TYPE_CHECKING or LATE is None`` of the package's ``__init__.py``. Type checkers and
bundlers of programs read that block as it is; at run time its text tells where each name comes from. A bundle holds no
text: there the block itself is run, and all is imported at once.
"""

from __future__ import annotations

import ast
from importlib import import_module
from importlib.machinery import ModuleSpec
from typing import Any

from roughcontact.threads import no_fork

__all__ = ["late_names", "open_name"]


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
    block = next(node for node in ast.parse(source).body if isinstance(node, ast.If))
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
        raise AttributeError(
            f"module {home!r} has no attribute {name!r}; it has {', '.join(package['__all__'])}"
        )
    with no_fork:  # a process forked in the middle of an import could never import the same
        members = vars(import_module(names[name]))
        package[name] = members[name] if name in members else import_module(f"{names[name]}.{name}")
    return package[name]
