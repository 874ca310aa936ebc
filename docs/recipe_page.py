"""The page of recipes: every field of every job and source, from what is declared of it."""

from collections.abc import Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from inspect import cleandoc
from typing import Any, get_type_hints

from roughcontact.recipe.command import command_name
from roughcontact.recipe.jobs import JOBS
from roughcontact.recipe.recipe_fields import Spec, specs
from roughcontact.recipe.source import SOURCES, Combined

HEAD = ("field", "meaning", "value", "default")


def recipes() -> list[str]:
    """Return the lines of the page."""
    return [
        "# Recipes",
        "",
        "Every table and every field of a job in a file. How to write, run and repeat one: "
        "[A job as a file](../how-to/recipes.md).",
        "",
        "Values are texts, with units where they are quantities. A number without a unit is in SI units.",
        "",
        "## Jobs",
        "",
        "`job` names one of them. Tables in parentheses may be left out.",
        "",
        *_table(("job", "what it does", "tables"), _jobs()),
        "",
        "## Sources",
        "",
        "The table `[source]` of every job except `theory`. Its `kind` says which of the following it is.",
        "",
        *(line for source in SOURCES for line in _part(f'kind = "{source.KIND}"', source)),
        "## Tables",
        "",
        *(line for part, names in _parts().items() for line in _part(", ".join(names), part)),
    ]


def _jobs() -> Iterator[tuple[str, ...]]:
    for name, job in JOBS.items():
        tables = [
            f"`{each.name}`" if each.default_factory is MISSING else f"(`{each.name}`)"
            for each in fields(job)
        ]
        does = f"{cleandoc(job.__doc__)} As `roughcontact {command_name(job)}`."
        yield f"`{name}`", does, " ".join(tables)


def _parts() -> dict[type[Any], list[str]]:
    """Return the parts of jobs, of each under which names it stands in which jobs."""
    found: dict[type[Any], dict[str, list[str]]] = {}
    for name, job in JOBS.items():
        for table, kind in get_type_hints(job).items():
            if is_dataclass(kind):
                found.setdefault(kind, {}).setdefault(table, []).append(name)
    every = sum("contact" in get_type_hints(job) for job in JOBS.values())  # all that press
    return {
        part: [
            f"`[{table}]`" + ("" if len(jobs) >= every else f" of {' and '.join(jobs)}")
            for table, jobs in tables.items()
        ]
        for part, tables in found.items()
    }


def _part(title: str, part: type[Any]) -> list[str]:
    exclusive = [
        f"{words} {', '.join(f'`{name}`' for name in names)} is given."
        for words, names in (
            ("Exactly one of", getattr(part, "ONE_OF", ())),
            ("At most one of", getattr(part, "AT_MOST", ())),
        )
        if names
    ]
    nested = ["`lower` and `upper` are tables of a source each."] if part is Combined else []
    rows = [_row(each, spec) for each, spec in specs(part)]
    return [
        f"### {title}",
        "",
        " ".join([cleandoc(part.__doc__), *exclusive, *nested]),
        "",
        *_table(HEAD, rows),
        "",
    ]


def _row(each: Field[Any], spec: Spec) -> tuple[str, ...]:
    text = spec.help if spec.needs is None else f"{spec.help} Needs `{spec.needs}`."
    example = "`true` or `false`" if "bool" in str(each.type) else f"`{spec.example}`" if spec.example else ""
    value = ", ".join(f"`{choice}`" for choice in spec.choices) or example
    default = "must be given" if each.default is MISSING else _default(each.default)
    return f"`{each.name}`", text, value, default


def _default(value: Any) -> str:
    return "" if value in (None, ()) else f"`{str(value).lower() if isinstance(value, bool) else value}`"


def _table(head: tuple[str, ...], rows: Any) -> list[str]:
    lines = [head, ("---",) * len(head), *rows]
    return [f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |" for row in lines]
