import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import pytest
import xarray

from roughcontact.study.store import Store
from roughcontact.study.study import Study
from study import trial

TESTS = Path(__file__).parents[1]
TEXT = """
name = "tried"
case = "study.trial:CASE"
samples = 3

[parameters]
size = "1 mm"

[table]
hurst = [0.1, 0.2]
"""
PATIENCE = 240  # [s], of a busy machine
# A shell that starts a job in the background makes it deaf to Ctrl-C; a person's does not.
PROGRAM = (
    "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
    "from roughcontact.cli.main import run; run()"
)


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Return a folder to work in that holds a study."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tried.toml").write_text(TEXT)
    return tmp_path


def with_failures(here):
    (here / "tried.toml").write_text(TEXT + 'end = ["well", "error"]')


def run(invoke, *arguments):
    return invoke("study", "run", *arguments, "--executor", "serial")


def test_a_study_is_run_looked_at_enlarged_and_exported(invoke, here):
    answer = run(invoke, "tried.toml")
    assert answer.exit_code == 0
    assert "cases    6 (2 combinations, 3 samples of each)" in answer.stdout
    assert "done     6" in answer.stdout
    assert "left     0" in invoke("study", "status", "tried").stdout

    answer = invoke("study", "add", "tried", "--samples", "5")
    assert answer.exit_code == 0
    assert "left     4" in answer.stdout
    assert "Note: to compute them: roughcontact study run tried" in answer.stderr
    assert "done     10" in run(invoke, "tried").stdout

    answer = invoke("study", "export", "tried", "--out", "all.nc")
    assert answer.exit_code == 0
    assert answer.stderr == ""
    with xarray.open_dataset(here / "all.nc") as dataset:
        assert dataset["stiffness"].sizes == {"hurst": 2, "sample": 5, "load": 4}
        assert "roughcontact" in dataset.attrs["source"]
    assert invoke("study", "export", "tried", "--out", "all.csv").exit_code == 0
    lines = [line for line in (here / "all.csv").read_text().splitlines() if not line.startswith("#")]
    assert len(lines) == 1 + 2 * 5 * 4


def test_one_json_object_for_programs(invoke, here):
    with_failures(here)
    told = json.loads(run(invoke, "tried.toml", "--out", "there", "--json").stdout)
    assert told.pop("seconds") > 0
    assert told == {"study": "tried", "folder": "there", "samples": 3, "done": 6, "failed": 6, "left": 0}
    assert json.loads(invoke("study", "status", "there", "--json").stdout) == told
    failures = json.loads(invoke("study", "status", "there", "--json", "--failed").stdout)["failures"]
    assert [each["sample"] for each in failures] == [0, 0, 1, 1, 2, 2]
    assert failures[0]["parameters"]["end"] == "error"
    assert failures[0]["message"].startswith("ArithmeticError: no contact at 0.1")
    assert len(failures[0]["key"]) == 64
    file = json.loads(invoke("study", "export", "there", "--out", "a.nc", "--json").stdout)
    assert file == told | {"file": "a.nc"}
    more = json.loads(invoke("study", "add", "there", "--samples", "4", "--json").stdout)
    assert more == told | {"samples": 4, "left": 4}


def test_failed_cases_are_listed_and_tried_again(invoke, here, monkeypatch):
    with_failures(here)
    answer = run(invoke, "tried.toml")
    assert answer.exit_code == 1
    assert (
        "Note: 6 cases failed; list their errors by: roughcontact study status tried --failed"
        in answer.stderr
    )
    listed = invoke("study", "status", "tried", "--failed").stdout
    assert listed.count("ArithmeticError: no contact") == 6
    assert "sample 2, hurst = 0.2, size = 0.001" in listed
    assert "ArithmeticError" not in invoke("study", "status", "tried").stdout
    answer = invoke("study", "export", "tried", "--out", "all.nc")
    assert "Note: 6 cases failed and 0 are left: they are missing in all.nc" in answer.stderr

    monkeypatch.setattr(trial, "fail", lambda parameters: None)
    assert run(invoke, "tried").exit_code == 1
    answer = run(invoke, "tried", "--retry")
    assert answer.exit_code == 0
    assert "failed   0" in answer.stdout


def test_cases_of_the_current_folder_are_found(invoke, here):
    (here / "own_cases.py").write_text("from study.trial import *\n")
    (here / "tried.toml").write_text(TEXT.replace("study.trial", "own_cases"))
    path = list(sys.path)
    assert run(invoke, "tried.toml").exit_code == 0
    assert sys.path == path
    assert invoke("study", "run", "tried.toml", "--out", "again", "--workers", "1").exit_code == 0


def test_a_study_file_in_its_results_means_these_results(invoke, here):
    run(invoke, "tried.toml", "--out", "results")
    answer = run(invoke, "results/study.toml")
    assert "folder   results" in answer.stdout
    assert not (here / "tried").exists()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["run", "none.toml"], "none.toml: No such file or directory; name the file of a study"),
        (["run", "."], "there is no study.toml in .: name the folder of the results of a study"),
        (["run", "bad.toml"], "bad.toml: sample: there is no 'sample': did you mean 'samples'?"),
        (
            ["run", "tried.toml", "--scheduler", "tcp://a:1"],
            "--scheduler: only --executor dask has a scheduler",
        ),
        (
            ["run", "tried.toml", "--executor", "serial", "--workers", "2"],
            "--workers: --executor serial computes one",
        ),
        (
            ["run", "tried.toml", "--executor", "dask", "--scheduler", "a", "--workers", "2"],
            "leave out --workers or --scheduler",
        ),
        (["run", "tried.toml", "--out", "tried.toml"], "cannot be created: File exists"),
        (["status", "nowhere"], "nowhere: there is no study.toml in it; name the folder"),
        (["export", "nowhere", "--out", "a.nc"], "there is no study.toml in it"),
        (
            ["export", "nowhere", "--out", "a.xlsx"],
            "--out: cannot write a.xlsx; give a file .nc (NetCDF) or .csv",
        ),
        (["export", "nowhere", "--out", "no/a.nc"], "there is no folder"),
        (["add", "nowhere", "--samples", "3"], "nowhere: No such file or directory"),
        (
            ["add", "nowhere", "--samples", "0"],
            "--samples: the number of samples must be a whole number from 1 up",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(invoke, here, arguments, complaint):
    (here / "bad.toml").write_text(TEXT.replace("samples", "sample"))
    answer = invoke("study", *arguments)
    assert answer.exit_code == 2
    assert complaint in " ".join(answer.stderr.split())
    assert "Traceback" not in answer.stderr
    assert answer.stdout == ""


def test_what_a_folder_refuses_is_told(invoke, here):
    run(invoke, "tried.toml")
    refused = run(invoke, "tried", "--out", "other")
    assert "tried is the folder of the results itself; leave out --out" in refused.stderr
    assert (
        "the study already has 3 samples; give more, not 3"
        in invoke("study", "add", "tried", "--samples", "3").stderr
    )
    (here / "tried.toml").write_text(TEXT.replace("samples = 3", "samples = 3\nseed = 1"))
    refused = run(invoke, "tried.toml")
    assert refused.exit_code == 2
    assert (
        "Error: tried: it holds results of a study with the seed 0, not 1; choose another folder"
        in refused.stderr
    )
    with Store.open("tried", Study.read("tried/study.toml")):
        refused = run(invoke, "tried")
        assert refused.exit_code == 2
        assert "another process is running a study in this folder; wait until it ends" in refused.stderr
        assert invoke("study", "status", "tried").exit_code == 0
    with sqlite3.connect("tried/cases.sqlite") as database:
        database.execute("PRAGMA user_version = 9")
    database.close()
    assert "has version 9, but this roughcontact reads version 1" in invoke("study", "status", "tried").stderr


def test_a_study_without_results_is_not_exported(invoke, here):
    (here / "tried.toml").write_text(TEXT.replace("[0.1, 0.2]", "[0.1]\nend = ['error']"))
    run(invoke, "tried.toml")
    answer = invoke("study", "export", "tried", "--out", "a.nc")
    assert answer.exit_code == 2
    assert "tried holds no results yet: roughcontact study run tried" in answer.stderr
    assert not (here / "a.nc").exists()


@pytest.fixture
def started(here):
    """Return a function that starts a slow study as a program of its own, and returns once it has results."""
    (here / "tried.toml").write_text(TEXT.replace('"1 mm"', '"1 mm"\nseconds = 0.5').replace("= 3", "= 20"))
    processes = []

    def start(*options):
        process = subprocess.Popen(
            [sys.executable, "-c", PROGRAM, "study", "run", "tried.toml", *options],
            env=os.environ | {"PYTHONPATH": str(TESTS)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        processes.append(process)
        end = time.monotonic() + PATIENCE
        while not (here / "tried" / "study.toml").exists() or not done():
            assert process.poll() is None, process.stderr.read()
            assert time.monotonic() < end
            time.sleep(0.2)
        return process

    yield start
    for process in processes:
        process.kill()
        process.communicate()


def done():
    with Store.open("tried") as store:
        return store.summary().done


@pytest.mark.parametrize(
    ("number", "status", "words", "options"),
    [
        (signal.SIGINT, 130, "Stopped; every finished case is stored.", ["--executor", "serial"]),
        (signal.SIGINT, 130, "Stopped; every finished case is stored.", ["--workers", "2"]),
        (signal.SIGTERM, 143, "Every finished case is stored.", ["--executor", "serial"]),
    ],
)
def test_stopped_it_says_how_to_go_on(started, invoke, monkeypatch, number, status, words, options):
    process = started(*options)
    process.send_signal(number)
    out, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == status
    assert out == ""
    assert f"{words} To go on: {' '.join(['roughcontact study run tried', *options])}" in err
    assert "Traceback" not in err
    assert 0 < done() < 40
    monkeypatch.setattr(trial, "wait", lambda seconds: None)
    assert "done     40" in run(invoke, "tried").stdout


@pytest.mark.parametrize(
    ("number", "status", "kind"), [(signal.SIGINT, 130, "interrupted"), (signal.SIGTERM, 143, "terminated")]
)
def test_stopped_it_says_so_in_one_json_object_too(started, number, status, kind):
    process = started("--executor", "serial", "--json")
    process.send_signal(number)
    out, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == status
    error = json.loads(out)["error"]
    assert (error["kind"], error["exit_status"]) == (kind, status)
    assert error["remedy"] == "roughcontact study run tried --executor serial"
    assert f"very finished case is stored. To go on: {error['remedy']}" in err
    assert "Traceback" not in err
    assert 0 < done() < 40


def test_killed_with_its_workers_at_work_it_can_go_on(started, invoke, monkeypatch):
    process = started("--workers", "2")
    refused = run(invoke, "tried")
    assert "another process is running a study in this folder" in refused.stderr
    process.kill()
    process.communicate(timeout=PATIENCE)
    assert 0 < done() < 40
    monkeypatch.setattr(trial, "wait", lambda seconds: None)
    assert "done     40" in run(invoke, "tried").stdout
