"""Commands that other packages add."""

import importlib.metadata
import json
import subprocess
import sys
from importlib.metadata import EntryPoint, EntryPoints

import pytest

GROUP = "roughcontact.commands"
MODULE = '''
"""A command of another package."""

from roughcontact.cli.option_groups import argument

EXAMPLES = {"greet": "roughcontact greet you", "press": "roughcontact press"}


def greet(name: str = argument("Whom.", "NAME")) -> None:
    """Greet somebody by name.

    In one line.
    """
    print(f"Hello {name}")


def press() -> None:
    """Take the place of a command that is there."""
'''


@pytest.fixture
def asked(tmp_path, monkeypatch):
    """Install a package that adds two commands, one of a name that is taken; return how often it was looked for."""
    (tmp_path / "greetings.py").write_text(MODULE, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    points = EntryPoints(EntryPoint(name, f"greetings:{name}", GROUP) for name in ("greet", "press"))
    times, others = [], importlib.metadata.entry_points

    def entry_points(**wanted):
        if wanted != {"group": GROUP}:
            return others(**wanted)
        times.append(wanted)
        return points

    monkeypatch.setattr(importlib.metadata, "entry_points", entry_points)
    yield times
    sys.modules.pop("greetings", None)


def test_an_added_command_runs_and_has_help(invoke, asked):
    answer = invoke("greet", "you")
    assert (answer.exit_code, answer.stdout) == (0, "Hello you\n")
    told = invoke("greet", "--help").stdout
    assert "In one line." in told
    assert "roughcontact greet you" in told
    assert len(asked) == 2


def test_the_help_of_the_program_lists_it(invoke, asked):
    told = invoke("--help").stdout
    assert "Greet somebody by name." in told
    assert "In one line." not in told
    assert asked


def test_a_command_that_is_there_keeps_its_name(invoke, asked):
    assert "--force" in invoke("press", "--help").stdout
    assert "Take the place" not in invoke("--help").stdout


@pytest.mark.parametrize(
    "words", [("press", "--help"), ("surface", "--help"), ("study", "status", "--help"), ("--version",)]
)
def test_other_commands_do_not_look_for_it(invoke, asked, words):
    assert invoke(*words).exit_code == 0
    assert asked == []


def test_a_command_that_nothing_adds_is_bad_input(invoke, asked):
    answer = invoke("gret")
    assert answer.exit_code == 2
    assert "'roughcontact' has no command 'gret'" in answer.stderr
    assert len(asked) == 1


def test_a_group_of_commands_has_none_of_them(invoke, asked):
    assert "'roughcontact surface' has no command 'greet'" in invoke("surface", "greet").stderr
    assert asked == []


def test_without_its_package_the_command_thesis_says_how_to_install_it(invoke, asked):
    answer = invoke("thesis", "list")
    assert answer.exit_code == 2
    assert answer.stdout == ""
    [line] = answer.stderr.splitlines()
    assert line.startswith("Error: ")
    assert f" {sys.executable} -m pip install roughcontact-thesis, " in line


def test_without_its_package_it_is_a_usage_error_in_json(invoke, asked, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["roughcontact", "thesis", "fig27", "--json"])
    answer = invoke("thesis", "fig27", "--json")
    assert answer.exit_code == 2
    error = json.loads(answer.stdout)["error"]
    assert (error["kind"], error["exit_status"]) == ("usage", 2)


def test_a_press_does_not_read_what_is_installed(rough):
    script = "import importlib.metadata\nimportlib.metadata.entry_points = None\n"
    script += "from roughcontact.cli.main import run\nrun()"
    command = [sys.executable, "-c", script, "press", rough, "--force", "1mN", "--modulus", "1GPa"]
    subprocess.run(command, check=True, capture_output=True, timeout=120)
