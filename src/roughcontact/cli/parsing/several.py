"""One command on several files: a table with one row for each file, also for one that fails, or a JSON array."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import typer

from roughcontact.cli.exits import INTERRUPTED, MISSED
from roughcontact.cli.json_answer import emit, kept
from roughcontact.cli.verbosity import is_quiet

__all__ = ["Cells", "do_each"]

Cells: TypeAlias = Mapping[str, Callable[[Mapping[str, Any]], str]]
"""Columns of the table: heading, and function of an answer in plain values."""

_STATUS = {0: "ok", MISSED: "tolerance missed", INTERRUPTED: "stopped"}


def do_each(
    files: Sequence[str], one: Callable[[Mapping[str, Any]], None], given: Mapping[str, Any], cells: Cells
) -> None:
    """Run a command on one file after the other, and print the answers.

    Parameters
    ----------
    files : sequence of str
        As they were typed.
    one : function
        Runs the command on one file, with its options by name.
    given : mapping
        The options for all of them; ``out`` gets a folder for each.
    cells : mapping
        The columns of the table.

    Raises
    ------
    typer.Exit
        With the worst status of all files, if it is not 0. Ctrl-C ends the work with the files that are done.
    """
    from roughcontact.cli.report import print_table

    answers: list[tuple[str, Mapping[str, Any], int]] = []
    for file, folder in zip(files, _folders(files), strict=True):
        if not is_quiet():
            typer.echo(f"{file}:", err=True)
        out = None if given["out"] is None else given["out"] / folder
        record, status = _answer(one, {**given, "file": file, "json": True, "out": out})
        answers.append((file, {"file": file, **record}, status))
        if status == INTERRUPTED:
            break
    if given["json"]:
        emit([record for _, record, _ in answers])
    else:
        width = max(map(len, files))
        rows = [list(_row(file.ljust(width), record, status, cells)) for file, record, status in answers]
        print_table(("file".ljust(width), *cells, "status"), rows)
    if worst := max(status for *_, status in answers):
        raise typer.Exit(worst)


def _answer(
    one: Callable[[Mapping[str, Any]], None], given: Mapping[str, Any]
) -> tuple[Mapping[str, Any], int]:
    """Return the answer of a command as plain values, and its status."""
    status = 0
    with kept() as answers:
        try:
            one(given)
        except typer.Exit as end:
            status = end.exit_code
    return answers[-1], status


def _row(file: str, record: Mapping[str, Any], status: int, cells: Cells) -> Iterator[str]:
    failed = "error" in record
    yield file
    for cell in cells.values():
        yield "-" if failed else cell(record)
    yield "failed" if failed and status != INTERRUPTED else _STATUS[status]


def _folders(files: Sequence[str]) -> list[str]:
    """Return the name of a folder for each file: without the file's ending, if this is unique."""
    stems = [Path(file).stem for file in files]
    if len(set(stems)) == len(stems):
        return stems
    return [f"{number}-{Path(file).name}" for number, file in enumerate(files, 1)]
