"""The command `adhesion detach`: a pressed surface that is stuck and drawn back."""

import json
from dataclasses import replace

import numpy as np
import pytest

import roughcontact as rc
from roughcontact.adhesion import detachment_path
from roughcontact.plot.facts import quantity
from roughcontact.solver.control import Status
from tables import read_table

GIVEN = ("--modulus", "10MPa", "--level", "none", "--work", "10mJ/m^2")
FALLING = ("--depths", "100nm:-300nm:3,-1um")


@pytest.fixture
def rough(tmp_path):
    """Return the file of a small surface."""
    surface = rc.self_affine(rc.Grid((12, 16), 1e-6), 0.8, rms=1e-7, rng=np.random.default_rng(5))
    rc.write(surface, tmp_path / "rough.npz")
    return tmp_path / "rough.npz"


@pytest.mark.usefixtures("drawn")
def test_the_numbers_are_those_of_the_library(invoke, rough, tmp_path):
    words = ("adhesion", "detach", rough, "--depth", "1.5e-7m", *GIVEN, *FALLING)
    answer = invoke(*words, "--json", "--out", tmp_path / "out")
    assert answer.exit_code == 0, answer.stderr
    record = json.loads(answer.stdout)
    preload = rc.press(rc.read(rough), 10e6, depth=1.5e-7)
    curve = rc.detachment_curve(preload, 10e-3, depths=record["depth"])
    expected = json.loads(json.dumps(curve.to_record()))
    assert {name: record[name] for name in expected} == expected
    assert (record["command"], record["converged"], record["whole"]) == ("adhesion detach", True, True)
    back = rc.read_detachment_curve(tmp_path / "out" / "detachment.nc")
    assert back.detachments == curve.detachments
    table = read_table(tmp_path / "out" / "detachment.csv")
    np.testing.assert_array_equal(table["force"], curve.force)
    events = (tmp_path / "out" / "detachments.csv").read_text().splitlines()
    assert len([line for line in events if not line.startswith("#")]) == 1 + len(curve.detachments)
    assert (tmp_path / "out" / "detachment.png").stat().st_size > 1000
    kept = json.loads((tmp_path / "out" / "detachment.json").read_text())
    assert "drawn back from depth = 1.5e-07 m" in kept["provenance"]["input_control"]


def test_without_loads_it_goes_on_until_no_cell_is_in_contact(invoke, rough):
    words = ("adhesion", "detach", rough, "--depth", "1.5e-7m", *GIVEN)
    record = json.loads(invoke(*words, "--json").stdout)
    curve = rc.detachment_curve(rc.press(rc.read(rough), 10e6, depth=1.5e-7), 10e-3)
    assert record["pull_off_force"] == curve.pull_off_force > 0
    assert (record["control"], len(record["contact_area"]), record["contact_area"][-1]) == ("depth", 3, 0.0)
    told = invoke(*words).stdout
    rows = [line.split() for line in told.splitlines() if line.startswith(" ")]
    assert len(rows) == 3  # start, pull-off and end
    last = min(curve.detachments, key=lambda event: event.force_before)
    assert last.force_before == -curve.pull_off_force
    force = quantity("pull_off_force", curve.pull_off_force)
    assert f" {force} in tension at a depth of {quantity('depth', last.depth)}\n" in told
    for each in ("detachments", "work of adhesion", "10 mJ/m²"):
        assert each in told


def test_it_goes_by_forces(invoke, rough):
    words = ("adhesion", "detach", rough, "--force", "1e-5N", *GIVEN, "--forces", "5e-6N,0N", "--json")
    record = json.loads(invoke(*words).stdout)
    assert record["control"] == "force"
    np.testing.assert_allclose(record["force"], [5e-6, 0], atol=1e-12)


def test_it_goes_by_pressures(invoke, rough):
    words = ("adhesion", "detach", rough, "--pressure", "60kPa", *GIVEN, "--pressures", "30kPa,0Pa", "--json")
    record = json.loads(invoke(*words).stdout)
    assert record["control"] == "force"
    np.testing.assert_allclose(record["force"], [3e4 * rc.read(rough).grid.area, 0], atol=1e-12)


def test_a_small_preload_is_told(invoke, rough):
    words = ("adhesion", "detach", rough, *GIVEN)
    assert "The preload was too small" in invoke(*words, "--depth", "10nm").stderr
    assert "The preload was too small" not in invoke(*words, "--pressure", "1MPa").stderr


def test_an_interrupt_keeps_the_loads_that_are_done(invoke, rough, monkeypatch, tmp_path):
    whole = detachment_path.states_drawn_back

    def interrupted(*arguments, **named):
        yield next(whole(*arguments, **named))
        raise KeyboardInterrupt

    monkeypatch.setattr(detachment_path, "states_drawn_back", interrupted)
    words = ("adhesion", "detach", rough, "--depth", "1.5e-7m", *GIVEN, *FALLING, "--out", tmp_path / "out")
    answer = invoke(*words)
    assert answer.exit_code == 130
    assert "stopped: 1 of 4 loads are kept; an adhesive path cannot be resumed" in answer.stderr
    assert len(rc.read_detachment_curve(tmp_path / "out" / "detachment.nc")) == 1


def test_a_missed_tolerance_ends_with_its_status(invoke, rough, monkeypatch):
    words = ("adhesion", "detach", rough, "--depth", "1.5e-7m", *GIVEN, *FALLING, "--json")
    monkeypatch.setattr("roughcontact.adhesion.detachment_path._residual", lambda *given: 1e-3)
    answer = invoke(*words)
    assert answer.exit_code == 1
    assert json.loads(answer.stdout)["converged"] is False
    assert "4 of 4 loads missed the tolerance" in answer.stderr
    assert "The preload missed" not in answer.stderr


def test_a_preload_that_missed_the_tolerance_ends_with_its_status(invoke, rough, monkeypatch):
    whole = rc.press

    def missed(*given, **named):
        solution = whole(*given, **named)
        raise rc.ConvergenceError(replace(solution, status=Status.STAGNATED))

    monkeypatch.setattr(rc, "press", missed)
    answer = invoke("adhesion", "detach", rough, "--depth", "1.5e-7m", *GIVEN, *FALLING, "--json")
    assert answer.exit_code == 1
    assert json.loads(answer.stdout)["converged"] is False
    assert "The preload missed the tolerance" in answer.stderr


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (("--depth", "10nm", "--range", "2nm"), "--range: this command has no such option"),
        (("--depth", "10nm", "--hardness", "2GPa"), "--hardness: this command has no such option"),
        ((), "--force, --pressure or --depth is required: add one, such as --force 10N"),
        (
            ("--depth", "10nm", "--depths", "5nm", "--forces", "0N"),
            "--depths and --forces exclude each other",
        ),
        (("--depth", "10nm", "--depths", "20nm"), "press to that depth, or begin with"),
        (("--depth", "10nm", "--depths", "-5nm,5nm"), "must decrease"),
        (("--depth", "0nm"), "nothing is in contact"),
    ],
)
def test_what_makes_no_sense_is_refused(invoke, rough, given, says):
    answer = invoke("adhesion", "detach", rough, *GIVEN, *given)
    assert answer.exit_code == 2
    assert says in answer.stderr
