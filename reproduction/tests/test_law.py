"""The ensembles of the law: their study files, and what the script makes of them."""

import importlib.util
import re
import sys
import tomllib
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import xarray

from roughcontact.files.write import write_netcdf
from roughcontact.study.export import export
from roughcontact.study.run import run
from roughcontact.study.store import Store
from roughcontact.study.study import Study

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / "examples" / "law").glob("*.toml"))


def study(name):
    return Study.read(ROOT / "examples" / "law" / f"{name}.toml")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_study_file_is_one_of_its_name_that_its_case_takes(path):
    assert Study.read(path).name == path.stem
    assert Study.read(path).combinations()
    assert path.read_text(encoding="utf-8").startswith("# E")


def test_every_ensemble_is_there():
    assert {path.name[:2] for path in FILES} == {f"e{number}" for number in range(1, 9)}


def test_surfaces_that_are_compared_are_the_same_draw():
    """E8 is drawn afresh, to test what the others found."""
    seeds = {path.stem: tomllib.loads(path.read_text(encoding="utf-8"))["seed"] for path in FILES}
    assert seeds == {name: 28 if name.startswith("e8") else 27 for name in seeds}


def test_e8_has_the_loads_and_hurst_exponents_of_e1():
    first, again = study("e1-surfaces"), study("e8-cut")
    assert (again.parameters, again.table) == (first.parameters, first.table)
    assert study("e8-border").parameters == first.parameters
    assert {*study("e8-border").table["hurst"]} <= {*first.table["hurst"]}


@pytest.mark.parametrize("name", ["e2-grids", "e3-modes", "e7-sizes"])
def test_waves_of_a_nested_ensemble_have_one_amplitude_on_every_grid(name):
    """The common band of two grids of one surface is the same heights, on the cells that both have in common."""
    wide = [each for each in study(name).combinations() if each.short_cutoff is None]
    lowest = min(each.hurst for each in wide)
    grids = sorted((each for each in wide if each.hurst == lowest), key=lambda each: each.points)
    for coarse, fine in pairwise(grids):
        both = [waves(each) for each in (coarse, fine)]
        # Of the rms height, which is that of about a thousand waves: what rounding leaves of each.
        np.testing.assert_allclose(*both, atol=1e-12 * coarse.rms)


def waves(parameters, highest=20):
    """Return the complex amplitudes of the longest waves, their phases counted from the outer corner."""
    heights = parameters.roughness(np.random.default_rng(3)).heights
    n = parameters.points
    kept = np.fft.fft2(heights)[: highest + 1, : highest + 1] / n**2
    turn = np.exp(-1j * np.pi * np.arange(highest + 1) / n)  # half a cell
    return kept * np.outer(turn, turn)


@pytest.fixture(scope="module")
def script():
    """Return the script that writes the page, as a module."""
    folder = ROOT / "reproduction" / "benchmarks"
    sys.path.insert(0, str(folder))  # it takes those beside it
    spec = importlib.util.spec_from_file_location("law", folder / "law.py")
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    yield found
    for name in [*sys.modules]:
        if name.startswith("law_") or name in ("certificate", "pages", "page_texts"):
            del sys.modules[name]
    sys.path.remove(str(folder))


@pytest.mark.slow
def test_the_pages_show_the_ensembles_that_are_there(script):
    text = "".join(page.read_text(encoding="utf-8") for page in script.PAGES)
    found = script.e3() | script.e7()
    for name, one in found.items():
        if name.endswith(" said"):
            assert one.replace("*", r"\*") in text
        else:
            data = (script.DATA / f"{name}.csv").read_text(encoding="utf-8")
            assert data == script.comma_separated(one)
            assert f":file: ../data/law/{name}.csv\n" in text
    for name, one in ({"runs": script.runs()} | script.result_tables()).items():
        table = script.markdown(one).replace("*", r"\*")
        assert f"<!-- table {name} -->\n{table}\n<!-- end -->" in text


def test_every_data_file_of_the_law_is_in_a_page_and_every_table_is_written(script):
    text = "".join(page.read_text(encoding="utf-8") for page in script.PAGES)
    shown = re.findall(r":file: ../data/law/(\S+)\.csv\n", text)
    assert sorted(shown) == sorted(path.stem for path in script.DATA.glob("*.csv"))
    assert "Not computed yet." not in text


def test_a_page_without_ensembles_says_so(script, tmp_path):
    assert set(script.tables(tmp_path)) == {"runs", "findings"}
    assert script.tables(tmp_path)["findings"] == ""
    page = "a\n<!-- table e3 -->\nold\n<!-- end -->\nb"
    assert script.filled(page, {}) == "a\n<!-- table e3 -->\nNot computed yet.\n<!-- end -->\nb"
    assert script.filled(page, {"e3": "E* L"}) == "a\n<!-- table e3 -->\nE\\* L\n<!-- end -->\nb"
    table = "| H |\n| --- |\n| 1 |"
    assert script.filled(page, {"e3": (["H"], [["1"]])}) == f"a\n<!-- table e3 -->\n{table}\n<!-- end -->\nb"


def test_a_table_without_a_place_in_a_page_is_a_data_file(script, tmp_path, monkeypatch):
    page = tmp_path / "page.md"
    page.write_text("<!-- table here -->\n<!-- end -->\n", encoding="utf-8")
    monkeypatch.setattr(script, "PAGES", (page,))
    monkeypatch.setattr(script, "DATA", tmp_path)
    script.write_pages({"here": (["H"], [["1"]]), "there": (["E* L", "w"], [["1, 2", "-"]]), "words": "E*"})
    assert page.read_text(encoding="utf-8") == "<!-- table here -->\n| H |\n| --- |\n| 1 |\n<!-- end -->\n"
    assert [path.name for path in tmp_path.glob("*.csv")] == ["there.csv"]
    assert (tmp_path / "there.csv").read_text(encoding="utf-8") == 'E* L,w\n"1, 2",\n'


@pytest.mark.parametrize("name", ["e4-models", "e5-patches", "e6-spheres"])
def test_another_solver_finds_the_stiffness_of_a_member(script, name):
    """The certificate bounds displacements to 1e-8 of the largest, by which depths are off; regions are the same."""
    ((_, _, one, other, difference),) = script.check([name])
    assert one == other
    assert float(difference.removeprefix("below ")) <= 1e-8


def test_a_power_law_is_found(script):
    from law_ensembles import law

    force = xarray.DataArray(np.geomspace(1e-3, 0.07, 6), dims="load")
    alpha, zeta = law(force, 1.2 * force**0.6, force > 0)
    assert float(alpha) == pytest.approx(0.6, rel=1e-12)
    assert float(zeta) == pytest.approx(1.2, rel=1e-12)


def test_samples_drawn_again_scatter_as_the_mean_of_them(script):
    """The bootstrap's standard error of a mean is s/sqrt(n); that of 400 replicates is off by 1/sqrt(800)."""
    from law_ensembles import error, resampled

    values = np.random.default_rng(5).normal(size=50)
    found = resampled(xarray.DataArray(values[:, np.newaxis], dims=("sample", "load")))
    assert float(found[0, 0]) == pytest.approx(values.mean(), rel=1e-12)
    expected = values.std(ddof=1) / 50**0.5
    assert float(error(found, 50)[0]) == pytest.approx(expected, rel=4 / 800**0.5)


def test_whole_samples_are_kept_and_grids_of_one_surface_are_found(script, tmp_path):
    from law_ensembles import grid, kept, read

    fixed = {"points": 16, "size": 1.0, "modulus": 1.0, "rms": 0.01, "hurst": 0.8, "loads": 3}
    rows = [{}, {"short_cutoff": 0.25}]
    study = Study(name="few", case="curve", samples=3, parameters=fixed, rows=rows)
    assert run(study, tmp_path / "few").done == 6
    with Store.open(tmp_path / "few") as store:
        exported = export(store, seconds=True)
    exported["case_status"][1, 1] = "missing"
    found = kept(exported)
    assert found["sample"].values.tolist() == [0, 2]
    assert found.attrs["failed"] == 0
    write_netcdf(found, tmp_path / "few.nc", {})
    ensemble = read("few", tmp_path)
    every, cut = grid(ensemble, 16), grid(ensemble, 16, 0.25)
    assert grid(ensemble, 32) is None
    for place, one in enumerate((every, cut)):
        stiffness = exported["dimensionless_stiffness"].isel(row=place, sample=[0, 2])
        np.testing.assert_allclose(
            one["dimensionless_stiffness"], stiffness, rtol=2.0**-23
        )  # single precision
        assert float(one["cell_stiffness"]) == float(np.ravel(exported["cell_stiffness"])[0])


def test_the_library_has_the_law_of_the_ensembles(script):
    """Its table is that of the file, to the last digit, and so are exponents, prefactors and their errors."""
    from law_crest import by_cut, laws_of, table
    from law_ensembles import error, read, value
    from law_formula import LIBRARY, module

    from roughcontact.theory.stiffness_laws import rough_square
    from roughcontact.theory.stiffness_laws.rough_square_table import TABLES

    ensemble = read("e8-cut")
    samples = ensemble.sizes["sample"]
    assert {cut: tuple(rows) for cut, rows in table(ensemble).items()} == TABLES
    assert module(ensemble) == LIBRARY.read_text(encoding="utf-8")
    hurst = ensemble["hurst"].to_numpy()
    for cut, one in by_cut(ensemble).items():
        alpha, level = laws_of(one)
        zeta = level * 0.02**-alpha
        for computed, ours, spread in (
            (alpha, rough_square.exponent(hurst, cut=cut), rough_square.exponent_error(hurst, cut=cut)),
            (zeta, rough_square.prefactor(hurst, cut=cut), rough_square.prefactor_error(hurst, cut=cut)),
        ):
            # The digits of the table: a fiftieth of the errors.
            np.testing.assert_array_less(abs(value(computed) - ours), error(computed, samples) / 50)
            # Linear: an error of 4 % has squares of 0.2 %, and two digits of a correlation are 2 % of an error.
            np.testing.assert_allclose(spread, error(computed, samples), rtol=0.03)
    assert f"{rough_square.LEAST_STIFFNESS:g}" == f"{20 * float(np.ravel(ensemble['cell_stiffness'])[0]):.2g}"


def made_cuts(samples=60):
    """Return an ensemble as E8, of two Hurst exponents: power laws, of which that of the period is 10 % stiffer."""
    rng = np.random.default_rng(1)
    force = np.geomspace(7e-5, 0.07, 16)
    alpha = np.array([0.4, 0.5])
    scatter = 1 + 0.1 * rng.normal(size=(1, 2, samples, 1))
    k = 0.12 * (force / 0.02) ** alpha[:, None, None] * scatter * np.array([1.1, 1.0])[:, None, None, None]
    share = np.broadcast_to(np.where(force > 0.01, 0.06, 0.01), k.shape)
    dims = ("row", "hurst", "sample", "load")
    return xarray.Dataset(
        {
            "dimensionless_stiffness": (dims, k),
            "border_share": (dims, share * np.array([3.0, 1.0])[:, None, None, None]),
            "dimensionless_force": ("load", force),
            "cell_stiffness": (("row", "hurst"), np.full((2, 2), 1e-3)),
        },
        coords={"hurst": [1.0, 1.5], "sample": np.arange(samples)},
        attrs={"study": "", "hours": 0.0, "failed": 0},
    )


def test_interior_loads_end_where_a_twentieth_of_the_force_is_at_the_border(script):
    from law_crest import by_cut, laws_of, misfit, table
    from law_cut import LARGER, PERIOD, mean_effect
    from law_ensembles import value

    made = made_cuts()
    cuts = by_cut(made)
    force = made["dimensionless_force"]
    seen = {cut: force.where(one["inside"]).max("load").to_numpy() for cut, one in cuts.items()}
    assert (seen["interior"] < 0.01).all()
    assert (seen["period"] == force[-1].item()).all()
    assert (seen["patch"] == force[-1].item()).all()
    for cut in ("interior", "period"):
        alpha, _ = laws_of(cuts[cut])
        np.testing.assert_allclose(value(alpha), [0.4, 0.5], rtol=1e-12)
        np.testing.assert_allclose(misfit(cuts[cut]), 0, atol=1e-12)
    # The patch has the period's effect, + 10 %, times the ratio of both effects for one crest, which is negative.
    middle = value(cuts["interior"]["mean"])
    ratio = mean_effect(middle.to_numpy() / 2, LARGER) / mean_effect(middle.to_numpy() / 2, PERIOD)
    assert (ratio < 0).all()
    assert (ratio > -1).all()
    np.testing.assert_allclose(value(cuts["patch"]["mean"]) / middle, 1 + 0.1 * ratio, rtol=1e-9)
    np.testing.assert_allclose(value(cuts["period"]["mean"]) / middle, 1.1, rtol=1e-12)
    rows = table(made)
    # Half of the effect of the border that was not computed is an error.
    for row, of_load, inside in zip(rows["patch"], ratio, cuts["patch"]["inside"].to_numpy(), strict=True):
        assert row[7] >= 0.05 * abs(of_load[inside]).max() - 1e-4
    assert [row[7] for row in rows["interior"]] == [0, 0]


def test_the_tables_of_the_cut(script, tmp_path):
    from law_crest import e8
    from law_cut import PERIOD, mean_effect

    made = made_cuts()
    assert e8(tmp_path) == {}
    write_netcdf(made, tmp_path / "e8-cut.nc", {})
    tables = e8(tmp_path)
    assert [line[3] for line in tables["e8"][1]] == ["0.400 ± 0.000", "0.500 ± 0.000"]
    assert [line[4] for line in tables["e8"][1]] == ["-20.0 ± 0.0 %", "+25.0 ± 0.0 %"]
    assert {line[5].lstrip("+-") for line in tables["e8"][1]} == {"0.0 ± 0.0 %"}
    head, body = tables["e8-cut"]
    assert head[-2:] == ["at 0.07", "theory at 0.07"]
    assert body[0][-2] == "+10.0 ± 0.0 %"
    k = 0.12 * 3.5**0.4
    # The mean of sixty surfaces that scatter by a tenth is 4 % off at most; a printed digit is 0.05 %.
    assert float(body[0][-1].split()[0]) == pytest.approx(
        100 * float(mean_effect(np.array(k / 2), PERIOD)), rel=0.06
    )
    shares = {tuple(line[:2]): line[-1] for line in tables["e8-share"][1]}
    assert shares["1", "interior"] == "6.0 %"
    assert shares["1", "period"] == "18.0 %"
