"""Options of commands, each declared once: as a field of a recipe, as a field of a group, or as a default value."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, Field, dataclass, field, fields, is_dataclass, replace
from pathlib import Path
from typing import Any, get_args, get_type_hints

import typer

from roughcontact.cli.parsing.printed import FORMS, print_job
from roughcontact.cli.parsing.several import Cells, do_each
from roughcontact.cli.progress_view import PROGRESS_FORMS, progress_shown
from roughcontact.cli.verbosity import quietly
from roughcontact.errors import InputError, placed, within
from roughcontact.recipe.jobs import JOBS
from roughcontact.recipe.recipe_fields import Spec, hints_of, option_of, words_of
from roughcontact.recipe.source import File
from roughcontact.recipe.texts import Choice

__all__ = ["HELP_ALL", "HELP_ALL_OPTION", "PRINT", "argument", "grouped", "listed", "option"]

HELP_ALL = "--help-all"


@dataclass(frozen=True, slots=True)
class _Declared:
    """An option or argument for typer, and how a command reads its value."""

    parameter: inspect.Parameter
    everyday: bool
    spec: Spec | None = None


def option(
    text: str,
    example: str | None = None,
    *names: str,
    default: Any = None,
    everyday: bool = True,
    **more: Any,
) -> Any:
    """Return an option with its help, its metavar and its default; ``...`` if it is required.

    The help shows the options of a group under its ``PANEL``; the short help shows those that are `everyday`. `names`
    replace the name of the field. `more` goes to `typer.Option`, except ``read``, which turns the text of the user
    into the value, or raises `InputError`.
    """
    given = {"names": names, "metavar": example, "help": text, "everyday": everyday, **more}
    return field(default=MISSING if default is ... else default, metadata=given)


def argument(text: str, metavar: str, default: Any = ...) -> Any:
    """Return an argument with its help, its metavar and its default; ``...`` if it is required."""
    given = {"argument": True, "metavar": metavar, "help": text}
    return field(default=MISSING if default is ... else default, metadata=given)


def listed(*names: str) -> Callable[[str], list[str]]:
    """Return the `autocompletion` of an option that takes a comma list: it completes the last name."""

    def complete(incomplete: str) -> list[str]:
        done, comma, begun = incomplete.rpartition(",")
        return [f"{done}{comma}{name}" for name in names if name.startswith(begun)]

    return complete


PRINT = option(
    "Print the job as a recipe (toml), as a command or as Python, and compute nothing.",
    None,
    "--print",
    read=Choice(FORMS),
    everyday=False,
    rich_help_panel="Answer",
)
_VERBOSITY = {
    "progress": option(
        "Progress on standard error: bars on a terminal and a line a minute elsewhere, JSON lines, or none.",
        default="auto",
        read=Choice(PROGRESS_FORMS),
        everyday=False,
        rich_help_panel="Answer",
    ),
    "quiet": option(
        "Print only errors and notes on wrong numbers on standard error; no progress, no remarks.",
        None,
        *("-q", "--quiet"),
        default=False,
        everyday=False,
        rich_help_panel="Answer",
    ),
    "verbose": option(
        "Print each step with its time on standard error.",
        None,
        *("-v", "--verbose"),
        default=False,
        everyday=False,
        rich_help_panel="Answer",
    ),
}


def grouped(command: Callable[..., None], cells: Cells | None = None) -> Callable[..., None]:
    """Return a command as typer takes it: parts of recipes and groups, which are dataclasses, become options.

    Errors of the input are reported. The attribute ``more`` of the function returned lists the parameters that the
    short help leaves out. Each command gets ``--progress``, ``--quiet`` and ``--verbose``; a command that does a job
    gets ``--print``. With `cells`, the columns of a table, a command takes several files.
    """
    hints = get_type_hints(command)
    parameters = inspect.signature(command).parameters.values()
    declared = [
        each for one in parameters for each in _declared(one.name, hints[one.name], one.default, None)
    ]
    if cells is not None:
        declared = [_of_several(each) if each.spec and each.spec.positional else each for each in declared]
    does_job = any(kind in JOBS.values() for kind in hints.values())
    if does_job:
        declared.append(_of_command("printed", str, PRINT, None))
    is_long = any(not each.everyday for each in declared)
    declared += [
        replace(_of_command(name, bool, shown, None), everyday=not is_long)
        for name, shown in _VERBOSITY.items()
    ]
    more = frozenset(each.parameter.name for each in declared if not each.everyday)
    flat = [*(each.parameter for each in declared), _parameter("help_all", bool, HELP_ALL_OPTION)]

    def run(**given: Any) -> None:
        form, quiet, verbose = (given.pop(name) for name in _VERBOSITY)
        if quiet and verbose:
            words = "--quiet and --verbose exclude each other"
            raise InputError(words, "give one of them", "--quiet, --verbose")
        shown = progress_shown("none" if quiet and form == "auto" else form, verbose=verbose)
        with quietly(quiet), shown:
            if cells is None:
                done(given)
                return
            files = given["file"]
            if len(files) == 1 or given.get("printed") is not None:
                for file in files:
                    done({**given, "file": file})
            else:
                do_each(files, done, given, cells)

    def done(given: Mapping[str, Any]) -> None:
        if not any(each.spec for each in declared):
            command(**{one.name: _built(hints[one.name], one.name, given) for one in parameters})
            return
        # Late: a command without a recipe reports its errors itself, even if these modules cannot be imported.
        from roughcontact.cli.job import require_one_process
        from roughcontact.cli.messages import UsageError, reported

        paths = [Path(given["file"])] if isinstance(given.get("file"), str) else []
        paths += [value for value in given.values() if isinstance(value, Path)]
        with reported(*paths, as_json=given.get("json", False)):
            whole = [each.parameter.name for each in declared if each.spec and each.spec.needs_whole]
            require_one_process({option_of(name): given[name] for name in whole})
            try:
                built = {one.name: _built(hints[one.name], one.name, given) for one in parameters}
            except InputError as error:
                raise UsageError(error.message, error.remedy, error.place) from error
            if does_job and given["printed"] is not None:
                [job] = (each for each in built.values() if type(each) in JOBS.values())
                print_job(job, given["printed"], as_json=given["json"])
            else:
                command(**built)

    run.__signature__ = inspect.Signature(flat)  # type: ignore[attr-defined]
    run.__annotations__ = {each.name: each.annotation for each in flat}
    run.__name__, run.__doc__ = command.__name__, command.__doc__
    run.more = more  # type: ignore[attr-defined]
    return run


def _declared(name: str, kind: Any, declared: Any, panel: str | None) -> Iterator[_Declared]:
    """Yield the options of a parameter: one, or those of its group and of the groups in it."""
    if is_dataclass(kind := _commanded(kind)):
        hints, panel = hints_of(kind), getattr(kind, "TITLE", getattr(kind, "PANEL", None))  # type: ignore[arg-type]  # a class
        for each in fields(kind):
            if each.metadata or is_dataclass(_commanded(hints[each.name])):
                yield from _declared(each.name, hints[each.name], each, panel)
    elif (spec := declared.metadata.get("spec")) is None:
        yield _of_command(name, kind, declared, panel)
    elif spec.option:
        yield _of_recipe(name, kind, declared, spec, panel)


def _commanded(kind: Any) -> Any:
    """Return the type of a parameter or field; for a source, that of a file, which a command takes."""
    return File if File in get_args(kind) else kind


def _of_command(name: str, kind: Any, declared: Any, panel: str | None) -> _Declared:
    """Return an option that is not a field of a recipe."""
    given = {"rich_help_panel": panel, **declared.metadata}
    default = ... if declared.default is MISSING else declared.default
    if given.pop("argument", False):
        info = typer.Argument(default, metavar=given["metavar"], help=given["help"])
        return _Declared(_parameter(name, kind, info), everyday=True)
    names = given.pop("names") or ([option_of(name)] if declared.default is False else [])
    everyday = given.pop("everyday")
    if (read := given.pop("read", None)) is not None:
        place = names[0] if names else option_of(name)
        kind, given = str if default is not None else str | None, _read_by(read, place, given)
    # A default that the help of an option states is not repeated.
    info = typer.Option(default, *names, show_default="(default:" not in given["help"], **given)
    return _Declared(_parameter(name, kind, info), everyday)


def _read_by(read: Callable[[str], Any], place: str, given: Mapping[str, Any]) -> dict[str, Any]:
    """Return the declaration of an option whose text is read by a function of ours."""

    def value(text: Any) -> Any:
        with placed(place):
            return None if text is None else read(text)

    choices = getattr(read, "choices", ())
    return {
        **given,
        "metavar": given["metavar"] or f"[{'|'.join(choices)}]",
        "callback": value,
        "autocompletion": listed(*choices) if choices else None,
    }


def _of_recipe(name: str, kind: Any, declared: Field[Any], spec: Spec, panel: str | None) -> _Declared:
    """Return the option of a field of a recipe, or the argument that names a file."""
    default = ... if declared.default is MISSING else declared.default
    metavar = f"[{'|'.join(spec.choices)}]" if spec.choices else spec.example
    if spec.positional:
        info = typer.Argument(default, metavar=metavar, help=spec.help)
        return _Declared(_parameter(name, kind, info), True, spec)
    several = kind == tuple[str, ...]
    names, proposed = words_of(name, spec), spec.choices or spec.names
    info = typer.Option(
        None if several else default,
        "/".join(names),
        metavar=metavar,
        help=spec.help,
        rich_help_panel=panel,
        autocompletion=listed(*proposed) if proposed else None,
    )
    parameter = _parameter(name, list[str] | None if several else kind, info)
    return _Declared(parameter, spec.everyday or default is ..., spec)


def _of_several(one: _Declared) -> _Declared:
    """Return an argument that may be given several times."""
    info = typer.Argument(..., metavar=one.parameter.default.metavar, help=one.parameter.default.help)
    return replace(one, parameter=_parameter(one.parameter.name, list[str], info))


def _parameter(name: str, kind: Any, info: Any) -> inspect.Parameter:
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=info, annotation=kind)


def _print_help(context: typer.Context, wanted: bool) -> None:
    if wanted and not context.resilient_parsing:
        context.meta[HELP_ALL] = True
        typer.echo(context.get_help())
        raise typer.Exit


HELP_ALL_OPTION = typer.Option(
    False, HELP_ALL, is_eager=True, callback=_print_help, help="Show the full help, and exit."
)


def _built(kind: Any, name: str, given: Mapping[str, Any]) -> Any:
    """Return the value of one parameter: the value given, or a group made of such values."""
    if not is_dataclass(kind := _commanded(kind)):
        return tuple(given[name] or ()) if kind == tuple[str, ...] else given[name]
    hints, parts = hints_of(kind), {}  # type: ignore[arg-type]
    for each in fields(kind):
        if each.name in given or is_dataclass(_commanded(hints[each.name])):
            with within(each.name):
                parts[each.name] = _built(hints[each.name], each.name, given)
    return kind(**parts)  # type: ignore[operator]
