"""Completion of the shell: what it proposes, what it imports, and that the scripts of the shells get it."""

import os
import shlex
import shutil
import subprocess
import sys

import pytest
from typer.testing import CliRunner

from roughcontact.adhesion.attraction import LAWS as ATTRACTIONS
from roughcontact.cli.app import app
from roughcontact.materials import MATERIALS
from roughcontact.recipe.adhesion_law import LAWS as ATTRACTIVE
from roughcontact.recipe.outputs import THEORIES
from roughcontact.recipe.texts import METALS
from roughcontact.theory.laws import LAWS

VARIABLE = "_ROUGHCONTACT_COMPLETE"
POSIX = pytest.mark.skipif(sys.platform == "win32", reason="the program stands on the path as a script of sh")


def asked(line):
    """Return the environment in which the script of bash asks for the last word of a line."""
    words = line.split(" ")
    return {"COMP_WORDS": line, "COMP_CWORD": str(len(words) - 1), VARIABLE: "complete_bash"}


def proposed(line):
    answer = CliRunner().invoke(app, [], env=asked(line))
    assert (answer.exit_code, answer.stderr) == (0, "")
    return answer.stdout.split()


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("roughcontact pr", ["press"]),
        ("roughcontact ad", ["adhesion"]),
        ("roughcontact sl", ["sliding"]),
        ("roughcontact shear tile.npz --shear", ["--shear-strength"]),
        ("roughcontact sliding tile.npz --mat", ["--material"]),
        ("roughcontact study st", ["status"]),
        ("roughcontact adhesion ", ["press", "curve", "loop", "detach"]),
        ("roughcontact --show", ["--show-completion"]),
        ("roughcontact press part.x3p --lev", ["--level"]),
        ("roughcontact press part.x3p --fr", ["--free"]),
        ("roughcontact surface make new.npz --short", ["--short-cutoff"]),
        ("roughcontact press part.x3p --level ", ["none", "mean", "plane", "quadratic"]),
        ("roughcontact curve part.x3p --format p", ["png", "pdf"]),
        ("roughcontact adhesion press part.x3p --law ", list(ATTRACTIONS)),
        ("roughcontact press part.x3p --materials st", ["steel", "stainless-steel"]),
        ("roughcontact press part.x3p --materials steel,ri", ["steel,rigid"]),
        ("roughcontact press part.x3p --hardness alu", ["aluminium"]),
        ("roughcontact conductance result --resistivity 1uohm*m,co", ["1uohm*m,copper"]),
        ("roughcontact curve part.x3p --theory persson,gw", ["persson,gw", "persson,gw-exponential"]),
        ("roughcontact curve part.x3p --table csv,aba", ["csv,abaqus", "csv,abaqus-mm"]),
        # Nothing, where the shell proposes its files.
        ("roughcontact press pa", []),
        ("roughcontact press part.x3p --out ", []),
        ("roughcontact study run ", []),
    ],
)
def test_commands_options_and_names_are_proposed(line, words):
    assert proposed(line) == words


def test_every_command_is_proposed_as_the_help_lists_them(invoke):
    told = invoke("--help").stdout
    words = proposed("roughcontact ")
    assert {"press", "curve", "serve", "study"} <= set(words)
    assert all(f" {word} " in told for word in words)


def test_the_names_are_those_of_the_library():
    assert tuple(MATERIALS) == METALS
    assert tuple(LAWS) == THEORIES
    assert tuple(ATTRACTIONS) == ATTRACTIVE


def test_a_command_whose_package_is_missing_does_not_speak_into_the_line(monkeypatch):
    monkeypatch.setattr("importlib.metadata.entry_points", lambda **group: ())
    assert "thesis" not in proposed("roughcontact ")
    assert proposed("roughcontact thesis fi") == []


@pytest.mark.parametrize(
    ("environment", "status", "text"),
    [
        ({VARIABLE: "complete_zsh", "_TYPER_COMPLETE_ARGS": "roughcontact press pa"}, 0, "_files\n"),
        ({VARIABLE: "complete_fish", "_TYPER_COMPLETE_FISH_ACTION": "is-args"}, 0, ""),
        (
            {
                VARIABLE: "complete_fish",
                "_TYPER_COMPLETE_FISH_ACTION": "is-args",
                "_TYPER_COMPLETE_ARGS": "roughcontact press pa",
            },
            1,
            "",
        ),
        (
            {
                VARIABLE: "complete_powershell",
                "_TYPER_COMPLETE_ARGS": "roughcontact press part.x3p --level pl",
                "_TYPER_COMPLETE_WORD_TO_COMPLETE": "pl",
            },
            0,
            "plane::: \n",
        ),
    ],
)
def test_other_shells_get_their_answers(environment, status, text):
    answer = CliRunner().invoke(app, [], env=environment)
    assert (answer.exit_code, answer.stdout) == (status, text)


@pytest.mark.parametrize(
    ("line", "without"),
    [
        ("roughcontact pr", {"roughcontact.cli.options"}),
        ("roughcontact surface ", {"roughcontact.cli.options"}),
        ("roughcontact curve part.x3p --materials st", set()),
        ("roughcontact adhesion loop part.x3p --l", set()),
        ("roughcontact study run ", set()),
    ],
)
def test_completion_waits_for_no_library_of_numerics(line, without):
    """Nor do names of commands wait for the modules of the commands."""
    code = (
        "import sys; from roughcontact.cli.main import run; sys.argv[1:] = []\n"
        f"try: run()\nexcept SystemExit: print({without | {'numpy', 'scipy', 'xarray', 'matplotlib', 'pint'}!r} "
        "& set(sys.modules))"
    )
    environment = os.environ | asked(line)
    answer = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, encoding="utf-8", check=True, env=environment
    )
    assert answer.stdout.endswith("set()\n")


@pytest.fixture
def shell(tmp_path):
    """Run lines in a shell that finds the program, in a home of its own with one file; return what they print."""
    program = tmp_path / "bin" / "roughcontact"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec {shlex.quote(sys.executable)} -m roughcontact "$@"\n')
    program.chmod(0o755)
    home = tmp_path / "home"
    home.mkdir()
    (home / "part.x3p").touch()

    def run(words, *lines, **variables):
        if shutil.which(words[0]) is None:
            pytest.skip(f"{words[0]} is not one of the choices")
        path = f"{program.parent}{os.pathsep}{os.environ['PATH']}"
        environment = os.environ | {"HOME": str(home), "PATH": path, **variables}
        command = [*words, "-c", "\n".join(lines)]
        answer = subprocess.run(
            command,
            capture_output=True,
            encoding="utf-8",
            env=environment,
            cwd=home,
            timeout=120,
            check=False,
        )
        assert answer.returncode == 0, answer.stderr
        return answer.stdout.splitlines()

    return run


STATED = {"_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION": "1"}  # the shell is named, not looked for


@POSIX
@pytest.mark.parametrize("start", ['eval "$(roughcontact --show-completion)"', ". ~/.bashrc"])
def test_bash_completes(shell, start):
    bash = "bash", "--norc"
    assert "completion installed in" in shell(bash, "roughcontact --install-completion; true")[0]
    told = shell(
        bash,
        start,
        "complete -p roughcontact",
        "COMP_WORDS=(roughcontact press part.x3p --materials steel,al) COMP_CWORD=4",
        'COMPREPLY=(); _roughcontact_completion roughcontact; echo "${COMPREPLY[@]}"',
        "COMP_WORDS=(roughcontact press pa) COMP_CWORD=2",
        'COMPREPLY=(); _roughcontact_completion roughcontact; echo "${#COMPREPLY[@]}"',
    )
    # Without a proposal bash proposes files, by "-o default".
    default = "complete -o default -F _roughcontact_completion roughcontact"
    assert told == [default, "steel,aluminium", "0"]


@POSIX
def test_zsh_completes(shell):
    told = shell(
        ["zsh", "-f"],
        "autoload -Uz compinit; compinit -u -D",
        'eval "$(roughcontact --show-completion zsh)"',
        '_arguments() { print -r -- "$@" }; _files() { print files }',
        "words=(roughcontact press part.x3p --materials st); CURRENT=5; $_comps[roughcontact]",
        "words=(roughcontact press pa); CURRENT=3; $_comps[roughcontact]",
        **STATED,
    )
    assert told == ["""*: :(("steel" "stainless-steel"))""", "files"]


@POSIX
def test_fish_completes(shell):
    told = shell(
        ["fish", "--no-config"],
        "roughcontact --show-completion fish | source",
        'complete -C"roughcontact press part.x3p --materials st"',
        'complete -C"roughcontact press pa"',
        **STATED,
    )
    assert told == ["stainless-steel", "steel", "part.x3p"]
