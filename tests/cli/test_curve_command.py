import dataclasses
import json
import math

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.cli.report import quantity
from roughcontact.contact import loading
from roughcontact.plot import canvas
from roughcontact.theory.random_surfaces.waves import Waves
from tables import read_table

MODULUS = ("--modulus", "110GPa")
FORCES = ("--forces", "1mN:1N:12")


def test_it_answers_as_the_library_does(invoke, rough, surface):
    answer = invoke("curve", rough, *FORCES, *MODULUS, "--level", "none", "--json")
    assert answer.exit_code == 0
    curve = rc.loading_curve(surface, 110e9, forces=np.geomspace(1e-3, 1.0, 12))
    record = json.loads(answer.stdout)
    for name in ("force", "depth", "stiffness", "contact_area", "mean_gap", "spots", "resolved", "residual"):
        assert record[name] == getattr(curve, name).tolist(), name
    assert record["converged"] is True
    assert record["status"] == ["converged"] * 12


def test_the_power_law_is_that_of_the_curve(invoke, tmp_path):
    path = tmp_path / "rough.npz"
    made = invoke(
        "surface", "make", path, "--hurst", "0.8", "--rms", "0.1um", "--size", "0.1mm", "--points", "256"
    )
    assert made.exit_code == 0
    words = ("curve", path, "--forces", "20mN:220mN:9", "--level", "none", *MODULUS)
    law = rc.loading_curve(rc.read(path), 110e9, forces=np.geomspace(0.02, 0.22, 9)).fit()
    answer = invoke(*words, "--json")
    fit = json.loads(answer.stdout)["fit"]
    assert fit == {
        "exponent": law.exponent,
        "prefactor": law.prefactor,
        "scatter": law.scatter,
        "window": list(law.window),
        "count": law.count,
        "bend": law.bend,
        "bend_error": law.bend_error,
        "straight": law.straight,
        "rule": law.rule,
    }
    assert f"(F/(E* L h))^{law.exponent:.4f}" in invoke(*words).stdout


def test_too_few_points_for_a_power_law_are_a_note_and_no_failure(invoke, rough):
    answer = invoke("curve", rough, "--forces", "1mN,2mN", *MODULUS, "--json")
    assert answer.exit_code == 0
    assert json.loads(answer.stdout)["fit"] is None
    assert "Note: no power law" in answer.stderr


def test_a_person_gets_one_line_a_load(invoke, rough):
    answer = invoke("curve", rough, *FORCES, *MODULUS)
    assert answer.exit_code == 0
    header = next(k for k, line in enumerate(answer.stdout.splitlines()) if "depth [" in line)
    rows = [line.split() for line in answer.stdout.splitlines()[header + 1 : header + 13]]
    np.testing.assert_allclose([float(row[0]) for row in rows], np.geomspace(1e-3, 1, 12), rtol=5e-4)
    assert "full-contact stiffness" in answer.stdout


def test_loads_can_be_pressures_or_depths(invoke, rough, surface):
    def ask(*loads):
        return json.loads(invoke("curve", rough, *loads, *MODULUS, "--level", "none", "--json").stdout)

    np.testing.assert_allclose(ask("--depths", "10nm,20nm")["depth"], [1e-8, 2e-8], rtol=1e-14)
    force = np.array(ask("--pressures", "1MPa,2MPa")["force"])
    np.testing.assert_allclose(force, np.array([1e6, 2e6]) * surface.grid.area, rtol=1e-9)


def test_without_loads_it_takes_those_of_the_library_and_says_so(invoke, rough, surface):
    answer = invoke("curve", rough, *MODULUS, "--level", "none", "--json")
    assert answer.exit_code == 0
    force, found = json.loads(answer.stdout)["force"], rc.load_range(surface, 110e9)
    np.testing.assert_allclose(force, found.forces, rtol=1e-9)
    ends = [quantity("force", end) for end in found.forces[[0, -1]]]
    says = f"the map is {found.kind.value}; no loads are named: 24 forces from {ends[0]} to {ends[1]}"
    assert says in answer.stderr
    assert all(note in answer.stderr for note in found.notes)
    assert "24 forces that suit the surface" in " ".join(invoke("curve", "--help-all").stdout.split())


def test_a_flat_surface_needs_its_loads_named(invoke, tmp_path):
    np.savez(tmp_path / "flat.npz", heights=np.zeros((8, 8)), spacing=1e-6, unit="m")
    answer = invoke("curve", tmp_path / "flat.npz", *MODULUS, "--out", tmp_path / "out")
    assert answer.exit_code == 2
    assert "Error: a flat surface has no scale of forces" in answer.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.usefixtures("drawn")
def test_files_and_picture_stand_in_the_folder(invoke, rough, tmp_path):
    out = tmp_path / "result"
    answer = invoke("curve", rough, *FORCES, *MODULUS, "--out", out, "--json")
    assert answer.exit_code == 0
    names = ["curve.csv", "curve.json", "curve.nc", "curve.png"]
    assert sorted(path.name for path in out.iterdir()) == names
    record = json.loads(answer.stdout)
    table = read_table(out / "curve.csv")
    with xarray.open_dataset(out / "curve.nc") as dataset:
        for name in ("force", "stiffness"):
            assert table[name].tolist() == record[name]
            assert dataset[name].to_numpy().tolist() == record[name]
    assert json.loads((out / "curve.json").read_text(encoding="utf-8")).items() >= record.items()
    assert (out / "curve.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.usefixtures("drawn")
def test_the_picture_has_its_format_and_names_theories_as_the_option_does(
    invoke, rough, tmp_path, monkeypatch
):
    drawn, make = [], canvas.curve_figure
    monkeypatch.setattr(canvas, "curve_figure", lambda *given: drawn.append(make(*given)) or drawn[-1])
    out = tmp_path / "result"
    words = ("curve", rough, *FORCES, *MODULUS, "--level", "none", "--theory", "gw,persson")
    answer = invoke(*words, "--out", out, "--format", "pdf")
    assert answer.exit_code == 0
    assert "curve.pdf are in" in answer.stderr
    assert (out / "curve.pdf").read_bytes().startswith(b"%PDF")
    assert not (out / "curve.png").exists()
    legend = [text.get_text() for text in drawn[0].axes[0].get_legend().get_texts()]
    assert legend[-2:] == ["gw", "persson"]


def test_one_folder_serves_press_and_curve(invoke, rough, tmp_path):
    out = tmp_path / "result"
    assert invoke("press", rough, "--force", "1mN", *MODULUS, "--out", out).exit_code == 0
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    assert invoke("curve", rough, *FORCES, *MODULUS, "--out", out).exit_code == 0
    after = {path.name: path.read_bytes() for path in out.iterdir()}
    assert before.items() <= after.items()
    assert after.keys() - before.keys() == {"curve.csv", "curve.json", "curve.nc", "curve.png"}


def test_one_load_that_misses_its_tolerance_gives_status_1(invoke, rough, monkeypatch):
    path = loading.solutions_along

    def last_one_stagnates(*arguments, **named):
        solutions = list(path(*arguments, **named))
        solutions[-1] = dataclasses.replace(solutions[-1], status=rc.Status.STAGNATED)
        return iter(solutions)

    monkeypatch.setattr(loading, "solutions_along", last_one_stagnates)
    answer = invoke("curve", rough, *FORCES, *MODULUS, "--json")
    assert answer.exit_code == 1
    record = json.loads(answer.stdout)
    assert record["status"] == ["converged"] * 11 + ["stagnated"]
    assert record["converged"] is False
    assert "Note: 1 of 12 loads missed the tolerance" in answer.stderr
    assert invoke("curve", rough, *FORCES, *MODULUS).stdout.count("MISSED") == 1


def test_an_interrupt_before_the_first_load_leaves_nothing(invoke, rough, monkeypatch, tmp_path):
    def interrupted(*_, **__):
        raise KeyboardInterrupt
        yield

    monkeypatch.setattr(loading, "solutions_along", interrupted)
    answer = invoke("curve", rough, *FORCES, *MODULUS, "--out", tmp_path / "out")
    assert answer.exit_code == 130
    assert answer.stdout == ""
    assert "Interrupted" in answer.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("verb", ["press", "curve"])
def test_flat_heights_are_answered(invoke, tmp_path, verb):
    np.savez(tmp_path / "flat.npz", heights=np.zeros((8, 8)), spacing=1e-6, unit="m")
    loads = {"press": ("--force", "1mN"), "curve": ("--forces", "1mN,2mN")}[verb]
    answer = invoke(verb, tmp_path / "flat.npz", *loads, *MODULUS, "--out", tmp_path / "out")
    assert answer.exit_code == 0


def test_theories_stand_beside_the_curve(invoke, rough, tmp_path):
    folder = tmp_path / "result"
    words = ("curve", rough, *FORCES, *MODULUS, "--theory", "persson, power-law", "--hurst", "0.8")
    answer = invoke(*words, "--out", folder)
    assert answer.exit_code == 0
    assert "Persson" in answer.stdout
    assert "Pohrt and Popov" in answer.stdout
    with xarray.open_dataset(folder / "curve.nc", engine="h5netcdf") as dataset:
        assert dataset.persson_contact_area.attrs["units"] == "m2"
        assert "J. Chem. Phys." in dataset.persson_contact_area.attrs["references"]
        assert (dataset.persson_contact_area > 0).all()
        assert dataset.power_law_stiffness.dims == ("load",)
    record = json.loads(invoke(*words, "--json").stdout)
    assert record["theories"]["power-law"]["predicted"]["stiffness"][3] > 0
    assert set(record["theories"]) == {"persson", "power-law"}


def test_theories_say_what_they_took_from_the_surface(invoke, rough, surface):
    words = (
        "curve",
        rough,
        *FORCES,
        *MODULUS,
        "--level",
        "none",
        "--theory",
        "persson,power-law,finite-size",
    )
    record = json.loads(invoke(*words, "--json").stdout)
    taken = record["theory_parameters"]
    assert taken["hurst"] == rc.hurst_exponent(surface).hurst
    assert taken["rms"] == surface.rms
    assert taken["rolloff"] == math.sqrt(surface.grid.area)
    assert taken["rms_slope"] == Waves.of(rc.power_spectrum(surface)).rms_slope
    line = next(line for line in invoke(*words).stdout.splitlines() if line.startswith("from the surface"))
    assert f"H (fitted) {taken['hurst']:.4g}, rms height {quantity('rms', surface.rms)}, roll-off" in line
    assert f"m4 {taken['m4']:.4g} 1/m²" in line
    # What the user says is not taken.
    said = invoke(*words, "--hurst", "0.8", "--rolloff", "20um", "--json")
    assert json.loads(said.stdout)["theory_parameters"].keys() == taken.keys() - {"hurst", "rolloff"}
    assert "from the surface" not in invoke(*words[:-1], "hertz", "--radius", "1mm").stdout


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--theory", "person"), "there is no theory 'person'; did you mean 'persson'? choose from persson"),
        (("--theory", "gw,gw"), "each theory once"),
        (("--theory", ","), "each theory once"),
        (("--hurst", "0.8"), "--hurst needs --theory"),
        (("--theory", "hertz"), "give --radius"),
        (("--theory", "power-law", "--hurst", "5"), "between -1 and 3"),
        (("--theory", "power-law", "--hurst", "tall"), "not a number"),
        (("--theory", "cmy"), "give --hardness"),
    ],
)
def test_theories_that_cannot_be_are_one_line(invoke, rough, words, message):
    answer = invoke("curve", rough, *FORCES, *MODULUS, "--level", "none", *words)
    assert answer.exit_code == 2
    assert message.lower() in answer.stderr.lower()
    assert len(answer.stderr.strip().splitlines()) == 1


def periodic(tmp_path):
    grid = rc.Grid((32, 32), 1e-6, periodic=True)
    path = tmp_path / "periodic.npz"
    rc.write(rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(0)), path)
    return path


@pytest.mark.parametrize(
    ("loads", "on", "areal"),
    [
        (("--forces", "1mN,2mN"), "periodic", True),
        (("--pressures", "1MPa,2MPa"), "rough", True),
        (("--forces", "1mN,2mN", "--unit-pressure", "MPa"), "rough", True),
        (("--forces", "1mN,2mN"), "rough", False),
        (("--depths", "10nm,20nm"), "rough", False),
    ],
)
def test_a_joint_is_told_per_area_against_pressure(invoke, rough, tmp_path, loads, on, areal):
    path = periodic(tmp_path) if on == "periodic" else rough
    answer = invoke("curve", path, *loads, *MODULUS)
    (header,) = [line for line in answer.stdout.splitlines() if "mean gap [" in line]
    assert header.startswith("nominal pressure [" if areal else "force [")
    assert ("K/A0 [N/µm/mm²]" in header) is areal
    # The stiffness of a free patch is in N/m, whatever else is told.
    assert (" stiffness [" in header) is not areal
    assert ("never per area" in answer.stderr) is (areal and on == "rough")


def test_units_are_those_of_the_user(invoke, rough, tmp_path):
    """Numbers of the table, the CSV and the NetCDF in them, to a rounding or two; JSON stays in SI."""
    words = ("curve", rough, "--pressures", "1MPa,10MPa", *MODULUS, "--out", tmp_path / "out")
    units = ("--unit-pressure", "bar", "--unit-stiffness", "MPa/mm")
    record = json.loads(invoke(*words, *units, "--json").stdout)
    np.testing.assert_allclose(record["nominal_pressure"], [1e6, 1e7], rtol=1e-9)
    areal = np.array(record["interfacial_stiffness"]) / record["nominal_area"]
    np.testing.assert_allclose(record["interfacial_stiffness_per_area"], areal, rtol=1e-15)
    assert record["units"]["interfacial_stiffness_per_area"] == "Pa m-1"
    expected = {"nominal_pressure": ("bar", np.array(record["nominal_pressure"]) / 1e5)}
    expected["interfacial_stiffness_per_area"] = "MPa/mm", areal / 1e9
    table = read_table(tmp_path / "out" / "curve.csv")
    with xarray.open_dataset(tmp_path / "out" / "curve.nc") as dataset:
        for name, (unit, values) in expected.items():
            np.testing.assert_allclose(dataset[name], values, rtol=1e-15)
            np.testing.assert_allclose(table[name], values, rtol=1e-15)
            assert dataset[name].units == unit
    assert "nominal_pressure [bar]" in (tmp_path / "out" / "curve.csv").read_text(encoding="utf-8")
    lines = invoke(*words, *units).stdout.splitlines()
    (header,) = [k for k, line in enumerate(lines) if "mean gap [" in line]
    assert "nominal pressure [bar]" in lines[header]
    assert "K/A0 [MPa/mm]" in lines[header]
    row = lines[header + 1].split()
    assert float(row[0]) == pytest.approx(10, rel=5e-4)  # four digits are shown
    assert float(row[2]) == pytest.approx(areal[0] / 1e9, rel=5e-4)
    # The file is still the curve: what is read back is in SI.
    assert (
        rc.read_curve(tmp_path / "out" / "curve.nc").nominal_pressure.tolist() == record["nominal_pressure"]
    )


@pytest.mark.parametrize(
    ("option", "unit", "message"),
    [
        (
            "--unit-stiffness",
            "N/um",
            "'N/um' is not a unit of a stiffness per area; give one such as N/um/mm^2",
        ),
        ("--unit-stiffness", "2MPa/mm", "is not a unit of a stiffness per area"),
        ("--unit-stiffness", "", "is not a unit of a stiffness per area"),
        ("--unit-pressure", "mm", "'mm' is not a unit of a pressure; give one such as MPa"),
        ("--unit-pressure", "degC", "is not a unit of a pressure"),
    ],
)
def test_units_that_are_none_are_refused_before_the_work(invoke, rough, option, unit, message):
    answer = invoke("curve", rough, *FORCES, *MODULUS, option, unit)
    assert answer.exit_code == 2
    assert message in answer.stderr
    assert "Pressing" not in answer.stderr


def test_a_theory_that_does_not_apply_is_left_out_and_the_curve_is_kept(invoke, rough, tmp_path):
    folder = tmp_path / "result"
    words = (
        "curve",
        rough,
        *FORCES,
        *MODULUS,
        "--level",
        "mean",
        "--periodic",
        "--theory",
        "cgp,persson,rough-sphere",
    )
    words = (*words, "--radius", "1mm", "--hurst", "2.5")
    answer = invoke(*words, "--out", folder)
    assert answer.exit_code == 0
    notes = [line for line in answer.stderr.splitlines() if "is left out" in line]
    assert len(notes) == 2
    assert notes[0].startswith("Note: theory cgp is left out: cgp is for a body that is indented as a whole")
    assert "Persson" in answer.stdout
    record = json.loads((folder / "curve.json").read_text(encoding="utf-8"))
    assert set(record["theories"]) == {"persson"}
    assert set(record["theories_left_out"]) == {"cgp", "rough-sphere"}


def test_local_exponents_stand_beside_those_of_theories(invoke, rough, surface):
    words = ("curve", rough, "--forces", "0.1N:2N:24", *MODULUS, "--level", "none", "--theory", "persson")
    record = json.loads(invoke(*words, "--json").stdout)
    curve = rc.loading_curve(surface, 110e9, forces=np.geomspace(0.1, 2, 24))
    found = curve.local_exponents()
    assert [each["exponent"] for each in record["local_exponents"]] == [each.exponent for each in found]
    assert found  # so that the lines below are about something
    text = invoke(*words).stdout
    assert f"{found[0].exponent:.3f} +- {found[0].error:.3f} from" in text
    assert "; Persson " in text


def test_no_stiffness_of_flowing_spots_is_drawn_beside_that_of_a_plastic_curve(
    invoke, rough, tmp_path, monkeypatch
):
    drawn = []

    def figure(curve, fit, laws, errors):
        drawn.extend(laws)
        return canvas.Figure()

    monkeypatch.setattr(canvas, "curve_figure", figure)
    words = (
        "curve",
        rough,
        *FORCES,
        *MODULUS,
        "--level",
        "none",
        "--hardness",
        "steel",
        "--theory",
        "cmy,mikic",
    )
    assert invoke(*words, "--out", tmp_path / "result").exit_code == 0
    plastic, elastic = drawn
    assert set(plastic.quantities) == {"contact_area"}
    assert "stiffness" in elastic.quantities


def test_errors_are_those_of_the_first_and_the_last_resolved_load(invoke, rough, surface, tmp_path):
    words = ("curve", rough, *FORCES, *MODULUS, "--level", "none", "--errors")
    answer = invoke(*words, "--json", "--out", tmp_path / "out")
    assert answer.exit_code == 0
    record = json.loads(answer.stdout)
    forces = [force for force, resolved in zip(record["force"], record["resolved"], strict=True) if resolved]
    assert len(forces) > 2
    assert [each["force"] for each in record["errors"]] == [forces[0], forces[-1]]
    for each in record["errors"]:
        budget = rc.error_budget(rc.press(surface, 110e9, force=each["force"]))
        number = budget["interfacial_stiffness"]
        for name, part in zip(("grid", "short_cutoff", "levelling", "sampling"), number.parts, strict=True):
            expected = None if np.isnan(part) else pytest.approx(part, rel=1e-5)
            assert each["interfacial_stiffness"][name] == expected
        assert each["interfacial_stiffness"]["value"] == pytest.approx(number.value, rel=1e-6)
    assert json.loads((tmp_path / "out" / "curve.json").read_text())["errors"] == record["errors"]
    assert json.loads(invoke(*words[:-1], "--json").stdout)["errors"] == []


def test_errors_of_a_joint_are_in_the_units_that_were_named(invoke, rough):
    told = invoke("curve", rough, *FORCES, *MODULUS, "--errors", "--unit-stiffness", "GPa/m").stdout
    table = told.split("errors at ")[1:]
    assert len(table) == 2
    assert all("GPa/m" in part and "K/A0" in part for part in table)


def test_without_a_resolved_load_there_are_no_errors_and_a_note_says_so(invoke, rough):
    answer = invoke("curve", rough, "--forces", "1uN,2uN", *MODULUS, "--errors", "--json")
    assert answer.exit_code == 0
    assert json.loads(answer.stdout)["errors"] == []
    assert "Note: no errors: no load is resolved" in answer.stderr


def test_an_interrupt_keeps_the_loads_that_are_done(invoke, rough, monkeypatch, tmp_path):
    whole = loading.solutions_along

    def interrupted(*arguments, **named):
        path = whole(*arguments, **named)
        yield next(path)
        yield next(path)
        raise KeyboardInterrupt

    monkeypatch.setattr(loading, "solutions_along", interrupted)
    words = ("curve", rough, "--modulus", "1GPa", "--forces", "1uN,2uN,4uN,8uN", "--out", tmp_path / "out")
    answer = invoke(*words)
    assert answer.exit_code == 130
    said = "stopped: 2 of 4 loads are computed; the same command computes the others"
    assert said in answer.stderr
    assert said in json.loads((tmp_path / "out" / "curve.json").read_text())["notes"][1]
    kept = rc.read_curve(tmp_path / "out" / "curve.nc")
    np.testing.assert_allclose(kept.force, [1e-6, 2e-6])
    monkeypatch.setattr(loading, "solutions_along", whole)
    again = invoke(*words)
    assert again.exit_code == 0, again.stderr
    assert "2 of 4 loads of the same recipe are in" in again.stderr
    whole_curve = rc.read_curve(tmp_path / "out" / "curve.nc")
    assert whole_curve.depth[:2].tolist() == kept.depth.tolist()
    np.testing.assert_allclose(whole_curve.force, [1e-6, 2e-6, 4e-6, 8e-6])
    # Nothing is computed then; the notes on the stored loads are those that were given, in their order.
    stored = invoke(*words).stderr.splitlines()
    assert "4 of 4 loads of the same recipe are in" in "".join(stored)
    kept_notes = [line for line in stored if "loads of the same recipe are in" not in line]
    assert kept_notes == [
        line for line in again.stderr.splitlines() if "loads of the same recipe are in" not in line
    ]


def test_a_curve_that_is_stopped_in_its_first_load_keeps_nothing(invoke, rough, tmp_path, monkeypatch):
    def interrupted(solution):
        raise KeyboardInterrupt

    monkeypatch.setattr(rc.Solution, "resolved", property(interrupted))  # after the load, before it is kept
    answer = invoke("curve", rough, "--modulus", "1GPa", "--forces", "1uN,2uN", "--out", tmp_path / "out")
    assert answer.exit_code == 130
    assert not (tmp_path / "out").exists()


def test_a_loop_writes_its_branches_and_the_flattened_surface(invoke, rough, surface, tmp_path):
    words = ("curve", rough, *FORCES, *MODULUS, "--level", "none", "--hardness", "2GPa")
    answer = invoke(*words, "--loop", "--flow", "raised", "--json", "--out", tmp_path / "out")
    assert answer.exit_code == 0
    record = json.loads(answer.stdout)
    loop = rc.loading_loop(surface, 110e9, hardness=2e9, forces=record["force"], flow="raised")
    assert record["loop"]["residual_depth"] == pytest.approx(loop.residual_depth, rel=1e-6)
    np.testing.assert_allclose(record["loop"]["unloading"]["stiffness"], loop.unloading.stiffness, rtol=1e-5)
    np.testing.assert_allclose(record["depth"], loop.loading.depth, rtol=1e-6)
    names = {each.name for each in (tmp_path / "out").iterdir()}
    assert {"curve.nc", "loop.nc", "loop.csv", "loop.png", "flattened.png", "flattened.npz"} <= names
    assert "first_loading.png" in names
    assert "curve.png" not in names
    assert "first_loading.png, loop.nc" in answer.stderr
    flat = rc.read(tmp_path / "out" / "flattened.npz")
    np.testing.assert_allclose(flat.heights, loop.flattened.heights, rtol=0, atol=1e-15)
    assert "raised by" in flat.provenance[-2] + flat.provenance[-1]
    assert rc.read_curve(tmp_path / "out" / "curve.nc").flow is not None
    with xarray.open_dataset(tmp_path / "out" / "curve.nc") as curve:
        areal = curve["unloaded_interfacial_stiffness_per_area"]
        unloading = loop.unloading.interfacial_stiffness_per_area[::-1]
        np.testing.assert_allclose(areal, unloading, rtol=1e-5)
        assert areal.units == "Pa m-1"
    told = invoke(*words, "--loop").stdout
    assert all(line in told for line in ("residual depth", "stiffness on unloading", "dissipated work"))


def test_what_flows_conducts(invoke, rough, surface):
    words = ("curve", rough, *FORCES, *MODULUS, "--level", "none", "--hardness", "2GPa", "--json")
    record = json.loads(invoke(*words, "--conductivity", "50W/m/K,160W/m/K").stdout)
    *_, last = rc.loading_path(surface, 110e9, forces=record["force"], hardness=2e9)
    expected = rc.conductance(last, conductivities=(50.0, 160.0))
    assert last.plastic.any()
    assert record["thermal_conductance"][-1] == pytest.approx(
        float(expected["thermal_conductance"]), rel=1e-5
    )


def test_a_loop_takes_the_hardness_of_the_softer_material(invoke, rough):
    words = ("curve", rough, *FORCES, "--materials", "steel,aluminium", "--loop", "--json")
    answer = invoke(*words)
    assert answer.exit_code == 0
    assert "Note: the hardness is that of aluminium: 1.049 GPa" in answer.stderr
    assert json.loads(answer.stdout)["loop"]["flow_volume"] > 0


def test_an_interrupt_of_a_loop_keeps_first_loading(invoke, rough, monkeypatch, tmp_path):
    whole = loading.solutions_along

    def interrupted(*arguments, **named):
        path = whole(*arguments, **named)
        for _ in range(6):
            yield next(path)
        raise KeyboardInterrupt

    monkeypatch.setattr(loading, "solutions_along", interrupted)
    words = ("curve", rough, "--modulus", "1GPa", "--forces", "1uN,2uN,4uN,8uN", "--hardness", "20MPa")
    answer = invoke(*words, "--loop", "--out", tmp_path / "out")
    assert answer.exit_code == 130
    assert "the loop is not closed" in answer.stderr
    assert len(rc.read_curve(tmp_path / "out" / "curve.nc")) == 4
    assert not (tmp_path / "out" / "loop.nc").exists()


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (("--loop",), "--loop needs a hardness, which is not given; give --hardness"),
        (
            ("--flow", "raised"),
            "--flow needs a hardness, which is not given; give --hardness",
        ),
        (("--loop", "--hardness", "1GPa", "--depths", "1nm,2nm"), "--loop needs forces or pressures"),
        (("--flow", "raised", "--hardness", "1GPa", "--errors"), "--errors does not go with --flow"),
        (("--flow", "raised", "--hardness", "1GPa", "--depths", "1nm,2nm"), "--flow needs forces"),
    ],
)
def test_a_loop_that_makes_no_sense_is_refused(invoke, rough, given, says):
    answer = invoke("curve", rough, *MODULUS, *given)
    assert answer.exit_code == 2
    assert says in " ".join(answer.stderr.split())


def test_the_edge_of_the_map_is_named_once_and_last(invoke, rough):
    """Under forces of a free map of 24 x 32 cells: a hundredth of the force lies on its edge at every load."""
    words = ("curve", rough, "--pressures", "1MPa,5MPa,20MPa", *MODULUS, "--errors")
    answer = invoke(*words)
    notes = [line for line in answer.stderr.splitlines() if line.startswith("Note: ")]
    assert "at the edge of the map" in notes[-1]
    assert len(notes) == len(set(notes))
    assert sum("at the edge of the map" in note for note in notes) == 1
    assert not any(
        "at the edge of the map" in line for line in invoke(*words, "--periodic").stderr.splitlines()
    )


@pytest.mark.parametrize("areal", [True, False])
def test_a_loop_tells_the_stiffness_of_unloading_at_each_load(invoke, rough, areal):
    loads = ("--pressures", "2MPa,5MPa,10MPa") if areal else ("--forces", "5mN,10mN,20mN")
    words = ("curve", rough, *loads, *MODULUS, "--hardness", "2GPa", "--loop")
    name, label, unit, factor = "stiffness", "stiffness", "kN/m", 1e-3
    if areal:
        words = (*words, "--unit-stiffness", "MPa/mm")
        name, label = "interfacial_stiffness_per_area", "interfacial stiffness per area K/A0"
        unit, factor = "MPa/mm", 1e-9
    lines = invoke(*words).stdout.splitlines()
    [at] = [k for k, line in enumerate(lines) if "mean gap [" in line]
    header = [cell.strip() for cell in lines[at].split("  ") if cell.strip()]
    place = header.index(f"{label} on unloading [{unit}]")
    shown = [float(line.split()[place]) for line in lines[at + 1 : at + 4]]
    unloading = json.loads(invoke(*words, "--json").stdout)["loop"]["unloading"]
    # Four digits are shown.
    np.testing.assert_allclose(shown, np.array(unloading[name])[::-1] * factor, rtol=5e-4)
