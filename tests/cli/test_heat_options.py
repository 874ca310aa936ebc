"""Gas, radiation and films along a curve, by options of the command."""

import json
import shlex

import numpy as np
import pytest

import roughcontact as rc
from tables import read_table

SIDE, CELLS = 192e-6, 48
HEAT = ("--conductivity", "50W/m/K,160W/m/K")
AIR = ("--gas", "air,1bar,20degC,alpha=0.9:0.9")


@pytest.fixture
def joint(tmp_path):
    """The map of tests/fluid/test_joint_conductance.py."""
    grid = rc.Grid((CELLS, CELLS), SIDE / CELLS, periodic=True)
    surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=1, rolloff=SIDE / 4, short_cutoff=SIDE * 3 / 48)
    rc.write(surface, tmp_path / "joint.npz")
    return tmp_path / "joint.npz"


@pytest.mark.parametrize(("gas", "beside"), [("air", (6678, 8000, 14770)), ("helium", (34660, 40210, 63350))])
def test_the_numbers_of_an_independent_code(invoke, joint, gas, beside):
    """As in tests/fluid/test_joint_conductance.py: spots to the printed digits, the properties of a gas to three."""
    loads = ("--pressures", "1MPa,10MPa,100MPa", "--modulus", "58.6GPa")
    answer = invoke("curve", joint, *loads, *HEAT, "--gas", f"{gas},101325Pa,300K,alpha=1", "--json")
    assert answer.exit_code == 0, answer.stderr
    record = json.loads(answer.stdout)
    np.testing.assert_allclose(record["spots_conductance_per_area"], [7542, 26830, 232600], rtol=3e-4)
    np.testing.assert_allclose(record["gas_conductance_per_area"], beside, rtol=2e-3)
    sums = np.add(record["spots_conductance_per_area"], record["gas_conductance_per_area"])
    np.testing.assert_allclose(record["joint_conductance_per_area"], sums, rtol=1e-14)  # the parts add
    assert record["thermal_conductance_per_area"] == pytest.approx(record["spots_conductance_per_area"])
    assert record["units"]["joint_conductance_per_area"] == "W m-2 K-1"
    assert max(record["conductance_interaction"]) < 0.2


@pytest.mark.usefixtures("drawn")
def test_files_and_screen_hold_the_parts(invoke, joint, tmp_path):
    out = tmp_path / "out"
    words = (
        "curve",
        joint,
        "--pressures",
        "100MPa,300MPa",
        "--modulus",
        "58.6GPa",
        "--conductivity",
        "0.5W/m/K",
        *AIR,
    )
    words += ("--emissivity", "0.2,0.3", "--film", "0.1mm^2*K/W", "--table", "csv")
    answer = invoke(*words, "--out", out)
    assert answer.exit_code == 0, answer.stderr
    for part in ("of the spots", "of the gas", "of radiation", "of the joint"):
        assert f"h {part} [" in answer.stdout
    assert "air,1bar,20degC,alpha=0.9:0.9" in answer.stdout
    assert "conductance_parts.png and interface.csv are in" in answer.stderr
    assert (out / "conductance_parts.png").stat().st_size > 10_000
    curve = rc.read_curve(out / "curve.nc")
    parts = rc.ConductanceParts(
        conductivities=(0.5, 0.5),
        gas=rc.Gas("air", pressure=1e5, temperature=293.15, accommodation=(0.9, 0.9)),
        emissivities=(0.2, 0.3),
        film=1e-7,
    )
    state = rc.press(rc.read(joint).levelled("auto"), 58.6e9, pressure=3e8)
    expected = parts(state)
    assert expected.pop("conductance_residual") < 1e-7
    for name, value in expected.items():
        assert curve.measured[name][1] == pytest.approx(value, rel=1e-6), name  # both to their tolerance
    assert any("do not add" in note for note in json.loads((out / "curve.json").read_text())["notes"])
    assert "do not add up" in answer.stderr
    written = read_table(out / "curve.csv")["joint_conductance_per_area"].tolist()
    assert written == curve.measured["joint_conductance_per_area"].tolist()
    table = read_table(out / "interface.csv")
    assert "joint_conductance_per_area" in table
    assert not any(name.startswith("thermal") for name in table)
    # The stored loads were measured with another conductivity: they are not kept.
    again = invoke(*words[:6], "--conductivity", "0.6W/m/K", *words[8:], "--out", out)
    assert again.exit_code == 0
    assert "are kept" not in again.stderr
    assert (
        rc.read_curve(out / "curve.nc").measured["spots_conductance_per_area"][1]
        > 1.1 * parts(state)["spots_conductance_per_area"]
    )
    assert (
        "2 of 2 loads of the same recipe"
        in invoke(*words[:6], "--conductivity", "0.6W/m/K", *words[8:], "--out", out).stderr
    )


def test_the_printed_python_measures_the_same(invoke, joint, monkeypatch):
    monkeypatch.chdir(joint.parent)
    words = ("curve", joint.name, "--pressures", "100MPa,300MPa", "--modulus", "58.6GPa", *HEAT, *AIR)
    printed = invoke(*words, "--print", "python").stdout
    assert 'measures=[rc.ConductanceParts(conductivities=(50.0, 160.0), gas=rc.Gas("air", ' in printed
    space = {}
    exec(printed, space)
    record = json.loads(invoke(*words, "--json").stdout)
    found = space["curve"].measured["joint_conductance_per_area"].tolist()
    assert found == record["joint_conductance_per_area"]
    command = invoke(*words, "--print", "command").stdout
    assert "--gas air,1bar,20degC,alpha=0.9:0.9" in " ".join(shlex.split(command))
