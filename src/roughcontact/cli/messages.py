"""Errors of the user are printed in one line; defects of ours with their traceback."""

from __future__ import annotations

import logging
import os
import re
import sys
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, redirect_stdout
from decimal import Decimal
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.exits import BAD_INPUT, INTERRUPTED, TERMINATED
from roughcontact.cli.json_answer import emit_error, kind_of
from roughcontact.cli.verbosity import is_quiet
from roughcontact.errors import InputError, correctable, joined
from roughcontact.files.file_errors import ReadError, SurfaceWarning
from roughcontact.memory import MemoryWarning
from roughcontact.recipe.preparation import masks_named
from roughcontact.recipe.recipe_fields import option_of

if TYPE_CHECKING:
    from roughcontact.labels.note import Note

__all__ = ["UsageError", "as_typed", "ended", "note", "note_all", "plain", "remark", "reported", "worded"]

_WARNINGS = SurfaceWarning, MemoryWarning
# Keywords and calls of Python in messages of the library, which the place of an error does not cover.
_OPTIONS = (
    (
        re.compile(r"read it by rc\.read\(.*\), and give all maps to rc\.Measurements\.of"),
        "write it by 'surface prepare FILE new.npz --unit nm --size 1mm', with its own unit and size",
    ),
    (
        re.compile(r"\bby filled\(\), or crop the map by cropped\(\)"),
        "by 'surface prepare --fill', or crop the map by 'surface prepare --crop'",
    ),
    (re.compile(r"\bthe width or \(Ly, Lx\)"), "the width or height x width"),
    (re.compile(r"\bsize=\(([^,()]+), ([^,()]+)\)"), r"--size '\1 x \2'"),
    (re.compile(r"\bhardness='([\w-]+)'"), r"--hardness \1"),
    (re.compile(r"\b(channel|unit|size|hardness|quantity|columns)=(?=['\d])"), r"--\1 "),
    (re.compile(r"\brc\.Solid\(210e9, 0\.3\)"), "--young 210GPa --poisson 0.3"),
    (re.compile(r"\b(channel|unit|size|surface)="), r"--\1"),
    (re.compile(r"\b(despike|mask)e?d\(\)"), r"'surface prepare --\1'"),
    (re.compile(r"\bsurface\.filled\(\)"), "--fill"),
    (re.compile(r"make the grid with periodic=True"), "give --periodic"),
    (re.compile(r"give the adhesion allow_unresolved=True"), "give --allow-unresolved"),
    (re.compile(r"\buse detachment_path\b"), "use 'roughcontact adhesion detach'"),
    (re.compile(r"\bby loading_loop\b"), "by press --after FORCE or curve --loop"),
    (re.compile(r"\badhesive_path, adhesive_loop\b"), "'roughcontact adhesion curve'"),
    (re.compile(r"give adhesive_path an Adhesion with a range\b"), "use 'roughcontact adhesion curve'"),
    (re.compile(r"; read a map by read$"), "; leave out --profile for a map"),
)
_FIELD = re.compile(r"`(\w+)`")  # of a job
_METRES = re.compile(r"\b(\d(?:\.\d+)?e-(?:0\d|1[0-8])) m(?![\w^/²])")


class UsageError(InputError):
    """An invalid option or field; its place is printed first unless the message begins with it."""

    def __str__(self) -> str:
        place, text = self.place or "", super().__str__()
        is_shown = place.startswith("-") or "." in place  # rather than a parameter of a function
        if not is_shown or self.message.startswith(place.split(", ")[0]):
            return text
        return joined(f"{place}: {self.message}", self.remedy)


def note(text: str) -> None:
    """Print one line on standard error, even with --quiet: something about the answer may be wrong."""
    typer.echo(f"Note: {worded(text)}", err=True)


def note_all(notes: Iterable[Note]) -> None:
    """Print the notes on an answer, each once, the most important first."""
    from roughcontact.labels.note import Rank, in_order

    kept = [each for each in notes if not (is_quiet() and each.rank is Rank.USUAL)]
    for text in in_order(kept):
        note(text)


def remark(text: str) -> None:
    """Print one line on standard error unless --quiet is given: it prevents no misreading of a number."""
    if not is_quiet():
        note(text)


@contextmanager
def reported(*paths: Path | None, as_json: bool = False) -> Iterator[dict[str, Any]]:
    """Turn errors of this library into one line and an exit status, and its warnings into notes.

    The lines name the `paths` of the command line as they were typed. With `as_json`, the error is also printed as
    JSON, together with the entries of the dictionary that is yielded.
    """
    beside: dict[str, Any] = {}
    try:
        with warnings.catch_warnings():
            for ours in _WARNINGS:
                warnings.simplefilter("always", ours)
            warnings.showwarning = _showwarning(warnings.showwarning)
            yield beside
    except KeyboardInterrupt:
        ended("interrupted", "Interrupted: no file was left half-written.", INTERRUPTED, as_json=as_json)
        raise typer.Exit(INTERRUPTED) from None
    except SystemExit as end:
        if end.code == TERMINATED:
            ended("terminated", "Terminated: no file was left half-written.", TERMINATED, as_json=as_json)
        raise
    except MemoryError as error:
        full = InputError("the memory does not suffice", "use fewer points, or another machine")
        _refused(kind_of(error), full, beside if as_json else None)
        raise typer.Exit(BAD_INPUT) from None
    except (ValueError, OSError) as error:
        if (found := correctable(error)) is None:
            raise
        _refused(kind_of(error), found, beside if as_json else None, paths)
        raise typer.Exit(BAD_INPUT) from None


def ended(kind: str, line: str, status: int, *, as_json: bool, remedy: str | None = None) -> None:
    """Print that a run was stopped from outside, and end."""
    typer.echo(line if remedy is None else f"{line} To go on: {remedy}", err=True)
    if as_json:
        emit_error(kind, line, status, remedy)


def _refused(
    kind: str, error: InputError, beside: dict[str, Any] | None, paths: Iterable[Path | None] = ()
) -> None:
    """Print an error; with `beside`, also as one JSON object."""

    def typed(text: str | None) -> str | None:
        for path in paths:
            if text is not None and path is not None:
                text = text.replace(os.path.realpath(path), str(path))
        return None if text is None else worded(text)

    told = UsageError(typed(error.message) or "", typed(error.remedy), _as_options(typed(error.place)))
    # For an incomplete file, its name is the place.
    typer.echo(f"Error: {joined(told.message, told.remedy) if kind == 'read' else told}", err=True)
    if beside is not None:
        several = [
            {"message": typed(each.message), "remedy": typed(each.remedy), "place": _as_options(each.place)}
            for each in error.parts
        ]
        whole = beside | ({"mistakes": several} if several else {})
        emit_error(kind, told.message, BAD_INPUT, told.remedy, told.place, whole)


def _as_options(place: str | None) -> str | None:
    """Return a place of the library as options of the running command, if it has these."""
    if place is None:
        return None
    # versions of typer contain click, or import it
    home = typer.Context.__mro__[1].__module__.rpartition(".")[0]
    context = import_module(f"{home}.globals").get_current_context(silent=True)
    known = set() if context is None else {name for each in context.command.params for name in each.opts}
    options = {part: option_of(part.rpartition(".")[2]) for part in place.split(", ")}
    inside = "recipe."  # of a place in a file, never of an option
    return ", ".join(
        option if option in known and not part.startswith(inside) else part
        for part, option in options.items()
    )


@contextmanager
def as_typed(file: Path) -> Iterator[None]:
    """Name an unreadable file by the path that the user typed, rather than by its bare name.

    What third-party readers print goes to standard error; their logs and warnings are dropped.
    """
    threshold = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings(), redirect_stdout(sys.stderr):
            warnings.simplefilter("ignore")
            warnings.simplefilter("always", SurfaceWarning)
            yield
    except ReadError as error:
        raise ReadError(plain(str(file)), error.problem, error.remedy, error.place) from error
    finally:
        logging.disable(threshold)


def plain(text: str) -> str:
    """Return `text` with a question mark for every byte of a file name that cannot be decoded."""
    return text.encode("utf-8", "replace").decode("utf-8")


def worded(text: str) -> str:
    """Return `text` in one line, with the library's keywords turned into the options of the same name."""
    text = _FIELD.sub(lambda name: option_of(name[1]), text)
    text = masks_named(text, "--mask ")
    for keyword, option in _OPTIONS:
        text = keyword.sub(option, text)
    return " ".join(_METRES.sub(_with_prefix, text).split())


def _with_prefix(metres: re.Match[str]) -> str:
    """Return a small length with a prefix and the same digits: 1.86 um for 1.86e-06 m."""
    length = Decimal(metres[1])
    steps = -(length.adjusted() // 3)
    return f"{length.scaleb(3 * steps):f} {'munpfa'[steps - 1]}m"


def _showwarning(original: Any) -> Any:
    """Return a `showwarning` that prints warnings of this library as notes and passes other warnings on."""

    def show(message: Warning | str, category: type[Warning], *rest: Any, **named: Any) -> None:
        if issubclass(category, _WARNINGS):
            note(str(message))
        else:
            original(message, category, *rest, **named)

    return show
