"""Recipes as plain values and as files: TOML for people, JSON inside results."""

from __future__ import annotations

import difflib
import json
import os
import tomllib
import types
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass, replace
from pathlib import Path
from typing import Any, TypeVar, Union, get_args, get_origin

import tomli_w

from roughcontact.errors import InputError, every, together, within
from roughcontact.files.file_errors import ContentError, ReadError
from roughcontact.files.fingerprint import fingerprint
from roughcontact.files.standard_streams import standard
from roughcontact.recipe.bodies import Conduction
from roughcontact.recipe.elastic_jobs import CurveJob, SurfaceJob
from roughcontact.recipe.in_time.viscoelastic_body import ViscoelasticBody
from roughcontact.recipe.jobs import JOBS, Job
from roughcontact.recipe.joint_job import JointPressure
from roughcontact.recipe.measured.incident_wave import Ultrasound
from roughcontact.recipe.measured.infer_job import InferJob, JointMeasurement
from roughcontact.recipe.outputs import OUTPUTS
from roughcontact.recipe.prescribed_loads import RisingLoads
from roughcontact.recipe.recipe_fields import Spec, given, hints_of, refused
from roughcontact.recipe.source import Combined, File, Source
from roughcontact.recipe.theory_job import TheoryJob

__all__ = [
    *(
        "FORMAT",
        "carried",
        "contact_in",
        "field_at",
        "fields_in",
        "from_plain",
        "located",
        "pinned",
        "read_job",
    ),
    *("require_same_files", "to_plain", "toml_in", "toml_of", "with_files"),
]

J = TypeVar("J", bound=Job)
# Parts of jobs that name a file other than that of the heights, and the field.
_MORE_FILES: dict[str, tuple[type[Any], str]] = {
    "bodies": (ViscoelasticBody, "material"),
    "pressure": (JointPressure, "pressure_field"),
    "source": (JointMeasurement, "file"),
}
FORMAT = 1  # of recipes: raise it when the meaning of written recipes changes


def to_plain(job: Job) -> dict[str, Any]:
    """Return a job as nested dictionaries of texts and flags: the format, and fields without their default."""
    return {"format": FORMAT, "job": job.NAME, **_plain(job)}


def _plain(part: Any) -> dict[str, Any]:
    kind = {"kind": part.KIND} if hasattr(part, "KIND") else {}
    found = {name: _plain(value) if is_dataclass(value) else value for name, value in given(part).items()}
    return {
        **kind,
        **{
            name: list(value) if isinstance(value, tuple) else value
            for name, value in found.items()
            if value != {}
        },
    }


def from_plain(plain: Mapping[str, Any]) -> Job:
    """Return the job that nested dictionaries describe.

    Raises
    ------
    InputError
        If they do not describe a job: all errors, each with part and field as its place.
    """
    values = dict(plain)
    number = values.pop("format", FORMAT)
    if number != FORMAT:
        raise InputError(
            f"the recipe has the format {number!r}, and this version reads {FORMAT}",
            "take the version of roughcontact that wrote it",
            "format",
        )
    name = values.pop("job", None)
    if name is None and "case" in values:
        raise InputError("this is a study, not a job", "run it by 'roughcontact study run'", "job")
    if name is None:
        raise InputError("no job is named", f'write job = "press", or one of {", ".join(JOBS)}', "job")
    if not isinstance(name, str) or name not in JOBS:
        raise InputError(f"there is no job {name!r}", f"choose from {', '.join(JOBS)}", "job")
    job: Job = _part(JOBS[name], values)
    return job


def _part(kind: Any, values: Any) -> Any:
    """Return a part from the values of its fields, each in its declared type."""
    if not isinstance(values, Mapping):
        raise refused(values, "not a table of fields", f"give a table of {_names(kind)}")
    hints, known = hints_of(kind), {each.name: each for each in fields(kind)}
    mistakes = [
        InputError(f"{name} is missing", f"give {name}", name)
        for name, each in known.items()
        if name not in values and each.default is MISSING and each.default_factory is MISSING
    ]
    made = {}
    for name, value in values.items():
        try:
            if (apart := getattr(kind, "APART", {}).get(name)) is not None:
                raise InputError(
                    f"{apart} together with viscoelasticity is not modelled", "leave it out", name
                )
            if name not in known:
                near = difflib.get_close_matches(str(name), known, 1)
                remedy = f"did you mean {near[0]}?" if near else f"there are {_names(kind)}"
                raise InputError(f"unknown field {name!r}", remedy, str(name))
            made[name] = _value(name, hints[name], value)
        except InputError as error:
            mistakes += every(error)
    if mistakes:
        raise together(mistakes)
    return kind(**made)


def field_at(plain: Mapping[str, Any], name: str) -> Spec:
    """Return the description of the field at a dotted name of a recipe, such as ``"bodies.modulus"``.

    Raises
    ------
    InputError
        If there is no such field.
    """
    found = fields_in(plain)
    if name in found:
        return found[name]
    inside = [each for each in found if each.startswith(f"{name}.")]
    if inside:
        raise InputError(f"{name} is not a single value", f"choose from {', '.join(inside)}", name)
    last = name.rpartition(".")[2]
    near = [each for each in found if each.rpartition(".")[2] == last] or difflib.get_close_matches(
        name, found, 2
    )
    remedy = f"did you mean {' or '.join(near)}?" if near else f"choose from {', '.join(found)}"
    raise InputError(f"the job has no field {name!r}", remedy, name)


def fields_in(plain: Mapping[str, Any]) -> dict[str, Spec]:
    """Return the description of each field of a recipe, by dotted names such as ``"bodies.modulus"``."""
    return dict(_specs_in(JOBS.get(plain.get("job", ""), SurfaceJob), plain, ""))


def _specs_in(kind: Any, plain: Mapping[str, Any], before: str) -> Iterator[tuple[str, Spec]]:
    for each in fields(kind):
        if (spec := each.metadata.get("spec")) is not None:
            yield f"{before}{each.name}", spec
            continue
        inside, hint = plain.get(each.name, {}), hints_of(kind)[each.name]
        members = {one.KIND: one for one in get_args(hint)} if _is_union(hint) else {}
        part = members.get(inside.get("kind", File.KIND), File) if members else hint
        yield from _specs_in(part, inside, f"{before}{each.name}.")


def _value(name: str, kind: Any, value: Any) -> Any:
    members = [each for each in get_args(kind) if is_dataclass(each)] if _is_union(kind) else []
    with within(name):
        if members:
            return _of_kind(members, value)
        return _part(kind, value) if is_dataclass(kind) else value


def _of_kind(members: list[Any], values: Any) -> Any:
    """Return a part of the kind that its table names; a table with ``file`` is of the kind "file"."""
    if not isinstance(values, Mapping):
        raise refused(
            values, "not a table of fields", 'write kind = "file" and file = "part.x3p", or another kind'
        )
    kinds = {each.KIND: each for each in members}
    left = {name: value for name, value in values.items() if name != "kind"}
    kind = values.get("kind", File.KIND if "file" in values else None)
    if not isinstance(kind, str) or kind not in kinds:
        raise InputError(f"there is no kind {kind!r} of source", f"choose from {', '.join(kinds)}", "kind")
    return _part(kinds[kind], left)


def _is_union(kind: Any) -> bool:
    return get_origin(kind) in (Union, types.UnionType)


def _names(kind: Any) -> str:
    return ", ".join(each.name for each in fields(kind))


def read_job(path: Path) -> Job:
    """Return the job in a file: TOML, or a result (JSON, NetCDF) with a recipe. File names are relative to it.

    Raises
    ------
    ReadError
        If the file cannot be read.
    InputError
        If it does not contain a job.
    """
    from roughcontact.files.content import content  # late, with NumPy

    if path.suffix.casefold() not in (".toml", ".json", ".nc"):
        raise ReadError(
            str(path), "it is neither a job nor a result", "name a job (.toml) or a result (.json, .nc)"
        )
    plain = _result_in(path)
    if plain is None:
        with content(path) as (_, data):
            plain = toml_in(data)
    elif plain.get("recipe") is None:
        raise ReadError(
            str(path),
            "it contains no recipe",
            "name a job (.toml), or a result of press, curve or adhesion",
        )
    else:
        plain = plain["recipe"]
    return located(from_plain(plain), path.parent)


def _result_in(path: Path) -> dict[str, Any] | None:
    """Return the record in a result (for NetCDF only its recipe); None if the file is neither JSON nor NetCDF.

    Raises
    ------
    ReadError
        If the file cannot be read.
    """
    from roughcontact.files.content import content  # late, with NumPy
    from roughcontact.files.netcdf import opened

    kind = path.suffix.casefold()
    if kind not in (".json", ".nc"):
        return None
    with content(path) as (_, data):
        if kind == ".json":
            return _record(data.decode())
        with opened(data) as (_, attributes):
            return {"recipe": _record(str(attributes["recipe"])) if "recipe" in attributes else None}


def _record(text: str) -> dict[str, Any]:
    try:
        found = json.loads(text)
    except ValueError as error:
        raise ContentError(
            f"it is not valid JSON ({error})", "copy the file again, or do the job again"
        ) from error
    if not isinstance(found, dict):
        raise ContentError("it holds no result", "name a result, such as curve.json")
    return found


def toml_in(data: bytes) -> dict[str, Any]:
    """Return the tables of a TOML file; an empty one is refused."""
    try:
        found = tomllib.loads(data.decode())
    except ValueError as error:
        raise ContentError(
            f"it is not valid TOML ({error})", "write it as in docs/how-to/recipes.md"
        ) from error
    if empty := [name for name, value in found.items() if value == {}]:
        remedy = f"write a field below it, or leave out [{empty[0]}]"
        raise InputError("the table is empty, which asks for nothing", remedy, empty[0])
    return found


def carried(job: Job, folder: Path | None) -> dict[str, Any]:
    """Return the recipe for a result in a folder: file names are relative to it, or to the current folder."""
    return to_plain(pinned(job, folder or Path()))


def contact_in(recipe: Mapping[str, Any]) -> dict[str, Any]:
    """Return the part of a recipe that the columns of a curve depend on, without its loads."""
    aside = (*OUTPUTS, Conduction, Ultrasound, RisingLoads)
    beside = {name for name, kind in hints_of(CurveJob).items() if kind in aside}
    if "heat" in recipe:
        beside.remove("conduction")
    return {name: value for name, value in recipe.items() if name not in beside}


def located(job: Job, folder: Path) -> Job:
    """Return a job whose file names, relative to a folder, are made relative to the current one."""
    return with_files(
        job, lambda file: file if standard(file.file) else replace(file, file=str(folder / file.file))
    )


def toml_of(recipe: Mapping[str, Any]) -> str:
    """Return a recipe in plain values as TOML."""
    return tomli_w.dumps(recipe)


def pinned(job: Job, folder: Path) -> Job:
    """Return a job whose file names are relative to a folder, with fingerprints of the files."""

    def pin(file: File) -> File:
        # Bytes of a name that cannot be decoded cannot be written as text.
        path = file.file if standard(file.file) else os.path.relpath(file.file, folder)
        name = path.encode("utf-8", "replace").decode("utf-8")
        return replace(file, file=Path(name).as_posix(), sha256=fingerprint(Path(file.file)))

    return with_files(job, pin)


def require_same_files(job: Job) -> None:
    """Raise an error if a file of a job has changed.

    Raises
    ------
    InputError
        If the fingerprint of a file differs from the one that the recipe states.
    """

    def require(file: File) -> File:
        if file.sha256 is not None and fingerprint(Path(file.file)) != file.sha256:
            raise InputError(
                f"{file.file} is not the file that the recipe was written for: its SHA-256 differs",
                "give that file, or leave out sha256 to take this one",
                "sha256",
            )
        return file

    with_files(job, require)


def with_files(job: J, change: Callable[[File], File]) -> J:
    """Return a job with each of its files, of heights, a material or a pressure field, replaced by a function."""

    def changed(source: Source) -> Source:
        if isinstance(source, Combined):
            return replace(source, lower=changed(source.lower), upper=changed(source.upper))
        return change(source) if isinstance(source, File) else source

    if isinstance(job, TheoryJob):
        return job
    if not isinstance(job, InferJob):
        with within("source"):
            job = replace(job, source=changed(job.source))
    for name, (kind, of) in _MORE_FILES.items():
        if isinstance(part := getattr(job, name, None), kind) and (path := getattr(part, of)) is not None:
            with within(name):
                file = change(File(file=path, sha256=part.sha256))
            named: Any = {name: replace(part, **{of: file.file, "sha256": file.sha256})}
            job = replace(job, **named)
    return job
