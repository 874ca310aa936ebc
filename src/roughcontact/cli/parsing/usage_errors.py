"""Errors of the command line's parser in the form of ours: problem, place and remedy."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import typer
from typer.core import TyperGroup

from roughcontact.cli.messages import UsageError
from roughcontact.errors import InputError
from roughcontact.recipe.jobs import JOBS
from roughcontact.recipe.texts import choose

__all__ = ["in_our_words", "no_such_command"]


@contextmanager
def in_our_words(context: Any = None) -> Iterator[None]:
    """Turn errors of the parser into `UsageError`; a group without a command has printed its help.

    The `context` of click is used if the error has none.
    """
    try:
        yield
    except InputError as refused:  # by the function that reads the text of an option
        raise UsageError(refused.message, refused.remedy, refused.place) from refused
    except Exception as raised:
        error: Any = raised  # versions of typer differ in the module of the class
        if type(error).__name__ == "NoArgsIsHelpError":  # the help is printed
            raise typer.Exit(error.exit_code) from None
        if not hasattr(error, "format_message"):
            raise
        raise _stated(error, error.ctx or context) from error


def no_such_command(context: Any, name: str, known: Iterable[str]) -> UsageError:
    """Return the error about a command that does not exist."""
    return UsageError(f"{context.command_path!r} has no command {name!r}", choose(name, tuple(known)))


def _stated(error: Any, context: Any) -> UsageError:
    name: Any = getattr(error, "option_name", None)
    if hasattr(error, "possibilities"):
        job = JOBS.get(context.info_name)
        if (apart := getattr(job, "APART", {}).get(name.removeprefix("--"))) is not None:
            return UsageError(f"{apart} together with viscoelasticity is not modelled", "leave it out", name)
        return UsageError("this command has no such option", _instead(context, name), name)
    if name is not None:
        named = next((each for each in context.command.params if name in each.opts), None)
        if named is None or named.is_flag:
            return UsageError("this option takes no value", f"write only {name}", name)
        return UsageError("the value is missing", f"write {name} {named.metavar}", name)
    named = getattr(error, "param", None)
    if named is not None and type(error).__name__ == "MissingParameter":
        option = named.opts[0]
        if named.param_type_name == "option":
            return UsageError(f"{option} is required", f"add it, such as {option} {named.metavar}", option)
        return UsageError(f"{named.metavar} is missing", _as_in_example(context), named.metavar)
    if (extra := re.search(r"unexpected extra argument\S* \((.*)\)", error.message)) is not None:
        words = f"unexpected argument {extra[1]!r}"
        return UsageError(words, "put quotes around a value that holds a space, such as '10 N'")
    return UsageError(error.message, place=None if named is None else named.opts[0])


def _instead(context: Any, option: str) -> str:
    """Return what to write instead of an option that a command does not have."""
    if option in _VERBOSITY and isinstance(context.command, TyperGroup):
        return f"write it after the name of a command: {context.command_path} COMMAND {option}"
    arguments = [each.opts[0] for each in context.command.params if each.param_type_name == "argument"]
    if option.removeprefix("--") in arguments:
        return f"write only its value, without {option}"
    if found := _elsewhere(context, option):
        return f"use {' or '.join(found)}"
    known = [name for each in context.command.params for name in (*each.opts, *each.secondary_opts)]
    if meant := [name for name in _GUESSED.get(option, ()) if name in known]:
        return f"use {' or '.join(meant)}"
    words = {name.strip("-"): name for name in known}
    near = [words[each] for each in difflib.get_close_matches(option.strip("-"), words, 2)]
    slip = difflib.get_close_matches(option, known, 1, cutoff=_SLIP)
    if not slip and (found := _elsewhere(context, option, anywhere=True)):
        return f"use {' or '.join(found)}"
    if near:
        return f"did you mean {' or '.join(near)}?"
    return f"choose one that '{context.command_path} --help-all' lists"


_GUESSED = {"--load": ("--pressure", "--force"), "--loads": ("--pressures", "--forces")}
_SLIP = 0.8  # least likeness of an option to a misspelt one
_MOST = 3  # most commands that a message names
_VERBOSITY = ("-q", "--quiet", "-v", "--verbose")


def _elsewhere(context: Any, option: str, *, anywhere: bool = False) -> list[str]:
    """Return commands that take an option, with their purpose: of the same name or group, otherwise among all."""
    root = context.find_root()
    if isinstance(context.command, TyperGroup):
        return []
    groups = {root.info_name: root.command} | {
        f"{root.info_name} {name}": group
        for name, group in root.command.commands.items()
        if isinstance(group, TyperGroup)
    }

    def taking(path: str, names: Iterable[str]) -> list[str]:
        known = [(name, groups[path].get_command(context, name)) for name in names]
        return [
            f"'{path} {name}' ({_purpose(each)})"
            for name, each in known
            if any(option in one.opts for one in each.params)
        ]

    found = [
        word
        for path in groups
        if context.info_name in groups[path].commands
        for word in taking(path, [context.info_name])
    ]
    if not found and context.parent is not root:
        found = taking(context.parent.command_path, context.parent.command.commands)
    if anywhere:
        found = [word for path, group in groups.items() for word in taking(path, group.commands)][:_MOST]
    return found


def _purpose(command: Any) -> str:
    """Return the beginning of the help of a command, up to the first colon or full stop."""
    words = re.split(r"[:.](?= |$)", " ".join(command.help.split()))[0]
    return words[:1].lower() + words[1:]


def _as_in_example(context: Any) -> str:
    """Return the first example of a command, as a remedy."""
    lines = (context.command.epilog or "").split("\n\n")
    return f"write a line such as: {lines[1]}" if len(lines) > 1 else f"see {context.command_path} --help"
