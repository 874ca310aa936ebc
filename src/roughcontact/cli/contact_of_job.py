"""The surface of a job, read or made and prepared, and its bodies; defaults that matter are printed."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.cli.job import slabs_of_job
from roughcontact.cli.messages import UsageError, as_typed, note, plain, remark
from roughcontact.cli.report import quantity
from roughcontact.files.file_errors import ReadError, SurfaceWarning
from roughcontact.progress.events import task
from roughcontact.recipe.bodies import Bodies, hardness_of
from roughcontact.recipe.elastic_jobs import SurfaceJob
from roughcontact.recipe.job_calls import Call, perform
from roughcontact.recipe.jobs import JobOfHeights, known_names, surface_calls
from roughcontact.recipe.plastic_flow import yields_at
from roughcontact.recipe.recipe_fields import value_of
from roughcontact.recipe.source import File, Source
from roughcontact.recipe.texts import RIGID

if TYPE_CHECKING:
    from roughcontact.recipe.elastic_jobs import CurveJob, PressJob
    from roughcontact.recipe.joint_job import JointJob
    from roughcontact.recipe.shear_job import ShearJob
    from roughcontact.surface.surface import Surface

__all__ = [
    "best_state",
    "contact_of",
    "hardness_of_job",
    "name_of",
    "note_materials",
    "prepared",
    "softer_of",
]

_READERS = ("rc.read", "rc.read_line")
_COARSER = ("preparation.average", "preparation.downsample")
_NAME_THE_BODY = (
    "say how it is pressed: --profile line, as a line contact, or --profile winkler, on the springs of the method of "
    "dimensionality reduction"
)


def name_of(source: Source) -> str:
    """Return the file of a source, or its kind."""
    return plain(source.file) if isinstance(source, File) else source.KIND


def contact_of(job: Any) -> dict[str, Any]:
    """Return the values that the calls of a job refer to: surface, modulus, and operator of a profile.

    Raises
    ------
    InputError
        If the surface cannot be read or prepared, or several processes cannot press it together.
    """
    known = prepared(job, _require_together)
    if isinstance(job.bodies, Bodies):
        note_materials(job.bodies)
    if job.contact.profile is not None:
        _note_profile(job.contact.profile, known["surface"])
    for call in (*job.bodies.calls(), *job.contact.calls()):
        perform(call, known)
    return known


def prepared(job: JobOfHeights, check: Callable[[Surface], None] = lambda surface: None) -> dict[str, Any]:
    """Return the values that calls refer to, with the surface of a job; it is checked before it is prepared."""
    from roughcontact.files.read import read_either

    known: dict[str, Any] = known_names() | {"read_either": read_either}
    for call in surface_calls(job):
        before = known.get("surface")
        with _reading(call, job) if call.function in _READERS else task(call.doing):
            perform(_adapted(call, job), known)
        after: Any = known.get("surface")
        if after is not before and call.place == "source":
            check(after)
            if call.function == "rc.read" and after.grid.ndim == 1:
                remark(f"{name_of(job.source)} holds a profile of {after.grid.size} heights")
        if call.place == "preparation.despike":
            note("no spikes were found" if after is before else after.provenance[-1])
        elif call.place in _COARSER and after.provenance[-1].endswith("left out"):
            note(after.provenance[-1])
        elif call.place == "preparation.level" and job.preparation.level is None:
            _note_level(call, after)
    return known


def best_state(call: Call, known: dict[str, Any]) -> Any:
    """Return the state that a call finds; if it misses the tolerance, the best state."""
    from roughcontact.contact.convergence import ConvergenceError

    try:
        perform(call, known)
    except ConvergenceError as error:
        return error.solution
    return known[call.result.rpartition(" ")[2]]


def softer_of(job: PressJob | CurveJob | ShearJob | JointJob) -> tuple[float, str] | None:
    """Return the hardness [Pa] and its origin, if it is given or known from the materials."""
    given, softer = job.plastic.hardness, job.bodies.softer
    if (text := given or softer) is None:
        return None
    found = hardness_of(text)
    value = found.value(known_names()) if isinstance(found, Call) else found
    return value, f"of {text}" if isinstance(found, Call) else "as given"


def hardness_of_job(job: PressJob | CurveJob | ShearJob | JointJob) -> float | None:
    """Return the hardness [Pa] of a job with plastic flow; print a remark if it is that of a material."""
    if yields_at(job.bodies, job.plastic) is None or (softer := softer_of(job)) is None:
        return None
    if job.plastic.hardness is None:
        remark(f"the hardness is that {softer[1]}: {quantity('hardness', softer[0])}")
    return softer[0]


def _adapted(call: Call, job: JobOfHeights) -> Call:
    """Return a call as this program makes it: for profiles without a contact too, in slabs by several processes."""
    if call.function == "rc.read" and isinstance(job, SurfaceJob):
        call = replace(call, function="read_either")
    slabs = slabs_of_job()
    in_slabs = slabs is not None and call.function in ("rc.read", "rc.self_affine")
    return replace(call, named={**call.named, "slabs": slabs}) if in_slabs else call


@contextmanager
def _reading(call: Call, job: JobOfHeights) -> Iterator[None]:
    """Rewrite errors within: files as they were typed, options in place of functions of the library."""
    file = Path(call.given[0])
    with as_typed(file):
        if job.preparation.despike is not None:  # done below, and noted there
            warnings.filterwarnings("ignore", r".*\bdespiked\(\)", SurfaceWarning)
        try:
            yield
        except ReadError as error:
            if "read_line" in str(error.remedy):
                raise ReadError(error.file, error.problem, _NAME_THE_BODY) from error
            if call.function == "rc.read_line" and (points := _points_of_map(file)) is not None:
                raise UsageError(
                    f"{plain(str(file))} holds a map of {points} heights",
                    "leave out --profile",
                    "contact.profile",
                ) from error
            raise


def _points_of_map(file: Path) -> str | None:
    """Return the rows and columns of the map in a file; None where it holds none."""
    from roughcontact.files.read import channels

    shapes = [channel.shape for channel in channels(file) if len(channel.shape) == 2]
    return " x ".join(map(str, shapes[0])) if shapes else None


def _require_together(surface: Surface) -> None:
    if slabs_of_job() is not None and not all(surface.grid.periodic):
        raise UsageError(
            "several processes press periodic surfaces only, and this one is free",
            "give --periodic, or start one process",
            "source.periodic",
        )


def _note_level(call: Call, surface: Surface) -> None:
    if call.given == ("auto",) and all(surface.grid.periodic):
        remark("the surface is periodic, so that it has no tilt: its mean height is removed")
    else:
        trend = "plane" if surface.grid.ndim == 2 else "line"
        remark(
            f"the tilt is removed by a least-squares {trend} (choose otherwise by --level mean or --level none)"
        )


def note_materials(bodies: Bodies) -> None:
    """Print which grades of the handbook the names of materials refer to."""
    from roughcontact.materials import handbook

    for name in dict.fromkeys(value_of(bodies, "materials") or () if isinstance(bodies, Bodies) else ()):
        if name != RIGID:
            material = handbook(name)
            remark(
                f"{material.name} is {material.grade}: E {material.solid.young_modulus / 1e9:.4g} GPa, "
                f"nu {material.solid.poisson_ratio:g} ({material.sources['solid']})"
            )


def _note_profile(profile: str, surface: Surface) -> None:
    """Print a remark on the meaning of the numbers of a profile."""
    if profile == "winkler":
        note(
            "independent springs of the method of dimensionality reduction: a measured profile is not the line that "
            "stands for its surface; rc.mdr.line_scan makes that of it"
        )
        return
    free = "; depth and k depend on the length of the profile, K does not"
    note(
        "a line contact: nothing changes across the profile; forces, stiffness and area are per unit length"
        + ("" if all(surface.grid.periodic) else free)
    )
