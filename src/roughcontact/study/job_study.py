"""A study made from a job: some of its fields vary, and each sample draws new random phases."""

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
    """Return the study of a job for a file: named like the file, with file names relative to it.

    Parameters
    ----------
    job : Job
    vary : dict of sequence
        Values of fields by their dotted names, in place of those of the job.
    samples : int
        Number of samples of every combination.
    path : Path
        The file of the study, which is not written here.

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
        name: [_from(folder, each) for each in values]
        if name.endswith((".file", "bodies.material"))
        else values
        for name, values in vary.items()
    }
    plain = to_plain(without_outputs(pinned(job, folder)))
    with placed("vary"):
        for name in vary:
            field_at(plain, name)
    given = flat(plain)
    # The study itself holds the fingerprints of files and the seed.
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
