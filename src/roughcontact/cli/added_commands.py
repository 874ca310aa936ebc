"""Commands that other packages add: entry points of the group ``roughcontact.commands``."""

from __future__ import annotations

import sys

__all__ = ["PACKAGES", "added_commands", "refuse_missing"]

_GROUP = "roughcontact.commands"
PACKAGES = {"thesis": ("roughcontact-thesis", "./reproduction")}
"""For each command of ours in a separate package: the name of the package and its folder in a checkout."""


def added_commands() -> dict[str, str]:
    """Return the modules of the commands that installed packages add, by the names of the commands."""
    from importlib.metadata import entry_points  # late: it reads the metadata of every installed package

    return {point.name: point.module for point in entry_points(group=_GROUP)}


def refuse_missing(command: str) -> None:
    """Raise an error for a command of ours whose package is not installed; the remedy installs it."""
    if command not in PACKAGES:
        return
    from roughcontact.cli.messages import UsageError, reported

    package, folder = PACKAGES[command]
    install = f"{sys.executable} -m pip install"
    with reported(as_json="--json" in sys.argv[1:]):
        raise UsageError(
            f"the package {package}, which adds the command {command!r}, is not installed",
            f"run: {install} {package}, or in a checkout: {install} {folder}",
        )
