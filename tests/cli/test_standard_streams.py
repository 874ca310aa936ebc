"""Surfaces by pipes: ``-`` is standard input and output, as .npz, and in another format with its name in front."""

import io
import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from roughcontact.cli.saving import require_output

MADE = ("--hurst", "0.8", "--rms", "1um", "--size", "1mm", "--points", "16", "--periodic")
LOAD = ("--pressure", "10kPa", "--modulus", "1GPa")


def piped(words, data=b""):
    return CliRunner().invoke(app, list(words), input=data)


def made(name="-", *more):
    answer = piped(("surface", "make", name, *MADE, *more))
    assert answer.exit_code == 0
    return answer.stdout_bytes


def test_a_surface_goes_through_pipes_whole(tmp_path):
    assert piped(("surface", "make", str(tmp_path / "r.npz"), *MADE)).exit_code == 0
    answer = piped(("surface", "prepare", "-", "nc:-", "--level", "mean"), made())
    assert "file" in answer.stderr  # the answer for people, beside the surface
    (tmp_path / "p.nc").write_bytes(answer.stdout_bytes)
    there, here = rc.read(tmp_path / "p.nc"), rc.read(tmp_path / "r.npz").levelled("mean")
    assert np.array_equal(there.heights, here.heights)
    assert there.grid == here.grid


def test_quiet_makes_a_surface_without_a_word():
    assert piped(("surface", "make", "-", *MADE, "-q")).stderr == ""


def test_what_was_piped_is_pressed_and_named_by_its_fingerprint(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    first, second = made(), made("-", "--seed", "2")
    record = json.loads(piped(("press", "-", *LOAD, "--json", "--out", "o"), first).stdout)
    assert record["file"] == record["recipe"]["source"]["file"] == "-"
    again = piped(("run", "o"), first)
    assert (again.exit_code, "same numbers" in again.stderr) == (0, True)
    other = piped(("run", "o"), second)
    assert other.exit_code == 2
    assert "its SHA-256 differs" in other.stderr


@pytest.mark.parametrize(
    ("words", "data", "message"),
    [
        (
            ("surface", "info", "-"),
            b"",
            "-: standard input is empty; check whether the command before",
        ),
        (("surface", "info", "-"), b"1 2 3\n", "-: it is not .npz; name its format, such as x3p:-"),
        (("surface", "make", "bmp:-", *MADE), b"", "cannot write bmp:-: a Surface is written as one of .npz"),
        (("surface", "make", "-", *MADE, "--json"), b"", "--json and the surface would both go to standard"),
        (
            ("surface", "make", "--out", "-", *MADE),
            b"",
            "--out: this command has no such option; write only its value",
        ),
    ],
)
def test_what_cannot_be_piped_is_refused(words, data, message):
    answer = piped(words, data)
    assert answer.exit_code == 2
    assert answer.stderr.startswith(f"Error: {message}")


def test_a_text_is_read_where_its_format_is_named():
    answer = piped(("surface", "info", "txt:-", "--json"), made("txt:-"))
    assert json.loads(answer.stdout)["shape"] == [16, 16]


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_terminal_is_no_pipe(monkeypatch):
    monkeypatch.setattr("sys.stdin", Terminal())
    with pytest.raises(
        rc.InputError, match="-: standard input is a terminal; pipe a surface into the command"
    ):
        rc.read("-")
    monkeypatch.setattr("sys.stdout", Terminal())
    with pytest.raises(rc.InputError, match="pipe the surface into another command, or name a file"):
        require_output(Path("-"))
