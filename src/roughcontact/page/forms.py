"""The forms of a page: descriptions of the fields of each part of a job, as plain values."""

from __future__ import annotations

from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any, get_type_hints

from roughcontact.recipe.in_time.creep_job import CreepJob
from roughcontact.recipe.in_time.sliding_job import SlidingJob
from roughcontact.recipe.jobs import JOBS
from roughcontact.recipe.joint_job import JointJob
from roughcontact.recipe.leak_job import LeakJob
from roughcontact.recipe.measured.infer_job import InferJob
from roughcontact.recipe.outputs import OUTPUTS, Theories
from roughcontact.recipe.recipe_fields import Spec, specs
from roughcontact.recipe.shear_job import ShearJob
from roughcontact.recipe.source import SOURCES, Combined, InPython
from roughcontact.recipe.theory_job import TheoryJob

__all__ = ["WITHOUT_FORM", "forms", "label_of", "names_of_fields"]

WITHOUT_FORM = (TheoryJob, LeakJob, ShearJob, CreepJob, SlidingJob, JointJob, InferJob)

_LEFT_OUT = "file"  # it is dropped
_SHOWN = Theories  # the only part of an answer with a form


def forms() -> dict[str, Any]:
    """Return, by name, the forms of the parts of each kind of source and each job, and the titles of the jobs.

    A form has a title, its fields, and the names of those of which exactly one (``one_of``) or at most one
    (``at_most``) is given.
    """
    jobs = {name: job for name, job in JOBS.items() if job not in WITHOUT_FORM}
    return {
        "sources": {
            source.KIND: _form(source) for source in SOURCES if not issubclass(source, Combined | InPython)
        },
        "jobs": {
            name: {
                part: _form(kind)
                for part, kind in _parts(job).items()
                if kind is _SHOWN or kind not in OUTPUTS
            }
            for name, job in jobs.items()
        },
        "about": {name: str(job.__doc__) for name, job in jobs.items()},
    }


def label_of(name: str) -> str:
    """Return the label of a field."""
    return name.replace("_", " ").replace("2", " 2").capitalize()


def names_of_fields() -> frozenset[str]:
    """Return the names of all fields of the forms."""
    parts = [*SOURCES, *(kind for job in JOBS.values() for kind in _parts(job).values())]
    return frozenset(each.name for part in parts for each, _ in specs(part))


def _parts(job: type[Any]) -> dict[str, type[Any]]:
    """Return the parts of a job that have one form."""
    hints = get_type_hints(job)
    return {each.name: hints[each.name] for each in fields(job) if is_dataclass(hints[each.name])}


def _form(part: type[Any]) -> dict[str, Any]:
    hints = get_type_hints(part)
    return {
        "title": part.TITLE,
        "one_of": getattr(part, "ONE_OF", ()),
        "at_most": getattr(part, "AT_MOST", ()),
        "fields": [
            _field(each, spec, hints[each.name])
            for each, spec in specs(part)
            if spec.option and each.name != _LEFT_OUT
        ],
    }


def _field(each: Field[Any], spec: Spec, kind: Any) -> dict[str, Any]:
    """Return the description of a field; its kind selects the input element."""
    kinds = {bool: "flag", bool | None: "truth", tuple[str, ...]: "texts"}
    stated = ("help", "choices", "names", "needs", "everyday")
    return {name: getattr(spec, name) for name in stated} | {
        "name": each.name,
        "label": label_of(each.name),
        "example": spec.example or "",
        "kind": kinds.get(kind, "choice" if spec.choices else "text"),
        "default": None if each.default is MISSING else each.default,
        "required": each.default is MISSING,
    }
