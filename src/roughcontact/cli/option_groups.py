"""Options of commands, each declared once: as a field of a group that commands share, or as a default value."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, field, fields, is_dataclass
from typing import Any, get_type_hints

import typer

from roughcontact.cli.job import require_one_process
from roughcontact.cli.messages import reported
from roughcontact.cli.progress_view import ProgressForm, progress_shown

__all__ = ["argument", "flag", "grouped", "option"]

_Declared = tuple[str, Any, Any, str | None]  # name, type, declaration and panel of an option


def option(
    text: str,
    example: str | None = None,
    *names: str,
    default: Any = None,
    needs_whole: bool = False,
    **more: Any,
) -> Any:
    """Return an option: its help, what its value looks like, and its default; ``...`` where it must be given.

    A group's options stand in the help under its ``PANEL``. Where it `needs_whole` surfaces, several processes that
    hold some rows each refuse it. `more` goes to `typer.Option`, as do `names` where the name of the field will not do.
    """
    given = {"names": names, "metavar": example, "help": text, "needs_whole": needs_whole, **more}
    return field(default=MISSING if default is ... else default, metadata=given)


def argument(text: str, metavar: str, default: Any = ...) -> Any:
    """Return an argument: its help, what stands for it there, and its default; ``...`` where it must be given."""
    given = {"argument": True, "metavar": metavar, "help": text}
    return field(default=MISSING if default is ... else default, metadata=given)


_PROGRESS = option(
    "How far it is, on standard error: bars on a terminal and a line a minute elsewhere, JSON lines, or nothing.",
    default=ProgressForm.AUTO,
    rich_help_panel="Answer",
)


def flag(name: str) -> str:
    """Return the option that the field of this name becomes."""
    return f"--{name.replace('_', '-')}"


def grouped(command: Callable[..., None]) -> Callable[..., None]:
    """Return a command as typer takes it: groups of options, which are dataclasses, become options side by side.

    A command that has ``--json`` gets ``--progress`` too.
    """
    hints = get_type_hints(command)
    parameters = inspect.signature(command).parameters.values()
    declared = [each for one in parameters for each in _declared(one.name, hints[one.name], one.default)]
    if any(name == "json" for name, *_ in declared):
        declared.append(("progress", ProgressForm, _PROGRESS, None))
    flat = [_parameter(*each) for each in declared]
    whole = [name for name, _, option, _ in declared if option.metadata.get("needs_whole")]

    def run(**given: Any) -> None:
        with reported(as_json=given.get("json", False)):
            require_one_process({flag(name): given[name] for name in whole})
        with progress_shown(given.pop("progress", ProgressForm.AUTO)):
            command(**{one.name: _built(hints[one.name], one.name, given) for one in parameters})

    run.__signature__ = inspect.Signature(flat)  # type: ignore[attr-defined]
    run.__annotations__ = {each.name: each.annotation for each in flat}
    run.__name__, run.__doc__ = command.__name__, command.__doc__
    return run


def _declared(name: str, kind: Any, declared: Any, panel: str | None = None) -> Iterator[_Declared]:
    """Yield the options of a parameter: one, or those of its group and of the groups in it."""
    if is_dataclass(kind):
        hints, panel = get_type_hints(kind), getattr(kind, "PANEL", None)
        for each in fields(kind):
            yield from _declared(each.name, hints[each.name], each, panel)
    else:
        yield name, kind, declared, panel


def _parameter(name: str, kind: Any, declared: Any, panel: str | None) -> inspect.Parameter:
    """Return an option as typer takes it."""
    given = {"rich_help_panel": panel, **declared.metadata}
    default = ... if declared.default is MISSING else declared.default
    if given.pop("argument", False):
        info = typer.Argument(default, metavar=given["metavar"], help=given["help"])
    else:
        names = given.pop("names") or ([flag(name)] if declared.default is False else [])
        del given["needs_whole"]
        info = typer.Option(default, *names, **given)
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=info, annotation=kind)


def _built(kind: Any, name: str, given: Mapping[str, Any]) -> Any:
    """Return the value of one parameter: what was given, or a group made of what was."""
    if not is_dataclass(kind):
        return given[name]
    hints = get_type_hints(kind)
    return kind(**{each.name: _built(hints[each.name], each.name, given) for each in fields(kind)})  # type: ignore[operator]
