"""Answers for people, and for programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import typer

from roughcontact.cli.json_answer import emit
from roughcontact.late import LateMethod

if TYPE_CHECKING:
    from roughcontact.plot.adhesive_facts import adhesive_curve_facts, adhesive_facts, law_facts
    from roughcontact.plot.facts import (
        bend_words,
        curve_facts,
        load_table,
        loop_facts,
        quantity,
        size_of,
        solution_facts,
        stiffness_facts,
        surface_facts,
        surface_record,
    )
else:  # late: the help and the completion of options do not wait for NumPy
    _HOMES = {
        "adhesive_facts": "adhesive_curve_facts adhesive_facts law_facts",
        "facts": (
            "bend_words curve_facts load_table loop_facts quantity size_of solution_facts stiffness_facts "
            "surface_facts surface_record"
        ),
    }
    for _home, _names in _HOMES.items():
        globals().update({name: LateMethod(f"roughcontact.plot.{_home}", name) for name in _names.split()})

__all__ = [
    "adhesive_curve_facts",
    "adhesive_facts",
    "bend_words",
    "curve_facts",
    "emit",
    "law_facts",
    "load_table",
    "loop_facts",
    "print_facts",
    "print_table",
    "quantity",
    "size_of",
    "solution_facts",
    "stiffness_facts",
    "surface_facts",
    "surface_record",
    "tell",
]


def print_facts(facts: Sequence[tuple[str, str]]) -> None:
    """Print lines of a name and a value on standard output."""
    width = max(len(name) for name, _ in facts)
    for name, value in facts:
        typer.echo(f"{name:<{width}}   {value}")


def print_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table with right-aligned columns on standard output, as wide as it needs to be."""
    lines = [header, *rows]
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    for line in lines:
        typer.echo("  ".join(f"{cell:>{width}}" for cell, width in zip(line, widths, strict=True)).rstrip())


def tell(record: Mapping[str, Any], facts: Sequence[tuple[str, str]], *, as_json: bool) -> None:
    """Print an answer as one JSON object, or as its file and facts."""
    if as_json:
        emit(record)
    else:
        print_facts([("file", record["file"]), *facts])
