"""The forms of the page are made of the fields of the jobs, and of nothing else."""

import json
from dataclasses import dataclass, fields
from typing import ClassVar, get_type_hints

import pytest

from every_field import smallest
from roughcontact.errors import InputError
from roughcontact.page.forms import forms
from roughcontact.page.server.page_request import PageRequest
from roughcontact.recipe.jobs import JOBS
from roughcontact.recipe.preparation import Preparation
from roughcontact.recipe.recipe_fields import described, specs
from roughcontact.recipe.source import SelfAffine, Source
from roughcontact.recipe.texts import Choice, whole


def field_of(form, name):
    [found] = [each for each in form["fields"] if each["name"] == name]
    return found


@pytest.mark.parametrize(
    "job", sorted(JOBS.keys() - {"theory", "leak", "shear", "creep", "sliding", "joint", "infer"})
)
def test_every_job_has_the_steps_of_the_preparation(job):
    form = forms()["jobs"][job]["preparation"]
    assert [each["name"] for each in form["fields"]] == [each.name for each, _ in specs(Preparation)]


def test_forms_are_plain_values():
    assert json.loads(json.dumps(forms())).keys() == {"sources", "jobs", "about"}


@pytest.mark.parametrize(
    ("part", "name", "expected"),
    [
        ("preparation", "level", {"kind": "choice", "choices": ("none", "mean", "plane", "quadratic")}),
        ("preparation", "fill", {"kind": "flag", "everyday": False}),
        ("preparation", "mask", {"kind": "texts"}),
        ("preparation", "tip_shape", {"kind": "choice", "needs": "tip", "label": "Tip shape"}),
        ("bodies", "young2", {"kind": "text", "needs": "young", "label": "Young 2"}),
        ("contact", "tolerance", {"default": "1e-8", "required": False}),
        ("load", "force", {"example": "10N", "everyday": True}),
    ],
)
def test_a_form_says_of_a_field_what_is_declared(part, name, expected):
    found = field_of(forms()["jobs"]["press"][part], name)
    assert {key: found[key] for key in expected} == expected


def test_what_excludes_another_is_one_choice():
    parts = forms()["jobs"]["press"]
    assert parts["bodies"]["one_of"] == ("modulus", "materials", "young")
    assert forms()["jobs"]["curve"]["loads"]["at_most"] == ("forces", "pressures", "depths")


def test_a_source_that_nothing_makes_again_has_no_form():
    assert "python" not in forms()["sources"]
    assert forms()["sources"]["self-affine"]["title"] == SelfAffine.TITLE


@pytest.mark.parametrize("name", ["theory", "leak", "shear", "creep", "sliding", "joint", "infer"])
def test_a_job_that_the_page_does_not_show_has_no_form_and_is_refused(name):
    assert name not in forms()["jobs"]
    with pytest.raises(InputError, match=f"does not show the job '{name}': use the command") as met:
        PageRequest.of(smallest(name), {}, {})
    assert met.value.place == "job"


@dataclass(frozen=True, slots=True, kw_only=True)
class Tried:
    """A part with two fields for trial."""

    TITLE: ClassVar = "On trial"
    median: str | None = described("Median over K x K cells.", "3", read=whole(1, "the number of cells"))
    shape: str | None = described("Shape of the window.", read=Choice(("disk", "square")), needs="median")


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """A job on trial."""

    NAME: ClassVar = "trial"
    source: Source
    preparation: Tried


def test_a_field_on_trial_is_in_the_forms_as_soon_as_it_is_declared(monkeypatch):
    assert get_type_hints(Trial)["preparation"] is Tried
    monkeypatch.setitem(JOBS, "trial", Trial)
    found = forms()
    form = found["jobs"]["trial"]["preparation"]
    assert [each["name"] for each in form["fields"]] == [each.name for each in fields(Tried)]
    assert field_of(form, "median")["help"] == "Median over K x K cells."
    assert field_of(form, "shape")["choices"] == ("disk", "square")
    assert found["about"]["trial"] == "A job on trial."
