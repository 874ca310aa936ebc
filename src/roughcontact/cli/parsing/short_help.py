"""The short help of a command, on one screen; ``--help-all`` prints the full help."""

from __future__ import annotations

import re
from collections.abc import Collection
from textwrap import fill
from typing import Any

__all__ = ["write_short_help"]

_IN_BRACKETS = re.compile(r" \([^()]*\)")
_LONG = 60  # letters: longer sentences are cut at their colon


def write_short_help(command: Any, context: Any, formatter: Any, more: Collection[str]) -> None:
    """Write the usage of a command, its everyday options under their headings, and the names of the other options.

    Parameters
    ----------
    command, context, formatter
        As click has them.
    more : collection of str
        The parameters of which only the names are listed.
    """
    summary, lines = command.help.partition("\n\n")[0], command.epilog.split("\n\n")
    formatter.write_usage(context.command_path, " ".join(command.collect_usage_pieces(context)))
    formatter.write_text(summary)
    headings: dict[str, list[tuple[str, str]]] = {}
    others = []
    for each in command.params:
        if each.name in more:
            others.append(max(each.opts, key=len))
        elif each.name != "help_all":
            heading = getattr(each, "rich_help_panel", None) or "Arguments"
            headings.setdefault(heading, []).append((_words(each), _first_sentence(each.help)))
    for heading, rows in headings.items():
        formatter.write(f"{heading}:\n")
        formatter.indent()
        formatter.write_dl(rows, col_max=28)
        formatter.dedent()
    for text in (f"Also (--help-all explains them): {', '.join(others)}", f"Example: {lines[1]}"):
        formatter.write(f"{fill(text, formatter.width, break_on_hyphens=False)}\n")


def _words(each: Any) -> str:
    """Return an option as it is typed."""
    if each.param_type_name == "argument":
        return str(each.metavar)
    names = "/".join([each.opts[0], *each.secondary_opts])
    return names if each.is_flag else f"{names} {each.metavar}"


def _first_sentence(text: str) -> str:
    """Return the first sentence without brackets; a long one only up to its colon."""
    sentence = re.split(r"(?<!\.)\.(?= |$)|; ", _IN_BRACKETS.sub("", text), maxsplit=1)[0]
    shown = sentence if len(sentence) <= _LONG else sentence.partition(": ")[0]
    return shown if shown.endswith(".") else f"{shown}."
