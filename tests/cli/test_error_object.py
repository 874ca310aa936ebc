"""Who asks for JSON gets JSON where the answer fails, too: one object on standard output."""

import json
import subprocess
import sys

import pytest

import roughcontact as rc
from roughcontact.cli.error_object import remedy_in

PROGRAM = [sys.executable, "-m", "roughcontact"]
MODULUS = ("--modulus", "1GPa")


def error_of(answer):
    """Return the one error that stands on standard output."""
    [line] = answer.stdout.splitlines()
    record = json.loads(line)
    assert record.keys() == {"error"}
    error = record["error"]
    assert error.keys() == {"kind", "message", "remedy", "exit_status"}
    return error


@pytest.mark.parametrize(
    ("words", "kind", "message", "remedy"),
    [
        (
            ("press", "FILE", *MODULUS),
            "usage",
            "give one load (--force or --pressure or --depth)",
            "give one load (--force or --pressure or --depth)",
        ),
        (
            ("press", "missing.x3p", "--force", "1N", *MODULUS),
            "read",
            "missing.x3p: ",
            "",
        ),
        (
            ("curve", "FILE", "--forces", "1N,2N", "--pressures", "1Pa,2Pa", *MODULUS),
            "usage",
            "--forces and --pressures exclude each other: give one of them",
            "give one of them",
        ),
        (
            ("press", "FILE", "--force", "1N", *MODULUS, "--out", "FILE"),
            "write",
            "is a file; choose another name",
            "choose another name",
        ),
        (("press", "FILE", "--depth", "1m", *MODULUS, "--periodic"), "value", "give a smaller depth", None),
        (("surface", "info", "missing.x3p"), "read", "missing.x3p", ""),
        (("surface", "spectrum", "missing.x3p"), "read", "missing.x3p", ""),
        (("surface", "prepare", "FILE", "out.xyz"), "write", "out.xyz", None),
        (("surface", "make", "a.npz", "--hurst", "9", "--rms", "1um", "--size", "1mm"), "value", "", None),
        (("conductance", "FILE"), "usage", "give --resistivity", ""),
        (("study", "run", "none.toml"), "study", "none.toml: No such file", ""),
        (("study", "status", "nowhere"), "store", "nowhere: there is no study.toml", "name the folder that"),
        (("study", "export", "nowhere", "--out", "a.nc"), "store", "nowhere", "name the folder that"),
        (("study", "average", "nowhere", "--out", "a.nc"), "store", "nowhere", "name the folder that"),
        (("study", "plot", "nowhere", "--out", "a.png"), "store", "nowhere", "name the folder that"),
        (("study", "table", "nowhere"), "store", "nowhere", "name the folder that"),
    ],
)
def test_each_command_answers_with_an_error(
    invoke, rough, tmp_path, monkeypatch, words, kind, message, remedy
):
    monkeypatch.chdir(tmp_path)
    answer = invoke(*(rough if word == "FILE" else word for word in words), "--json")
    assert answer.exit_code == 2
    error = error_of(answer)
    assert (error["kind"], error["exit_status"]) == (kind, 2)
    assert message in error["message"]
    assert f"Error: {error['message']}" in answer.stderr  # the line for people stays where it is
    if remedy is not None:
        assert error["remedy"].startswith(remedy)
        assert error["message"].endswith(error["remedy"])


def test_without_json_standard_output_stays_empty(invoke, rough):
    answer = invoke("press", rough, *MODULUS)
    assert (answer.exit_code, answer.stdout) == (2, "")


def test_an_interrupt_is_an_error_too(invoke, rough, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(rc, "press", interrupted)
    answer = invoke("press", rough, "--force", "1mN", *MODULUS, "--json")
    assert answer.exit_code == 130
    assert (error_of(answer)["kind"], error_of(answer)["exit_status"]) == ("interrupted", 130)


def test_no_room_in_memory_is_an_error_too(invoke, rough, monkeypatch):
    def full(*_, **__):
        raise MemoryError

    monkeypatch.setattr(rc, "press", full)
    error = error_of(invoke("press", rough, "--force", "1mN", *MODULUS, "--json"))
    assert (error["kind"], error["remedy"]) == ("memory", "use fewer points, or another machine")


def call(words):
    return subprocess.run([*map(str, words)], capture_output=True, encoding="utf-8", timeout=120, check=False)


def test_a_misspelt_option_is_an_error_too(rough):
    answer = call([*PROGRAM, "press", rough, "--forec", "1N", "--json"])
    assert answer.returncode == 2
    error = error_of(answer)
    assert (error["kind"], error["exit_status"]) == ("usage", 2)
    assert "--forec" in error["message"]
    assert "Traceback" not in answer.stderr


def test_a_mistake_of_ours_is_an_error_too(rough):
    broken = "import sys, roughcontact as rc; rc.press = None; from roughcontact.cli.main import run; run()"
    answer = call([sys.executable, "-c", broken, "press", rough, "--force", "1N", *MODULUS, "--json"])
    assert answer.returncode == 70
    error = error_of(answer)
    assert (error["kind"], error["exit_status"]) == ("mistake", 70)
    assert error["message"].startswith("TypeError: ")
    assert "Traceback" in answer.stderr


def test_an_answer_ends_as_without_json(rough):
    words = [*PROGRAM, "press", rough, "--force", "1mN", *MODULUS, "--json"]
    answer = call(words)
    assert answer.returncode == 0
    assert json.loads(answer.stdout)["command"] == "press"
    assert call([*words, "--help"]).returncode == 0


@pytest.mark.parametrize(
    ("message", "remedy"),
    [
        ("a file; choose another name", "choose another name"),
        (
            "two loads: give one of them, or none: leave out --depth",
            "give one of them, or none: leave out --depth",
        ),
        ("give the unit", "give the unit"),
        ("there is no 'sample': did you mean 'samples'?", None),
        ("the gives and takes: nothing", None),
        ("giver: none", None),
    ],
)
def test_the_remedy_is_the_end_that_says_what_to_do(message, remedy):
    assert remedy_in(message) == remedy
