"""E8 of the law: where the crest lies, which force is near the border, and batches that resume."""

import shutil
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray

import roughcontact as rc
from roughcontact.files.write import write_netcdf
from roughcontact.study.task import generator
from roughcontact_thesis.crest_case import CASE, CrestParameters, border_share, crest_distance

SQUARE = {"points": 32, "size": 1.0, "modulus": 1.0, "rms": 0.01, "hurst": 0.8, "loads": 3}
STUDY = """
name = "few"
case = "roughcontact_thesis.crest_case:CASE"
seed = 28
samples = 3

[parameters]
points = 16
size = 1.0
modulus = 1.0
rms = 0.01
loads = 3

[table]
hurst = [0.6, 1.2]

[[rows]]

[[rows]]
crest = 0.5
"""


def heights(crest, seed=1):
    return CrestParameters(**SQUARE, crest=crest).roughness(np.random.default_rng(seed)).heights


@pytest.mark.parametrize(("crest", "column"), [(0.5, 16), (0.25, 8), (0.0, 0)])
def test_the_crest_is_rolled_to_its_place(crest, column):
    rolled = heights(crest)
    assert np.unravel_index(rolled.argmax(), rolled.shape) == (16, column)
    surface = rc.Surface(rolled, 1 / 32)
    assert crest_distance(surface) == min(column + 0.5, 31.5 - column) / 32


def test_squares_of_one_sample_have_the_same_waves_for_every_place_of_the_crest():
    drawn, other = heights(None), heights(None, seed=2)
    middle = heights(0.5)
    row, column = np.unravel_index(drawn.argmax(), drawn.shape)
    np.testing.assert_array_equal(np.roll(middle, (row - 16, column - 16), (0, 1)), drawn)
    np.testing.assert_array_equal(np.sort(heights(0.0), axis=None), np.sort(drawn, axis=None))
    assert not np.array_equal(np.sort(other, axis=None), np.sort(drawn, axis=None))


def test_the_square_that_is_cut_at_random_is_that_of_the_case_curve():
    plain = rc.study.find_case("curve")
    first = plain.run(plain.parameters(**SQUARE), generator(28, 0))
    second = CASE.run(CrestParameters(**SQUARE), generator(28, 0))
    for name in ("stiffness", "depth", "contact_area", "dimensionless_force"):
        np.testing.assert_array_equal(first[name], second[name])


@pytest.mark.parametrize("width", [0.0, 0.1, 0.26, 0.5, 0.7])
def test_of_an_even_pressure_the_share_is_that_of_the_area(width):
    """A frame of a width w has the area 1 - (1 - 2 w)^2; cells at its inner edge count in part."""
    problem = SimpleNamespace(modulus=3.0, grid=rc.Grid((24, 40), (1 / 24, 1 / 40)))
    state = SimpleNamespace(stiffness=2 * 3.0 * width, problem=problem, pressure=np.full((24, 40), 7.0))
    expected = 1 - max(1 - 2 * width, 0) ** 2
    assert border_share(state)["border_share"] == pytest.approx(expected, rel=1e-12, abs=1e-15)


def test_the_force_of_one_crest_is_near_the_border_if_the_crest_is():
    """In the middle nothing is near. On the border the contact ends within a, and all of it is near.

    Half a crest under half of the force reaches as far from the border as the whole one under the whole force, or
    less: about Hertz's radius. Both halves together are stiffer than the whole crest, so a exceeds that radius.
    """
    ball = rc.shapes.paraboloid(rc.Grid((96, 96), 1 / 96), radius=1.0)
    shares = {}
    for column in (0, 6, 48):
        # The apex is the corner of four cells: all places are whole cells off.
        moved = rc.Surface(np.roll(ball.heights, column - 48, 1), ball.grid)
        state = rc.press(moved, 1.0, force=4 / 3 * 0.1**3)  # Hertz: a = 0.1
        shares[column] = border_share(state)["border_share"]
    assert shares[48] == 0
    assert shares[0] == pytest.approx(1, rel=1e-12)
    assert 0 < shares[6] < 1


@pytest.fixture
def script(tmp_path, monkeypatch):
    """Return the script that runs studies, with one small study."""
    monkeypatch.syspath_prepend(str(Path(__file__).parents[1] / "benchmarks"))
    import law_ensembles
    import law_run

    (tmp_path / "studies").mkdir()
    (tmp_path / "studies" / "few.toml").write_text(STUDY, encoding="utf-8")
    for module in (law_ensembles, law_run):
        monkeypatch.setattr(module, "STUDIES", tmp_path / "studies")
    yield law_run
    for name in ("law_run", "law_ensembles"):
        del sys.modules[name]


@pytest.fixture
def computed(script, monkeypatch):
    """Return the list of the cases that the script computes: sample, Hurst exponent and crest."""
    cases = []
    original = script.run

    def run(study, folder, on_result):
        tasks = {
            task.key: (task.sample, task.parameters.hurst, task.parameters.crest) for task in study.tasks()
        }

        def seen(result):
            cases.append(tasks[result.key])
            on_result(result)

        return original(study, folder, on_result=seen)

    monkeypatch.setattr(script, "run", run)
    return cases


def collected(folder):
    with xarray.open_dataset(folder / "few.nc", engine="h5netcdf") as data:
        return data.load()


def test_batches_compute_whole_samples_and_a_second_run_nothing(script, computed, tmp_path):
    seen = []
    original = script.collect

    def collect(source, folder):
        original(source, folder)
        seen.append(collected(folder)["sample"].values.tolist())

    script.collect = collect
    script.batches(["few"], tmp_path / "out", tmp_path / "data", 2)
    assert seen == [[0, 1], [0, 1, 2]]
    assert [sample for sample, *_ in computed] == [0] * 4 + [1] * 4 + [2] * 4
    computed.clear()
    script.batches(["few"], tmp_path / "out", tmp_path / "data", 2)
    assert computed == []


def test_another_computer_takes_over_what_was_collected(script, computed, tmp_path):
    script.batches(["few"], tmp_path / "out", tmp_path / "whole", 3)
    whole = collected(tmp_path / "whole")
    part = tmp_path / "part"
    part.mkdir()
    write_netcdf(whole.isel(sample=[0, 2]), part / "few.nc", {})
    computed.clear()
    script.batches(["few"], tmp_path / "other", part, 3)
    assert sorted(computed, key=str) == sorted(
        [(1, hurst, crest) for hurst in (0.6, 1.2) for crest in (None, 0.5)], key=str
    )
    again = collected(part)
    xarray.testing.assert_equal(again, whole)  # rounded twice to the same digits
    assert again["crest"].isnull().values.tolist() == [True, False]


def test_a_stiffness_that_was_missed_stays_missing(script, tmp_path):
    script.batches(["few"], tmp_path / "out", tmp_path / "data", 3)
    found = collected(tmp_path / "data")
    found["dimensionless_stiffness"][1, 0, 2, 1] = np.nan
    write_netcdf(found, tmp_path / "data" / "few.nc", {})
    shutil.rmtree(tmp_path / "out")
    script.batches(["few"], tmp_path / "out", tmp_path / "data", 3)
    missing = collected(tmp_path / "data")["dimensionless_stiffness"].isnull()
    assert int(missing.sum()) == 1
    assert bool(missing[1, 0, 2, 1])


def test_collected_samples_of_another_study_are_refused(script, tmp_path):
    script.batches(["few"], tmp_path / "out", tmp_path / "data", 3)
    file = script.STUDIES / "few.toml"
    file.write_text(file.read_text(encoding="utf-8").replace("seed = 28", "seed = 29"), encoding="utf-8")
    with pytest.raises(SystemExit, match="holds another study"):
        script.batches(["few"], tmp_path / "new", tmp_path / "data", 3)


def test_numbers_are_rounded_to_binary_digits(script):
    from law_ensembles import rounded

    values = xarray.DataArray(np.array([0.0, 1 / 3, np.nan, 2.0, 1e-5], np.float32))
    found = rounded(values, 8)
    assert found.dtype == np.float32
    np.testing.assert_allclose(found, values, rtol=2.0**-8)  # half a digit of a part above 1/2
    np.testing.assert_array_equal(rounded(found, 8), found)
    assert float(found[1]) == round(256 * 2 / 3) / 512
