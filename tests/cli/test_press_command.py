import dataclasses
import errno
import json
from pathlib import Path

import numpy as np
import pytest
import xarray
from matplotlib.text import Text

import roughcontact as rc
from roughcontact.cli.report import solution_facts
from roughcontact.plot import canvas as figures

MODULUS = ("--modulus", "110GPa")
FORCE = ("--force", "10mN")


def test_it_answers_as_the_library_does(invoke, rough, surface):
    answer = invoke("press", rough, *FORCE, *MODULUS, "--level", "none", "--json")
    assert answer.exit_code == 0
    solution = rc.press(surface, 110e9, force=0.01)
    record = json.loads(answer.stdout)
    for name in (
        "force",
        "depth",
        "stiffness",
        "interfacial_stiffness",
        "contact_area",
        "mean_gap",
        "residual",
    ):
        assert record[name] == getattr(solution, name), name
    assert record["max_pressure"] == solution.pressure.max()
    assert record["spots"] == solution.spots.count
    assert record["converged"] is True
    assert record["tolerance"] == 1e-8
    assert record["modulus"] == 110e9
    assert record["units"]["depth"] == "m"


def test_the_plane_is_taken_out_unless_told_otherwise_and_it_says_so(invoke, rough, surface):
    heights = surface.heights + 1e-7 * np.arange(32)
    np.savez(rough, heights=heights, spacing=np.array(surface.grid.spacing), unit=np.array("m"))
    tilted = rc.read(rough)
    depths = {}
    for level, expected in (
        (None, tilted.levelled("plane")),
        ("plane", tilted.levelled("plane")),
        ("mean", tilted.levelled("mean")),
        ("none", tilted),
    ):
        answer = invoke(
            "press", rough, *FORCE, *MODULUS, "--json", *(() if level is None else ("--level", level))
        )
        depths[level] = json.loads(answer.stdout)["depth"]
        assert depths[level] == rc.press(expected, 110e9, force=0.01).depth
        assert ("removed by a least-squares plane" in answer.stderr) == (level is None)
    assert depths["plane"] != depths["none"]


def test_the_load_can_be_a_force_a_pressure_or_a_depth(invoke, rough, surface):
    def ask(*load):
        return json.loads(invoke("press", rough, *load, *MODULUS, "--level", "none", "--json").stdout)

    pressure = 0.01 / surface.grid.area
    assert ask("--pressure", f"{pressure!r}Pa")["force"] == pytest.approx(0.01, rel=1e-12)
    assert ask("--depth", "50nm")["depth"] == pytest.approx(50e-9, rel=1e-14)


def test_the_modulus_can_follow_from_the_bodies(invoke, rough):
    def ask(*bodies):
        return json.loads(invoke("press", rough, *FORCE, *bodies, "--json").stdout)["modulus"]

    steel, aluminium = rc.Solid(210e9, 0.3), rc.Solid(70e9, 0.33)
    first = ("--young", "210GPa", "--poisson", "0.3")
    assert ask(*first) == rc.reduced_modulus(steel)
    assert ask(*first, "--young2", "70GPa", "--poisson2", "0.33") == rc.reduced_modulus(steel, aluminium)


def test_a_file_that_says_it_is_periodic_is_pressed_so(invoke, tmp_path):
    path = tmp_path / "made.npz"
    making = ("--hurst", "0.8", "--rms", "1um", "--size", "1mm", "--points", "16", "--periodic")
    assert invoke("surface", "make", path, *making).exit_code == 0
    answer = invoke("press", path, *FORCE, *MODULUS, "--json")
    assert json.loads(answer.stdout)["periodic"] == [True, True]
    assert "its mean height is removed" in answer.stderr
    free = invoke("press", path, *FORCE, *MODULUS, "--json", "--free")
    assert json.loads(free.stdout)["periodic"] == [False, False]
    assert "removed by a least-squares plane" in free.stderr


def test_a_periodic_surface_has_no_edge(invoke, rough):
    record = json.loads(invoke("press", rough, *FORCE, *MODULUS, "--periodic", "--json").stdout)
    assert record["periodic"] == [True, True]
    assert record["touches_edge"] is False


def test_a_person_gets_a_table(invoke, rough):
    answer = invoke("press", rough, *FORCE, *MODULUS)
    assert answer.exit_code == 0
    lines = dict(line.split("   ", 1) for line in answer.stdout.splitlines())
    assert lines["force"].strip() == "10 mN"
    assert lines["reduced modulus E*"].strip() == "110 GPa"
    assert "24 x 32 cells, 48 µm x 32 µm, free" in lines["surface"]
    assert "tolerance 1e-08: met" in lines["certificate"]


def test_numbers_per_area_are_told_in_the_units_of_the_user(invoke, rough):
    words = ("press", rough, "--pressure", "5MPa", *MODULUS)
    record = json.loads(invoke(*words, "--json").stdout)
    areal = record["interfacial_stiffness"] / record["nominal_area"]
    assert record["interfacial_stiffness_per_area"] == pytest.approx(areal, rel=1e-15)
    assert record["nominal_area"] == pytest.approx(48e-6 * 32e-6, rel=1e-12)

    def told(*more):
        lines = invoke(*words, *more).stdout.splitlines()
        facts = dict(line.split("   ", 1) for line in lines if "   " in line)
        return [facts[name].split() for name in ("interfacial stiffness per area K/A0", "nominal pressure")]

    assert told() == [[f"{areal / 1e12:.4g}", "N/µm/mm²"], ["5", "MPa"]]
    units = ("--unit-stiffness", "MPa/mm", "--unit-pressure", "bar")
    assert told(*units) == [[f"{areal / 1e9:.4g}", "MPa/mm"], ["50", "bar"]]
    errors = invoke(*words, *units, "--errors").stdout.partition("errors at")[2]
    assert any("K/A0" in line and "MPa/mm" in line for line in errors.splitlines())


def test_a_gap_that_is_mere_rounding_is_none(invoke, rough):
    answer = invoke("press", rough, "--force", "1e9N", *MODULUS)
    (gap,) = (line.split()[2:] for line in answer.stdout.splitlines() if line.startswith("mean gap"))
    assert gap == ["0", "m"]
    assert solution_facts(rc.press(rc.read(rough), 110e9, force=0.01))[11][1] != "0 m"


def test_what_a_reader_should_know_is_a_note(invoke, rough, surface):
    heights = surface.heights.copy()
    heights[3, 4:6] = np.nan
    heights[0, 0] = 2 * np.nanmax(heights)
    np.savez(rough, heights=heights, spacing=np.array(surface.grid.spacing), unit=np.array("m"))
    answer = invoke("press", rough, *FORCE, *MODULUS)
    tilt, *notes = answer.stderr.splitlines()
    assert "the tilt is removed" in tilt
    assert [line.split(maxsplit=2)[1:2] for line in notes[:1]] in ([["A"]], [["Not"]])  # what is wrong
    assert "Note: 2 cells hold no height" in notes[-2]
    assert "Note: The cells at the edge of the map carry" in notes[-1]


@pytest.mark.usefixtures("drawn")
def test_files_and_picture_stand_in_the_folder(invoke, rough, tmp_path):
    out = tmp_path / "new" / "result"
    answer = invoke("press", rough, *FORCE, *MODULUS, "--out", out, "--json")
    assert answer.exit_code == 0
    assert sorted(path.name for path in out.iterdir()) == ["press.json", "pressure.nc", "pressure.png"]
    record = json.loads(answer.stdout)
    summary = json.loads((out / "press.json").read_text(encoding="utf-8"))
    assert summary.items() >= record.items()
    assert summary["provenance"]["input_control"] == "force = 0.01 N"
    with xarray.open_dataset(out / "pressure.nc") as dataset:
        assert float(dataset["force"]) == record["force"]
        assert dataset["pressure"].shape == (24, 32)
        assert float(dataset["pressure"].max()) == record["max_pressure"]
    assert (out / "pressure.png").read_bytes().startswith(b"\x89PNG")


class TestMissedTolerance:
    @pytest.fixture(autouse=True)
    def _stagnate(self, monkeypatch):
        press = rc.press

        def stagnated(*arguments, **named):
            raise rc.ConvergenceError(
                dataclasses.replace(press(*arguments, **named), status=rc.Status.STAGNATED)
            )

        monkeypatch.setattr(rc, "press", stagnated)

    def test_the_answer_is_marked_and_the_status_is_1(self, invoke, rough, tmp_path):
        answer = invoke("press", rough, *FORCE, *MODULUS, "--json", "--out", tmp_path / "out")
        assert answer.exit_code == 1
        record = json.loads(answer.stdout)
        assert (record["converged"], record["status"]) == (False, "stagnated")
        assert json.loads((tmp_path / "out" / "press.json").read_text())["converged"] is False
        assert "The residual stopped falling above the tolerance" in answer.stderr

    def test_a_person_sees_it_in_the_table(self, invoke, rough):
        answer = invoke("press", rough, *FORCE, *MODULUS)
        assert answer.exit_code == 1
        assert "MISSED" in answer.stdout

    def test_it_has_no_errors_and_a_note_says_why(self, invoke, rough):
        answer = invoke("press", rough, *FORCE, *MODULUS, "--errors", "--json")
        assert answer.exit_code == 1
        assert json.loads(answer.stdout)["errors"] is None
        assert "Note: no errors at 10 mN: residual" in answer.stderr


class TestNothingHalfWritten:
    @pytest.fixture
    def out(self, tmp_path):
        out = tmp_path / "out"
        out.mkdir()
        (out / "press.json").write_text("of yesterday")
        return out

    @staticmethod
    def _left(folder):
        return {path.name: path.read_text() for path in folder.iterdir()}

    @pytest.mark.parametrize(
        ("error", "status"),
        [
            (OSError(errno.ENOSPC, "No space left on device", "pressure.png"), 2),
            (KeyboardInterrupt(), 130),
            (RuntimeError("a mistake of ours"), 1),
        ],
    )
    def test_a_failure_between_the_files_leaves_what_was_there(
        self, invoke, rough, out, monkeypatch, error, status
    ):
        def fail(*_):
            raise error

        monkeypatch.setattr(figures, "save", fail)
        answer = invoke("press", rough, *FORCE, *MODULUS, "--out", out)
        assert answer.exit_code == status
        assert self._left(out) == {"press.json": "of yesterday"}
        assert answer.stdout == ""

    def test_a_folder_made_for_a_run_that_fails_goes_again(self, invoke, rough, tmp_path):
        answer = invoke("press", rough, "--force", "-1N", *MODULUS, "--out", tmp_path / "new" / "out")
        assert answer.exit_code == 2
        assert sorted(path.name for path in tmp_path.iterdir()) == ["rough.npz"]

    def test_a_folder_in_the_place_of_a_file_is_refused(self, invoke, rough, out):
        (out / "pressure.nc").mkdir()
        answer = invoke("press", rough, *FORCE, *MODULUS, "--out", out)
        assert answer.exit_code == 2
        assert "it is a folder; choose another --out" in answer.stderr
        assert sorted(path.name for path in out.iterdir()) == ["press.json", "pressure.nc"]
        assert (out / "press.json").read_text() == "of yesterday"

    def test_the_folder_is_tried_before_the_work(self, invoke, rough, monkeypatch):
        monkeypatch.setattr(rc, "read", lambda *_, **__: pytest.fail("it went to work"))
        answer = invoke("press", rough, *FORCE, *MODULUS, "--out", rough)
        assert answer.exit_code == 2
        assert "is a file" in answer.stderr


@pytest.mark.usefixtures("drawn")
def test_the_distribution_of_the_pressure_is_drawn_beside_a_theory(invoke, rough, tmp_path):
    words = ("press", rough, "--force", "1N", "--modulus", "110GPa", "--theory", "persson")
    answer = invoke(*words, "--out", tmp_path / "result")
    assert answer.exit_code == 0
    assert (tmp_path / "result" / "distribution.png").stat().st_size > 10_000
    nowhere = invoke(*words)
    assert nowhere.exit_code == 2
    assert "say where by --out" in nowhere.stderr
    assert invoke(*words[:-1], "gw", "--out", tmp_path / "result").exit_code == 2


def test_a_hardness(invoke, rough):
    words = ("press", rough, "--force", "1N", "--modulus", "110GPa", "--json")
    soft = json.loads(invoke(*words, "--hardness", "2GPa").stdout)
    assert soft["max_pressure"] == 2e9
    assert any("they are plastic" in note for note in soft["notes"])
    for bad in ("--hardness=-1GPa", "--hardness=2N"):
        assert invoke(*words, bad).exit_code == 2


def test_bodies_can_be_named(invoke, rough, surface):
    answer = invoke("press", rough, *FORCE, "--materials", "steel, Aluminium", "--level", "none", "--json")
    steel, aluminium = rc.handbook("steel"), rc.handbook("aluminium")
    assert json.loads(answer.stdout)["modulus"] == rc.reduced_modulus(steel.solid, aluminium.solid)
    assert "steel is AISI 1045" in answer.stderr  # it says which steel, and who says so
    assert "ASM" in answer.stderr
    rigid = invoke("press", rough, *FORCE, "--materials", "rigid,copper", "--level", "none", "--json")
    assert json.loads(rigid.stdout)["modulus"] == rc.reduced_modulus(rc.handbook("copper").solid)


def test_a_hardness_can_be_that_of_a_material(invoke, rough, surface):
    given = ("press", rough, "--force", "1N", "--materials", "steel,aluminium", "--level", "none", "--json")
    record = json.loads(invoke(*given, "--hardness", "aluminium").stdout)
    assert record["max_pressure"] == pytest.approx(rc.handbook("aluminium").hardness)
    assert json.loads(invoke(*given).stdout)["max_pressure"] > record["max_pressure"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (
            ("--materials", "steel"),
            "'steel' does not name two bodies; name both, such as steel,aluminium",
        ),
        (("--materials", "steel,aluminium,copper"), "does not name two bodies"),
        (("--materials", "steel,cheese"), "no material named 'cheese'; there are steel"),
        (("--materials", "steel,110GPa"), "'110GPa' is not a name"),
        (("--materials", "rigid,rigid"), "one of the two bodies must be elastic"),
        (("--materials", "steel,steel", "--modulus", "1GPa"), "exclude each other"),
        (
            ("--materials", "steel,steel", "--poisson", "0.3"),
            "--poisson needs --young, which is not given",
        ),
        (("--modulus", "110"), "110 without a unit is 110 Pa, softer than foam; write 110GPa"),
        (("--young", "210", "--poisson", "0.3"), "--young: 210 without a unit"),
        (("--modulus", "1GPa", "--hardness", "2"), "--hardness: 2 without a unit"),
    ],
)
def test_bodies_that_make_no_sense_are_asked_about(invoke, rough, given, message):
    answer = invoke("press", rough, *FORCE, *given)
    assert answer.exit_code == 2
    assert message in answer.stderr


def test_a_soft_body_is_pressed_if_its_unit_is_given(invoke, rough):
    """And a bare number of pascals from a megapascal on."""
    for modulus in ("110Pa", "110 kPa", "1e6"):
        assert invoke("press", rough, "--depth", "10nm", "--modulus", modulus).exit_code == 0


@pytest.mark.usefixtures("drawn")
@pytest.mark.parametrize(("form", "magic"), [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")])
def test_pictures_come_in_the_format_that_is_asked_for(invoke, rough, tmp_path, form, magic):
    out = tmp_path / "result"
    answer = invoke(
        *("press", rough, "--force", "1N", *MODULUS, "--theory", "persson"),
        *("--out", out, "--format", form),
    )
    assert answer.exit_code == 0
    names = [f"distribution.{form}", "press.json", "pressure.nc", f"pressure.{form}"]
    assert sorted(path.name for path in out.iterdir()) == names
    for name in names[::3]:
        assert (out / name).read_bytes().startswith(magic)
        assert name in answer.stderr


def test_a_format_without_a_folder_is_refused_before_the_work(invoke, rough, monkeypatch):
    monkeypatch.setattr(rc, "read", lambda *_, **__: pytest.fail("it went to work"))
    for words in (
        ("press", rough, *FORCE, *MODULUS),
        ("curve", rough, *MODULUS),
        ("surface", "info", rough),
        ("surface", "spectrum", rough),
        ("conductance", rough, "--resistivity", "17nohm*m"),
    ):
        answer = invoke(*words, "--format", "svg")
        assert answer.exit_code == 2
        assert "--format is that of pictures: say where by --out" in answer.stderr


def test_errors_are_those_of_the_library(invoke, rough, surface, tmp_path):
    words = ("press", rough, *FORCE, *MODULUS, "--level", "none", "--errors", "--shortest-wave", "10um")
    answer = invoke(*words, "--json", "--out", tmp_path / "out")
    assert answer.exit_code == 0
    budget = rc.error_budget(rc.press(surface, 110e9, force=0.01), short_cutoff=10e-6)
    found = json.loads(answer.stdout)["errors"]
    assert found == {"force": found["force"], **budget.to_record()}
    assert found["force"] == pytest.approx(0.01, rel=1e-12)
    assert json.loads((tmp_path / "out" / "press.json").read_text())["errors"] == found
    assert json.loads(invoke("press", rough, *FORCE, *MODULUS, "--json").stdout)["errors"] is None


def test_noise_has_its_share_of_the_errors(invoke, rough, surface):
    words = ("press", rough, *FORCE, *MODULUS, "--level", "none", "--errors", "--noise", "3nm")
    length = ("--noise-length", "4um")
    found = json.loads(invoke(*words, *length, "--json").stdout)["errors"]
    noise = rc.Noise(3e-9, 4e-6)
    expected = rc.error_budget(rc.press(surface, 110e9, force=1e-2), noise=noise).to_record()
    assert found == {"force": found["force"], **expected}
    assert "white noise of 3e-09 m rms" in invoke(*words).stdout
    refused = invoke(*words, "--noise-length", "1m")
    assert refused.exit_code == 2
    assert "at most a quarter of the map" in refused.stderr
    at_depth = ("press", rough, "--depth", "10nm", *MODULUS, "--errors", "--noise", "3nm")
    assert "--noise needs a force or a pressure" in invoke(*at_depth).stderr


def test_errors_are_told_in_units_that_suit(invoke, rough):
    force = ("--force", "0.5N")  # 11 spots
    told = invoke("press", rough, *force, *MODULUS, "--errors").stdout
    table = told.partition("errors at 500 mN, nominal pressure ")[2].splitlines()[1:]
    assert table[0].split() == ["value", "error", "grid", "short", "cut-off", "levelling", "sampling"]
    stiffness = next(line for line in table if line.lstrip().startswith("interfacial stiffness"))
    record = json.loads(invoke("press", rough, *force, *MODULUS, "--errors", "--json").stdout)["errors"]
    known = record["interfacial_stiffness"]
    value, _, error, unit = stiffness.split()[2:6]
    assert unit == "MN/m"
    assert float(error) == pytest.approx(known["error"] * 1e-6, rel=0.05)
    assert float(value) == pytest.approx(known["value"] * 1e-6, abs=float(error) / 10)
    assert "short cut-off     bias: Gaussian low-pass at" in told
    # A periodic map stands for a joint: numbers per area. This one does not close, so that its levelling is a choice.
    joint = invoke("press", rough, *FORCE, *MODULUS, "--errors", "--periodic").stdout.partition("errors at")[
        2
    ]
    assert "levelling" in joint
    assert "K/A0" in joint


def texts(figure):
    return [text.get_text() for text in figure.findobj(Text)]


def test_what_other_maps_would_give_stands_in_table_picture_and_record(invoke, rough, tmp_path, monkeypatch):
    """A sentence with 3 spots, at 10 mN; a number with 11, at 0.5 N."""
    drawn = []
    monkeypatch.setattr(figures, "save", lambda figure, path: drawn.append(figure) or Path(path).touch())
    answers = {}
    for force in ("10mN", "0.5N"):
        words = ("press", rough, "--force", force, *MODULUS, "--errors")
        answers[force] = invoke(*words, "--out", tmp_path / force), invoke(*words, "--json")
    sentence = "3 spots, too few to estimate from one map how much another map of this surface would differ"
    (told, record), (known, numbers) = (
        (answer.stdout.partition("errors at")[2], json.loads(json_answer.stdout)["errors"])
        for answer, json_answer in answers.values()
    )
    assert f"sampling        {sentence}" in told
    assert "+- unknown" in told
    assert "size of the map" not in told
    assert record["sources"]["sampling"] == {"kind": "unknown", "how": sentence}
    assert record["interfacial_stiffness"]["sampling"] is record["interfacial_stiffness"]["error"] is None
    assert record["bias_of_size"] == {}
    assert f"at 10 mN, {sentence}" in texts(drawn[0])
    assert "sampling          order of magnitude: four free quarters" in known
    changes = (
        "size of the map   the numbers of quarters of the map differ from those of the map by: interfacial"
    )
    assert changes in known
    assert "unknown" not in next(line for line in known.splitlines() if "mean gap" in line)
    number = numbers["interfacial_stiffness"]
    assert 0 < number["sampling"] <= number["error"]
    part = 100 * number["sampling"] / number["value"]
    words = f"at 500 mN, sampling, in order of magnitude: interfacial stiffness {part:.0f} %"
    assert any(text.startswith(words) for text in texts(drawn[1]))


def test_a_cutoff_that_is_not_taken_is_refused_before_the_work(invoke, rough):
    for words, message in (
        (("--shortest-wave", "10um"), "--shortest-wave needs --errors"),
        (("--errors", "--shortest-wave", "10"), "leaves nothing of a map"),
        (("--errors", "--shortest-wave", "1um"), "too short for cells"),
        (("--errors", "--shortest-wave", "-1um"), "a wavelength must be positive"),
    ):
        answer = invoke("press", rough, *FORCE, *MODULUS, *words)
        assert answer.exit_code == 2
        assert message in answer.stderr
        assert answer.stdout == ""


@pytest.mark.usefixtures("drawn")
def test_a_load_after_a_larger_one_is_on_what_that_left(invoke, rough, surface, tmp_path):
    words = ("press", rough, "--force", "0.2N", "--after", "1N", "--modulus", "110GPa", "--level", "none")
    answer = invoke(*words, "--hardness", "5GPa", "--json", "--out", tmp_path / "out")
    assert answer.exit_code == 0
    record = json.loads(answer.stdout)
    *_, last = rc.loading_path(surface, 110e9, forces=[1.0, 0.2], hardness=5e9)
    assert last.flow.volume > 0
    assert record["depth"] == pytest.approx(last.depth, rel=1e-6)
    assert record["flow_volume"] == pytest.approx(last.flow.volume, rel=1e-6)
    assert record["units"]["flow_volume"] == "m3"
    assert record["surface"][-1].startswith("flattened by up to")
    assert (tmp_path / "out" / "flattened.png").stat().st_size > 10_000
    assert "flattened.png" in answer.stderr
    told = invoke(*words, "--hardness", "5GPa", "--flow", "raised").stdout
    assert "residual depth" in told
    lines = dict(line.split("   ", 1) for line in told.splitlines())
    assert lines["load"].strip() == "force 200 mN, unloaded from 1 N"
    elastic = rc.press(surface, 110e9, force=0.2)
    assert record["without_plastic_flow"]["stiffness"] == pytest.approx(elastic.stiffness, rel=1e-6)
    assert float(lines["stiffness without plastic flow"].split()[0]) == pytest.approx(
        elastic.stiffness / 1e6, rel=1e-3
    )
    assert "nothing flowed" in invoke(*words, "--hardness", "5000GPa").stderr
    assert "nothing flowed" not in answer.stderr
    first = invoke(*words[:3], "1N", *words[6:], "--hardness", "5GPa").stdout
    assert "stiffness on unloading" in first
    assert not any(words in first for words in ("unloaded from", "without plastic flow"))


def test_an_elastic_contact_of_named_metals_names_the_options_of_flow(invoke, rough):
    words = ("press", rough, "--force", "1N", "--materials", "steel,aluminium")
    note = invoke(*words).stderr
    assert "of the contact area the pressure exceeds the hardness of aluminium, 1.049 GPa" in note
    assert "If this is the first loading, give --hardness aluminium." in note
    assert "exceeds the hardness" in invoke("curve", *words[1:2], "--forces", "0.5N,1N", *words[4:]).stderr
    for given in (("--hardness", "aluminium"), ("--after", "2N")):
        assert "exceeds the hardness" not in invoke(*words, *given).stderr
    assert "exceeds the hardness" not in invoke(*words[:4], "--modulus", "57GPa").stderr


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (
            ("--after", "2N"),
            "--after needs a hardness, which is not given; give --hardness",
        ),
        (
            ("--flow", "raised"),
            "--flow needs a hardness, which is not given; give --hardness",
        ),
        (("--after", "1N", "--hardness", "1GPa"), "--after 1N is not larger than the force"),
        (("--after", "1MPa", "--hardness", "1GPa"), "--after"),
        (("--after", "2N", "--hardness", "1GPa", "--errors"), "--errors does not go with --after"),
    ],
)
def test_a_load_before_that_makes_no_sense_is_refused(invoke, rough, given, says):
    answer = invoke("press", rough, "--force", "1N", "--modulus", "110GPa", *given)
    assert answer.exit_code == 2
    assert says in " ".join(answer.stderr.split())
