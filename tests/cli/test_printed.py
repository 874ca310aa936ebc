"""A job is printed as a recipe, as a command and as Python, and nothing is computed."""

import shlex
import tomllib
from pathlib import Path

import pytest

import roughcontact as rc

GIVEN = ("--short-cutoff", "8um", "--pressure", "10kPa", "--modulus", "110GPa")


@pytest.fixture
def here(rough, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(rc, "press", None)  # nothing is pressed
    return tmp_path


def printed(invoke, *words):
    answer = invoke(*words)
    assert (answer.exit_code, answer.stderr) == (0, "")
    return answer.stdout


def test_a_command_and_its_recipe_are_printed_alike(invoke, here):
    recipe = printed(invoke, "press", "rough.npz", *GIVEN, "--print", "toml")
    assert tomllib.loads(recipe)["preparation"] == {"short_cutoff": "8um"}
    Path("job.toml").write_text(recipe, encoding="utf-8")
    for form in ("toml", "command", "python"):
        told = printed(invoke, "press", "rough.npz", *GIVEN, "--print", form)
        assert printed(invoke, "run", "job.toml", "--print", form) == told
    command = printed(invoke, "run", "job.toml", "--print", "command")
    assert printed(invoke, *shlex.split(command)[1:], "--print", "toml") == recipe


def test_numbers_in_python_are_those_of_the_user(invoke, here):
    python = printed(invoke, "press", "rough.npz", "--size", "200um", *GIVEN, "--print", "python")
    assert "size=0.0002)" in python
    assert "short_cutoff=8e-06" in python
    assert "\nmodulus = 110000000000.0\n" in python
    compile(python, "job", "exec")


def test_a_source_without_options_is_left_to_its_recipe(invoke, here):
    Path("job.toml").write_text(
        'job = "surface"\n[source]\nkind = "example"\nexample = "ground"\n', encoding="utf-8"
    )
    assert printed(invoke, "run", "job.toml", "--print", "command") == "roughcontact run job.toml\n"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--print", "json"), "--print: 'json' is not one of the choices; choose from toml, command, python"),
        (("--print", "toml", "--json"), "--print and --json exclude each other: give one of them"),
    ],
)
def test_what_is_not_printed_is_refused(invoke, here, words, message):
    answer = invoke("press", "rough.npz", *GIVEN, *words)
    assert answer.exit_code == 2
    assert f"Error: {message}" in answer.stderr
