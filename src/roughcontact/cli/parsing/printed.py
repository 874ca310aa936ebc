"""A job in another form: as a recipe, as the command that does it, or as Python."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typer

from roughcontact.cli.messages import UsageError

if TYPE_CHECKING:
    from roughcontact.recipe.jobs import Job

__all__ = ["FORMS", "print_job"]

FORMS = ("toml", "command", "python")


def print_job(job: Job, form: str, *, recipe: str = "job.toml", as_json: bool = False) -> None:
    """Print a job in one of the forms; file names, and that of its `recipe`, are relative to the current folder.

    Raises
    ------
    InputError
        If the job has no such form, or an answer is asked for as JSON too.
    """
    from roughcontact.recipe.command import command_of
    from roughcontact.recipe.job_calls import python_of
    from roughcontact.recipe.jobs import calls_of
    from roughcontact.recipe.written import to_plain, toml_of

    if as_json:
        raise UsageError("--print and --json exclude each other", "give one of them", "--print, --json")
    match form:
        case "toml":
            text = toml_of(to_plain(job))
        case "command":
            text = command_of(job, recipe)
        case _:
            text = python_of(calls_of(job))
    typer.echo(text.rstrip("\n"))
