"""The jobs by name, and the calls of a job."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any, TypeAlias

from roughcontact.errors import InputError, within
from roughcontact.recipe.adhesive_jobs import AdhesiveCurveJob, AdhesiveLoopJob, AdhesivePressJob, DetachJob
from roughcontact.recipe.elastic_jobs import CurveJob, PressJob, SurfaceJob
from roughcontact.recipe.in_time.creep_job import CreepJob
from roughcontact.recipe.in_time.sliding_job import SlidingJob
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.joint_job import JointJob
from roughcontact.recipe.leak_job import LeakJob
from roughcontact.recipe.measured.infer_job import InferJob
from roughcontact.recipe.shear_job import ShearJob
from roughcontact.recipe.source import File, SmoothBody
from roughcontact.recipe.theory_job import TheoryJob

__all__ = [
    *("JOBS", "Job", "JobOfHeights", "calls_of", "contact_calls", "is_of_profile", "known_names"),
    "surface_calls",
]

JobOfHeights: TypeAlias = (
    SurfaceJob
    | PressJob
    | LeakJob
    | ShearJob
    | CurveJob
    | CreepJob
    | AdhesivePressJob
    | AdhesiveCurveJob
    | AdhesiveLoopJob
    | DetachJob
    | SlidingJob
    | JointJob
)
JobWithoutHeights: TypeAlias = TheoryJob | InferJob
Job: TypeAlias = JobOfHeights | JobWithoutHeights
JOBS: Mapping[str, type[Any]] = {
    job.NAME: job
    for job in (
        SurfaceJob,
        PressJob,
        LeakJob,
        ShearJob,
        CurveJob,
        CreepJob,
        AdhesivePressJob,
        AdhesiveCurveJob,
        AdhesiveLoopJob,
        DetachJob,
        SlidingJob,
        JointJob,
        TheoryJob,
        InferJob,
    )
}


def surface_calls(job: Job) -> list[Call]:
    """Return the calls that read or make the surface of a job, and prepare it; none for jobs without heights.

    Raises
    ------
    InputError
        If the source cannot be used: an example as a profile, heights that were made in Python, or a map that is
        periodic by option and cropped.
    """
    if isinstance(job, JobWithoutHeights):
        return []
    made_of = [job.source, getattr(job.source, "lower", None), getattr(job.source, "upper", None)]
    by_option = any(isinstance(each, File) and each.periodic for each in made_of)
    if by_option and job.preparation.crop is not None:
        raise InputError(
            "a map that is cropped is free, and `periodic` is given",
            "write the cropped map to a file ('surface prepare'), and give `periodic` to that file",
            "source.periodic",
        )
    with within("source"):
        source = list(job.source.calls(line=is_of_profile(job)))
    return [*source, *job.preparation.calls(_default_level(job))]


def is_of_profile(job: Job) -> bool:
    """Return whether a job presses a profile."""
    contact = getattr(job, "contact", None)
    return contact is not None and contact.profile is not None


def calls_of(job: Job) -> Iterator[Call]:
    """Yield the calls of a job, from the file to the answer."""
    yield from surface_calls(job)
    yield from contact_calls(job)


def contact_calls(job: Job) -> Iterator[Call]:
    """Yield the calls that press the prepared surface; none if a job only prepares heights."""
    if isinstance(job, JobWithoutHeights):
        yield from job.calls()
    elif not isinstance(job, SurfaceJob):
        yield from job.bodies.calls()
        yield from job.contact.calls()
        yield from job.calls()


def known_names() -> dict[str, Any]:
    """Return the modules that calls begin with."""
    # By name: an import would be circular, because the package imports studies, which use jobs.
    return {
        "rc": import_module("roughcontact"),
        "np": import_module("numpy"),
    }


def _default_level(job: JobOfHeights) -> str:
    """Return the default levelling of the heights of a job."""
    if isinstance(job, SurfaceJob) or isinstance(job.source, SmoothBody):
        return "none"
    # A measured map that is periodic by an option rather than by its file may be tilted.
    return "plane" if isinstance(job.source, File) and job.source.periodic else "auto"
