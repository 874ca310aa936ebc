"""The command ``creep``: a history on the screen and in files, stopped and continued."""

import json
from pathlib import Path

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.viscoelastic import growing_curve

HISTORY = ("--history", "0s:0N, 0s:20uN, 1e3s:20uN, 1e3s:5uN")
QUICK = ("--time-tolerance", "0.05")


@pytest.fixture
def here(tmp_path, monkeypatch, surface):
    monkeypatch.chdir(tmp_path)
    rc.write(surface, "rough.npz")
    rc.Viscoelastic(1e6, [2e6, 6e6], [1.0, 0.01]).write("rubber.toml")
    return tmp_path


@pytest.fixture
def creep(here, invoke):
    return lambda *words: invoke("creep", "rough.npz", "--material", "rubber.toml", *words)


def by_hand(**given):
    surface = rc.read("rough.npz").levelled("auto")
    given = {"times": [0, 0, 1e3, 1e3], "forces": [0, 2e-5, 2e-5, 5e-6], "time_tolerance": 0.05} | given
    return rc.viscoelastic_curve(surface, rc.Viscoelastic.read("rubber.toml"), **given)


@pytest.mark.usefixtures("drawn")
def test_the_given_times_are_on_the_screen_and_all_states_in_the_files(creep, here):
    answer = creep(*HISTORY, *QUICK, "--out", "out")
    assert answer.exit_code == 0, answer.stderr
    found, lines = by_hand(), answer.stdout.splitlines()
    assert [line.split()[0] for line in lines[-4:]] == ["0", "0", "1000", "1000"]
    shown = np.array([line.split() for line in lines[-4:]], float)
    at = np.flatnonzero(found.prescribed)
    np.testing.assert_allclose(shown[:, 1], 1e6 * found.force[at], rtol=1e-3)  # four digits
    np.testing.assert_allclose(shown[:, 2], 1e9 * found.depth[at], rtol=1e-3)
    assert "force [µN]  depth [nm]  contact area [µm²]  stiffness [N/m]  mean gap [nm]" in lines[-5]
    told = dict(line.split("   ", 1) for line in lines[:-5])
    assert told["states"].strip() == f"{len(found)}, of which 4 are at given times"
    assert told["error of time"].strip() == f"{found.time_error[-1]:.1e}, estimated"
    assert "9 MPa at once, 1 MPa after a long time; 2 relaxation times" in told["reduced modulus"]
    with xarray.open_dataset("out/creep.nc", engine="h5netcdf") as dataset:
        np.testing.assert_array_equal(dataset["depth"], found.depth)
        assert dataset["depth"].dims == ("time",)
    record = json.loads(Path("out/creep.json").read_text())
    assert record["contact_area"] == found.contact_area.tolist()
    assert (record["whole"], record["converged"], record["material"]) == (True, True, "rubber.toml")
    assert len(Path("out/creep.csv").read_text().splitlines()) == len(found) + 1
    assert Path("out/creep.png").stat().st_size > 10_000
    assert not Path("out/creep_checkpoint.npz").exists()


def test_a_pressure_shows_numbers_per_area_and_a_leak_its_columns(creep, here):
    line = ("--history", "0:0,1:20kPa,5:20kPa", "--steps", "3", "--leak", "0")
    answer = creep(*line)
    assert "nominal pressure [kPa]" in answer.stdout
    assert "hydraulic gap [nm]" in answer.stdout
    assert "not estimated for fixed steps" in answer.stdout
    record = json.loads(creep(*line, "--json").stdout)
    measure = rc.Transmissivity(0)
    found = by_hand(
        times=[0, 1, 5],
        forces=None,
        pressures=[0, 2e4, 2e4],
        steps=3,
        time_tolerance=1e-3,
        measures=[measure],
    )
    assert record["hydraulic_gap"] == found.measured["hydraulic_gap"].tolist()


@pytest.fixture
def interrupt(monkeypatch):
    """Ctrl-C at a state."""

    def arm(at):
        count, real = [0], growing_curve.measured_at

        def counting(*given):
            count[0] += 1
            if count[0] == at:
                raise KeyboardInterrupt
            return real(*given)

        monkeypatch.setattr(growing_curve, "measured_at", counting)

    yield arm
    monkeypatch.undo()


def test_the_same_command_goes_on_to_the_same_files(creep, here, interrupt):
    creep(*HISTORY, *QUICK, "--out", "whole")
    interrupt(12)
    stopped = creep(*HISTORY, *QUICK, "--out", "out")
    assert stopped.exit_code == 130
    record = json.loads(Path("out/creep.json").read_text())
    assert (len(record["time"]), record["whole"]) == (11, False)
    assert f"stopped at {record['time'][-1]:.6g} s; the same command goes on from there" in stopped.stderr
    assert stopped.stdout.splitlines()[-1].split()[0] == f"{1e3 * record['time'][-1]:.4g}"  # [ms]
    interrupt(0)
    answer = creep(*HISTORY, *QUICK, "--out", "out")
    assert answer.exit_code == 0, answer.stderr
    assert "the computation goes on from there" in answer.stderr
    assert Path("out/creep.csv").read_bytes() == Path("whole/creep.csv").read_bytes()
    assert not Path("out/creep_checkpoint.npz").exists()


def test_ctrl_c_without_a_folder_shows_what_is_done(creep, here, interrupt):
    interrupt(5)
    answer = creep(*HISTORY, *QUICK)
    assert answer.exit_code == 130
    assert "with --out, the same command goes on from there" in answer.stderr
    assert "states                     4, of which 2 are at given times" in answer.stdout
    interrupt(1)
    answer = creep(*HISTORY, *QUICK)
    assert answer.exit_code == 130
    assert "states" not in answer.stdout


def test_what_is_stored_of_another_computation_is_replaced_with_a_note(creep, here, interrupt):
    interrupt(5)
    creep(*HISTORY, *QUICK, "--out", "out")
    interrupt(0)
    answer = creep(*HISTORY, "--steps", "2", "--out", "out")
    assert (
        "creep_checkpoint.npz is of another computation and is replaced; another --out keeps it"
        in answer.stderr
    )
    assert len(json.loads(Path("out/creep.json").read_text())["time"]) == 5


def test_the_material_of_a_recipe_lies_beside_it_and_is_the_same_file(creep, invoke, here, monkeypatch):
    creep(*HISTORY, "--steps", "2", "--out", "out")
    again = invoke("run", "out")
    assert "same numbers" in again.stderr
    (here / "elsewhere").mkdir()
    monkeypatch.chdir(here / "elsewhere")
    assert "same numbers" in invoke("run", here / "out" / "creep.json").stderr
    rc.viscoelastic.standard_solid(1e6, 2e6, 1.0).write(here / "rubber.toml")
    refused = invoke("run", here / "out" / "creep.json")
    assert refused.exit_code == 2
    assert "bodies.sha256" in refused.stderr
    assert "rubber.toml is not the file that the recipe was written for" in refused.stderr


def test_a_profile_has_forces_per_length(here, invoke):
    line = rc.self_affine(rc.Grid(64, 1e-6, periodic=True), 0.8, 1e-7, rng=1)
    rc.write(line, "line.npz")
    words = ("creep", "line.npz", "--material", "rubber.toml", "--steps", "2")
    answer = invoke(*words, "--profile", "line", "--history", "0s:0N/m,1s:0.1N/m")
    assert answer.exit_code == 0, answer.stderr
    assert "force [mN/m]" in answer.stdout
    springs = invoke(*words, "--profile", "winkler", "--history", "0s:0um,1s:0.1um")
    assert springs.exit_code == 0, springs.stderr
