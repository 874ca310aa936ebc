"""Who asks for JSON gets JSON where the answer fails, too: one object on standard output."""

import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import roughcontact as rc

PROGRAM = [sys.executable, "-m", "roughcontact"]
MODULUS = ("--modulus", "1GPa")
MADE = ("--hurst", "0.8", "--rms", "1um", "--size", "1mm")


def error_of(answer):
    """Return the one error that stands on standard output."""
    [line] = answer.stdout.splitlines()
    record = json.loads(line)
    assert record.keys() == {"error"}
    error = record["error"]
    assert error.keys() == {"kind", "message", "remedy", "place", "exit_status"}
    return error


WRONG = """
name = "w"
case = "curve"
[parameters]
points = 8
size = 1e-3
modulus = 1e9
hurst = 0.8
rms = 1e-6
hurts = 0.8
"""


@pytest.mark.parametrize(
    ("words", "kind", "message", "remedy", "place"),
    [
        (
            ("press", "FILE", *MODULUS),
            "usage",
            "--force, --pressure or --depth is required",
            "add one, such as --force 10N",
            "--force",
        ),
        (
            ("press", "missing.x3p", "--force", "1N", *MODULUS),
            "read",
            "missing.x3p: ",
            "check the path",
            "source",
        ),
        (
            ("curve", "FILE", "--forces", "1N,2N", "--pressures", "1Pa,2Pa", *MODULUS),
            "usage",
            "--forces and --pressures exclude each other",
            "give one of them",
            "--forces, --pressures",
        ),
        (
            ("press", "FILE", "--force", "1N", *MODULUS, "--out", "FILE"),
            "write",
            "is a file",
            "choose another name",
            None,
        ),
        (
            ("press", "FILE", "--depth", "1m", *MODULUS, "--periodic"),
            "value",
            "in full contact",
            "give a smaller depth",
            "--depth",
        ),
        (("surface", "info", "missing.x3p"), "read", "missing.x3p", "check the path", None),
        (("surface", "spectrum", "missing.x3p"), "read", "missing.x3p", "check the path", "source"),
        (
            ("press", "bare.npy", "--force", "1N", *MODULUS),
            "read",
            "bare.npy: it states",
            "pass --unit",
            "--unit, --size",
        ),
        (("surface", "prepare", "FILE", "out.xyz"), "write", "out.xyz", None, None),
        (
            ("surface", "make", "a.npz", *MADE, "--hurst", "9"),
            "usage",
            "the Hurst exponent must lie between -1 and 3",
            "give a number such as 0.8",
            "--hurst",
        ),
        (
            ("surface", "make", "a.npz", *MADE, "--seed", "x"),
            *("usage", "the seed must be a whole number from 0 up, not 'x'", "give one such as 2", "--seed"),
        ),
        (("conductance", "FILE"), "usage", "a conductance needs", "give --resistivity", None),
        (("study", "run", "none.toml"), "study", "none.toml: No such file", "name the file of a study", None),
        (("study", "run", "wrong.toml"), "study", "no parameter 'hurts'", None, "parameters.hurts"),
        (
            ("study", "status", "nowhere"),
            "store",
            "nowhere: there is no study.toml",
            "name the folder",
            "folder",
        ),
        (
            ("study", "export", "nowhere", "--out", "a.nc"),
            "store",
            "nowhere",
            "name the folder of",
            "folder",
        ),
        (
            ("study", "average", "nowhere", "--out", "a.nc"),
            "store",
            "nowhere",
            "name the folder of",
            "folder",
        ),
        (
            ("study", "plot", "nowhere", "--out", "a.png"),
            "store",
            "nowhere",
            "name the folder of",
            "folder",
        ),
        (("study", "table", "nowhere"), "store", "nowhere", "name the folder of", "folder"),
    ],
)
def test_each_command_answers_with_an_error(
    invoke, rough, tmp_path, monkeypatch, words, kind, message, remedy, place
):
    monkeypatch.chdir(tmp_path)
    np.save("bare.npy", np.eye(8))
    pathlib.Path("wrong.toml").write_text(WRONG)
    answer = invoke(*(rough if word == "FILE" else word for word in words), "--json")
    assert answer.exit_code == 2
    error = error_of(answer)
    assert (error["kind"], error["exit_status"]) == (kind, 2)
    assert message in error["message"]
    assert error["message"] in answer.stderr  # the line for people stays where it is
    if remedy is None:
        assert error["remedy"] is None
    else:
        assert error["remedy"].startswith(remedy)
        assert error["remedy"] not in error["message"]
        assert answer.stderr.endswith(f"{error['remedy']}\n")
    assert error["place"] == place


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
    assert error == {
        "kind": "usage",
        "message": "this command has no such option",
        "remedy": "did you mean --force or --free?",
        "place": "--forec",
        "exit_status": 2,
    }
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
