"""The commands `adhesion ...`: the numbers of the library, files, refusals, Ctrl-C."""

import json
import re

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.adhesion import adhesive_loading
from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
from tables import read_table

MODULUS = ("--modulus", "10MPa", "--level", "none")
STICKS = ("--work", "10mJ/m^2", "--range", "0.1um")
ADHESION = rc.Adhesion(work=10e-3, range=1e-7)
FEW = ("--depths", "-0.2um,0.05um,-0.1um")


@pytest.fixture
def rough(tmp_path):
    """Return the file of a small surface on which the attraction is resolved."""
    surface = rc.self_affine(rc.Grid((16, 16), 1e-6), 0.8, rms=1e-7, rng=np.random.default_rng(5))
    rc.write(surface, tmp_path / "rough.npz")
    return tmp_path / "rough.npz"


@pytest.fixture
def whole(tmp_path):
    """Return the file of a small periodic surface on which the attraction is resolved."""
    grid = rc.Grid((16, 16), 1e-6, periodic=True)
    rc.write(rc.self_affine(grid, 0.8, rms=1e-7, rng=np.random.default_rng(5)), tmp_path / "whole.npz")
    return tmp_path / "whole.npz"


@pytest.mark.usefixtures("drawn")
def test_a_press_answers_as_the_library_does(invoke, rough, tmp_path):
    answer = invoke(
        "adhesion", "press", rough, "--depth", "-20nm", *MODULUS, *STICKS, "--json", "--out", tmp_path / "out"
    )
    assert answer.exit_code == 0, answer.stderr
    state = rc.adhesive_state(rc.read(rough), 10e6, ADHESION, depth=-20e-9)
    record = json.loads(answer.stdout)
    expected = json.loads(json.dumps(state.to_record()))
    assert {name: record[name] for name in expected} == expected
    assert record["converged"] is True
    assert (tmp_path / "out" / "adhesive_state.png").stat().st_size > 1000
    with xarray.open_dataset(tmp_path / "out" / "adhesive_state.nc") as dataset:
        np.testing.assert_array_equal(dataset["pressure"], state.pressure)
        assert "depth = -2e-08 m" in dataset.attrs["input_control"]
    assert json.loads((tmp_path / "out" / "adhesive_state.json").read_text())["provenance"]["input_sha256"]


def test_a_press_takes_a_pressure_and_a_mean_gap(invoke, whole):
    words = ("adhesion", "press", whole, *MODULUS, *STICKS, "--json")
    surface = rc.read(whole)
    pressed = rc.adhesive_state(surface, 10e6, ADHESION, pressure=1e3)
    record = json.loads(invoke(*words, "--pressure", "1kPa").stdout)
    assert record["force"] == pressed.force == pytest.approx(1e3 * surface.grid.area)
    near = rc.adhesive_state(surface, 10e6, ADHESION, mean_gap=2e-7)
    record = json.loads(invoke(*words, "--mean-gap", "2e-7m").stdout)
    assert record["force"] == near.force
    assert record["mean_gap"] == pytest.approx(2e-7)


def test_a_press_tells_tension_and_stability(invoke, rough):
    told = invoke("adhesion", "press", rough, "--force", "0N", *MODULUS, *STICKS).stdout
    for words in ("largest tension", "Irwin's length", "stability", "jump", "certificate", "10 mJ/m²"):
        assert words in told


@pytest.mark.usefixtures("drawn")
def test_a_curve_answers_as_the_library_does(invoke, rough, tmp_path):
    answer = invoke("adhesion", "curve", rough, *FEW, *MODULUS, *STICKS, "--json", "--out", tmp_path / "out")
    assert answer.exit_code == 0, answer.stderr
    depths = [-0.2e-6, 0.05e-6, -0.1e-6]
    curve = rc.adhesive_curve(rc.read(rough), 10e6, ADHESION, depths=depths)
    record, expected = json.loads(answer.stdout), json.loads(json.dumps(curve.to_record()))
    assert {name: record[name] for name in expected} == expected
    assert record["branch"] == ["approach", "approach", "retreat"]
    back = rc.read_adhesive_curve(tmp_path / "out" / "adhesive_curve.nc")
    np.testing.assert_array_equal(back.force, curve.force)
    assert back.jumps == curve.jumps
    table = read_table(tmp_path / "out" / "adhesive_curve.csv")
    np.testing.assert_array_equal(table["force"], curve.force)
    lines = (tmp_path / "out" / "adhesive_curve_jumps.csv").read_text().splitlines()
    assert len([line for line in lines if not line.startswith("#")]) == 1 + len(curve.jumps)
    assert (tmp_path / "out" / "adhesive_curve.png").stat().st_size > 1000


def test_one_folder_holds_the_files_of_all_commands(invoke, rough, tmp_path):
    given = (rough, *MODULUS, "--out", tmp_path)
    held: dict[str, bytes] = {}
    for words in (
        ("press", "--force", "1uN"),
        ("curve", "--forces", "1uN,2uN"),
        ("adhesion", "press", "--depth", "-20nm", *STICKS),
        ("adhesion", "curve", *FEW, *STICKS),
        ("adhesion", "loop", "--depth", "20nm", "--points", "3", *STICKS),
        ("adhesion", "detach", "--depth", "0.15um", "--work", "10mJ/m^2"),
    ):
        assert invoke(*words, *given).exit_code == 0
        written = {each.name: each.read_bytes() for each in tmp_path.iterdir()}
        assert held.items() < written.items()  # new files, and the old ones as they were
        held = written
    for name in ("adhesive_loop.nc", "detachment.nc"):
        told = invoke("conductance", tmp_path / name, "--resistivity", "17nohm*m")
        assert told.exit_code == 2
        assert f"{name} holds a path of adhesive states, whose conductance is not computed" in told.stderr
    assert invoke("conductance", tmp_path, "--resistivity", "17nohm*m").exit_code == 0


def test_an_ambiguous_jump_is_told(invoke, rough, monkeypatch):
    words = ("adhesion", "curve", rough, *FEW, *MODULUS, *STICKS)
    answer = invoke(*words)
    assert answer.exit_code == 0
    assert "is ambiguous" not in answer.stderr
    monkeypatch.setattr(AdhesiveCurve, "ambiguous", True)
    assert "Note: A jump is ambiguous" in invoke(*words).stderr


def test_a_loop_is_that_of_the_library_and_names_pull_off_and_jumps(invoke, rough):
    words = ("adhesion", "loop", rough, *MODULUS, *STICKS, "--depth", "50nm", "--points", "6")
    record = json.loads(invoke(*words, "--json").stdout)
    turn = record["depth"][6]  # 50 nm as it was read
    loop = rc.adhesive_loop(rc.read(rough), 10e6, ADHESION, depth=turn, points=6)
    finer = rc.adhesive_loop(rc.read(rough), 10e6, ADHESION, depth=turn, points=25)
    assert record["pull_off_force"] == pytest.approx(finer.pull_off_force, rel=2e-6)
    assert record["lowest_force"] == loop.lowest_force.tolist()
    assert record["force"] == loop.force.tolist()
    assert record["pull_off_force"] == loop.pull_off_force
    told = invoke(*words).stdout
    for each in ("approach", "retreat", "pull-off force", "jump", "energy lost in jumps"):
        assert each in told


def test_forces_go_up_and_down(invoke, rough):
    words = ("adhesion", "curve", rough, "--forces", "0N:1uN:3,-1uN", *MODULUS, *STICKS, "--json")
    record = json.loads(invoke(*words).stdout)
    assert record["control"] == "force"
    np.testing.assert_allclose(record["force"], [0, 0.5e-6, 1e-6, -1e-6], atol=1e-12)
    assert record["branch"] == ["approach"] * 3 + ["retreat"]


def test_a_range_beyond_the_heights_is_noted(invoke, rough):
    span = np.ptp(rc.read(rough).heights)
    words = ("adhesion", "press", rough, "--depth", "0nm", *MODULUS, "--work", "10mJ/m^2", "--range")
    beyond, within = (invoke(*words, f"{share * span:.9e}") for share in (1.001, 0.999))
    assert (beyond.exit_code, within.exit_code) == (0, 0)
    assert "from lowest to highest: a --range without a unit is in metres" in beyond.stderr
    assert "from lowest to highest" not in within.stderr
    path = ("adhesion", "curve", rough, "--depths", "0nm", *MODULUS, "--work", "10mJ/m^2", "--range", "2")
    assert "Note: the range of 2 m is longer than the surface is high" in invoke(*path).stderr


def test_pressures_go_up_and_down(invoke, rough):
    words = ("adhesion", "curve", rough, "--pressures", "0Pa:2kPa:3,-1kPa", *MODULUS, *STICKS, "--json")
    record = json.loads(invoke(*words).stdout)
    area = rc.read(rough).grid.area
    np.testing.assert_allclose(record["force"], [0, 1e3 * area, 2e3 * area, -1e3 * area], atol=1e-12)
    assert record["branch"] == ["approach"] * 3 + ["retreat"]


def test_mean_gaps_are_those_of_the_library(invoke, whole):
    gaps = ("--mean-gaps", "0.5um:0.2um:3,0.4um")
    words = ("adhesion", "curve", whole, *MODULUS, *STICKS, *gaps)
    answer = invoke(*words, "--json")
    assert answer.exit_code == 0, answer.stderr
    record = json.loads(answer.stdout)
    curve = rc.adhesive_curve(rc.read(whole), 10e6, ADHESION, mean_gaps=[5e-7, 3.5e-7, 2e-7, 4e-7])
    # Texts and numbers are of the last digit apart, and the tolerance of the states is 1e-8.
    np.testing.assert_allclose(record["mean_gap"], [5e-7, 3.5e-7, 2e-7, 4e-7], rtol=1e-9)
    np.testing.assert_allclose(record["force"], curve.force, rtol=1e-8)
    assert record["branch"] == ["approach", "approach", "approach", "retreat"]


def test_mean_gaps_are_refused_where_the_library_refuses_them(invoke, rough):
    gaps = ("--mean-gaps", "0.5um,0.2um")
    words = ("adhesion", "curve", rough, *MODULUS, *STICKS, *gaps)
    answer = invoke(*words)
    assert (answer.exit_code, "the body is not periodic" in answer.stderr) == (2, True)
    assert "--depths and --mean-gaps exclude each other" in invoke(*words, "--depths", "10nm").stderr


def test_an_interrupt_keeps_the_loads_that_are_done(invoke, rough, monkeypatch, tmp_path):
    whole = adhesive_loading.states_under

    def interrupted(*arguments, **named):
        path = whole(*arguments, **named)
        yield next(path)
        yield next(path)
        raise KeyboardInterrupt

    monkeypatch.setattr(adhesive_loading, "states_under", interrupted)
    answer = invoke("adhesion", "curve", rough, *FEW, *MODULUS, *STICKS, "--out", tmp_path / "out")
    assert answer.exit_code == 130
    assert "stopped: 2 of 3 loads are kept; an adhesive path cannot be resumed" in answer.stderr
    assert len(rc.read_adhesive_curve(tmp_path / "out" / "adhesive_curve.nc")) == 2
    loop = ("--depth", "50nm", "--points", "4", "--out", tmp_path / "loop")
    answer = invoke("adhesion", "loop", rough, *MODULUS, *STICKS, *loop)
    assert answer.exit_code == 130
    assert "stopped: the loop is not closed" in answer.stderr


def test_a_missed_tolerance_is_told_and_ends_with_its_status(invoke, rough):
    answer = invoke(
        "adhesion", "press", rough, "--depth", "50nm", *MODULUS, *STICKS, "--tolerance", "1.1e-14"
    )
    assert answer.exit_code == 1
    assert "MISSED" in answer.stdout


def test_an_unresolved_attraction_is_refused_with_a_remedy_that_works(invoke, rough):
    words = ("adhesion", "press", rough, "--depth", "10nm", *MODULUS, "--work", "10mJ/m^2")
    answer = invoke(*words, "--range", "20nm")
    assert answer.exit_code == 2
    assert "give --allow-unresolved" in answer.stderr
    longer = answer.stderr.split("a range of at least ")[1].split(", ")[0]
    assert invoke(*words, "--range", longer).exit_code == 0
    path = ("adhesion", "curve", rough, "--depths", "-10nm,10nm", *MODULUS, "--work", "10mJ/m^2")
    for command in (words, path):
        marked = invoke(*command, "--range", "20nm", "--allow-unresolved")
        assert marked.exit_code == 0
        assert "the grid traps every state" in marked.stderr
        assert "the grid traps" not in invoke(*command, "--range", longer).stderr


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (("--range", "2nm"), "--work is required: add it, such as --work 50mJ/m^2"),
        (("--work", "50mJ/m^2"), "--range is required"),
        (("--work", "0J/m^2", "--range", "2nm"), "the work of adhesion must be positive"),
        (("--work", "50mJ/m^2", "--range", "0nm"), "the range of the attraction must be positive"),
        (("--work", "50mJ", "--range", "2nm"), "'50mJ' is not an energy per area"),
        (
            (*STICKS, "--law", "sharp"),
            "--law: 'sharp' is not one of the choices; choose from exponential, dugdale",
        ),
    ],
)
def test_a_law_that_is_none_is_refused(invoke, rough, given, says):
    for command in (("press", rough, "--depth", "10nm"), ("curve", rough, "--depths", "10nm")):
        answer = invoke("adhesion", *command, *MODULUS, *given)
        assert answer.exit_code == 2
        assert says in answer.stderr


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (("adhesion", "press", "--force", "-1uN", *STICKS), "compute an adhesion curve with --forces 0,-1uN"),
        (
            ("adhesion", "press", "--pressure", "-1kPa", *STICKS),
            "compute an adhesion curve with --pressures 0,-1kPa",
        ),
        (
            ("adhesion", "press", *STICKS),
            "--depth or --mean-gap is required: add one, such as --force 10mN",
        ),
        (("press", "--depth", "-5nm"), "the depth is measured from first touch"),
        (
            ("adhesion", "curve", *STICKS),
            "--depths, --forces, --pressures or --mean-gaps is required: add one, such as --depths",
        ),
        (("adhesion", "loop", *STICKS), "--depth is required"),
        (
            ("adhesion", "loop", "--depth", "1nm", "--points", "1", *STICKS),
            "--points: the number of steps must be a whole number from 2 to 10000",
        ),
        (("adhesion", "curve", "--depths", "1nm:2nm", *STICKS), "'1nm:2nm' is not a range"),
        (("adhesion", "curve", "--depths", ",", *STICKS), "holds no load"),
        (("adhesion", "curve", "--depths", "1nm:2nm:1", *STICKS), "from 2 to 100000 loads, not 1"),
        (("curve", "--depths", "-1nm,2nm"), "every load must be positive"),
    ],
)
def test_each_refusal_names_what_to_do(invoke, rough, given, says):
    group, command, *options = given if given[0] == "adhesion" else ("", *given)
    answer = invoke(*filter(None, (group, command)), rough, *options, *MODULUS)
    assert answer.exit_code == 2
    assert says in answer.stderr


@pytest.mark.parametrize(
    "option", ["--hardness", "--errors", "--flow", "--after", "--theory", "--table", "--loop"]
)
@pytest.mark.parametrize("command", ["press", "curve", "loop"])
def test_what_is_elastic_or_plastic_is_no_option_of_adhesion(invoke, command, option):
    assert f" {option} " not in invoke("adhesion", command, "--help").stdout


@pytest.mark.parametrize("command", ["press", "curve"])
def test_what_is_adhesive_is_no_option_of_the_others(invoke, command):
    told = invoke(command, "--help").stdout
    for option in ("--work", "--range", "--law", "--allow-unresolved", "--mean-gap", "--points"):
        assert option not in told


def test_an_option_of_the_other_press_says_where_it_is(invoke, rough):
    words, no = (rough, "--force", "1uN", *MODULUS), "this command has no such option; use"
    answer = invoke("press", *words, "--work", "10mJ/m^2")
    assert answer.exit_code == 2
    assert (
        f"--work: {no} 'roughcontact adhesion press' (bring an adhesive surface to one load)" in answer.stderr
    )
    answer = invoke("adhesion", "press", *words, *STICKS, "--hardness", "1GPa")
    assert f"--hardness: {no} 'roughcontact press' (press a rough surface by one load)" in answer.stderr
    for option, commands in (
        ("--points", ("adhesion loop",)),
        ("--range", ("adhesion press", "adhesion curve", "adhesion loop")),
    ):
        told = invoke("adhesion", "detach", *words, "--work", "1mJ/m^2", option, "20").stderr
        told = " ".join(told.replace("│", "").split())
        named = " or ".join(rf"'roughcontact {name}' \([^()]+\)" for name in commands)
        assert re.search(f"{option}: {no} {named}$", told)
    told = invoke("press", *words, "--pressures", "1kPa").stderr  # of curve, which is no press
    assert "did you mean --pressure" in told
    assert "roughcontact" not in told
