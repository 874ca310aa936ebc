"""The command ``sliding``: a table against speed, Persson's theory beside it, files, and Ctrl-C."""

import csv
import json

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.theory import persson_friction, waves
from roughcontact.viscoelastic import friction_curve, sliding_solver

RUBBER = rc.viscoelastic.standard_solid(2e6, 4e7, 1e-3)
LOAD = ("--pressure", "0.1MPa", "--speeds", "1mm/s:1m/s:4")


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """A folder with a material, one that flows, and a tile."""
    path = tmp_path_factory.mktemp("sliding")
    RUBBER.write(path / "rubber.toml")
    rc.viscoelastic.maxwell(1e6, 1.0).write(path / "maxwell.toml")
    grid = rc.Grid((24, 32), 1e-5, periodic=True)
    rc.write(
        rc.self_affine(grid, hurst=0.8, rms=3e-6, rng=2, rolloff=2e-4, short_cutoff=5e-5), path / "tile.npz"
    )
    return path


@pytest.fixture
def slide(invoke, home):
    def run(*words, material="rubber.toml", load=LOAD):
        return invoke("sliding", home / "tile.npz", "--material", home / material, *load, *words)

    return run


@pytest.mark.usefixtures("drawn")
def test_the_table_is_the_curve_with_the_theory_beside_it(slide, home, tmp_path):
    out = tmp_path / "out"
    answer = slide("--direction", "30deg", "--out", out)
    assert answer.exit_code == 0, answer.stderr
    surface = rc.read(home / "tile.npz").levelled("auto")
    angle = np.pi / 6
    given = {"pressure": 1e5, "direction": (np.cos(angle), np.sin(angle))}
    curve = rc.friction_curve(surface, RUBBER, speeds=np.geomspace(1e-3, 1, 4), **given)
    spectrum = waves.Waves.of_heights(surface.heights, surface.grid.spacing)
    with xarray.open_dataset(out / "sliding.nc", engine="h5netcdf") as dataset:
        for name in ("friction_coefficient", "friction_across", "contact_fraction", "dissipation"):
            np.testing.assert_array_equal(dataset[name], getattr(curve, name))
        across = curve.friction @ (-np.sin(angle), np.cos(angle)) / 1e5
        np.testing.assert_allclose(dataset["friction_across"], across, rtol=1e-9)
        for name, gamma in (
            ("persson_friction_coefficient", 1.0),
            ("persson_friction_coefficient_half", 0.5),
        ):
            expected = persson_friction.friction_coefficient(1e5, RUBBER, spectrum, 1e-2, gamma=gamma)
            assert float(dataset[name][1]) == pytest.approx(expected, rel=1e-9)  # of the pressure's sum
        assert dataset.attrs["notes"] == "\n".join(curve.notes)
    table = list(csv.DictReader((out / "sliding.csv").read_text().splitlines()))
    assert [float(row["sliding_speed [m s-1]"]) for row in table] == pytest.approx(curve.speed, rel=1e-15)
    assert float(table[2]["friction_coefficient"]) == curve.friction_coefficient[2]
    record = json.loads((out / "sliding.json").read_text())
    assert record["converged"]
    assert record["whole"]
    assert record["units"]["dissipation"] == "W m-2"
    assert (out / "sliding.png").stat().st_size > 10_000
    assert "Persson, gamma 1/2" in answer.stdout
    largest = f"{curve.friction_coefficient.max():.4g} at"
    assert largest in answer.stdout
    assert "Persson's theory assumes isotropic random waves" in answer.stderr


def test_ctrl_c_keeps_the_speeds_that_are_done(slide, monkeypatch, tmp_path):
    moving = friction_curve.moving

    def stopped(rest, material, speed, *more):
        if speed > 5e-3:
            raise KeyboardInterrupt
        return moving(rest, material, speed, *more)

    monkeypatch.setattr(friction_curve, "moving", stopped)
    out = tmp_path / "out"
    answer = slide("--out", out)
    assert answer.exit_code == 130
    assert "stopped: 1 of 4 speeds are computed; compute the others with --speeds 0.01,0.1,1" in answer.stderr
    record = json.loads((out / "sliding.json").read_text())
    assert not record["whole"]
    assert record["sliding_speed"] == [1e-3]
    monkeypatch.undo()
    rest = slide("--json", load=("--pressure", "0.1MPa", "--speeds", "0.01,0.1,1"))
    whole = json.loads(slide("--json").stdout)
    assert json.loads(rest.stdout)["friction_coefficient"] == pytest.approx(
        whole["friction_coefficient"][1:], rel=1e-5
    )


def test_a_missed_tolerance_is_told_by_status_and_note(slide, monkeypatch):
    monkeypatch.setattr(sliding_solver, "MAX_SOLVES", 0)
    answer = slide()
    assert answer.exit_code == 1
    assert "stagnated" in answer.stdout
    assert "Note: At 4 of 4 speeds, first at 0.001 m/s: The residual is" in answer.stderr


def test_a_flat_surface_has_no_theory(invoke, home, tmp_path):
    flat = tmp_path / "flat.npz"
    rc.write(rc.Surface(np.zeros((8, 8)), rc.Grid((8, 8), 1e-5, periodic=True)), flat)
    answer = invoke("sliding", flat, "--material", home / "rubber.toml", *LOAD)
    assert answer.exit_code == 0, answer.stderr
    assert "Persson's theory is left out" in answer.stderr
    assert "Persson" not in answer.stdout


@pytest.mark.parametrize(
    ("words", "message", "right"),
    [
        (("--free",), "if the surface repeats itself, give --periodic", ("--periodic",)),
        (("--mask", "box=2:4,2:4"), "fill them: --fill", ("--mask", "box=2:4,2:4", "--fill")),
        (("--profile", "line"), "leave --profile out", ()),
        (("--direction", "30"), "give x, y or an angle such as 30deg", ("--direction", "30deg")),
        (("--direction", "0x deg"), "write a number such as 30deg", ("--direction", "30 deg")),
    ],
)
def test_what_cannot_slide_is_refused_and_the_remedy_works(slide, words, message, right):
    answer = slide(*words)
    assert answer.exit_code == 2
    assert message in answer.stderr
    answer = slide(*right)
    assert answer.exit_code == 0, answer.stderr


@pytest.mark.parametrize(
    ("speeds", "message"),
    [
        ("0mm/s", "every speed must be positive"),
        ("-1mm/s,1mm/s", "every speed must be positive"),
        ("0mm/s:1mm/s:3", "a range of speeds must increase from a positive speed"),
        ("1mm/s:1m/s:1", "a range holds from 2 to 100000 speeds, not 1"),
        (",", "holds no speed"),
        ("1mm", "write a speed such as 10mm/s"),
    ],
)
def test_speeds_are_positive_and_have_units_of_speed(slide, speeds, message):
    answer = slide(load=("--pressure", "0.1MPa", f"--speeds={speeds}"))
    assert answer.exit_code == 2
    assert message in answer.stderr


def test_a_material_that_flows_is_refused(slide):
    answer = slide(material="maxwell.toml")
    assert answer.exit_code == 2
    assert "--material: the material has no relaxed modulus" in answer.stderr
    assert "give it an equilibrium modulus" in answer.stderr
