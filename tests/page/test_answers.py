"""What the page shows and writes of a load and of a curve is what the command that it states gives."""

import io
import json
import re
import shlex
import zipfile
from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest
from typer.testing import CliRunner

import roughcontact as rc
from roughcontact.cli.app import app
from roughcontact.labels.variables import VARIABLES
from roughcontact.page.jobs.curve_jobs import curve, theories
from roughcontact.page.jobs.export_job import export
from roughcontact.page.jobs.press_jobs import cut, press
from roughcontact.page.jobs.session_cache import SessionCache, UploadedFile
from roughcontact.page.jobs.surface_jobs import look, study
from roughcontact.page.server.page_request import PageRequest
from roughcontact.page.stopping import Stopped

LOADS = {"forces": "50 mN:2 N:7"}
BODIES = {"materials": "steel,aluminium"}
CONDUCTION = dict.fromkeys(("resistivity", "conductivity"), "steel,aluminium")
THEORIES = {"theories": ["persson", "cmy"]}


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

    def plain(parts):
        source = {"kind": "file", "file": "key"}
        return {
            "job": "press" if "load" in parts else "curve",
            "source": source,
            "preparation": {"level": "plane"},
            "bodies": BODIES,
            **parts,
        }

    def asked(do, more=None, beside=None, **parts):
        said, more = [], {**(more or {}), "beside": None if beside is None else plain(beside)}
        request = PageRequest.of(plain(parts), {"key": file}, more)
        do(request, cache, lambda header, data=b"": said.append((json.loads(json.dumps(header)), data)))
        return said

    return asked


def of(said, kind):
    return [header for header, _ in said if header["type"] == kind]


def run(command):
    result = CliRunner().invoke(app, shlex.split(command)[1:])
    assert result.exit_code == 0, result.stderr
    return result.stdout


def test_the_points_of_a_curve_are_those_of_its_command(ask):
    said = ask(curve, loads=LOADS, ultrasound={"frequency": "5MHz"})
    record = json.loads(run(of(said, "stated")[0]["command"] + " --json"))
    points = of(said, "point")
    shown = [column["name"] for column in of(said, "loads")[0]["columns"]]
    assert {"interfacial_stiffness_per_area", "max_pressure", "mean_pressure"} <= {*shown}
    for name in shown:
        assert [point[name] for point in points] == record[name]
    table = (files("roughcontact.page") / "static" / "curve_table.js").read_text(encoding="utf-8")
    in_table = re.findall(r'"(\w+)"', table.partition("const COLUMNS = [")[2].partition("]")[0])
    assert {"interfacial_stiffness_per_area", *in_table} == {*in_table} <= {*VARIABLES}
    assert {name for name in in_table if name in record} <= {*shown}
    assert [point["resolved"] for point in points] == record["resolved"]
    space = {}
    exec(of(said, "stated")[0]["python"], space)
    assert [point["depth"] for point in points] == space["curve"].depth.tolist()


def test_the_last_message_of_a_curve_tells_its_law(ask):
    said = ask(curve, loads=LOADS)
    [end] = of(said, "curve")
    assert not end["stopped"]
    assert end["facts"][0][0] == "power law"
    assert (
        len(end["fit"]["force"])
        == len(end["fit"]["stiffness"])
        == sum(point["resolved"] for point in of(said, "point"))
    )


def test_theories_that_do_not_apply_say_why_and_leave_the_command(ask):
    ask(curve, loads=LOADS)
    said = ask(theories, THEORIES, loads=LOADS, conduction=CONDUCTION)
    persson, cmy = sorted(of(said, "theory"), key=lambda each: "refused" in each)
    assert persson["name"] == "persson"
    assert len(persson["predicted"]["contact_area"]) == 7
    assert cmy["name"] == "cmy"
    assert "hardness" in cmy["refused"]
    [stated] = of(said, "stated")
    assert (
        "--resistivity steel,aluminium --conductivity steel,aluminium --theory persson" in stated["command"]
    )
    record = json.loads(run(stated["command"] + " --json"))
    assert record["theories"]["persson"]["predicted"] == persson["predicted"]
    space = {}
    exec(stated["python"], space)
    comparison = space["curve"].compare(space["theories"][0])
    assert comparison.predicted["contact_area"].tolist() == persson["predicted"]["contact_area"]


def test_conductances_of_points_are_those_of_the_python_that_is_stated(ask):
    points = of(ask(curve, loads=LOADS, conduction=CONDUCTION), "point")
    space = {}
    exec(of(ask(theories, THEORIES, loads=LOADS, conduction=CONDUCTION), "stated")[0]["python"], space)
    for name in ("thermal_conductance_per_area", "electrical_conductance_per_area"):
        assert [point[name] for point in points] == space["conductance"][name].tolist()


def test_the_flow_at_each_point_is_that_of_the_python_that_is_stated(ask):
    """Computed once for a point and the curve; its columns stand beside the others, and in the files."""
    parts = {"loads": LOADS, "leak": {"leak": "1"}}
    said = ask(curve, **parts)
    [loads], points = of(said, "loads"), of(said, "point")
    assert {"hydraulic_gap", "transmissivity", "percolates"} <= {each["name"] for each in loads["columns"]}
    [stated], space = of(said, "stated"), {}
    assert "--leak 1" in stated["command"]
    exec(stated["python"], space)
    for name in ("hydraulic_gap", "flow_factor", "percolates"):
        assert [point[name] for point in points] == space["curve"].measured[name].tolist()
    assert any(name == "open path" for name, _ in of(said, "curve")[0]["facts"])
    [(_, table)] = [each for each in ask(export, {"kind": "csv"}, **parts) if each[1]]
    assert b"hydraulic_gap [m]" in table
    without = of(ask(curve, loads=LOADS), "loads")[0]["columns"]
    assert not any(each["name"] == "hydraulic_gap" for each in without)


def test_the_reflection_at_points_is_that_of_the_python_that_is_stated(ask):
    heard = {"frequency": "5MHz"}
    said, space = ask(curve, loads=LOADS, ultrasound=heard), {}
    points, [end] = of(said, "point"), of(said, "curve")
    exec(of(said, "stated")[0]["python"], space)
    for name in ("reflection", "error_amplification", "best_frequency"):
        assert [point[name] for point in points] == pytest.approx(
            space["reflection"][name].tolist(), rel=1e-14
        )
    assert any("K/A0 cannot be inferred from the reflection at 5 MHz" in note for note in end["notes"])
    [header] = of(said, "loads")
    assert {"name": "best_frequency", "label": "best frequency", "unit": "Hz"} in header["columns"]
    silent = ask(curve, loads=LOADS)
    assert not any("reflection" in point for point in of(silent, "point"))
    assert not any("K/A0" in note for note in of(silent, "curve")[0]["notes"])
    [(_, table)] = ask(export, {"kind": "csv"}, loads=LOADS, ultrasound=heard)[-1:]
    assert b"error_amplification" in table


def test_gas_and_radiation_are_columns_of_the_points(ask):
    heat = {"gas": "air,1bar,20degC,alpha=0.9:0.9", "emissivity": "0.2"}
    said = ask(curve, loads=LOADS, conduction=CONDUCTION, heat=heat)
    [loads], points = of(said, "loads"), of(said, "point")
    record = json.loads(run(of(said, "stated")[0]["command"] + " --json"))
    labels = {each["name"]: (each["label"], each["unit"]) for each in loads["columns"]}
    assert labels["joint_conductance_per_area"] == ("h of the joint", "W/m²/K")
    for part in ("spots", "gas", "radiation", "joint"):
        name = f"{part}_conductance_per_area"
        assert name in labels
        assert [point[name] for point in points] == record[name]


def test_one_rigid_body_conducts_nothing(ask):
    [loads] = of(ask(curve, loads=LOADS, bodies={"materials": "steel,rigid"}), "loads")
    assert not any("conductance" in column["name"] for column in loads["columns"])


def rows(text):
    return [line for line in text.splitlines() if not line.startswith("#")]


def test_the_table_of_a_curve_is_that_of_its_command(ask, tmp_path):
    beside = {"theories": {"theory": "persson"}, "conduction": CONDUCTION}
    [(header, data)] = [each for each in ask(export, {"kind": "csv"}, loads=LOADS, **beside) if each[1]]
    assert re.fullmatch(r"part-curve-[0-9a-f]{6}\.csv", header["name"])
    run(
        of(ask(theories, {"theories": ["persson"]}, loads=LOADS, conduction=CONDUCTION), "stated")[0][
            "command"
        ]
        + " --out out"
    )
    assert rows(data.decode()) == rows((tmp_path / "out" / "curve.csv").read_text())


@pytest.mark.slow
def test_the_archive_holds_what_the_commands_give_and_how_to_make_it_again(ask):
    load = {"pressure": "3 MPa"}
    [(header, data)] = [each for each in ask(export, {"kind": "zip"}, {"loads": LOADS}, load=load) if each[1]]
    assert re.fullmatch(r"part-contact-[0-9a-f]{6}\.zip", header["name"])
    archive = zipfile.ZipFile(io.BytesIO(data))
    for command in archive.read("commands.sh").decode().splitlines():
        theirs = json.loads(run(f"{command} --json"))
        ours = json.loads(archive.read(f"{theirs['command']}.json"))
        shared = ours.keys() & theirs.keys() - {"theories"}
        assert {"force", "depth", "stiffness", "contact_area"} <= shared
        assert {key: ours[key] for key in shared} == {key: theirs[key] for key in shared}
    assert rows(archive.read("curve.csv").decode())[0].startswith("force [N],")
    space = {}
    exec(archive.read("same.py"), space)
    assert space["solution"].force == json.loads(archive.read("press.json"))["force"]


def test_a_picture_of_the_load_is_named_by_it(ask):
    load = {"pressure": "3 MPa"}
    [(header, data)] = [each for each in ask(export, {"kind": "svg"}, load=load) if each[1]]
    assert re.fullmatch(r"part-pressure-3MPa-[0-9a-f]{6}\.svg", header["name"])
    assert data.startswith(b"<?xml")


def test_without_a_load_there_is_nothing_to_export(file):
    with pytest.raises(ValueError, match="start the curve"):
        export(
            PageRequest.of(
                {"job": "surface", "source": {"kind": "file", "file": "key"}}, {"key": file}, {"kind": "csv"}
            ),
            SessionCache(),
            lambda *_: None,
        )


def test_a_load_that_the_grid_does_not_resolve_has_a_remedy(ask):
    light = ask(press, load={"force": "1 uN"})
    assert "larger load" in of(light, "state")[0]["warning"]
    assert of(ask(press, load={"force": "0.3 N"}), "state")[0]["warning"] == ""


def test_reduced_maps_keep_the_highest_pressure_and_the_lowest_gap(ask, file):
    said = ask(press, {"pixels": 16}, load={"force": "0.3 N"})
    maps = {header["map"]: np.frombuffer(data, "<f4") for header, data in said if header["type"] == "map"}
    solution = rc.press(
        rc.read(file.path).levelled("plane"),
        rc.reduced_modulus(*(rc.handbook(name).solid for name in BODIES["materials"].split(","))),
        force=0.3,
    )
    for name, extreme in (("pressure", np.max), ("gap", np.min)):
        blocks = getattr(solution, name).reshape(16, 6, 16, 6)
        np.testing.assert_array_equal(maps[name].reshape(16, 16), extreme(blocks, axis=(1, 3)).astype("<f4"))


def test_sliders_go_from_a_light_load_to_a_heavy_one(ask, file):
    surface = rc.read(file.path).levelled("plane")
    modulus = rc.reduced_modulus(*(rc.handbook(name).solid for name in BODIES["materials"].split(",")))
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
    load = {"force": "0.3 N"}
    [found] = of(ask(cut, {"axis": axis, "place": 8}, load=load), "cut")
    solution = rc.press(
        rc.read(file.path).levelled("plane"),
        rc.reduced_modulus(*(rc.handbook(name).solid for name in BODIES["materials"].split(","))),
        force=0.3,
    )
    line = (7, slice(None)) if axis == "row" else (slice(None), 7)
    assert found["count"] == 96
    assert found["gap"] == solution.gap[line].tolist()
    assert found["before"] == (solution.depth - solution.problem.separation[line]).tolist()
    assert found["across"] == solution.problem.grid.coordinates[0][7]


def test_a_spike_takes_no_room_in_the_distribution_of_the_pressure(ask, file):
    """The bars hold what is in contact, less the part that is named."""
    heights = rc.read(file.path).heights.copy()
    heights[20, 30] += 2e-6
    rc.write(rc.Surface(heights, rc.Grid((96, 96), 1e-6)), file.path)
    [found] = of(ask(press, load={"pressure": "2 GPa"}), "pressures")
    [header] = [
        each for each in of(ask(press, load={"pressure": "2 GPa"}), "map") if each["map"] == "pressure"
    ]
    width = found["x"][1] - found["x"][0]
    assert found["x"][-1] < 0.2 * header["ends"][1]
    part = float(re.search(r"([\d.]+) % of the contact area", found["beyond"])[1]) / 100
    [point] = [each["point"] for each in of(ask(press, load={"pressure": "2 GPa"}), "numbers")]
    # The part is written with two digits.
    assert sum(found["y"]) * width == pytest.approx((1 - part) * point["contact_fraction"], abs=5e-3 * part)


def test_the_distribution_of_hertz_needs_no_end(ask):
    ball = {"kind": "shape", "shape": "sphere", "radius": "5mm", "size": "0.2mm", "points": "64"}
    [found] = of(ask(press, source=ball, preparation={}, load={"force": "1N"}), "pressures")
    assert (found["beyond"], found["unit"]) == ("", "Pa")


WAVY = {"kind": "self-affine", "hurst": "0.8", "rms": "0.2um", "size": "64um", "points": "64", "seed": "3"}


@pytest.mark.parametrize(
    ("profile", "body", "unit"), [("line", "line", "Pa"), ("winkler", "foundation", "N/m")]
)
def test_a_profile_is_a_map_of_one_row(ask, profile, body, unit):
    parts = {"source": WAVY, "contact": {"profile": profile}}
    [heights] = of(ask(look, **parts), "map")
    assert (heights["cells"], heights["lengths"][1]) == ([1, 64], 64e-6)
    [span] = of(ask(press, **parts), "span")
    start = f"{span['pressure'][2]} {span['units']['pressure']}"
    said = ask(press, load={"pressure": start}, **parts)
    space = {}
    exec(of(said, "numbers")[0]["python"], space)
    solution = space["solution"]
    assert solution.problem.geometry.value == body
    assert 0 < solution.contact_fraction < 1
    data = {header["map"]: (header, data) for header, data in said if header["type"] == "map"}
    assert data["pressure"][0]["unit"] == of(said, "pressures")[0]["unit"] == unit
    np.testing.assert_array_equal(np.frombuffer(data["gap"][1], "<f4"), solution.gap.astype("<f4"))
    for axis in ("row", "column"):  # it has one line
        [found] = of(ask(cut, {"axis": axis, "place": 8}, load={"pressure": start}, **parts), "cut")
        assert (found["axis"], found["count"], found["across"], found["unit"]) == ("row", 1, None, unit)
        assert found["gap"] == solution.gap.tolist()
    facts = [name for name, *_ in of(ask(study, **parts), "roughness")[0]["facts"]]
    assert facts[:2] == ["Rq", "Ra"]


def test_the_curve_of_a_profile_has_its_units(ask):
    said = ask(curve, source=WAVY, contact={"profile": "line"}, loads={"forces": "1N/mm:10N/mm:3"})
    units = {each["name"]: each["unit"] for each in of(said, "loads")[0]["columns"]}
    assert (units["force"], units["stiffness"], units["nominal_pressure"]) == ("N/m", "N/m²", "Pa")
    assert len(of(said, "point")) == 3


def test_a_state_of_surfaces_that_stick_is_that_of_the_library(ask):
    said = ask(
        curve,
        job="adhesion press",
        load={"depth": "20nm"},
        preparation=SMALL,
        bodies={"modulus": "1GPa"},
        adhesion=ADHESION,
    )
    space = {}
    exec(of(said, "stated")[0]["python"], space)
    [point] = of(said, "point")
    assert (point["depth"], point["force"]) == (2e-8, space["state"].force)
    [(header, data)] = [(header, data) for header, data in said if header["type"] == "map"]
    assert header["map"] == "traction"
    assert header["ends"][0] < 0 < header["ends"][1]
    np.testing.assert_array_equal(
        np.frombuffer(data, "<f4").reshape(header["shape"]), space["state"].pressure.astype("<f4")
    )


def test_a_total_conductance_is_a_column(ask):
    said = ask(curve, loads={"forces": "0.5 N"}, conduction={**CONDUCTION, "of": "total"})
    names = [each["name"] for each in of(said, "loads")[0]["columns"]]
    assert {"electrical_conductance", "thermal_conductance"} <= of(said, "point")[0].keys() & {*names}
    assert "electrical_conductance_per_area" not in names


PLASTIC = {"hardness": "1.5 GPa", "loop": True}
ADHESION = {"work": "10mJ/m^2", "range": "100nm"}
SMALL = {"crop": "0:24,0:24", "level": "plane"}


def test_the_branches_of_a_loop_are_those_of_the_library(ask):
    said = ask(curve, loads={"forces": "50 mN:0.5 N:4"}, plastic=PLASTIC)
    space = {}
    exec(of(said, "stated")[0]["python"], space)
    points, loop = of(said, "point"), space["loop"]
    assert of(said, "loads")[0]["count"] == len(points) == 12
    for name, branch in loop.curves.items():
        mine = [point for point in points if point["branch"] == name]
        for quantity in ("force", "depth", "stiffness", "contact_area", "interfacial_stiffness_per_area"):
            assert [point[quantity] for point in mine] == getattr(branch, quantity).tolist(), (name, quantity)
    facts = dict(of(said, "curve")[0]["facts"])
    assert {"residual depth", "volume of flow", "dissipated work", "mean gap at the largest load"} <= {*facts}
    [(header, data)] = [(header, data) for header, data in said if header["type"] == "map"]
    heights = loop.flattened.heights
    assert header["map"] == "flattened"
    np.testing.assert_array_equal(
        np.frombuffer(data, "<f4").reshape(header["shape"]), (heights - heights.mean()).astype("<f4")
    )


def test_a_loop_of_surfaces_that_stick_is_that_of_the_library(ask):
    job = {"job": "adhesion loop", "turn": {"depth": "50nm", "points": "5"}, "adhesion": ADHESION}
    said = ask(curve, preparation=SMALL, bodies={"modulus": "1GPa"}, **job)
    space = {}
    exec(of(said, "stated")[0]["python"], space)
    points, loop = of(said, "point"), space["curve"]
    for quantity in ("depth", "force", "contact_fraction", "stiffness", "mean_gap"):
        assert [point[quantity] for point in points] == getattr(loop, quantity).tolist(), quantity
    assert [point["branch"] for point in points] == loop.branch.tolist()
    lines = of(said, "curve")[0]["lines"]
    assert {"approach", "retreat", "pull-off force"} <= {line["label"] for line in lines}
    [level] = [line for line in lines if line["label"] == "pull-off force"]
    assert level["y"] == [-loop.pull_off_force] * 2


@pytest.mark.slow
def test_a_jump_is_a_line_of_two_places(ask):
    """Under a prescribed depth the force jumps; a chart has one value a place."""
    job = {"job": "adhesion loop", "turn": {"depth": "1nm", "points": "2"}}
    adhesion = {"work": "50mJ/m^2", "range": "5nm", "allow_unresolved": True}
    said = ask(curve, preparation=SMALL, bodies={"modulus": "1GPa"}, adhesion=adhesion, **job)
    lines = [line for line in of(said, "curve")[0]["lines"] if line["label"] == "jump"]
    assert lines
    for line in lines:
        assert len({*line["x"]}) == 2
        assert line["x"][1] == pytest.approx(line["x"][0], rel=1e-6)
    assert any("Unresolved" in note for note in of(said, "curve")[0]["notes"])


def test_surfaces_that_are_drawn_back_let_go_as_those_of_the_library(ask):
    job = {"job": "adhesion detach", "load": {"force": "10mN"}, "adhesion": {"work": "10mJ/m^2"}}
    said = ask(
        curve, preparation=SMALL, bodies={"modulus": "1GPa"}, retreat={"depths": "100nm:-50nm:4"}, **job
    )
    space = {}
    exec(of(said, "stated")[0]["python"], space)
    assert [point["force"] for point in of(said, "point")] == space["curve"].force.tolist()
    [line] = [line for line in of(said, "curve")[0]["lines"] if line["label"] == "retreat"]
    assert min(line["y"]) == pytest.approx(-space["curve"].pull_off_force, rel=1e-9)
    assert (np.diff(line["x"]) < 0).all()


@pytest.mark.parametrize("kind", ["csv", "nc", "png"])
def test_a_loop_is_exported(ask, kind):
    [(header, data)] = [
        each
        for each in ask(export, {"kind": kind}, loads={"forces": "50 mN,0.5 N"}, plastic=PLASTIC)
        if each[1]
    ]
    assert re.fullmatch(rf"part-curve-[0-9a-f]{{6}}\.{kind}", header["name"])
    if kind == "csv":
        assert len(rows(data.decode())) == 7
        assert "unloading" in data.decode()


def test_a_curve_that_is_stopped_is_that_of_the_loads_that_it_reached(file, monkeypatch):
    cache, said = SessionCache(), []
    plain = {"job": "curve", "source": {"kind": "file", "file": "key"}, "bodies": BODIES, "loads": LOADS}

    def send(header, data=b""):
        said.append(header)
        if sum(header["type"] == "point" for header in said) == 3 and header["type"] == "point":
            stop.append(True)

    stop = []
    follow = SessionCache.followed

    def followed(self, job):
        path = follow(self, job)

        def states():
            for state in path.states:
                if stop:
                    raise Stopped
                yield state

        return replace(path, states=states())

    monkeypatch.setattr(SessionCache, "followed", followed)
    curve(PageRequest.of(plain, {"key": file}, {}), cache, send)
    monkeypatch.undo()
    [end] = of([(header, b"") for header in said], "curve")
    assert end["stopped"]
    again = PageRequest.of({**plain, **end["part"]}, {"key": file}, {})
    found = cache.curve(again.job)
    assert len(found) == 3
    assert (
        found.force.tolist()
        == rc.loading_curve(
            cache.surface(again.job), found.modulus, forces=np.geomspace(0.05, 2, 7)[:3]
        ).force.tolist()
    )


def test_exports_of_different_answers_have_different_names(ask):
    def named(**more):
        [(header, _)] = [each for each in ask(export, {"kind": "csv"}, job="press", **more) if each[1]]
        return header["name"]

    first = named(load={"pressure": "3MPa"})
    assert first == named(load={"pressure": "3MPa"})
    assert first != named(load={"pressure": "3MPa"}, preparation={"level": "mean"})
