"""Commands that other packages add: entry points of the group ``roughcontact.commands``."""

from __future__ import annotations

import sys

__all__ = ["added_commands", "how_to_add"]

_GROUP = "roughcontact.commands"
_OURS = {"thesis": ("roughcontact-thesis", "./reproduction")}  # on an index, and in a checkout


def added_commands() -> dict[str, str]:
    """Return the modules of the commands that installed packages add, by the names of the commands."""
    from importlib.metadata import entry_points  # late: it looks at every package that is installed

    return {point.name: point.module for point in entry_points(group=_GROUP)}


def how_to_add(command: str) -> str | None:
    """Return the line that installs the package of ours that has a command; None if there is none."""
    if command not in _OURS:
        return None
    package, folder = _OURS[command]
    install = f"{sys.executable} -m pip install"
    return (
        f"the package {package}, which adds the command {command!r}, is not installed; run: {install} {package}; in a "
        f"checkout: {install} {folder}"
    )
