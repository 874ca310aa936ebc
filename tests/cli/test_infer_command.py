"""The command ``infer``: tables of each quantity, the printed answer, files, and the same answer once more."""

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
from roughcontact.recipe.written import from_plain, read_job

P = np.array([7.0, 15.0, 30.0, 65.0, 140.0])  # MPa
K = 1.9e7 * (1e6 * P) ** 0.88 / 1e12  # N/um/mm^2
LINE = "infer joint.csv --modulus 115GPa --area '2cm^2' --branch loading"
FACES = "--rms 1.15um --rms-error 10% --rolloff 100um --rolloff-error 30%"


def table(name, header, *columns):
    rows = "".join(", ".join(f"{value:.12g}" for value in row) + "\n" for row in np.transpose(columns))
    Path(name).write_text(f"{header}\n{rows}")


@pytest.fixture
def run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    table("joint.csv", "pressure [MPa], stiffness [N/um/mm^2], error [%]", P, K, np.full(5, 5.0))
    environment = {"COLUMNS": "500", "TERM": "dumb", "NO_COLOR": "1"}
    return lambda line: CliRunner().invoke(app, shlex.split(line), env=environment)


def record(answer):
    assert answer.exit_code == 0, answer.stderr
    return json.loads(answer.stdout)


def test_the_answer_is_that_of_the_library(run):
    found = rc.infer_joint(
        rc.JointStiffness(1e6 * P, 1e12 * K, 0.05, gain=0.03),
        modulus=115e9,
        modulus_error=0.02,
        area=2e-4,
        branch="loading",
    )
    told = record(run(f"{LINE} --gain 3% --json"))
    # Twelve digits of the table, in draws of a posterior a hundredth as wide as the height.
    assert told["effective_height"] == pytest.approx(found.effective_height, rel=1e-8)
    for level in (50, 90):
        ends = [told[f"effective_height_{end}_{level}"] for end in ("low", "high")]
        assert ends == pytest.approx(found.interval(level / 100), rel=1e-8)
    assert told["fits"]
    assert [each["name"] for each in told["parameters"]] == ["rms", "rolloff", "hurst", "band", "modulus"]
    assert [each["informed"] for each in told["parameters"]] == [each.informed for each in found.parameters]
    assert told["notes"] == list(found.notes)
    assert told["units"]["predicted"] == "Pa m-1"
    printed = run(f"{LINE} --gain 3%").stdout
    assert "measured                 stiffness at 5 loads, 7 MPa to 140 MPa, on loading" in printed
    assert "the model fits" in printed
    [hurst] = [line for line in printed.splitlines() if "Hurst" in line]
    assert hurst.endswith("no information")
    assert "no information" not in next(line for line in printed.splitlines() if "rms height" in line)


def test_every_quantity_of_one_joint_gives_its_height(run):
    """K, the closure int dp/K and the reflection of the same K: the widths of the heights overlap."""
    p, k = 1e6 * P, 1e12 * K
    table("closure.csv", "pressure [MPa]; closure [um]", P, 1e6 * p**0.12 / 0.12 / 1.9e7 + P * 1e-4)
    steel, aluminium = (rc.handbook(each).impedance for each in ("steel", "aluminium"))
    wave = abs(rc.theory.ultrasound.reflection(k, 5e5, (steel, aluminium)))
    table("echo.csv", "pressure [MPa], reflection", P[1:], wave[1:])
    Path("closure.csv").write_text(Path("closure.csv").read_text().replace(",", ";"))
    given = LINE.removeprefix("infer joint.csv")
    closure = f"infer closure.csv {given} --quantity closure --resolution 5nm --compliance 1e-16m/Pa"
    echo = f"infer echo.csv {given} --quantity reflection --errors 0.002 --frequency 0.5MHz"
    heights = [
        record(run(f"{line} --json"))["effective_height"]
        for line in (LINE, closure, f"{echo} --impedance steel,aluminium")
    ]
    assert max(heights) < 1.1 * min(heights)
    assert "--impedance" in run(echo).stderr
    materials = echo.replace("--modulus 115GPa", "--materials steel,aluminium")
    # K ~ E* h^-0.9 p^0.9 l^-0.1 E*^-0.9: half of E* changes the height little, by its power 0.1.
    assert record(run(f"{materials} --json"))["effective_height"] == pytest.approx(heights[2], rel=0.15)


def test_what_no_joint_does_is_an_answer(run):
    bodies = 1 / (1 / K + 1 / 50)  # K of an assembly with its bodies inside
    table("joint.csv", "pressure [MPa], stiffness [N/um/mm^2]", P, bodies)
    answer = run(f"{LINE} --errors 2%")
    assert answer.exit_code == 0
    assert "not this model, by the " in answer.stdout
    assert "effective height" not in answer.stdout
    assert "parameter" not in answer.stdout
    assert "Bodies or a machine in series" in answer.stderr
    told = record(run(f"{LINE} --errors 2% --json"))
    assert not told["fits"]
    assert told["effective_height"] is None
    assert told["parameters"] == []


def test_whether_it_is_the_joint_of_a_topography(run):
    assert "the model fits" in run(f"{LINE} {FACES}").stdout
    smoother = run(f"{LINE} {FACES.replace('1.15um', '0.6um')}")
    assert "not this model, by the level" in smoother.stdout
    assert "not the joint of this topography" in smoother.stderr


def test_one_load_gives_a_height_only(run):
    table("joint.csv", "p [MPa], K [N/um/mm^2]", P[:1], K[:1])
    printed = run(f"{LINE} --errors 5%").stdout
    assert "effective height" in printed
    assert "parameter" not in printed


@pytest.mark.usefixtures("drawn")
def test_the_answer_is_kept_repeated_and_done_by_the_printed_python(run):
    told = record(run(f"{LINE} {FACES} --json"))
    assert run(f"{LINE} {FACES} --out kept").exit_code == 0
    kept = json.loads(Path("kept/inference.json").read_text(encoding="utf-8"))
    moved = {"recipe", "file"}
    assert {name: kept[name] for name in told if name not in moved} == {
        name: value for name, value in told.items() if name not in moved
    }
    assert kept["recipe"]["source"] == told["recipe"]["source"] | {"file": "../joint.csv"}
    for file in ("kept", "kept/inference.nc"):
        assert "same numbers" in run(f"run {file}").stderr
    job = from_plain(told["recipe"])
    known = {}
    exec(python_of(calls_of(job)), known)
    assert known["inference"].effective_height == told["effective_height"]
    assert command_of(job) == f"roughcontact {LINE} {FACES}"
    rows = pd.read_csv("kept/inference.csv", comment="#")
    np.testing.assert_array_equal(rows["predicted [Pa m-1]"], told["predicted"])
    with xarray.open_dataset("kept/inference.nc", engine="h5netcdf") as stored:
        assert stored["posterior"].dims == ("parameter", "share")
        assert stored.attrs["fits"] == "true"
    assert Path("kept/inference.png").stat().st_size > 0
    Path("joint.csv").write_text(Path("joint.csv").read_text() + "200, 400, 5\n")
    assert "is not the file that the recipe was written for" in run("run kept").stderr
    assert read_job(Path("kept/inference.json")).joint.branch == "loading"


def test_a_plan_is_that_of_the_library_and_needs_pressures_only(run):
    Path("loads.csv").write_text("pressure [MPa]\n" + "".join(f"{each:g}\n" for each in P))
    line = f"infer loads.csv {LINE.removeprefix('infer joint.csv')} {FACES} --errors 5% --gain 3%"
    plan = rc.plan_joint(
        1e6 * P,
        errors=0.05,
        gain=0.03,
        modulus=115e9,
        modulus_error=0.02,
        areas=2e-4 * np.array([1, 2, 4, 8]),
        profile=rc.JointTopography(1.15e-6, 0.1, 1e-4, 0.3),
    )
    told = record(run(f"{line} --plan 6% --json"))
    assert told["width"] == pytest.approx(plan.width, rel=1e-9)
    assert told["width_without"] == pytest.approx(plan.without, rel=1e-9)
    area, number = plan.reaching(0.06)
    assert told["reached"] == pytest.approx({"area": area, "number": number})
    printed = run(f"{line} --plan 6% --out kept").stdout
    assert "1 joint of 200 mm" in printed
    rows = pd.read_csv("kept/inference.csv", comment="#")
    assert rows.shape == (20, 3)
    assert rows.filter(like="width").to_numpy().reshape(4, 5) == pytest.approx(plan.width, rel=1e-9)
    assert run("run kept").exit_code == 0
    assert "none of these" in run(f"{line} --plan 1%").stdout
    assert record(run(f"{line} --plan 1% --json"))["reached"] is None


def test_the_hardness_is_a_parameter_and_explains_what_does_not_fit(run):
    told = record(run(f"{LINE} --hardness 2GPa --hardness-error 10% --json"))
    assert told["parameters"][-1]["name"] == "hardness"
    soft = FACES.replace("1.15um", "0.8um").replace("--rms-error 10%", "--rms-error 5%")
    told = record(run(f"{LINE} {soft} --json"))
    assert not told["fits"]
    assert {each["name"] for each in told["explanations"]} == {"carrying", "hardness"}
