"""The command ``study from``: a study file made from a job."""

from __future__ import annotations

import json as json_text
import tomllib
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import typer

from roughcontact.cli.messages import UsageError, remark, reported
from roughcontact.cli.option_groups import argument, option
from roughcontact.cli.options import JSON
from roughcontact.cli.report import emit, print_facts
from roughcontact.recipe.texts import whole

__all__ = ["EXAMPLES", "from_"]

EXAMPLES = {
    "from": """
roughcontact study from job.toml --vary preparation.level=plane,quadratic --out levels.toml
roughcontact study from result/curve.json --vary source.hurst=0.6,0.8 --samples 10 --out hurst.toml
roughcontact study from job.toml --vary "bodies.materials=steel,steel;steel,copper" --out metals.toml
"""
}

SOURCE = argument("A job, or a result that holds its recipe.", "JOB.toml|RESULT.json")


def _fields(ctx: typer.Context, incomplete: str) -> list[str]:
    """Return the fields of the job on the command line, to complete the name of a field."""
    from roughcontact.recipe.written import fields_in

    found: dict[str, Any] = {}
    with suppress(OSError, ValueError, KeyError, TypeError):
        data = Path(next(iter(ctx.args), str(ctx.params["source"]))).read_bytes()
        found = json_text.loads(data)["recipe"] if data.startswith(b"{") else tomllib.loads(data.decode())
    return [f"{name}=" for name in fields_in(found) if name.startswith(incomplete)]


VARY = option(
    "A field of the job and its values, separated by commas, or by semicolons if a value contains commas. Repeat the "
    "option for another field.",
    "FIELD=VALUE,...",
    default=(),
    autocompletion=_fields,
)
SAMPLES = option(
    "Samples of every combination; each draws a different surface.",
    "N",
    default="1",
    read=whole(1, "the number of samples"),
)
OUT = option("Study file to write.", "STUDY.toml", default=...)
_FLAGS = {"true": True, "false": False}


def from_(
    source: Path = SOURCE,
    *,
    vary: list[str] = VARY,
    samples: int = SAMPLES,
    out: Path = OUT,
    json: bool = JSON,
) -> None:
    """Make a study from a job: any of its fields may vary, and each sample draws new random phases."""
    with reported(source, out, as_json=json):
        from roughcontact.files.aside import require_target
        from roughcontact.recipe.written import read_job, require_same_files
        from roughcontact.study.job_study import is_random, job_study

        require_target(out)
        job = read_job(source)
        require_same_files(job)
        study = job_study(job, _varied(vary), samples=samples, path=out)
        study.write(out)
        combinations = len(study.combinations())
        if json:
            emit(
                {"command": "study from", "file": str(out), "combinations": combinations, "samples": samples}
            )
        else:
            print_facts([("file", str(out)), ("cases", _counted(combinations, samples))])
        if is_random(job):
            remark("each sample draws different random phases, from the seed of the study")
        remark(f"to compute them: roughcontact study run {out}")


def _counted(combinations: int, samples: int) -> str:
    return f"{combinations * samples} ({combinations} combinations, {samples} samples of each)"


def _varied(texts: Sequence[str]) -> dict[str, list[Any]]:
    """Return the values of each field that varies."""
    found: dict[str, list[Any]] = {}
    for text in texts:
        name, _, values = text.partition("=")
        name, between = name.strip(), ";" if ";" in values else ","
        parts = [part.strip() for part in values.split(between) if part.strip()]
        if not name or not parts:
            raise UsageError(
                f"{text!r} is not a field with values", "write preparation.level=plane,quadratic", "--vary"
            )
        if name in found:
            raise UsageError(f"{name} is given twice", "name all of its values in one --vary", "--vary")
        found[name] = [_FLAGS.get(part, part) for part in parts]
    return found
