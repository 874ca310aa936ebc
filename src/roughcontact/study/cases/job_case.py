"""A case: a job from a recipe. Any of its fields may vary in a study."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ConfigDict, Field, model_validator

from roughcontact.errors import InputError, every, together
from roughcontact.files.fingerprint import fingerprint
from roughcontact.recipe.job_calls import Call, Name, perform
from roughcontact.recipe.jobs import Job, calls_of, known_names
from roughcontact.recipe.numbers_of_fields import number_at, number_reader
from roughcontact.recipe.outputs import OUTPUTS
from roughcontact.recipe.source import File
from roughcontact.recipe.written import (
    from_plain,
    located,
    require_same_files,
    to_plain,
    with_files,
)
from roughcontact.study.case import Case, Parameters, Record
from roughcontact.study.nested_names import at, flat

__all__ = ["CASE", "JobParameters", "draws", "run", "without_outputs"]

_ANSWERS = (
    "joint",
    "leak",
    "shear",
    "loop",
    "curve",
    "state",
    "solution",
)  # the first that exists is the answer
_KEPT = {"load", "sliding_speed", "axis", "time"}  # dimensions of a record, without those of maps and spots


class JobParameters(Parameters):
    """A recipe: the name of its ``job``, and its parts as nested tables of texts, as `roughcontact run` takes them.

    A generated surface has no ``seed``: each sample of a study draws different phases. Outputs beside the numbers of
    a job (theories, errors, tables, units) are left out.

    Parameters
    ----------
    folder, files
        See `roughcontact.study.Study`.
    """

    model_config = ConfigDict(extra="allow")
    folder: str = Field(default="", exclude=True, repr=False)
    files: dict[str, str] = Field(default_factory=dict, exclude=True, repr=False)

    @model_validator(mode="before")
    @classmethod
    def _canonical(cls, values: dict[str, Any]) -> dict[str, Any]:
        own = {name: values[name] for name in ("folder", "files") if name in values}
        plain = {name: value for name, value in values.items() if name not in own}
        mistakes = list(_seeds(plain.get("source"), "source"))
        try:
            job = from_plain(plain)
            if job.NAME in ("surface", "theory", "infer"):
                raise InputError(
                    "a study only supports jobs that press surfaces", "take press or curve", "job"
                )
            job = with_files(job, lambda file: _pinned(file, own.get("folder", ""), own.get("files", {})))
        except InputError as error:
            mistakes += every(error)
        if mistakes:
            raise together(mistakes)
        return to_plain(without_outputs(job)) | own

    @property
    def recipe(self) -> Job:
        """The job."""
        return from_plain(self.model_dump())

    @classmethod
    def reader(cls, name: str, beside: Mapping[str, Any]) -> Callable[[Any], Any]:
        """Return the function that converts the text of a field into its value in SI."""
        return number_reader(beside, name)

    def labelled(self, names: Iterable[str] = ()) -> dict[str, tuple[Any, str | None]]:
        """Return fields by dotted names: numbers in SI with their unit, other values unchanged."""
        plain, job, found = self.model_dump(), self.recipe, {}
        for name in dict.fromkeys([*flat(plain), *names]):
            try:
                found[name] = number_at(job, name)
            except AttributeError:  # the name of the job, the kind of a source, or a whole part
                found[name] = at(plain, name), None
        return found

    def inputs(self) -> dict[str, str]:
        """Return the SHA-256 of the files of the source, by their names."""
        found: dict[str, str] = {}
        with_files(self.recipe, lambda file: found.update({file.file: file.sha256 or ""}) or file)
        return found


def run(parameters: JobParameters, rng: np.random.Generator) -> Record:
    """Return the answer of the job for one sample.

    Returns
    -------
    xarray.Dataset
        The variables of ``to_dataset()`` of the answer without a dimension, along ``load`` or ``sliding_speed``, and at
        the given times; for a job with conductors also the conductance of the interface, with a frequency the
        reflection of ultrasound.
    """
    job = located(parameters.recipe, Path(parameters.folder))
    require_same_files(job)
    known = known_names() | {"rng": rng}
    columns = []
    for call in calls_of(job):
        if call.result in ("conductance", "reflection"):
            columns.append(replace(call, given=(Name("dataset"), *call.given[1:]), result="dataset"))
        else:
            perform(_drawing(call), known)
    answer = next(known[name] for name in _ANSWERS if name in known)
    dataset = answer if "shear" in known else answer.to_dataset()
    if "prescribed" in dataset:  # adapted steps differ from sample to sample
        dataset = dataset.isel(time=dataset["prescribed"].to_numpy())
    known["dataset"] = dataset
    for call in columns:
        perform(call, known)
    dataset = known["dataset"]
    record: Record = dataset.drop_dims([each for each in dataset.dims if each not in _KEPT])
    return record


def without_outputs(job: Job) -> Job:
    """Return a job without the outputs beside its numbers."""
    parts = {each.name: getattr(job, each.name) for each in fields(job)}
    aside: Any = {name: type(part)() for name, part in parts.items() if isinstance(part, OUTPUTS)}
    return replace(job, **aside)


def _seeds(source: Any, place: str) -> Iterator[InputError]:
    """Yield the error of each seed of a source, and of the sources in it."""
    for name, value in source.items() if isinstance(source, Mapping) else ():
        if name == "seed":
            words = "each sample of a study draws different phases, from the seed of the study"
            yield InputError(words, "leave seed out", f"{place}.seed")
        yield from _seeds(value, f"{place}.{name}")


def _pinned(file: File, folder: str, files: Mapping[str, str]) -> File:
    digest = file.sha256 or files.get(file.file) or fingerprint(Path(folder, file.file))
    return replace(file, sha256=digest)


def _drawing(call: Call) -> Call:
    """Return a call whose random numbers are those of the sample."""
    return replace(call, given=tuple(Name("rng") if _is_generator(each) else each for each in call.given))


def draws(call: Call) -> bool:
    """Return whether a call draws random numbers."""
    return any(map(_is_generator, call.given))


def _is_generator(argument: Any) -> bool:
    return isinstance(argument, Call) and argument.function == "np.random.default_rng"


CASE = Case("job", 1, JobParameters, run)
