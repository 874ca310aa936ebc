"""The command ``joint``: its numbers are those of the library; files, leak, flow of metal, and Ctrl-C."""

import dataclasses
import json

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.contact import loading
from roughcontact.joints import whole_joint

BOLT = ("--bolt-force", "2kN", "--head", "13mm", "--hole", "9mm", "--thickness", "2mm")
BODIES = ("--materials", "steel,aluminium")


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """A folder with a tile, and a table of pressures."""
    path = tmp_path_factory.mktemp("joint")
    grid = rc.Grid((48, 64), (2e-6, 1e-6), periodic=True)
    rc.write(
        rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=2, rolloff=2e-5, short_cutoff=8e-6), path / "tile.npz"
    )
    points = [(x, y, 1.5 * x) for y in (0, 1, 2) for x in (0, 2, 4, 6)]
    lines = ["x [mm], y [mm], p [MPa]", *(f"{x}, {y}, {p}" for x, y, p in points)]
    (path / "field.csv").write_text("\n".join(lines) + "\n")
    return path


@pytest.fixture
def joint(invoke, home):
    return lambda *words: invoke("joint", home / "tile.npz", *words)


def computed(home, field, bodies=("steel", "aluminium"), **named):
    surface = rc.read(home / "tile.npz").levelled("auto")
    curve = rc.loading_curve(surface, bodies, pressures=field.loads, **named)
    return surface, curve, rc.hurst_exponent(surface).longest_wave


@pytest.mark.usefixtures("drawn")
def test_a_bolt_under_shear(joint, home, tmp_path):
    out = tmp_path / "out"
    answer = joint(
        *BOLT, *BODIES, "--friction", "0.2", "--amplitude", "0.1um", "--conductivity", "50W/m/K", "--out", out
    )
    assert answer.exit_code == 0, answer.stderr
    field = rc.bolt_pressure(force=2e3, head=13e-3, hole=9e-3, thickness=2e-3)
    _, curve, wave = computed(home, field)
    found = rc.joint(rc.shear_law(curve, ("steel", "aluminium"), friction=0.2), field, longest_wave=wave)
    record = json.loads((out / "joint.json").read_text())
    expected = json.loads(json.dumps(found.to_record()))
    assert {name: record[name] for name in expected if name not in ("units",)} == {
        name: value for name, value in expected.items() if name != "units"
    }
    assert record["joint_loss"] == found.loss(1e-7)
    assert record["damping"] == found.damping(1e-7)
    assert record["thermal_conductance"] == found.conductance(conductivities=(50, 50))["thermal_conductance"]
    units = {
        "normal_stiffness": "N m-1",
        "tilting_stiffness": "N m rad-1",
        "joint_loss": "J",
        "left_out_area": "m2",
    }
    assert units.items() <= record["units"].items()
    assert record["converged"] is True
    assert "leak_rate" not in record
    with xarray.open_dataset(out / "joint.nc", engine="h5netcdf") as dataset:
        np.testing.assert_array_equal(dataset["nominal_pressure"], field.pressure)
        np.testing.assert_array_equal(dataset["interfacial_stiffness_per_area"], found.stiffness_per_area)
        np.testing.assert_array_equal(dataset["x"], field.grid.coordinates[1])
        assert dataset.attrs["notes"] == "\n".join(found.notes)
    assert (out / "joint.png").stat().st_size > 10_000
    for line in ("force                              2 kN", "area left out", "damping", "N·m/rad, 0 N·m/rad"):
        assert line in answer.stdout
    assert "Shear from the normal curve is exact for Poisson's ratio 0" in answer.stderr


def test_a_table_of_pressures(joint, home):
    printed = joint("--pressure-field", home / "field.csv", "--modulus", "110GPa").stdout
    assert "face                               3 x 4 cells, 3 mm x 8 mm\n" in printed
    answer = joint("--pressure-field", home / "field.csv", "--modulus", "110GPa", "--json")
    assert answer.exit_code == 0, answer.stderr
    field = rc.read_pressure_field(home / "field.csv")
    _, curve, _ = computed(home, field, 110e9)
    record = json.loads(answer.stdout)
    assert record["normal_stiffness"] == rc.joint(rc.normal_law(curve), field).normal_stiffness
    assert record["shear_stiffness"] is None
    assert record["centre_of_stiffness"][0] > 4e-3 > record["centre_of_stiffness"][1]
    assert record["loaded_area"] == pytest.approx(9 * 2e-6)
    assert record["left_out_area"] == pytest.approx(3 * 2e-6)
    assert record["steep_share"] == 0  # three waves are shorter than a cell
    assert "100% of the force lies on pressures that the map does not resolve" in answer.stderr


def test_a_leak(joint, home):
    leak = ("--leak", "1", "--viscosity", "2mPa*s", "--drop", "2bar")
    answer = joint(*BOLT, "--modulus", "1GPa", *leak, "--json")
    assert answer.exit_code == 0, answer.stderr
    field = rc.bolt_pressure(force=2e3, head=13e-3, hole=9e-3, thickness=2e-3)
    _, curve, _ = computed(home, field, 1e9, measures=[rc.Transmissivity(axis=1)])
    expected = rc.joint_leak(rc.joint(rc.normal_law(curve), field), rc.Liquid(2e-3), drop=2e5)
    record = json.loads(answer.stdout)
    assert record["leak_rate"] == list(expected)
    assert record["units"]["leak_rate"] == "m3 s-1"
    open_ = joint(*BOLT, "--modulus", "1GPa", *leak[:-1], "2kbar")
    assert "leak rate" in open_.stdout
    assert "infinite" in open_.stdout


def test_a_joint_that_was_tightened(joint, home):
    answer = joint(*BOLT, *BODIES, "--hardness", "aluminium", "--json")
    assert answer.exit_code == 0, answer.stderr
    field = rc.bolt_pressure(force=2e3, head=13e-3, hole=9e-3, thickness=2e-3)
    surface, curve, _ = computed(home, field)
    loop = rc.loading_loop(surface, ("steel", "aluminium"), hardness="aluminium", pressures=field.loads)
    flown = rc.joint(rc.normal_law(loop), field).normal_stiffness
    assert json.loads(answer.stdout)["normal_stiffness"] == flown
    assert flown > 1.01 * rc.joint(rc.normal_law(curve), field).normal_stiffness
    assert "counts as pressed before by the largest load" in answer.stderr
    assert json.loads(joint(*BOLT, *BODIES, "--loop", "--json").stdout)["normal_stiffness"] == flown


def test_ctrl_c_leaves_nothing(joint, monkeypatch, tmp_path):
    def stopped(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(whole_joint, "Joint", stopped)
    answer = joint(*BOLT, *BODIES, "--out", tmp_path / "out")
    assert answer.exit_code == 130
    assert not (tmp_path / "out").exists()


def test_a_missed_tolerance_is_told_by_status_and_note(joint, monkeypatch):
    along = loading.follow

    def missed(*given, **named):
        for state in along(*given, **named):
            yield (
                dataclasses.replace(state, status=rc.Status.STAGNATED)
                if state.nominal_pressure < 2e6
                else state
            )

    monkeypatch.setattr(loading, "follow", missed)
    answer = joint(*BOLT, "--modulus", "1GPa", "--json")
    assert answer.exit_code == 1, answer.stderr
    assert json.loads(answer.stdout)["converged"] is False
    assert "loads missed the tolerance" in answer.stderr
