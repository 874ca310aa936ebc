"""A study file made of a job: it runs as it is, wherever the job, the maps and the study lie."""

import json
import tomllib

import pytest

import roughcontact as rc
from roughcontact.study.study import Study

JOB = """
job = "curve"
[source]
kind = "self-affine"
hurst = "0.8"
rms = "1um"
size = "1mm"
points = "16"
seed = "7"
[bodies]
modulus = "110GPa"
[loads]
forces = "1N,2N,4N"
[theories]
theory = "persson"
"""
PRESS = """
job = "press"
[source]
file = "part.npz"
[bodies]
modulus = "110GPa"
[load]
force = "10N"
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Return a folder to work in that holds two jobs, and two maps in a folder of theirs."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "job.toml").write_text(JOB)
    maps = tmp_path / "maps"
    maps.mkdir()
    (maps / "press.toml").write_text(PRESS)
    for number, name in enumerate(("part", "other")):
        rc.write(rc.self_affine(rc.Grid((16, 16), 1e-4), 0.8, 1e-6, rng=number), maps / f"{name}.npz")
    return tmp_path


@pytest.mark.usefixtures("drawn")
def test_a_study_of_a_job_runs(invoke, here):
    answer = invoke(
        *("study", "from", "job.toml", "--vary", "preparation.level=plane, quadratic"),
        *("--vary", "preparation.fill=true,false", "--samples", "3", "--out", "levels.toml"),
    )
    assert answer.exit_code == 0
    assert "cases   12 (4 combinations, 3 samples of each)" in answer.stdout
    assert "Note: each sample draws different random phases" in answer.stderr
    assert "Note: to compute them: roughcontact study run levels.toml" in answer.stderr
    written = tomllib.loads((here / "levels.toml").read_text())
    assert "seed" not in written["parameters"]["source"]
    assert "theories" not in written["parameters"]
    assert written["table"] == {
        "preparation.level": ["plane", "quadratic"],
        "preparation.fill": [True, False],
    }
    run = invoke("study", "run", "levels.toml", "--executor", "serial")
    assert "done     12" in run.stdout
    table = invoke("study", "table", "levels", "--quantity", "rms")
    assert "preparation.level" in table.stdout
    assert "quadratic" in table.stdout
    for file in ("all.nc", "all.csv"):
        assert invoke("study", "export", "levels", "--out", file).exit_code == 0
    assert invoke("study", "average", "levels", "--out", "mean.nc").exit_code == 0
    assert invoke("study", "plot", "levels", "--out", "levels.png").exit_code == 0


def test_files_are_named_from_where_the_study_is_written(invoke, here):
    (here / "studies").mkdir()
    answer = invoke(
        *("study", "from", "maps/press.toml", "--vary", "source.file=maps/part.npz,maps/other.npz"),
        *("--vary", "load.force=1N,10N", "--out", "studies/maps.toml", "--json"),
    )
    assert json.loads(answer.stdout) == {
        **{"command": "study from", "file": "studies/maps.toml", "combinations": 4, "samples": 1},
    }
    assert "random" not in answer.stderr
    written = tomllib.loads((here / "studies" / "maps.toml").read_text())
    assert written["table"]["source.file"] == ["../maps/part.npz", "../maps/other.npz"]
    assert set(written["files"]) == set(written["table"]["source.file"])
    assert invoke("study", "run", "studies/maps.toml", "--executor", "serial").exit_code == 0
    # Without a file among the values, that of the job.
    assert invoke("study", "from", "maps/press.toml", "--out", "one.toml").exit_code == 0
    assert Study.read("one.toml").parameters["source"]["file"] == "maps/part.npz"


def test_a_result_that_holds_its_recipe_starts_a_study(invoke, here):
    (here / "curve.json").write_text(json.dumps({"force": [1.0], "recipe": tomllib.loads(JOB)}))
    answer = invoke("study", "from", "curve.json", "--vary", "source.hurst=0.6,0.8", "--out", "hurst.toml")
    assert answer.exit_code == 0
    assert [each.recipe.source.hurst for each in Study.read("hurst.toml").combinations()] == ["0.6", "0.8"]


def test_semicolons_separate_values_that_hold_commas(invoke, here):
    vary = "loads.forces=1N,2N;1N:10N:3; 2N,"
    assert invoke("study", "from", "job.toml", "--vary", vary, "--out", "loads.toml").exit_code == 0
    assert Study.read("loads.toml").table["loads.forces"] == ("1N,2N", "1N:10N:3", "2N,")


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["none.toml"], "none.toml: it cannot be opened (No such file or directory)"),
        (
            ["job.toml", "--vary", "preparation.level"],
            "--vary: 'preparation.level' is not a field with values",
        ),
        (["job.toml", "--vary", "preparation.level="], "write preparation.level=plane,quadratic"),
        (["job.toml", "--vary", "=plane"], "is not a field with values"),
        (
            ["job.toml", "--vary", "preparation.level=plane", "--vary", "preparation.level=mean"],
            "--vary: preparation.level is given twice; name all of its values in one --vary",
        ),
        (
            ["job.toml", "--vary", "source.hurst=9,8"],
            "table.source.hurst: the Hurst exponent must lie between -1 and 3, not '9'",
        ),
        (
            ["job.toml", "--vary", "source.hurst=9,8", "--vary", "preparation.levl=plane"],
            "--vary: the job has no field 'preparation.levl'; did you mean preparation.level",
        ),
        (
            ["job.toml", "--vary", "hurst=0.5"],
            "--vary: the job has no field 'hurst'; did you mean source.hurst",
        ),
        (["job.toml", "--vary", "source=x"], "--vary: source is not a single value; choose from source."),
        (["job.toml", "--vary", "source.seed=1,2"], "leave seed out"),
        (["job.toml", "--vary", "source.points=16,16"], "a case appears twice"),
        (["maps/press.toml", "--samples", "2"], "--samples: the source of this job is not random"),
        (["maps/press.toml", "--vary", "source.file=no.npz"], "no.npz: No such file"),
    ],
)
def test_what_makes_no_sense_is_refused(invoke, here, words, complaint):
    answer = invoke("study", "from", *words, "--out", "study.toml")
    assert answer.exit_code == 2
    assert complaint in " ".join(answer.stderr.split())
    assert "Traceback" not in answer.stderr
    assert not (here / "study.toml").exists()


def test_the_study_needs_a_folder_to_be_written_in(invoke, here):
    answer = invoke("study", "from", "job.toml", "--out", "no/study.toml")
    assert answer.exit_code == 2
    assert "there is no folder" in answer.stderr
