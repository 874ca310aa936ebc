"""The reflection of ultrasound in the command `curve`: on the screen, as JSON and in files."""

import csv
import json
import tomllib

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import REFLECTION

NAMES = names_of(REFLECTION)
GIVEN = ("--materials", "steel,aluminium", "--pressures", "10MPa,100MPa")
SOUND = ("--frequency", "5MHz")


@pytest.fixture
def joint(tmp_path):
    grid = rc.Grid((64, 64), 4e-6, periodic=True)
    rng = np.random.default_rng(1)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rolloff=64e-6, short_cutoff=32e-6, rng=rng)
    rc.write(surface, tmp_path / "joint.npz")
    return tmp_path / "joint.npz"


def wanted(joint, **given):
    curve = rc.loading_curve(
        rc.read(joint).levelled("auto"), ("steel", "aluminium"), pressures=[1e7, 1e8], **given
    )
    return rc.reflection(curve, ("steel", "aluminium"), 5e6)


def test_json_and_files_have_the_columns_of_the_library(invoke, joint, tmp_path):
    answer = invoke("curve", joint, *GIVEN, *SOUND, "--json", "--out", tmp_path / "out")
    assert answer.exit_code == 0, answer.stderr
    record, seen = json.loads(answer.stdout), wanted(joint)
    with xarray.open_dataset(tmp_path / "out" / "curve.nc", engine="h5netcdf") as stored:
        for name in NAMES:
            assert record[name] == seen[name].tolist()
            np.testing.assert_array_equal(stored[name], seen[name])
    lines = (tmp_path / "out" / "curve.csv").read_text(encoding="utf-8").splitlines()
    rows = [*csv.DictReader(line for line in lines if not line.startswith("#"))]
    assert [float(row["reflection"]) for row in rows] == seen["reflection"].tolist()
    assert [float(row["best_frequency [Hz]"]) for row in rows] == seen["best_frequency"].tolist()
    assert record["units"]["best_frequency"] == "Hz"
    assert record["measurable"] == [False, True]
    assert any("At 1 of 2 loads K/A0 cannot be inferred" in note for note in record["notes"])
    assert record["recipe"]["ultrasound"] == {"frequency": "5MHz"}


def test_a_person_sees_where_the_stiffness_cannot_be_measured(invoke, joint):
    answer = invoke("curve", joint, *GIVEN, *SOUND)
    lines = answer.stdout.splitlines()
    at = next(k for k, line in enumerate(lines) if "best frequency [MHz]  K/A0 measurable" in line)
    assert [line.split()[-1 if "resolved" not in line else -3] for line in lines[at + 1 : at + 3]] == [
        "no",
        "yes",
    ]
    assert "impedances" in answer.stdout
    assert "46 and 16.6 MPa s/m" in answer.stdout
    assert "beam" in answer.stdout
    assert "2.56 mm or wider" in answer.stdout  # ten sides of the map
    assert "by the stiffness on unloading" not in answer.stdout
    assert "K/A0 cannot be inferred from the reflection at 5 MHz" in answer.stderr
    silent = invoke("curve", joint, *GIVEN)
    assert "reflection" not in silent.stdout
    assert "K/A0 cannot" not in silent.stderr


def test_a_loop_has_the_reflection_of_first_loading_by_the_stiffness_on_unloading(invoke, joint):
    answer = invoke("curve", joint, *GIVEN, *SOUND, "--hardness", "aluminium", "--loop", "--json")
    assert answer.exit_code == 0, answer.stderr
    # Each stiffness is solved to 1e-8.
    found = json.loads(answer.stdout)["reflection"]
    assert found == pytest.approx(wanted(joint, hardness="aluminium")["reflection"].tolist(), rel=1e-7)
    told = invoke("curve", joint, *GIVEN, *SOUND, "--hardness", "aluminium").stdout
    assert "by the stiffness on unloading, because a small oscillation is elastic" in told
    assert "K/A0 on unloading [N/µm/mm²]" in told
    assert "K/A0 on unloading" not in invoke("curve", joint, *GIVEN, *SOUND).stdout


def test_another_frequency_does_not_press_again(invoke, joint, tmp_path, monkeypatch):
    out = ("--out", tmp_path / "out")
    assert invoke("curve", joint, *GIVEN, *out).exit_code == 0
    seen = wanted(joint)["reflection"].tolist()
    monkeypatch.setattr(
        "roughcontact.contact.loading.solutions_along", lambda *_, **__: pytest.fail("pressed")
    )
    answer = invoke("curve", joint, *GIVEN, *SOUND, *out)
    assert answer.exit_code == 0, answer.stderr
    assert json.loads((tmp_path / "out" / "curve.json").read_text())["reflection"] == seen


def test_the_job_is_printed_with_frequency_and_densities(invoke, joint):
    words = ("--frequency", "5MHz", "--density", "steel,2700kg/m^3")
    printed = tomllib.loads(invoke("curve", joint, *GIVEN, *words, "--print", "toml").stdout)
    assert printed["ultrasound"] == {"frequency": "5MHz", "density": "steel,2700kg/m^3"}
    python = invoke("curve", joint, *GIVEN, *words, "--print", "python").stdout
    assert (
        'rc.reflection(curve, ("steel", "aluminium"), 5000000.0, densities=(rc.handbook("steel").density, 2700.0))'
        in python
    )
