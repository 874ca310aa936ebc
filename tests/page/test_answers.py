"""What the page shows and writes of a load and of a curve is what the command that it states gives."""

import io
import json
import shlex
import zipfile

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from roughcontact.page.jobs.curve_jobs import curve, theories
from roughcontact.page.jobs.export_job import export
from roughcontact.page.jobs.press_jobs import cut, press
from roughcontact.page.jobs.session_cache import SessionCache, UploadedFile
from roughcontact.page.recipe import as_recipe
from roughcontact.page.server.page_request import PageRequest

LOADS = {"control": "force", "start": "50 mN", "end": "2 N", "count": 7}
BODIES = {"materials": ["steel", "aluminium"]}
BESIDE = {"theories": ["persson", "cmy"], "conducting": True}


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    grid = rc.Grid((96, 96), 1e-6)
    rc.write(
        rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(2)),
        tmp_path / "part.npz",
    )
    return UploadedFile(tmp_path / "part.npz", "part.npz")


@pytest.fixture
def ask(file):
    """Do a job, and return its messages with their bytes."""
    cache = SessionCache()

    def asked(job, load=None, loads=None, bodies=BODIES, **more):
        recipe = {"source": {"kind": "file", "file": "key"}, "bodies": bodies, "load": load, "loads": loads}
        said = []
        request = PageRequest(as_recipe(recipe), {"key": file}, more)
        job(request, cache, lambda header, data=b"": said.append((json.loads(json.dumps(header)), data)))
        return said

    return asked


def of(said, kind):
    return [header for header, _ in said if header["type"] == kind]


def run(command):
    result = CliRunner().invoke(app, shlex.split(command)[1:])
    assert result.exit_code == 0, result.stderr
    return result.stdout


def test_the_points_of_a_curve_are_those_of_its_command(ask):
    said = ask(curve, loads=LOADS)
    record = json.loads(run(of(said, "stated")[0]["command"] + " --json"))
    points = of(said, "point")
    for name in ("force", "depth", "stiffness", "interfacial_stiffness", "contact_fraction", "mean_gap"):
        assert [point[name] for point in points] == record[name]
    assert [point["resolved"] for point in points] == record["resolved"]
    space = {}
    exec(of(said, "stated")[0]["python"], space)
    assert [point["depth"] for point in points] == space["curve"].depth.tolist()


def test_the_last_message_of_a_curve_tells_its_law(ask):
    [end] = of(ask(curve, loads=LOADS), "curve")
    assert not end["stopped"]
    assert end["facts"][0][0] == "power law"
    assert len(end["fit"]["force"]) == len(end["fit"]["stiffness"]) == end["resolved"]


def test_theories_that_do_not_apply_say_why_and_leave_the_command(ask):
    ask(curve, loads=LOADS)
    said = ask(theories, loads=LOADS | BESIDE)
    persson, cmy = sorted(of(said, "theory"), key=lambda each: "refused" in each)
    assert persson["name"] == "persson"
    assert len(persson["predicted"]["contact_area"]) == LOADS["count"]
    assert cmy["name"] == "cmy"
    assert "hardness" in cmy["refused"]
    [stated] = of(said, "stated")
    assert "--theory persson --resistivity steel,aluminium" in stated["command"]
    record = json.loads(run(stated["command"] + " --json"))
    assert record["theories"]["persson"]["predicted"] == persson["predicted"]
    space = {}
    exec(stated["python"], space)
    assert space["comparisons"][0].predicted["contact_area"].tolist() == persson["predicted"]["contact_area"]


def test_conductances_of_points_are_those_of_the_python_that_is_stated(ask):
    points = of(ask(curve, loads=LOADS), "point")
    space = {}
    exec(of(ask(theories, loads=LOADS | BESIDE), "stated")[0]["python"], space)
    for name in ("thermal_conductance_per_area", "electrical_conductance_per_area"):
        assert [point[name] for point in points] == space["conductance"][name].tolist()


def test_one_rigid_body_conducts_nothing(ask):
    [loads] = of(ask(curve, loads=LOADS, bodies={"materials": ["steel", "rigid"]}), "loads")
    assert not any("conductance" in column["name"] for column in loads["columns"])


def rows(text):
    return [line for line in text.splitlines() if not line.startswith("#")]


def test_the_table_of_a_curve_is_that_of_its_command(ask, tmp_path):
    loads = LOADS | {"theories": ["persson"], "conducting": True}
    [(header, data)] = [each for each in ask(export, loads=loads, kind="csv", of="curve") if each[1]]
    assert header["name"] == "part-curve-force.csv"
    run(of(ask(theories, loads=loads), "stated")[0]["command"] + " --out out")
    assert rows(data.decode()) == rows((tmp_path / "out" / "curve.csv").read_text())


def test_the_archive_holds_what_the_commands_give_and_how_to_make_it_again(ask):
    load = {"control": "pressure", "text": "3 MPa"}
    [(header, data)] = [each for each in ask(export, load=load, loads=LOADS, kind="zip") if each[1]]
    assert header["name"] == "part-contact.zip"
    archive = zipfile.ZipFile(io.BytesIO(data))
    for command in archive.read("commands.sh").decode().splitlines():
        theirs = json.loads(run(f"{command} --json"))
        ours = json.loads(archive.read(f"{theirs['command']}.json"))
        shared = ours.keys() & theirs.keys() - {"theories"}
        assert {"force", "depth", "stiffness", "contact_area"} <= shared
        assert {key: ours[key] for key in shared} == {key: theirs[key] for key in shared}
    assert rows(archive.read("curve.csv").decode())[0].startswith("force,")
    space = {}
    exec(archive.read("same.py"), space)
    assert space["solution"].force == json.loads(archive.read("press.json"))["force"]


def test_a_picture_of_the_load_is_named_by_it(ask):
    load = {"control": "pressure", "text": "3 MPa"}
    [(header, data)] = [each for each in ask(export, load=load, kind="svg", of="load") if each[1]]
    assert header["name"] == "part-pressure-3MPa.svg"
    assert data.startswith(b"<?xml")


def test_without_a_curve_there_is_nothing_to_export(ask):
    with pytest.raises(ValueError, match="start the curve"):
        ask(export, kind="csv", of="curve")


def test_a_load_that_the_grid_does_not_resolve_has_a_remedy(ask):
    light = ask(press, load={"control": "force", "text": "1 uN"})
    assert "larger load" in of(light, "state")[0]["warning"]
    assert of(ask(press, load={"control": "force", "text": "0.3 N"}), "state")[0]["warning"] == ""


def test_reduced_maps_keep_the_highest_pressure_and_the_lowest_gap(ask, file):
    said = ask(press, load={"control": "force", "text": "0.3 N"}, pixels=16)
    maps = {header["map"]: np.frombuffer(data, "<f4") for header, data in said if header["type"] == "map"}
    solution = rc.press(
        rc.read(file.path).levelled("plane"),
        rc.reduced_modulus(*(rc.handbook(name).solid for name in BODIES["materials"])),
        force=0.3,
    )
    for name, extreme in (("pressure", np.max), ("gap", np.min)):
        blocks = getattr(solution, name).reshape(16, 6, 16, 6)
        np.testing.assert_array_equal(maps[name].reshape(16, 16), extreme(blocks, axis=(1, 3)).astype("<f4"))


def test_sliders_go_from_a_light_load_to_a_heavy_one(ask, file):
    surface = rc.read(file.path).levelled("plane")
    modulus = rc.reduced_modulus(*(rc.handbook(name).solid for name in BODIES["materials"]))
    [span] = of(ask(press), "span")
    # From a thousandth of the rms height to ten of them: the highest point of a surface stands no higher.
    np.testing.assert_allclose(span["depth"], np.array([1e-3, 10, 1]) * surface.rms, rtol=1e-12)
    assert span["depth"][1] < 100 * surface.rms
    np.testing.assert_allclose(span["force"], np.array(span["pressure"]) * surface.grid.area, rtol=1e-12)
    most = span["pressure"][1]
    assert span["pressure"] == pytest.approx([most / 2e6, most, most / 200], rel=1e-12)
    # At the upper end the pressure is of the order of the modulus times the slope: nearly all is in contact.
    assert rc.press(surface, modulus, pressure=most).contact_fraction > 0.9


@pytest.mark.parametrize("axis", ["row", "column"])
def test_a_cut_is_a_line_of_the_solution(ask, file, axis):
    load = {"control": "force", "text": "0.3 N"}
    [found] = of(ask(cut, load=load, axis=axis, place=8), "cut")
    solution = rc.press(
        rc.read(file.path).levelled("plane"),
        rc.reduced_modulus(*(rc.handbook(name).solid for name in BODIES["materials"])),
        force=0.3,
    )
    line = (7, slice(None)) if axis == "row" else (slice(None), 7)
    assert found["count"] == 96
    assert found["gap"] == solution.gap[line].tolist()
    assert found["before"] == (solution.depth - solution.problem.separation[line]).tolist()
    assert found["across"] == solution.problem.grid.coordinates[0][7]
