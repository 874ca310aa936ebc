"""Groups of commands that are imported only when they are called, so that the help of a group appears at once."""

from __future__ import annotations

import ast
import sys
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from inspect import cleandoc
from keyword import iskeyword
from typing import Any

import typer
from typer.core import TyperCommand, TyperGroup

from roughcontact.cli.messages import reported
from roughcontact.cli.option_groups import HELP_ALL, grouped
from roughcontact.cli.parsing.short_help import write_short_help
from roughcontact.cli.parsing.usage_errors import in_our_words, no_such_command

__all__ = ["late_group"]


def late_group(
    commands: Mapping[str, str],
    added: Callable[[], Mapping[str, str]] = dict,
    refuse: Callable[[str], None] = lambda name: None,
) -> type[TyperGroup]:
    """Return the class of a group of commands: functions of these names, in these modules of a package.

    ``EXAMPLES`` of the module holds the examples by the name of the command, and ``CELLS`` the columns of the table
    for several files. `added` returns the modules of commands of other packages; it is called for other names and for
    the help. `refuse` may raise a more helpful error for an unknown name.
    """
    modules = {name: f"roughcontact.cli.{module}" for name, module in commands.items()}

    class LateGroup(TyperGroup):
        def __init__(self, **given: Any) -> None:
            super().__init__(**given)
            # These names are listed, and proposed for a misspelt one.
            self.commands = {name: TyperCommand(name) for name in commands} | dict(self.commands)

        def get_command(self, ctx: Any, cmd_name: str) -> Any:
            known = super().get_command(ctx, cmd_name)
            module = added().get(cmd_name) if known is None else modules.get(cmd_name)
            if module is not None:
                return _imported(module, cmd_name)
            if known is None and not ctx.resilient_parsing:  # as completion parses
                refuse(cmd_name)
                raise no_such_command(ctx, cmd_name, self.commands)
            return known

        def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
            with in_our_words(ctx):
                return super().parse_args(ctx, args)

        def main(self, args: Any = None, *given: Any, **named: Any) -> Any:
            words = sys.argv[1:] if args is None else list(args)
            is_program = named.pop("standalone_mode", True)
            status: Any = 0
            try:
                with reported(as_json="--json" in words), in_our_words():
                    status = super().main(args, *given, **{**named, "standalone_mode": False})
            except typer.Exit as end:
                status = end.exit_code
            if is_program:
                sys.exit(status or 0)
            return status

        def list_commands(self, ctx: Any) -> list[str]:
            return list(dict.fromkeys([*super().list_commands(ctx), *added()]))

        def format_help(self, ctx: Any, formatter: Any) -> None:
            if HELP_ALL not in ctx.meta:
                _without_types(self._summarised(), ctx).format_help(ctx, formatter)
                return
            formatter.write_usage(ctx.command_path, "COMMAND ...")
            formatter.write_dl(list(self.every_command(ctx.command_path)), col_max=40)
            formatter.write(f"{ctx.command_path} COMMAND --help-all explains all options of a command.\n")

        def every_command(self, path: str) -> Iterator[tuple[str, str]]:
            """Yield the commands of this group and of the groups in it, each with its summary."""
            for name, each in self._summarised().commands.items():
                words = f"{path} {name}"
                inside = getattr(each, "every_command", None)
                yield from [(words, each.help or "")] if inside is None else inside(words)

        def shell_complete(self, ctx: Any, incomplete: str) -> Any:
            ctx.command = self._summarised()  # typer reads names and summaries from it
            return ctx.command.shell_complete(ctx, incomplete)

        def _summarised(self) -> TyperGroup:
            """Return the same group, of commands that only have a summary."""
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
    """A command with a short help, which fits a screen."""

    more: frozenset[str] = frozenset()  # parameters that the short help only lists

    def format_help(self, ctx: Any, formatter: Any) -> None:
        if self.more and HELP_ALL not in ctx.meta:
            write_short_help(self, ctx, formatter, self.more)
        else:
            _without_types(super(), ctx).format_help(ctx, formatter)

    def parse_args(self, ctx: Any, args: list[str]) -> list[str]:
        with in_our_words(ctx):
            return super().parse_args(ctx, args)


def _without_types(command: Any, ctx: Any) -> Any:
    """Return a command whose help shows no types of flags; some versions of typer write ``<bool>``."""
    for each in command.get_params(ctx):
        if getattr(each, "is_flag", False):
            each.metavar = ""
    return command


def _imported(module: str, name: str) -> Any:
    return _made(vars(import_module(module))[_function(name)], module, name)


@cache  # a process may call a command often
def _made(function: Callable[..., None], module: str, name: str) -> Any:
    members = vars(import_module(module))
    lines = members["EXAMPLES"][name].strip().split("\n")
    epilog = "\n\n".join(["Examples:" if len(lines) > 1 else "Example:", *lines])
    alone = typer.Typer(add_completion=False, rich_markup_mode="rich")
    command: Any = grouped(function, members.get("CELLS", {}).get(name))
    alone.command(name, cls=_Command, epilog=epilog)(command)
    found: Any = typer.main.get_command(alone)
    found.more = command.more
    return found


def _summary(module: str, name: str) -> str:
    """Return the first paragraph of a command's docstring, from the text of its module."""
    spec = find_spec(module)
    source = getattr(spec and spec.loader, "get_source", lambda name: None)(spec and spec.name)
    if source is None:  # a bundled program contains no source text
        return _imported(module, name).help or ""
    function = next(
        node
        for node in ast.parse(source).body
        if isinstance(node, ast.FunctionDef) and node.name == _function(name)
    )
    return cleandoc(ast.get_docstring(function) or "").partition("\n\n")[0]


def _function(name: str) -> str:
    """Return the name of the function of a command: a keyword of Python gets an underscore."""
    return f"{name}_" if iskeyword(name) else name
