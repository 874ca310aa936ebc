"""What a release says in several places is the same in all of them."""

import importlib
import re
import tomllib
from pathlib import Path

import pytest

import roughcontact as rc
from roughcontact.cli.added_commands import PACKAGES

HOME = Path(__file__).parent.parent
PROJECT = tomllib.loads((HOME / "pyproject.toml").read_text(encoding="utf-8"))
THESIS = tomllib.loads((HOME / "reproduction" / "pyproject.toml").read_text(encoding="utf-8"))
RECIPE = (HOME / "conda" / "recipe.yaml").read_text(encoding="utf-8")
WORKFLOW = (HOME / ".github" / "workflows" / "check.yml").read_text(encoding="utf-8")
# What conda calls otherwise: Matplotlib without the libraries of windows.
CONDA_NAMES = {"matplotlib": "matplotlib-base"}


def test_the_version_is_one():
    citation = (HOME / "CITATION.cff").read_text(encoding="utf-8")
    written = [
        PROJECT["project"]["version"],
        re.search(r"^version: (.*)$", citation, re.MULTILINE)[1],
        re.search(r'^  version: "(.*)"$', RECIPE, re.MULTILINE)[1],
        THESIS["project"]["version"],
    ]
    assert written == [rc.__version__] * 4


def test_every_step_of_the_workflow_is_a_command_or_an_action():
    """A colon and a space in a command that is not quoted would make the whole file unreadable."""
    jobs = pytest.importorskip("yaml").safe_load(WORKFLOW)["jobs"]
    assert {"tests", "lowest", "coverage", "docs", "package"} <= jobs.keys()
    for step in (step for job in jobs.values() for step in job["steps"]):
        [kind] = {"run", "uses"} & step.keys()
        assert isinstance(step[kind], str), step


def test_the_package_of_the_figures_belongs_to_this_version():
    """It uses modules that are not public, and adds the command by whose name the program tells how to install it."""
    assert THESIS["project"]["dependencies"] == [f"roughcontact=={rc.__version__}"]
    assert THESIS["project"]["requires-python"] == PROJECT["project"]["requires-python"]
    commands = THESIS["project"]["entry-points"]["roughcontact.commands"]
    assert dict.fromkeys(commands, (THESIS["project"]["name"], "./reproduction")) == PACKAGES
    for name, place in commands.items():
        module, _, function = place.partition(":")
        assert function == name
        assert name in importlib.import_module(module).EXAMPLES


def test_each_package_holds_its_own_folder():
    for project, name in ((PROJECT, "roughcontact"), (THESIS, "roughcontact_thesis")):
        targets = project["tool"]["hatch"]["build"]["targets"]
        assert targets["wheel"]["packages"] == [f"src/{name}"]


def test_the_recipe_has_the_dependencies_of_the_package():
    lines = [text.partition(";")[0] for text in PROJECT["project"]["dependencies"]]
    wanted = {tuple(line.split(">=")) for line in ["python" + PROJECT["project"]["requires-python"], *lines]}
    run = RECIPE[RECIPE.index("  run:\n") : RECIPE.index("tests:\n")]
    lowest = re.search(r'^  python_min: "(.*)"$', RECIPE, re.MULTILINE)[1]
    run = run.replace("${{ python_min }}", lowest)
    found = set(re.findall(r"^    - (\S+) >=(\S+)$", run, re.MULTILINE))
    assert found == {(CONDA_NAMES.get(name, name), bound) for name, bound in wanted}


def test_what_a_cluster_needs_is_in_the_extra_that_messages_name():
    extras = PROJECT["project"]["optional-dependencies"]
    needed = {"distributed", "cryptography"}
    assert {re.match(r"[\w-]+", text)[0] for text in extras["cluster"]} == needed
    assert {*extras["cluster"]} <= {*extras["test"]}


def test_the_recipe_is_built_and_tried_on_the_oldest_python():
    """As conda-forge wants it of a package for every Python (its enhancement proposal 25)."""
    assert len(re.findall(r"python(?:_version:)? \$\{\{ python_min \}\}\.\*$", RECIPE, re.MULTILINE)) == 3
    assert re.search(r"  host:\n    - python \$\{\{ python_min \}\}\.\*\n", RECIPE)


def test_each_dependency_says_what_it_weighs_and_what_it_is_for(monkeypatch):
    monkeypatch.syspath_prepend(HOME / "benchmarks")
    purposes = importlib.import_module("weights").PURPOSES
    named = {re.match(r"[\w-]+", text)[0] for text in PROJECT["project"]["dependencies"]}
    assert purposes.keys() == named
    page = (HOME / "docs" / "project" / "release.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([\w-]+) \| [\d.]+ \| .* \| (.*) \|$", page, re.MULTILINE)
    assert dict(rows) == purposes


def test_the_workflow_does_what_the_check_of_a_checkout_does():
    check = (HOME / ".ci" / "run").read_text(encoding="utf-8")
    kernels = re.search(r"ARGS='(.*)'", check)[1]
    assert f"python -m nox {kernels}\n" in WORKFLOW
    lint = (HOME / "Makefile").read_text(encoding="utf-8")
    for step in ("ruff check .", "ruff format --check .", "pytest -n auto"):
        assert f"python -m {step}" in lint
        assert f"run: python -m {step}\n" in WORKFLOW
    systems = re.search(r"printf '%s\\n' (.*) \\\n", lint)[1].split()
    assert systems == re.findall(r"run: python -m mypy --platform (\w+)\n", WORKFLOW)
    assert len(systems) == 3


def test_the_pythons_are_those_of_the_package():
    classified = re.findall(r"Python :: (3\.\d+)", "\n".join(PROJECT["project"]["classifiers"]))
    assert re.search(r"python: \[(.*)\]", WORKFLOW)[1] == ", ".join(f'"{each}"' for each in classified)
    assert re.search(r"PYTHONS = \((.*)\)", (HOME / "noxfile.py").read_text())[1] == ", ".join(
        f'"{each}"' for each in classified
    )


def test_the_source_archive_is_a_whole_checkout():
    included = PROJECT["tool"]["hatch"]["build"]["targets"]["sdist"]["include"]
    assert [name for name in included if not (HOME / name).exists()] == []
    assert {"src", "reproduction", "tests"} <= set(included)
    assert (HOME / "reproduction" / "LICENSE").read_bytes() == (HOME / "LICENSE").read_bytes()
    assert {path.name for path in HOME.glob("*.md")} <= set(included)
