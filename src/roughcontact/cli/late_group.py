"""Groups of commands that are imported when they are called: the help of a group waits for none of them."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Mapping
from importlib import import_module
from importlib.util import find_spec
from inspect import cleandoc
from keyword import iskeyword
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from roughcontact.cli.option_groups import HELP_ALL, grouped
from roughcontact.cli.short_help import write_short_help

__all__ = ["late_group"]


def late_group(
    commands: Mapping[str, str],
    added: Callable[[], Mapping[str, str]] = dict,
    refuse: Callable[[str], None] = lambda name: None,
) -> type[TyperGroup]:
    """Return the class of a group of commands: functions of these names, in these modules of this room.

    Their examples stand in the module's ``EXAMPLES``, by the name of the command. For a name that is not among them,
    and for the help, `added` returns the modules of commands of other packages; `refuse` may say more of a name that
    nothing adds than that there is no such command.
    """
    modules = {name: f"roughcontact.cli.{module}" for name, module in commands.items()}

    class LateGroup(TyperGroup):
        def __init__(self, **given: Any) -> None:
            super().__init__(**given)
            # Their names are listed, and proposed to whoever misspells one.
            self.commands = {name: TyperCommand(name) for name in commands} | dict(self.commands)

        def get_command(self, ctx: Any, cmd_name: str) -> Any:
            known = super().get_command(ctx, cmd_name)
            module = added().get(cmd_name) if known is None else modules.get(cmd_name)
            if module is not None:
                return _imported(module, cmd_name)
            if known is None and not ctx.resilient_parsing:  # as completion parses
                refuse(cmd_name)
            return known

        def list_commands(self, ctx: Any) -> list[str]:
            return list(dict.fromkeys([*super().list_commands(ctx), *added()]))

        def format_help(self, ctx: Any, formatter: Any) -> None:
            self._summarised().format_help(ctx, formatter)

        def shell_complete(self, ctx: Any, incomplete: str) -> Any:
            ctx.command = self._summarised()  # typer asks the command of the context for names and summaries
            return ctx.command.shell_complete(ctx, incomplete)

        def _summarised(self) -> TyperGroup:
            """Return the same group of commands that have but a summary."""
            every = {**added(), **modules}
            summaries = {name: TyperCommand(name, help=_summary(every[name], name)) for name in every}
            return TyperGroup(
                name=self.name,
                commands={**self.commands, **summaries},
                params=self.params,
                help=self.help,
                epilog=self.epilog,
                rich_markup_mode=self.rich_markup_mode,
            )

    return LateGroup


class _Command(TyperCommand):
    """A command whose help fits a screen, and that says of a wrong or missing option which are meant."""

    more: frozenset[str] = frozenset()  # parameters that the short help only names

    def format_help(self, ctx: Any, formatter: Any) -> None:
        if self.more and HELP_ALL not in ctx.meta:
            write_short_help(self, ctx, formatter, self.more)
        else:
            super().format_help(ctx, formatter)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        try:
            return super().parse_args(ctx, args)
        except Exception as raised:
            error: Any = raised
            # No such option: typers differ in the class.
            if hasattr(error, "possibilities") and (others := _elsewhere(ctx, error.option_name)):
                error.message, error.possibilities = f"{error.message}; {others}", None
            if type(error).__name__ == "MissingParameter" and error.param.metavar and not error.message:
                error.message = f"Give one such as {error.param.opts[0]} {error.param.metavar}"
            raise


def _elsewhere(ctx: Any, option: str) -> str:
    """Return which commands of the same name in other groups take an option, else which of the same nested group do."""
    root = ctx.find_root()
    groups = {root.info_name: root.command} | {
        f"{root.info_name} {name}": group
        for name, group in root.command.commands.items()
        if isinstance(group, TyperGroup)
    }

    def taking(path: str, names: Iterable[str]) -> list[str]:
        known = [(name, groups[path].get_command(ctx, name)) for name in names]
        return [f"'{path} {name}'" for name, each in known if any(option in one.opts for one in each.params)]

    found = [
        word
        for path in groups
        if ctx.info_name in groups[path].commands
        for word in taking(path, [ctx.info_name])
    ]
    if not found and ctx.parent is not root:
        found = taking(ctx.parent.command_path, ctx.parent.command.commands)
    return f"use {' or '.join(found)} for it" if found else ""


def _imported(module: str, name: str) -> Any:
    members = vars(import_module(module))
    lines = members["EXAMPLES"][name].strip().split("\n")
    epilog = "\n\n".join(["Examples:" if len(lines) > 1 else "Example:", *lines])
    alone = typer.Typer(add_completion=False, rich_markup_mode="rich")
    command: Any = grouped(members[_function(name)])
    alone.command(name, cls=_Command, epilog=epilog)(command)
    found: Any = typer.main.get_command(alone)
    found.more = command.more
    return found


def _summary(module: str, name: str) -> str:
    """Return the first paragraph of a command's docstring, from the text of its module."""
    spec = find_spec(module)
    source = getattr(spec and spec.loader, "get_source", lambda name: None)(spec and spec.name)
    if source is None:  # a bundle of the program holds no text
        return _imported(module, name).help or ""
    function = next(
        node
        for node in ast.parse(source).body
        if isinstance(node, ast.FunctionDef) and node.name == _function(name)
    )
    return cleandoc(ast.get_docstring(function) or "").partition("\n\n")[0]


def _function(name: str) -> str:
    """Return the name of the function that is a command: a word of Python's own has a line behind it."""
    return f"{name}_" if iskeyword(name) else name
