"""The jobs by name, and the calls that do one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any, TypeAlias

from roughcontact.recipe.adhesive_jobs import AdhesiveCurveJob, AdhesiveLoopJob, AdhesivePressJob, DetachJob
from roughcontact.recipe.elastic_jobs import CurveJob, PressJob, SurfaceJob
from roughcontact.recipe.library_calls import Call, perform
from roughcontact.recipe.source import File, Shape

__all__ = ["JOBS", "Job", "calls_of", "known_names", "surface_calls", "surface_of"]

Job: TypeAlias = (
    SurfaceJob | PressJob | CurveJob | AdhesivePressJob | AdhesiveCurveJob | AdhesiveLoopJob | DetachJob
)
JOBS: Mapping[str, type[Any]] = {
    job.NAME: job
    for job in (
        SurfaceJob,
        PressJob,
        CurveJob,
        AdhesivePressJob,
        AdhesiveCurveJob,
        AdhesiveLoopJob,
        DetachJob,
    )
}


def surface_calls(job: Job) -> Iterator[Call]:
    """Yield the calls that read or make the surface of a job, and prepare it."""
    contact = getattr(job, "contact", None)
    yield from job.source.calls(line=contact is not None and contact.profile is not None)
    yield from job.preparation.calls(_default_level(job))


def calls_of(job: Job) -> Iterator[Call]:
    """Yield the calls that do a job, from the file to the answer."""
    yield from surface_calls(job)
    if not isinstance(job, SurfaceJob):
        yield from job.bodies.calls()
        yield from job.contact.calls()
        yield from job.calls()


def surface_of(job: Job) -> Any:
    """Return the surface of a job, prepared."""
    known = known_names()
    for call in surface_calls(job):
        perform(call, known)
    return known["surface"]


def known_names() -> dict[str, Any]:
    """Return the modules that calls begin with, as a program of a user imports them."""
    modules = {name: import_module(module) for name, module in (("rc", "roughcontact"), ("np", "numpy"))}
    return {**modules, "float": float, "getattr": getattr}


def _default_level(job: Job) -> str:
    """Return how the heights of a job are levelled where nothing is said."""
    if isinstance(job, SurfaceJob) or isinstance(job.source, Shape):
        return "none"
    # A file that does not say that its map repeats itself says nothing about a tilt.
    return "plane" if isinstance(job.source, File) and job.source.periodic else "auto"
