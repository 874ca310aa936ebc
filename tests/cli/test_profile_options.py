"""Profiles, pressed as a line contact or on springs."""

import json

import numpy as np
import pytest
import xarray

import roughcontact as rc

MODULUS = ("--modulus", "110GPa")


@pytest.fixture
def line():
    return rc.self_affine(rc.Grid(512, 1e-6), 0.8, 1e-7, np.random.default_rng(4))


@pytest.fixture
def scan(line, tmp_path):
    """Return the file of a small profile."""
    rc.write(line, tmp_path / "scan.npz")
    return tmp_path / "scan.npz"


BODIES = {"line": rc.line, "winkler": rc.foundation}


@pytest.mark.parametrize(("body", "force"), [("line", "2N/mm"), ("winkler", "0.2N")])
def test_a_load_is_that_of_the_library(invoke, line, scan, body, force):
    answer = invoke("press", scan, "--profile", body, "--force", force, *MODULUS, "--level", "none", "--json")
    assert answer.exit_code == 0, answer.stderr
    record = json.loads(answer.stdout)
    operator = BODIES[body](line.grid, 110e9)
    solution = rc.press(line, 110e9, force={"line": 2e3, "winkler": 0.2}[body], operator=operator)
    for name in ("force", "depth", "stiffness", "contact_area"):
        assert record[name] == getattr(solution, name), name
    assert record["units"]["force"] == {"line": "N m-1", "winkler": "N"}[body]
    assert record["kind"] == "profile"


@pytest.mark.usefixtures("drawn")
@pytest.mark.parametrize("body", BODIES)
def test_a_curve_is_that_of_the_library_and_its_files_are_there(invoke, line, scan, body, tmp_path):
    out = tmp_path / "out"
    answer = invoke("curve", scan, "--profile", body, *MODULUS, "--level", "none", "--json", "--out", out)
    assert answer.exit_code == 0, answer.stderr
    record = json.loads(answer.stdout)
    curve = rc.loading_curve(line, 110e9, operator=BODIES[body](line.grid, 110e9))
    assert record["force"] == curve.force.tolist()
    assert record["stiffness"] == curve.stiffness.tolist()
    assert sorted(path.name for path in out.iterdir()) == ["curve.csv", "curve.json", "curve.nc", "curve.png"]
    assert "the map is a profile; no loads are named: 24 forces" in answer.stderr
    below = int(np.argmax(curve.resolved))
    assert below > 0
    assert f"{below} of them below what the grid resolves" in answer.stderr


def test_units_on_the_screen_are_those_of_the_body(invoke, scan):
    words = ("curve", scan, *MODULUS, "--profile")
    line = invoke(*words, "line", "--forces", "1N/mm,2N/mm").stdout
    assert "force [kN/m]" in line
    assert "stiffness [GN/m²]" in line
    areal = invoke(*words, "line", "--pressures", "1MPa,2MPa").stdout
    assert "nominal pressure [MPa]" in areal
    springs = invoke(*words, "winkler", "--pressures", "1N/mm,2N/mm").stdout
    assert "nominal pressure [kN/m]" in springs
    load = invoke("press", scan, *MODULUS, "--profile", "line", "--force", "1N/mm").stdout
    facts = dict(line.split("   ", 1) for line in load.splitlines())
    assert facts["force"].strip() == "1 kN/m"
    assert facts["stiffness"].strip().endswith("GN/m²")


@pytest.mark.usefixtures("drawn")
def test_the_picture_of_a_load_is_written(invoke, scan, tmp_path):
    out = tmp_path / "out"
    answer = invoke("press", scan, "--profile", "line", "--depth", "50nm", *MODULUS, "--out", out)
    assert answer.exit_code == 0, answer.stderr
    assert sorted(path.name for path in out.iterdir()) == ["press.json", "pressure.nc", "pressure.png"]
    with xarray.open_dataset(out / "pressure.nc") as dataset:
        assert dataset["pressure"].dims == ("x",)


@pytest.mark.parametrize("command", ["press", "curve"])
def test_a_profile_asks_how_it_is_pressed(invoke, scan, command):
    loads = ("--force", "1N") if command == "press" else ()
    answer = invoke(command, scan, *loads, *MODULUS)
    assert answer.exit_code == 2
    assert "it is a profile of 512 heights" in answer.stderr
    assert "--profile line, as a line contact, or --profile winkler" in answer.stderr


def test_a_map_is_no_profile(invoke, rough):
    answer = invoke("press", rough, "--profile", "line", "--force", "1N/m", *MODULUS)
    assert answer.exit_code == 2
    assert "holds a map of 24 x 32 heights; leave out --profile" in answer.stderr


@pytest.mark.parametrize(
    ("command", "given", "message"),
    [
        ("press", ("line", "--force", "1N"), "'1N' is not a force per length; write a force per length"),
        ("press", ("winkler", "--pressure", "1MPa"), "--pressure: '1MPa' is not a force per length"),
        ("press", ("line", "--force=-1N/m"), "--force: the force per length must be positive"),
        (
            "press",
            ("winkler", "--force", "1N", "--hardness", "2GPa"),
            "--hardness is a pressure, but springs",
        ),
        ("press", ("line", "--force", "1N/m", "--theory", "persson", "--out", "o"), "--theory predicts"),
        ("curve", ("line", "--resistivity", "17nohm*m"), "the conductance of a line contact is undetermined"),
        ("curve", ("winkler", "--resistivity", "17nohm*m"), "give --of total"),
        ("curve", ("winkler", "--unit-pressure", "MPa"), "--unit-pressure are per area"),
        ("curve", ("line", "--forces", "1N/m:2N/m"), "write from:to:count, such as 1mN/m:1N/m:100"),
    ],
)
def test_what_a_profile_does_not_give_is_refused_before_the_work(
    invoke, scan, monkeypatch, command, given, message
):
    monkeypatch.setattr(rc, "read_line", lambda *_, **__: pytest.fail("it went to work"))
    answer = invoke(command, scan, "--profile", *given, *MODULUS)
    assert answer.exit_code == 2
    assert message in answer.stderr


def test_springs_have_a_total_conductance(invoke, scan):
    words = ("--profile", "winkler", "--forces", "10mN,20mN", "--resistivity", "17nohm*m", "--of", "total")
    answer = invoke("curve", scan, *words, *MODULUS, "--json")
    assert answer.exit_code == 0, answer.stderr
    assert len(json.loads(answer.stdout)["electrical_resistance"]) == 2
