"""A recipe as the command for the same job."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from roughcontact.recipe.jobs import Job, is_of_profile
from roughcontact.recipe.measured.infer_job import JointMeasurement
from roughcontact.recipe.recipe_fields import option_of, specs, words_of
from roughcontact.recipe.source import File, SelfAffine
from roughcontact.recipe.specified import Specified, SpecifiedJoint

__all__ = ["command_name", "command_of"]

_MADE, _PREPARED = "rough.npz", "prepared.npz"


def command_name(job: Job) -> str:
    """Return the words of the command that does a job."""
    return "surface prepare" if job.NAME == "surface" else job.NAME


def command_of(job: Job, recipe: str = "job.toml") -> str:
    """Return the lines of a shell for a job; a random map is written first.

    For a source without options, the line is ``roughcontact run`` with the name of the recipe's file.
    """
    if isinstance(job.source, SpecifiedJoint):
        return _line(job.NAME, *_options(job))
    if isinstance(job.source, File | JointMeasurement):
        return _line(*_words(job, job.source.file), *_options(job))
    if not isinstance(job.source, SelfAffine | Specified) or is_of_profile(job):
        return _line("run", recipe)
    verb = "make" if isinstance(job.source, SelfAffine) else "specified"
    return "\n".join(
        [
            _line("surface", verb, _MADE, *_options_of(job.source)),
            _line(*_words(job, _MADE), *_options(job)),
        ]
    )


def _words(job: Job, file: str) -> tuple[str, ...]:
    return (*command_name(job).split(), file, *([_PREPARED] if job.NAME == "surface" else []))


def _line(*parts: str) -> str:
    return shlex.join(["roughcontact", *parts])


def _options(job: Job) -> Iterator[str]:
    for each in fields(job):
        part = getattr(job, each.name)
        if each.name != "source" or isinstance(part, File | JointMeasurement | SpecifiedJoint):
            yield from _options_of(part)


def _options_of(part: Any) -> Iterator[str]:
    for each, spec in specs(part):
        value: Any = getattr(part, each.name)
        if value == each.default or not spec.option or spec.positional or is_dataclass(value):
            continue
        if isinstance(value, bool):
            yield words_of(each.name, spec)[0 if value else 1]
            continue
        for text in value if isinstance(value, tuple) else (value,):
            # The command would take a value that begins with a minus sign for an option.
            yield from (
                [f"{option_of(each.name)}={text}"] if text.startswith("-") else [option_of(each.name), text]
            )
