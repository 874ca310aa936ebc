"""A study of a job: the answer of the library for each combination, surfaces drawn anew, files by their content."""

import json
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.recipe.written import from_plain
from roughcontact.statistics.averages import averages
from roughcontact.study.cases import CASES, find_case
from roughcontact.study.cases.job_case import CASE, JobParameters
from roughcontact.study.export import export
from roughcontact.study.job_study import job_study
from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study
from roughcontact.study.study_errors import StudyError
from roughcontact.study.task import canonical, generator

MADE = {"kind": "self-affine", "hurst": "0.8", "rms": "1um", "size": "1mm", "points": "16"}
BODIES = {"modulus": "110GPa"}
CURVE = {"job": "curve", "source": MADE, "bodies": BODIES, "loads": {"forces": "1N,2N,4N,8N"}}
STICKY = {
    **{"source": MADE | {"rms": "50nm"}, "bodies": {"modulus": "1GPa"}},
    "adhesion": {"work": "5 mJ/m^2", "range": "200 nm"},
}
JOBS = {  # with what its record is sure to hold, and along what it lies
    "press": ({"load": {"force": "10N"}, "source": MADE, "bodies": BODIES}, "depth", ()),
    "leak": (
        {
            **{"load": {"force": "100N"}, "source": MADE, "bodies": BODIES},
            **{"fluid": {"viscosity": "1mPa*s"}, "seal": {"drop": "1bar"}},
        },
        "leak_rate",
        (),
    ),
    "shear": (
        {
            **{"source": MADE, "bodies": {"materials": "steel,steel"}},
            "shear": {"pressures": "1MPa,10MPa", "friction": "0.2", "amplitude": "0.5,0.8"},
        },
        *("displacement_amplitude", ("load",)),
    ),
    "creep": (
        {
            **{"history": {"history": "0s:0N,1s:1mN,9s:1mN"}, "contact": {"time_tolerance": "0.1"}},
            **{"source": MADE | {"points": "8"}, "bodies": {"material": "rubber.toml"}},
        },
        *("depth", ("time",)),
    ),
    "curve": ({"loads": {"depths": "0.1um,0.2um"}, "source": MADE, "bodies": BODIES}, "stiffness", ("load",)),
    "sliding": (
        {
            **{"source": MADE | {"periodic": True}, "bodies": {"material": "rubber.toml"}},
            "sliding": {"pressure": "0.1MPa", "speeds": "1cm/s,1m/s"},
        },
        "friction_coefficient",
        ("sliding_speed",),
    ),
    "joint": (
        {
            **{"source": MADE, "bodies": BODIES},
            "pressure": {"bolt_force": "1kN", "head": "13mm", "hole": "9mm", "thickness": "1cm"},
        },
        *("normal_stiffness", ()),
    ),
    "adhesion press": ({"load": {"depth": "1nm"}, **STICKY}, "force", ()),
    "adhesion curve": ({"loads": {"depths": "-10nm,10nm"}, **STICKY}, "force", ("load",)),
    "adhesion loop": ({"turn": {"depth": "10nm", "points": "3"}, **STICKY}, "pull_off_force", ()),
    "adhesion detach": (
        {"load": {"force": "1mN"}, **STICKY, "adhesion": {"work": "1 mJ/m^2"}},
        "pull_off_force",
        (),
    ),
}


def study(parameters=CURVE, **given):
    return Study(**({"name": "few", "case": "job", "parameters": parameters} | given))


def exported(found, folder):
    assert run(found, folder).failed == 0
    with Store.open(folder) as store:
        return export(store)


def places(found):
    return [each.place for each in found.value.parts]


def drawn(sample=0, seed=0, size=1e-3):
    grid = rc.Grid((16, 16), size / 16)
    return rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=generator(seed, sample))


@pytest.fixture
def maps(tmp_path):
    """Return a folder with two maps of one name in two folders."""
    for number, name in enumerate(("one", "two")):
        (tmp_path / name).mkdir()
        rc.write(drawn(number), tmp_path / name / "map.npz")
    return tmp_path


def test_each_sample_draws_phases_of_its_own_and_each_combination_is_what_the_library_computes(tmp_path):
    found = exported(study(samples=2, seed=5, table={"preparation.level": ["plane", "quadratic"]}), tmp_path)
    assert found["stiffness"].dims == ("preparation.level", "sample", "load")
    for sample in range(2):
        for level in ("plane", "quadratic"):
            surface = drawn(sample, seed=5).levelled(level)
            curve = rc.loading_curve(surface, 110e9, forces=[1.0, 2.0, 4.0, 8.0])
            one = found.sel({"preparation.level": level}).isel(sample=sample)
            xarray.testing.assert_equal(
                one["stiffness"].reset_coords(drop=True),
                curve.to_dataset()["stiffness"].reset_coords(drop=True),
            )


@pytest.mark.parametrize("name", JOBS)
def test_every_job_has_a_record_of_numbers_with_units_and_without_maps(name, tmp_path, monkeypatch):
    parameters, quantity, along = JOBS[name]
    monkeypatch.chdir(tmp_path)
    rc.viscoelastic.standard_solid(1e6, 1e7, 1e-3).write("rubber.toml")
    found = exported(study({"job": name} | parameters, samples=2), tmp_path)
    assert found[quantity].dims == ("sample", *along)
    assert found[quantity].attrs["units"]
    assert not {"x", "y"} & set(found.dims)
    assert (found[quantity].isel(sample=0) != found[quantity].isel(sample=1)).any()


def test_a_loop_under_a_hardness_and_what_conducts_are_in_the_record(tmp_path):
    loop = CURVE | {"plastic": {"hardness": "0.1GPa", "loop": True}}
    found = exported(study(loop), tmp_path / "loop")
    assert {"loading", "unloading", "reloading"} == set(found["branch"].values.ravel())
    assert found["residual_depth"].item() > 0
    with pytest.raises(KeyError):  # what goes up and down makes no power law
        averages(found, rng=1)["exponent"]
    found = exported(study(CURVE | {"conduction": {"resistivity": "17nohm*m"}}), tmp_path / "copper")
    by_hand = rc.conductance(
        rc.loading_curve(drawn().levelled("auto"), 110e9, forces=[1, 2, 4, 8]), resistivities=(17e-9, 17e-9)
    )
    np.testing.assert_array_equal(
        found["electrical_resistance"].values.ravel(), by_hand["electrical_resistance"]
    )


def test_the_reflection_of_ultrasound_is_in_the_record(tmp_path):
    asked = {"bodies": {"materials": "steel,steel"}, "ultrasound": {"frequency": "5MHz"}}
    found = exported(study(CURVE | asked), tmp_path / "sound")
    curve = rc.loading_curve(drawn().levelled("auto"), ("steel", "steel"), forces=[1, 2, 4, 8])
    seen = rc.reflection(curve, ("steel", "steel"), 5e6)
    for name in ("reflection", "error_amplification", "measurable"):
        np.testing.assert_array_equal(found[name].values.ravel(), seen[name])


def test_averages_of_samples_at_forces_of_their_own_have_laws(tmp_path):
    # Levelled heights have an rms height of their own, by which forces are divided.
    found = exported(study(CURVE | {"preparation": {"level": "plane"}}, samples=3), tmp_path)
    assert (found["dimensionless_force"].std("sample") > 0).all()
    laws = averages(found, rc.statistics.force_window(1e-4, 1e2), rng=1)
    assert 0.3 < laws["exponent"].item() < 1
    assert laws["law_count"].item() == 4


def test_canonical_parameters_are_the_recipe_sorted_with_its_format():
    text = canonical(JobParameters(**CURVE))
    assert json.loads(text) == CURVE | {"format": 1}
    assert list(json.loads(text)) == sorted(json.loads(text))
    # A number is its text, a default is left out, and what is shown beside the numbers makes no other case.
    source = MADE | {"hurst": 0.8, "points": 16.0}
    more = {"theories": {"theory": "persson"}, "contact": {"tolerance": "1e-8"}, "errors": {"errors": True}}
    assert canonical(JobParameters(**(CURVE | more | {"source": source}))) == text
    assert JobParameters(**CURVE).recipe == JobParameters(**CURVE, folder="elsewhere").recipe


def test_ranges_take_units_and_stand_in_si_in_an_export(tmp_path):
    table = {
        "bodies.modulus": {"start": "1 GPa", "stop": "100 GPa", "count": 3, "spacing": "log"},
        "source.points": {"start": 8, "stop": 16, "step": 8},
        "load.force": {"start": "1 N", "stop": "2 N", "count": 2},
    }
    press = {"job": "press", "source": {n: v for n, v in MADE.items() if n != "points"}}
    found = exported(study(press, table=table), tmp_path)
    assert found["depth"].shape == (3, 2, 2, 1)
    np.testing.assert_allclose(
        found["bodies.modulus"], [1e9, 1e10, 1e11], rtol=1e-12
    )  # ranges have 12 digits
    assert found["bodies.modulus"].attrs["units"] == "Pa"
    assert found["source.points"].values.tolist() == [8, 16]
    assert found["load.force"].values.tolist() == [1, 2]
    assert found["load.force"].attrs["units"] == "N"
    assert found["source.hurst"].item() == 0.8
    assert found["source.kind"].item() == "self-affine"


def test_rows_and_nested_tables_of_a_file_are_dotted_names(tmp_path):
    (tmp_path / "few.toml").write_text("""
name = "few"
case = "job"
[parameters]
job = "press"
bodies.modulus = "110GPa"
source = { kind = "self-affine", hurst = 0.8, rms = "1um", size = "1mm" }
[table]
load.force = ["1N", "2N"]
preparation = { fill = [true, false] }
[[rows]]
source.points = 8
[[rows]]
source.points = 16
source.rolloff = "0.5mm"
""")
    found = Study.read(tmp_path / "few.toml")
    dataset = exported(found, tmp_path / "few")
    assert dataset["depth"].dims == ("row", "load.force", "preparation.fill", "sample")
    assert dataset["source.points"].values.tolist() == [8, 16]
    assert dataset["preparation.fill"].values.tolist() == [True, False]
    again = Study.read(tmp_path / "few" / "study.toml")
    assert [task.key for task in again.tasks()] == [task.key for task in found.tasks()]


def test_a_whole_part_may_vary():
    found = study(
        {"job": "curve", "source": MADE},
        table={"bodies": [{"modulus": "1GPa"}, {"young": "1GPa", "poisson": 0.3}]},
    )
    assert [each.recipe.bodies.modulus for each in found.combinations()] == ["1GPa", None]


def test_all_mistakes_come_at_once_each_with_its_place():
    with pytest.raises(StudyError) as refused:
        Study(
            **{"name": "a/b", "case": "job", "samples": 0, "sample": 3},
            parameters={
                "job": "curve",
                "source": MADE | {"hurst": 9, "seed": 1},
                "bodies": BODIES,
                "laods": {},
            },
            table={"preparation.levl": ["plane"], "preparation.fill": [], "loads.forces": ["1N", "1um", "2"]},
        )
    assert set(places(refused)) == {
        *("name", "samples", "sample", "table.preparation.fill", "parameters.source.hurst"),
        *("parameters.source.seed", "parameters.laods", "table.preparation.levl"),
    }
    assert "table.preparation.levl: unknown field 'levl'; did you mean level?" in str(refused.value)
    with pytest.raises(StudyError) as refused:  # across the parts of a job, once these are right
        study({**CURVE, "loads": {}}, table={"loads.forces": ["1N,2N", "1um", "2N,1N"]})
    assert places(refused) == ["table.loads.forces"] * 2
    assert "'1um' is not a force" in str(refused.value)
    assert "the loads must increase" in str(refused.value)


@pytest.mark.parametrize(
    ("parameters", "table", "place", "words"),
    [
        (CURVE | {"job": "curv"}, {}, "parameters.job", "there is no job 'curv'; choose from"),
        (
            {"job": "surface", "source": MADE},
            {},
            "parameters.job",
            "a study only supports jobs that press surfaces; take press or curve",
        ),
        (CURVE, {"source.seed": [1, 2]}, "table.source.seed", "leave seed out"),
        (CURVE | {"source": {"file": "no.x3p"}}, {}, "parameters.source", "No such file"),
        (CURVE, {"source.hurst": ["0.5"]}, "parameters.source.hurst, table.source.hurst", "given both in"),
        (CURVE, {"bodies": [{"modulus": 2e9}]}, "parameters.bodies.modulus, table.bodies.modulus", "both in"),
        (CURVE, {"bodies.young": ["2GPa"]}, "parameters.bodies.modulus, table.bodies.young", "exclude"),
        (
            CURVE,
            {"source.kind": {"start": 1, "stop": 2, "count": 2}},
            "table.source.kind",
            "no field 'source.kind'",
        ),
        (CURVE, {"loads": {"start": 1, "stop": 2, "count": 2}}, "table.loads", "not a single value"),
        (CURVE | {"format": 9}, {}, "parameters.format", "this version reads 1"),
    ],
)
def test_what_is_wrong_names_its_place(parameters, table, place, words):
    with pytest.raises(StudyError) as refused:
        study(parameters, table=table)
    assert any((each.place or "").startswith(place) for each in refused.value.parts)
    assert words in str(refused.value)


def test_files_count_from_the_study_and_are_known_by_their_content(maps, monkeypatch):
    monkeypatch.chdir(maps)
    files = ["one/map.npz", "two/map.npz"]
    press = {"job": "press", "bodies": BODIES, "load": {"force": "1N"}, "source": {"kind": "file"}}
    study(press, table={"source.file": files}).write("few.toml")
    here = Study.read("few.toml")
    keys = [task.key for task in here.tasks()]
    assert len(set(keys)) == 2
    found = exported(here, "results")
    assert found["source.file"].values.tolist() == files
    assert not np.isclose(*found["depth"].values.ravel())

    monkeypatch.chdir(maps / "one")  # from anywhere
    kept = Study.read("../results/study.toml")
    assert [task.key for task in kept.tasks()] == keys
    assert (set(kept.files), kept.folder) == (set(files), "..")
    with Store.open("../results") as store:
        xarray.testing.assert_identical(export(store), found)
        assert store.summary().left == 0
    assert run(Study.read("../few.toml"), "../results").done == 2


def test_another_file_under_a_name_is_not_taken_and_results_do_without_it(maps, monkeypatch):
    monkeypatch.chdir(maps)
    press = {"job": "press", "bodies": BODIES, "load": {"force": "1N"}, "source": {"file": "one/map.npz"}}
    exported(study(press), "results")
    kept = Study.read("results/study.toml")
    rc.write(drawn(7), "one/map.npz")
    with pytest.raises(StudyError, match=r"one/map.npz is not the file that the study was begun with"):
        run(kept, "results")
    assert next(study(press).tasks()).key != next(kept.tasks()).key
    (maps / "one" / "map.npz").unlink()
    with Store.open("results") as store:
        assert store.summary().done == 1
        assert export(store)["depth"].sizes == {"sample": 1}
    with pytest.raises(rc.InputError, match="No such file"):
        run(kept, "results")


def test_a_case_in_another_process_checks_its_file(maps, monkeypatch):
    monkeypatch.chdir(maps)
    source = {"file": "map.npz", "sha256": "0" * 64}
    parameters = JobParameters(job="press", bodies=BODIES, load={"force": "1N"}, source=source, folder="one")
    with pytest.raises(rc.InputError, match="its SHA-256 differs"):
        CASE.run(parameters, generator(0, 0))
    assert parameters.inputs() == {"map.npz": "0" * 64}


def test_two_surfaces_are_drawn_one_after_the_other(tmp_path):
    both = {"kind": "combined", "lower": MADE, "upper": MADE | {"hurst": "0.5"}}
    found = exported(study(CURVE | {"source": both}), tmp_path)
    rng, grid = generator(0, 0), rc.Grid((16, 16), 1e-3 / 16)
    lower, upper = (rc.self_affine(grid, hurst, 1e-6, rng).levelled("plane") for hurst in (0.8, 0.5))
    curve = rc.loading_curve(rc.combined(lower, upper).levelled("auto"), 110e9, forces=[1, 2, 4, 8])
    np.testing.assert_array_equal(found["stiffness"].values.ravel(), curve.stiffness)


def of_page(*place):
    """Return the blocks of TOML of a page."""
    page = Path(__file__).parents[3].joinpath("docs", *place).read_text(encoding="utf-8")
    return [tomllib.loads(text) for text in re.findall(r"```toml\n(.*?)```", page, re.DOTALL)]


def test_the_job_and_the_study_of_the_pages_are_what_they_are_said_to_be():
    job, study_of_job = of_page("how-to", "studies.md")
    heights = [f"{height}um" for height in ("0.2", "0.4", "0.6", "0.8", "1")]
    vary = {"source.hurst": ["0.2", "0.4", "0.6", "0.8", "1"], "source.rms": heights}
    made = job_study(from_plain(job), vary, samples=4, path=Path("design.toml"))
    written = Study(**study_of_job)
    assert (len(made.combinations()), made.samples, written.samples) == (25, 4, 4)
    for one, other in zip(made.combinations(), written.combinations(), strict=True):
        assert one.labelled()["source.rms"] == other.labelled()["source.rms"]
        assert one.recipe.bodies == other.recipe.bodies
        assert one.recipe.loads == other.recipe.loads
    few = next(Study(**each) for each in of_page("reference", "study-files.md") if each.get("case") == "job")
    assert [each.recipe.preparation.level for each in few.combinations()] == 3 * ["plane"] + 3 * ["quadratic"]
    assert few.combinations()[-1].recipe.source.hurst == "0.8"


def test_the_page_names_every_parameter_of_every_case():
    page = (
        Path(__file__).parents[3].joinpath("docs", "reference", "study-files.md").read_text(encoding="utf-8")
    )
    for name in CASES:
        assert f"| `{name}` |" in page
        for field in find_case(name).parameters.model_fields:
            assert f"`{field}`" in page, f"{name}: {field}"
