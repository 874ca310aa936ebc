"""The command ``theory``, and surfaces as they are specified."""

import json
import shlex
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from roughcontact.recipe.command import command_of
from roughcontact.recipe.job_calls import python_of
from roughcontact.recipe.jobs import calls_of
from roughcontact.recipe.written import read_job

JOINT = (
    "theory --sigma 1.2um,1.2um --slope 0.12,0.12 --materials aluminium,stainless-steel "
    "--pressures 1MPa,5MPa,10MPa --theory cmy,mikic --conductivity aluminium,stainless-steel"
)
SURFACE = "surface specified joint.npz --sigma 1.2um --slope 0.12 --hurst 0.8 --rolloff 64um --size 512um --periodic"


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def invoked(line):
        environment = {"COLUMNS": "500", "TERM": "dumb", "NO_COLOR": "1"}
        return CliRunner().invoke(app, shlex.split(line), env=environment)

    return invoked


def test_the_conductance_of_two_faces_is_printed(run):
    answer = run(JOINT)
    assert answer.exit_code == 0, answer.stderr
    assert "sigma 1.697 µm, mean absolute slope m 0.1697 (rms slope of a profile 0.2127)" in answer.stdout
    assert "hardness                 1.049 GPa, of aluminium" in answer.stdout
    assert "thermal conductivities   167 and 16.2 W/(m K)" in answer.stdout
    assert "resistivities" not in answer.stdout
    electrical = run(
        JOINT.replace("--conductivity aluminium,stainless-steel", "--resistivity 17nohm*m,copper")
    )
    assert "electrical resistivities   1.7e-08 and 1.678e-08 ohm m" in electrical.stdout
    assert "in vacuum: gas in the gap, films and radiation are not included" in answer.stdout
    rows = [line.split() for line in answer.stdout.splitlines() if line.strip().startswith("cmy")]
    # By hand, 1.25 k m/sigma (P/H)^0.95 in kW/m2/K: 4.982, 22.98, 44.40.
    assert [row[-1] for row in rows] == ["4.982", "22.98", "44.4"]


def test_the_answer_is_kept_repeated_and_done_by_the_printed_python(run):
    told = json.loads(run(f"{JOINT} --json").stdout)
    assert run(f"{JOINT} --out kept").exit_code == 0
    kept = json.loads(Path("kept/theory.json").read_text(encoding="utf-8"))
    assert {name: kept[name] for name in told} == told
    for file in ("kept", "kept/theory.nc"):
        assert "same numbers" in run(f"run {file}").stderr
    job = read_job(Path("kept/theory.json"))
    known = {}
    exec(python_of(calls_of(job)), known)
    column = "thermal_conductance_per_area"
    np.testing.assert_array_equal(known["table"][column].to_numpy().ravel(), told[column])
    assert command_of(job) == f"roughcontact {JOINT}"
    rows = pd.read_csv("kept/theory.csv", comment="#")
    assert rows["theory"].tolist() == ["cmy"] * 3 + ["mikic"] * 3
    with xarray.open_dataset("kept/theory.nc", engine="h5netcdf") as stored:
        np.testing.assert_array_equal(stored[column], known["table"][column])


def test_a_spectrum_that_is_settled_is_stated(run):
    answer = run(
        "theory --ra 1um --slope 0.1 --hurst 0.8 --rolloff 64um --modulus 57GPa --theory gw --pressures 1MPa"
    )
    law = rc.specified(ra=1e-6, slope=0.1, hurst=0.8, rolloff=64e-6).spectrum
    shortest = f"{law.short_cutoff * 1e6:.4g} µm"
    assert f"H 0.8, roll-off 64 µm, shortest wave {shortest}, Nayak's parameter" in answer.stdout
    assert "conductance" not in answer.stdout
    assert "Note: -" not in answer.stderr


def test_what_a_theory_does_not_say_is_a_dash(run):
    answer = run(
        "theory --sigma 1um --slope 0.1 --modulus 57GPa --hardness 1GPa --theory cmy --pressures 1MPa,1GPa"
    )
    assert answer.stdout.splitlines()[-1].split() == ["cmy", "1", "-", "-"]
    assert "Note: -: the theory does not predict this quantity" in answer.stderr


@pytest.mark.parametrize(
    ("more", "words", "right"),
    [
        (
            "--theory gw",
            "give --nayak, or --hurst and one of --rolloff",
            ["--nayak 20", "--hurst 0.8 --rolloff 64um"],
        ),
        (
            "--theory persson --hurst 0.8",
            "give one of --rolloff",
            ["--rolloff 64um", "--correlation-length 15um"],
        ),
        ("--theory cmy", "give --hardness, or both bodies as --materials", ["--hardness 1GPa"]),
    ],
)
def test_the_number_that_is_missing_is_named_and_does(run, more, words, right):
    line = f"theory --sigma 1.2um --slope 0.12 --modulus 57GPa --pressures 1MPa {more}"
    answer = run(line)
    assert answer.exit_code == 2
    assert words in answer.stderr
    for each in right:
        assert run(f"{line} {each}").exit_code == 0


def test_a_joint_has_no_total_conductance(run):
    answer = run(f"{JOINT} --of total")
    assert answer.exit_code == 2
    assert "leave out --of" in answer.stderr


def test_a_surface_is_made_as_it_is_specified(run):
    answer = run(f"{SURFACE} --points 268 --json")
    assert answer.exit_code == 0, answer.stderr
    record, surface = json.loads(answer.stdout), rc.read("joint.npz")
    assert record["rms"] == pytest.approx(1.2e-6, rel=1e-12)
    assert any("its waves have the mean slope 0.12" in line for line in surface.provenance)
    coarse = run(f"{SURFACE} --points 64")
    assert coarse.exit_code == 2
    assert "give it four cells: 268 x 268 points on the same sides" in coarse.stderr
