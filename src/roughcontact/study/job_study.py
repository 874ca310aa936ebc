"""A study made of a job that works: some of its fields vary, and surfaces that are made are drawn anew."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from roughcontact.errors import InputError, placed
from roughcontact.recipe.jobs import Job, surface_calls
from roughcontact.recipe.written import field_at, pinned, to_plain
from roughcontact.study.cases.job_case import draws, without_outputs
from roughcontact.study.nested_names import flat, merged
from roughcontact.study.study import Study

__all__ = ["is_random", "job_study"]


def job_study(job: Job, vary: Mapping[str, Sequence[Any]], *, samples: int, path: Path) -> Study:
    """Return the study of a job for a file: named like it, with the names of files as they are from there.

    Parameters
    ----------
    job : Job
    vary : dict of sequence
        Values of fields by their dotted names, in place of those of the job.
    samples : int
        Of every combination.
    path : Path
        Where the study is to be written.

    Raises
    ------
    StudyError
        If the job does not take a value.
    InputError
        If samples would not differ.
    """
    if samples > 1 and not is_random(job):
        raise InputError(
            f"the source of this job is not random: its {samples} samples would be the same",
            "leave samples out, and vary source.file for several surfaces",
            "samples",
        )
    folder = path.parent
    table: dict[str, Any] = {
        name: [_from(folder, each) for each in values] if name.endswith(".file") else values
        for name, values in vary.items()
    }
    plain = to_plain(without_outputs(pinned(job, folder)))
    with placed("vary"):
        for name in vary:
            field_at(plain, name)
    given = flat(plain)
    # Of files the study itself keeps the fingerprints, and of random numbers the seed.
    left = {
        name: each
        for name, each in given.items()
        if name not in vary and name.rpartition(".")[2] not in ("sha256", "seed")
    }
    return Study(
        name=path.stem,
        case="job",
        samples=samples,
        parameters=merged(left),
        table=table,
        folder="" if folder == Path() else str(folder),
    ).pinned()


def is_random(job: Job) -> bool:
    """Return whether the surface of a job is drawn at random."""
    return any(map(draws, surface_calls(job)))


def _from(folder: Path, file: Any) -> str:
    return Path(os.path.relpath(file, folder)).as_posix()
